#include "report/page/stage_pictures.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "check/bounds/bounds.h"

namespace plumbline::report {

namespace {

// Plane of value(i) of the last fragment i drawn at each pixel, `none` elsewhere. Empty without such records.
template <class T, class Value>
Plane<T> of_winners(const Capture& c, T none, std::size_t records, Value value) {
  const Records<double>& r = c.records;
  if (records == 0 || records != r.covered.size() || r.drawn.size() != r.covered.size()) return {};
  Plane<T> out(c.width, c.height, none);
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Covered& at = r.covered[i];
    if (r.drawn[i].drawn && at.x < out.width() && at.y < out.height()) out(at.x, at.y) = value(i);
  }
  return out;
}

Plane<glm::vec4> texture_coordinates(const Capture& c) {
  const auto& fragments = c.records.varyings[Varying::texture].fragments;
  return of_winners(c, glm::vec4(0), fragments.size(), [&](std::size_t i) { return glm::vec4(fragments[i]); });
}

// Texels of the winners' records; planes.texel without such records.
Plane<glm::vec4> texels_of_winners(const Capture& c) {
  const auto& texels = c.records.texels;
  Plane<glm::vec4> out =
      of_winners(c, glm::vec4(0), texels.size(), [&](std::size_t i) { return glm::vec4(texels[i].color); });
  return out.empty() ? c.planes.texel : out;
}

Plane<glm::vec4> shaded_winners(const Scene& scene, const Capture& c) {
  const auto& shaded = c.records.shaded;
  Plane<glm::vec4> out =
      of_winners(c, scene.frame.clear_color, shaded.size(), [&](std::size_t i) { return glm::vec4(shaded[i].color); });
  return out.empty() ? c.planes.shaded : out;
}

Plane<double> levels_of_detail(const Capture& c) {
  const auto& texels = c.records.texels;
  return of_winners(c, std::numeric_limits<double>::quiet_NaN(), texels.size(),
                    [&](std::size_t i) { return texels[i].lod; });
}

}  // namespace

std::vector<Layer> stage_layers(const Scene& scene, const Capture& mine, const Capture& expected) {
  const Planes* const planes[] = {&mine.planes, &expected.planes};
  std::vector<Layer> out = frame_layers(scene, planes);
  const auto add = [&](const char* name, const char* says, const char* paint, std::vector<Stage> judged,
                       auto plane_of) {
    Layer layer{name, says, paint, std::move(judged), {}};
    for (const Capture* capture : {&mine, &expected}) layer.sides.push_back(numbers_of(plane_of(*capture), 0));
    if (!layer.sides[0].empty() || !layer.sides[1].empty()) out.push_back(std::move(layer));
  };
  add("coordinates", "the winner's texture coordinates, s in red, t in green: their fractions", "coordinates",
      {Stage::attributes}, texture_coordinates);
  add("texel", "the winner's texel", "color", {Stage::texture}, texels_of_winners);
  add("level of detail", "0 blue, 8 yellow", "lod", {Stage::texture}, levels_of_detail);
  add("shaded", "the winner's colour before it is merged", "color", {Stage::shade, Stage::attributes, Stage::light},
      [&](const Capture& c) { return shaded_winners(scene, c); });
  std::ranges::stable_sort(out, {}, [](const Layer& layer) { return layer.judged.front(); });
  return out;
}

std::string positions_drawing(const Scene& scene, const Capture& mine, const Capture& expected, std::size_t most) {
  const std::vector<WindowTriangle<double>>&a = mine.records.triangles, &b = expected.records.triangles;
  if (a.empty()) return {};
  // Rounding may snap a corner one unit elsewhere, and drop thin triangles, so triangles are matched by primitive.
  const auto same_place = [](const WindowTriangle<double>& t, const WindowTriangle<double>& w) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::ivec2 off = glm::abs(t.v[k].snapped - w.v[k].snapped);
      if (off.x > 1 || off.y > 1) return false;
    }
    return true;
  };
  const auto is_in = [&](const Records<double>& all, const WindowTriangle<double>& t) {
    return std::ranges::any_of(check::triangles_of(all, static_cast<std::int32_t>(t.primitive)),
                               [&](const WindowTriangle<double>& w) { return same_place(t, w); });
  };
  const bool from_top = rows_from_top(scene.dialect);
  const int height = scene.frame.height;
  const auto path = [&](const WindowTriangle<double>& t, const char* kind) {
    std::string d;
    for (std::size_t k = 0; k < t.corners && k < 3; ++k) {
      const double y = from_top ? t.v[k].p_win.y : height - t.v[k].p_win.y;
      d += fmt::format("{}{:.4f} {:.4f}", k == 0 ? "M" : "L", t.v[k].p_win.x, y);
    }
    return fmt::format("<path class={} d=\"{}{}\"><title>primitive {}</title></path>\n", kind, d,
                       t.corners == 3   ? "Z"
                       : t.corners == 1 ? "h.01"
                                        : "",
                       t.primitive);
  };
  // Those that differ before the others, which the limit may leave out.
  std::string same, expected_alone, mine_alone;
  std::size_t drawn = 0;
  for (const bool differing : {true, false}) {
    for (const WindowTriangle<double>& t : b) {
      if (is_in(mine.records, t) == differing || drawn >= 2 * most) continue;
      (differing ? expected_alone : same) += path(t, differing ? "expected" : "same");
      ++drawn;
    }
    for (const WindowTriangle<double>& t : a) {
      if (!differing || is_in(expected.records, t) || drawn >= 2 * most) continue;
      mine_alone += path(t, "mine");
      ++drawn;
    }
  }
  return fmt::format("<svg class=positions viewBox=\"0 0 {} {}\">\n{}{}{}</svg>\n", scene.frame.width, height, same,
                     expected_alone, mine_alone);
}

}  // namespace plumbline::report
