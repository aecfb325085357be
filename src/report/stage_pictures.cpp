#include "report/stage_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace plumbline::report {

namespace {

constexpr glm::vec4 kNothing{0, 0, 0, 1};

// From dark blue over green to yellow: brighter is more, for any eye and in print.
glm::vec4 ramp(double t) {
  constexpr std::array<glm::vec3, 5> kColors = {glm::vec3(0.27f, 0.00f, 0.33f),
                                                {0.23f, 0.32f, 0.55f},
                                                {0.13f, 0.57f, 0.55f},
                                                {0.37f, 0.79f, 0.38f},
                                                {0.99f, 0.91f, 0.15f}};
  if (!std::isfinite(t)) return {1, 0, 1, 1};
  const double at = std::clamp(t, 0.0, 1.0) * (kColors.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kColors.size() - 2);
  return {glm::mix(kColors[i], kColors[i + 1], static_cast<float>(at - static_cast<double>(i))), 1};
}

glm::vec4 clamped(const glm::vec4& color) {
  glm::vec4 out(0, 0, 0, 1);
  for (int c = 0; c < 3; ++c) out[c] = std::isfinite(color[c]) ? std::clamp(color[c], 0.0f, 1.0f) : 1.0f;
  return out;
}

// Neighbouring numbers get colours far apart.
glm::vec4 color_of_id(std::int32_t id) {
  if (id == kBackground) return kNothing;
  const auto h = (static_cast<std::uint32_t>(id) + 1) * 0x9e3779b1u;
  const auto part = [&](int shift) { return 0.25f + 0.75f * static_cast<float>(h >> shift & 0xffu) / 255.0f; };
  return {part(24), part(16), part(8), 1};
}

double apart(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  return std::isfinite(a - b) ? std::abs(a - b) : std::numeric_limits<double>::infinity();
}
double apart(const glm::vec4& a, const glm::vec4& b) {
  double most = 0;
  for (int c = 0; c < 4; ++c) most = std::max(most, apart(static_cast<double>(a[c]), static_cast<double>(b[c])));
  return most;
}
double apart(std::uint32_t a, std::uint32_t b) { return apart(static_cast<double>(a), static_cast<double>(b)); }
double apart(std::int32_t a, std::int32_t b) { return a == b ? 0 : 1; }
double apart(std::uint8_t a, std::uint8_t b) { return apart(static_cast<double>(a), static_cast<double>(b)); }

template <class T, class Color>
Plane<glm::vec4> painted(const Plane<T>& plane, Color color) {
  Plane<glm::vec4> out(plane.width(), plane.height());
  for (std::size_t i = 0; i < plane.size(); ++i) out.values()[i] = color(plane.values()[i]);
  return out;
}

// Red on grey: full where they differ by `much` or more, the darker the less, down to a ten-thousandth of it.
template <class T>
void mark_differences(const Plane<T>& a, const Plane<T>& b, double much, StagePicture& picture) {
  if (a.empty() || a.width() != b.width() || a.height() != b.height()) return;
  picture.differences = picture.mine;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double off = apart(a.values()[i], b.values()[i]);
    picture.differing += off > 0 ? 1 : 0;
    picture.largest = std::max(picture.largest, off);
    glm::vec4& p = picture.differences.values()[i];
    const float grey = 0.3f * glm::dot(glm::vec3(p), glm::vec3(0.2126f, 0.7152f, 0.0722f));
    const double share = off == 0 ? 0 : std::clamp(1 + std::log10(off / much) / 4, 0.0, 1.0);
    p = off == 0 ? glm::vec4(grey, grey, grey, 1) : glm::vec4(0.15f + 0.85f * static_cast<float>(share), 0, 0, 1);
  }
}

template <class T, class Color>
void add(std::vector<StagePicture>& out, Stage stage, std::string name, std::string says, const Plane<T>& mine,
         const Plane<T>& expected, double much, Color color) {
  if (mine.empty() && expected.empty()) return;
  StagePicture picture{stage, std::move(name), std::move(says), painted(mine, color), painted(expected, color), {}, 0,
                       0};
  mark_differences(mine, expected, much, picture);
  out.push_back(std::move(picture));
}

// The smallest and the largest finite value of both.
std::pair<double, double> range_of(const Plane<double>& a, const Plane<double>& b) {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const Plane<double>* plane : {&a, &b}) {
    for (const double v : plane->values()) {
      if (!std::isfinite(v)) continue;
      lo = std::min(lo, v), hi = std::max(hi, v);
    }
  }
  return lo <= hi ? std::pair(lo, hi) : std::pair(0.0, 1.0);
}

// Depths but for the background's, which is NaN here.
Plane<double> drawn_depths(const Planes& planes) {
  Plane<double> out = planes.depth;
  for (std::size_t i = 0; i < out.size() && planes.id.size() == out.size(); ++i) {
    if (planes.id.values()[i] == kBackground) out.values()[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

constexpr int kContours = 20;

// A line where a pixel's neighbour above or to the right is on another level.
void draw_contours(const Plane<double>& values, double lo, double hi, Plane<glm::vec4>& picture) {
  const auto level = [&](int x, int y) {
    const double v = values(x, y);
    return std::isfinite(v) && hi > lo ? static_cast<int>((v - lo) / (hi - lo) * kContours) : -1;
  };
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const int here = level(x, y);
      const bool line = here >= 0 && ((x + 1 < values.width() && level(x + 1, y) != here) ||
                                      (y + 1 < values.height() && level(x, y + 1) != here));
      if (line) picture(x, y) = glm::vec4(glm::vec3(picture(x, y)) * 0.45f, 1);
    }
  }
}

void add_depth(std::vector<StagePicture>& out, const Capture& mine, const Capture& expected) {
  const Plane<double> a = drawn_depths(mine.planes), b = drawn_depths(expected.planes);
  const auto [lo, hi] = range_of(a, b);
  const auto color = [lo = lo, hi = hi](double z) {
    return std::isnan(z) ? kNothing : ramp(hi > lo ? 1 - (z - lo) / (hi - lo) : 1);
  };
  const std::size_t before = out.size();
  add(out, Stage::depth, "depth",
      fmt::format("window z from {:.6g} (yellow) to {:.6g} (blue), {} contour lines", lo, hi, kContours), a, b, 1e-3,
      color);
  if (out.size() == before) return;
  draw_contours(a, lo, hi, out.back().mine);
  draw_contours(b, lo, hi, out.back().expected);
}

// Of the last fragment drawn at each pixel, `value(i)`; `none` elsewhere. Empty without such records.
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

// As the records have it; else as the plane does.
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

std::vector<StagePicture> stage_pictures(const Scene& scene, const Capture& mine, const Capture& expected) {
  std::vector<StagePicture> out;
  const Planes &a = mine.planes, &b = expected.planes;
  add(out, Stage::coverage, "coverage", "fragments at each pixel: 1 blue, 8 or more yellow", a.count, b.count, 1,
      [](std::uint32_t n) { return n == 0 ? kNothing : ramp(static_cast<double>(n - 1) / 7); });
  add_depth(out, mine, expected);
  const auto fraction = [](float v) { return std::isfinite(v) ? v - std::floor(v) : 1.0f; };
  add(out, Stage::attributes, "texture-coordinates", "s in red, t in green: their fractions", texture_coordinates(mine),
      texture_coordinates(expected), 0.1,
      [&](const glm::vec4& st) { return glm::vec4(fraction(st.x), fraction(st.y), 0, 1); });
  add(out, Stage::texture, "texel", "the winner's texel", texels_of_winners(mine), texels_of_winners(expected), 0.1,
      clamped);
  add(out, Stage::texture, "level-of-detail", "0 blue, 8 yellow", levels_of_detail(mine), levels_of_detail(expected),
      0.5, [](double lod) { return std::isnan(lod) ? kNothing : ramp(lod / 8); });
  add(out, Stage::shade, "shaded", "the winner's colour before it is merged", shaded_winners(scene, mine),
      shaded_winners(scene, expected), 0.1, clamped);
  add(out, Stage::visibility, "primitives", "a colour for each winning primitive", a.id, b.id, 1, color_of_id);
  add(out, Stage::visibility, "stencil", "stencil values: 0 black, 255 yellow", a.stencil, b.stencil, 1,
      [](std::uint8_t s) { return s == 0 ? kNothing : ramp(s / 255.0); });
  add(out, Stage::merge, "colour", "the frame", a.color, b.color, 0.1, clamped);
  return out;
}

std::string positions_drawing(const Scene& scene, const Capture& mine, const Capture& expected, std::size_t most) {
  using Triangles = std::vector<WindowTriangle<double>>;
  const Triangles &a = mine.records.triangles, &b = expected.records.triangles;
  if (a.empty() && b.empty()) return {};
  // Rounding may snap a corner one unit elsewhere, and leave thin triangles out: they are found by their primitive.
  const auto same_place = [](const WindowTriangle<double>& t, const WindowTriangle<double>& w) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::ivec2 off = glm::abs(t.v[k].snapped - w.v[k].snapped);
      if (off.x > 1 || off.y > 1) return false;
    }
    return true;
  };
  const auto is_in = [&](const Triangles& all, const WindowTriangle<double>& t) {
    return std::ranges::any_of(std::ranges::equal_range(all, t.primitive, {}, &WindowTriangle<double>::primitive),
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
      if (is_in(a, t) == differing || drawn >= 2 * most) continue;
      (differing ? expected_alone : same) += path(t, differing ? "expected" : "same");
      ++drawn;
    }
    for (const WindowTriangle<double>& t : a) {
      if (!differing || is_in(b, t) || drawn >= 2 * most) continue;
      mine_alone += path(t, "mine");
      ++drawn;
    }
  }
  return fmt::format("<svg viewBox=\"0 0 {} {}\">\n{}{}{}</svg>\n", scene.frame.width, height, same, expected_alone,
                     mine_alone);
}

}  // namespace plumbline::report
