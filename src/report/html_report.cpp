#include "report/html_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace plumbline::report {

namespace {

constexpr std::string_view kStyle = R"(
img { width: 256px; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
tr.different td, tr.failed td, tr.missing td { background: #d3323233; }
tr.dispute td { background: #d3a03233; }
tr.unsupported td { opacity: .55; }
)";

// |a - b| per channel, times 8, so that a small difference is seen; opaque. White where one side is not finite.
Plane<glm::vec4> difference_picture(const Plane<glm::vec4>& a, const Plane<glm::vec4>& b) {
  Plane<glm::vec4> out(a.width(), a.height());
  for (std::size_t i = 0; i < out.size(); ++i) {
    glm::vec4 d(1);
    for (int c = 0; c < 3; ++c) {
      const double diff = check::difference(a.values()[i][c], b.values()[i][c]);
      d[c] = std::isfinite(diff) ? static_cast<float>(std::min(8 * diff, 1.0)) : 1.0f;
    }
    out.values()[i] = d;
  }
  return out;
}

std::string row(const check::Comparison& c) {
  const check::Measurement& m = c.measurement;
  const check::Worst* worst = check::shown(c);
  const std::string largest = worst != nullptr ? fmt::format("{:.4g} {}", worst->difference, m.unit)
                              : m.items > 0    ? "0"
                                               : "";
  return fmt::format(
      "<tr class=\"{}\"><td>{}<td>{}<td>{}<td class=number>{}<td class=number>{}<td class=number>{}<td "
      "class=number>{}<td class=number>{}<td>{}</tr>\n",
      name_of(c.outcome), escaped(c.reference), name_of(c.stage), name_of(c.outcome), m.items, m.differing, m.ambiguous,
      escaped(largest), worst != nullptr ? fmt::format("{:.4g}", worst->tolerance) : "", escaped(check::remark(c)));
}

}  // namespace

// Scenes of two folders may have one name.
std::string HtmlReport::free_folder(const std::string& scene) {
  const std::string name = file_name(scene);
  std::string free = name;
  for (int i = 2; !folders_.insert(free).second; ++i) free = fmt::format("{}-{}", name, i);
  return free;
}

namespace {

// What a judge of records has drawn nothing for, it draws for the reader; empty where it cannot.
Plane<glm::vec4> picture_of(const Scene& scene, const check::Reference& reference, const Capture& drawn) {
  if (!drawn.planes.color.empty() || reference.renderer == nullptr) return drawn.planes.color;
  try {
    Request request;
    request.planes = WantedPlanes::picture;
    return reference.renderer->capture(scene, request).planes.color;
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

void HtmlReport::add(const check::SceneVerdict& verdict, std::span<const check::Reference> references,
                     const check::Drawn& drawn, const Scene& scene) {
  const std::string scene_folder = free_folder(verdict.scene);
  const auto picture = [&](const Plane<glm::vec4>& plane, const std::string& name, const std::string& caption) {
    if (plane.empty()) return;
    const std::string file = fmt::format("{}/{}.png", scene_folder, file_name(name));
    Plane<glm::vec4> opaque = rows_from_top(scene.dialect) ? upside_down(plane) : plane;
    for (glm::vec4& color : opaque.values()) color.a = 1;  // what is behind the page is none of the frame's
    page_.write_picture(file, opaque);
    body_ += fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" loading=lazy></a>"
        "<figcaption>{1}</figcaption></figure>\n",
        file, escaped(caption));
  };
  body_ += fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n", scene_folder, escaped(verdict.scene),
                       escaped(scene.description));
  const Plane<glm::vec4>& ours = drawn.candidate.planes.color;
  picture(ours, "ours", "ours");
  for (std::size_t i = 0; i < references.size() && i < drawn.references.size(); ++i) {
    const Plane<glm::vec4> theirs = picture_of(scene, references[i], drawn.references[i]);
    picture(theirs, references[i].name, references[i].name);
    if (ours.size() != theirs.size() || ours.width() != theirs.width()) continue;
    picture(difference_picture(ours, theirs), references[i].name + "-difference",
            "ours - " + references[i].name + ", times 8");
  }
  body_ +=
      "<table><tr><th>reference<th>stage<th>outcome<th>pixels<th>differing<th>ambiguous<th>largest<th>tolerance"
      "<th>worst</tr>\n";
  for (const check::Comparison& c : verdict.comparisons) body_ += row(c);
  body_ += "</table>\n";
}

void HtmlReport::write(const std::string& summary) {
  page_.commit("plumbline", kStyle, fmt::format("<h1>plumbline check</h1>\n<p>{}</p>\n{}", escaped(summary), body_));
}

}  // namespace plumbline::report
