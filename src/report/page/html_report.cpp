#include "report/page/html_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/files/image_file.h"
#include "report/page/viewer_data.h"
#include "report/page/web_files.h"
#include "report/text/safe_text.h"

namespace plumbline::report {

namespace {

using Json = nlohmann::ordered_json;

// 5 MB, but for the style and the list of files.
constexpr std::size_t kBytesOfPage = 4'930'000, kBytesOfScene = 46'000, kBytesOfColor = 7'000;

std::string text_of(const Json& json) { return in_script(json.dump(-1, ' ', false, Json::error_handler_t::replace)); }

// The plane reduced to at most 96 pixels a side by means; opaque, so that the page's background does not show.
Plane<glm::vec4> thumbnail(const Plane<glm::vec4>& plane) {
  constexpr int kSide = 96;
  const int side = std::max(plane.width(), plane.height());
  const auto shrunk = [&](int length) { return side > kSide ? std::max(1, length * kSide / side) : length; };
  Plane<glm::vec4> out(shrunk(plane.width()), shrunk(plane.height()));
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const auto from = [](int at, int of, int all) { return static_cast<int>(std::int64_t{at} * all / of); };
      glm::vec4 sum(0);
      for (int v = from(y, out.height(), plane.height()); v < from(y + 1, out.height(), plane.height()); ++v) {
        for (int u = from(x, out.width(), plane.width()); u < from(x + 1, out.width(), plane.width()); ++u) {
          for (int c = 0; c < 3; ++c) {
            const float value = plane(u, v)[c];
            sum[c] += std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f;
          }
          sum.a += 1;
        }
      }
      out(x, y) = sum / sum.a;
    }
  }
  return out;
}

// The worst outcome of the scene's rows; "fails" if the scene fails and none of its rows does.
std::string_view outcome_of(const check::SceneVerdict& verdict, bool fails) {
  using check::Outcome;
  constexpr Outcome kWorstFirst[] = {Outcome::failed,  Outcome::missing,        Outcome::different, Outcome::expected,
                                     Outcome::dispute, Outcome::ambiguous_only, Outcome::within,    Outcome::equal};
  for (const Outcome outcome : kWorstFirst) {
    if (fails && !is_failure(outcome)) return "fails";
    if (std::ranges::count(verdict.comparisons, outcome, &check::Comparison::outcome) > 0) return name_of(outcome);
  }
  return name_of(Outcome::unsupported);
}

// Planes of the reference's capture; planes that the reference draws for the page, where the capture has no colour.
Planes planes_of(const Scene& scene, const check::Reference& reference, const Capture& drawn) {
  if (!drawn.planes.color.empty() || reference.renderer == nullptr) return drawn.planes;
  try {
    return reference.renderer->capture(scene, Request{}).planes;
  } catch (const std::exception&) {
    return drawn.planes;
  }
}

Viewed viewed_of(const std::string& name, std::span<const check::Reference> references,
                 const check::BothCaptures& drawn, const Scene& scene) {
  const Plane<glm::vec4>& ours = drawn.candidate.planes.color;
  Viewed out{name, ours.width(), ours.height(), rows_from_top(scene.dialect), {"ours"}, {}};
  std::vector<Planes> drawn_for_reader;
  drawn_for_reader.reserve(references.size());
  std::vector<const Planes*> sides{&drawn.candidate.planes};
  for (std::size_t i = 0; i < references.size() && i < drawn.references.size(); ++i) {
    const Planes& planes = drawn_for_reader.emplace_back(planes_of(scene, references[i], drawn.references[i]));
    if (planes.color.empty() && planes.depth.empty()) continue;
    out.sides.push_back(references[i].name);
    sides.push_back(&planes);
  }
  if (ours.empty()) {  // what was expected is shown nevertheless
    out.width = scene.frame.width;
    out.height = scene.frame.height;
  }
  out.layers = frame_layers(scene, sides);
  return out;
}

}  // namespace

HtmlReport::HtmlReport(const std::filesystem::path& folder, std::size_t scenes)
    : page_(folder), share_(std::max(kBytesOfScene, 100 * kBytesOfScene / std::max<std::size_t>(scenes, 1))) {}

// Scenes of two folders may have one name.
std::string HtmlReport::free_name(const std::string& scene) {
  const std::string name = file_name(scene);
  std::string free = name;
  for (int i = 2; !names_.insert(free).second; ++i) free = fmt::format("{}-{}", name, i);
  return free;
}

void HtmlReport::put(const std::string& file, std::string_view bytes) {
  page_.write(file, bytes);
  written_ += bytes.size();
}

HtmlReport::Drawing HtmlReport::draw(const check::SceneVerdict& verdict, std::span<const check::Reference> references,
                                     const check::BothCaptures& drawn, const Scene& scene, const std::string& failure,
                                     const std::string& repeat) const {
  const check::Comparison* first = check::first_different(verdict);
  Drawing out;
  out.scene = verdict.scene;
  out.description = scene.description;
  out.fails = !failure.empty();
  out.outcome = outcome_of(verdict, out.fails);
  if (first != nullptr) out.first = name_of(first->stage);
  if (const Plane<glm::vec4>& ours = drawn.candidate.planes.color; !ours.empty()) {
    const Plane<glm::vec4> small = thumbnail(ours);
    out.thumbnail = encode_png("thumbnail.png", rows_from_top(scene.dialect) ? upside_down(small) : small);
  }
  Json about{{"description", scene.description},
             {"failure", failure},
             {"repeat", repeat},
             {"first", first != nullptr ? Json(first - verdict.comparisons.data()) : Json(nullptr)},
             {"color_alone", false}};
  Viewed viewed = viewed_of(verdict.scene, references, drawn, scene);
  const auto script = [&](std::size_t bytes) {
    return fmt::format("sceneArrived({{...{}, view: {}}});\n", text_of(about),
                       in_script(viewer_json(viewed, verdict.comparisons, scene.frame.antialias.factor, bytes)));
  };
  out.all = script(share_ - std::min(out.thumbnail.size(), share_));
  if (out.fails || out.outcome == name_of(check::Outcome::dispute)) return out;
  std::erase_if(viewed.layers, [](const Layer& layer) { return layer.name != "colour"; });
  about["color_alone"] = true;
  out.color_alone = script(kBytesOfColor);
  return out;
}

void HtmlReport::add(Drawing drawing) {
  const std::string key = free_name(drawing.scene);
  Json card{{"key", key},
            {"name", drawing.scene},
            {"group", check::group_of(drawing.scene)},
            {"description", drawing.description},
            {"outcome", drawing.outcome},
            {"fails", drawing.fails},
            {"first", drawing.first.empty() ? Json(nullptr) : Json(drawing.first)},
            {"file", key + ".js"},
            {"thumbnail", nullptr}};
  if (!drawing.thumbnail.empty()) {
    card["thumbnail"] = key + ".png";
    put(key + ".png", drawing.thumbnail);
  }
  scenes_ += (scenes_.empty() ? "" : ",\n") + text_of(card);
  if (drawing.color_alone.empty()) return put(key + ".js", drawing.all);
  holding_.push_back({key + ".js", std::move(drawing.all), std::move(drawing.color_alone)});
}

void HtmlReport::write(const std::string& summary) {
  std::string html(web_file("check_page.html"));
  const std::string_view here = "{summary}";
  html.replace(html.find(here), here.size(), escaped(summary));
  const std::string script =
      web_files({"dom.js", "planes.js", "difference.js", "viewer.js", "rows.js", "scene_view.js", "check_page.js"});
  const std::string body = fmt::format(
      "{}<script type=\"application/json\" id=\"report\">{{\"stages\": {}, \"scenes\": [\n{}]}}</script>\n"
      "<script>\n{}</script>\n",
      html, Json(kStageNames).dump(), scenes_, script);
  std::size_t least = written_ + body.size();
  for (const Holding& scene : holding_) least += scene.color_alone.size();
  for (const Holding& scene : holding_) {
    const std::size_t more = scene.all.size() - std::min(scene.all.size(), scene.color_alone.size());
    const bool fits = least + more <= kBytesOfPage;
    if (fits) least += more;
    put(scene.file, fits ? scene.all : scene.color_alone);
  }
  page_.commit("plumbline check", web_file("viewer.css"), body);
}

}  // namespace plumbline::report
