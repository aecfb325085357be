#include "report/html_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "report/text_file.h"
#include "stages/image_file.h"

namespace plumbline::report {

namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; }
body { font: 14px/1.4 system-ui, sans-serif; margin: 2em; max-width: 100em; }
h1 { font-size: 1.4em; } h2 { font-size: 1.1em; margin-top: 2em; }
figure { display: inline-block; margin: 0 1em 1em 0; }
img { image-rendering: pixelated; width: 256px; height: auto; border: 1px solid #8888; }
figcaption { font-size: 12px; }
table { border-collapse: collapse; font-size: 12px; }
th, td { text-align: left; padding: 1px 10px 1px 0; white-space: nowrap; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
tr.different td, tr.failed td, tr.missing td { background: #d3323233; }
tr.dispute td { background: #d3a03233; }
tr.unsupported td { opacity: .55; }
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

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
  const std::string place = m.max_difference > 0 ? check::to_string(m.worst.place) : "";
  const std::string largest = m.max_difference > 0 ? fmt::format("{:.4g} {}", m.worst.difference, m.unit)
                              : m.items > 0        ? "0"
                                                   : "";
  return fmt::format(
      "<tr class=\"{}\"><td>{}<td>{}<td>{}<td class=number>{}<td class=number>{}<td class=number>{}<td "
      "class=number>{}<td class=number>{}<td>{}</tr>\n",
      name_of(c.outcome), escaped(c.reference), name_of(c.stage), name_of(c.outcome), m.items, m.differing, m.ambiguous,
      escaped(largest), m.max_difference > 0 ? fmt::format("{:.4g}", m.worst.tolerance) : "",
      escaped(place + (place.empty() || c.note.empty() ? "" : "; ") + c.note));
}

}  // namespace

HtmlReport::HtmlReport(std::filesystem::path folder) : folder_(std::move(folder)) {}

void HtmlReport::add(const check::SceneVerdict& verdict, std::span<const check::Reference> references,
                     const check::Drawn& drawn, const std::string& description) {
  const std::filesystem::path scene_folder = folder_ / verdict.scene;
  std::filesystem::create_directories(scene_folder);
  const auto picture = [&](const Plane<glm::vec4>& plane, const std::string& name, const std::string& caption) {
    if (plane.empty()) return;
    write_png(scene_folder / (name + ".png"), plane);
    body_ += fmt::format(
        "<figure><a href=\"{0}/{1}.png\"><img src=\"{0}/{1}.png\" alt=\"{2}\" loading=lazy></a>"
        "<figcaption>{2}</figcaption></figure>\n",
        escaped(verdict.scene), escaped(name), escaped(caption));
  };
  body_ += fmt::format("<h2 id=\"{0}\">{0}</h2>\n<p>{1}</p>\n", escaped(verdict.scene), escaped(description));
  const Plane<glm::vec4>& ours = drawn.candidate.planes.color;
  picture(ours, "ours", "ours");
  for (std::size_t i = 0; i < references.size() && i < drawn.references.size(); ++i) {
    const Plane<glm::vec4>& theirs = drawn.references[i].planes.color;
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

void HtmlReport::write(const std::string& summary) const {
  std::filesystem::create_directories(folder_);
  write_text(folder_ / "index.html",
             fmt::format("<!doctype html>\n<html lang=en><meta charset=utf-8><title>plumbline</title>\n"
                         "<style>{}</style>\n<h1>plumbline check</h1>\n<p>{}</p>\n{}</html>\n",
                         kStyle, escaped(summary), body_));
}

}  // namespace plumbline::report
