// Numbers that depths are interpolated in: their arithmetic, and 1/w in place of window z.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/float_depth.h"
#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

using C = Conventions;

namespace {

constexpr double kDoubleError = 1e-3;  // [step]

// A triangle whose depths are multiples of 2^-16, with corners that are exact in float: only interpolation rounds.
struct SlopedTriangle {
  WindowCorners p_win;
  // Shares of the corners at a point.
  glm::dvec3 shares(glm::dvec2 p) const {
    const auto area = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
      return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const glm::dvec2 a(p_win[0]), b(p_win[1]), c(p_win[2]);
    return glm::dvec3(area(b, c, p), area(c, a, p), area(a, b, p)) / area(a, b, c);
  }
  bool holds(glm::dvec2 p) const {
    constexpr double kInside = 0.04;  // no rule and no grid leaves such a sample out
    const glm::dvec3 of = shares(p);
    return std::min({of.x, of.y, of.z}) > kInside;
  }
  double depth(glm::dvec2 p) const { return glm::dot(shares(p), {p_win[0].z, p_win[1].z, p_win[2].z}); }
};

// One large triangle, 59 pixels wide, at the origin.
std::vector<SlopedTriangle> large_and_near() {
  return {{{glm::dvec3(2, 1, 9973 / 65536.0), glm::dvec3(61, 5, 39019 / 65536.0), glm::dvec3(7, 58, 60013 / 65536.0)}}};
}
// One triangle of 2,000 x 6 pixels, along which errors of stepping from pixel to pixel add up.
std::vector<SlopedTriangle> long_and_low() {
  return {
      {{glm::dvec3(1, 1, 9973 / 65536.0), glm::dvec3(2001, 3, 60013 / 65536.0), glm::dvec3(4, 7, 19013 / 65536.0)}}};
}
double on_grid(double p, int bits) { return std::ldexp(std::nearbyint(std::ldexp(p, bits)), -bits); }

// 16 small triangles, 5 pixels wide, near (500, 500), nearly level, so that planes lose little there.
std::vector<SlopedTriangle> small_and_far(int grid_bits) {
  std::vector<SlopedTriangle> out;
  for (int x = 480; x < 504; x += 6) {
    for (int y = 480; y < 504; y += 6) {
      const double z = 20011 + (61 * x + 977 * y) % 30000;
      const auto corner = [&](double right, double up, double depth) {
        return glm::dvec3(on_grid(x + right, grid_bits), on_grid(y + up, grid_bits), (z + depth) / 65536);
      };
      out.push_back({{corner(0.1934, 0.3047, 0), corner(4.9385, 1.1943, 37), corner(1.4404, 3.8115, 83)}});
    }
  }
  return out;
}

// One triangle along the frame's diagonal, 700 pixels long, 2 wide and nearly level: stepped edge functions are large
// beside it, and its area is small.
std::vector<SlopedTriangle> long_and_aslant(int grid_bits) {
  const auto at = [&](double x, double y, double code) {
    return glm::dvec3(on_grid(x, grid_bits), on_grid(y, grid_bits), code / 65536);
  };
  return {{{at(3.1934, 5.3047, 30011), at(503.9385, 489.1943, 30048), at(251.4404, 248.8115, 30094)}}};
}

// Format in which the renderer leaves the depths of a 24-bit frame.
DepthFormat format_of_24(C::Depth format) {
  return format == C::Depth::z16 ? DepthFormat::z16 : format == C::Depth::z32f ? DepthFormat::z32f : DepthFormat::z24;
}

// Calls visit(sample, step, off) for each pixel within the triangle: its sample, the depth format's step [window z],
// and how much farther from the exact depth its depth is than rounding makes it [steps].
void each_depth(const C& c, const SlopedTriangle& t, const Plane<double>& left, auto visit) {
  const auto [low_x, high_x] = std::minmax({t.p_win[0].x, t.p_win[1].x, t.p_win[2].x});
  const auto [low_y, high_y] = std::minmax({t.p_win[0].y, t.p_win[1].y, t.p_win[2].y});
  for (int y = static_cast<int>(low_y); y < static_cast<int>(high_y); ++y) {
    for (int x = static_cast<int>(low_x); x < static_cast<int>(high_x); ++x) {
      const glm::dvec2 sample = glm::dvec2(x, y) + c.sample;
      if (!t.holds(sample)) continue;
      const double z = t.depth(sample), step = depth_step(format_of_24(c.depth_format), z);
      visit(sample, step, farther(0, (left(x, y) - z) / step + middle_of(c.depth_rounding)) - 0.5);
    }
  }
}

// Counts of pixels within triangles: all, and, by arithmetic, those whose depth is within the arithmetic's error of the
// rounded exact depth.
struct Interpolated {
  std::size_t pixels = 0;
  std::array<std::size_t, kNamesOf<C::DepthArithmetic>.size()> fit{};
  double most = 0;  // [steps more than rounding]
};

// Draws the triangles in a frame, and counts.
void count(Prober& prober, glm::ivec2 size, const std::vector<SlopedTriangle>& triangles, Interpolated& out) {
  const C& c = prober.learned.conventions;
  std::vector<std::array<ProbeCorner, 3>> corners;
  for (const SlopedTriangle& t : triangles) {
    const auto corner = [&](std::size_t i) {
      return ProbeCorner{{glm::dvec2(t.p_win[i]), in_volume(c, t.p_win[i].z)}, glm::vec4(1), {}};
    };
    corners.push_back({corner(0), corner(1), corner(2)});
  }
  Scene scene = probe_frame(fmt::format("depth_arithmetic_{}", size.x), size.x, size.y);
  add_triangles(scene, corners);
  scene.frame.depth = DepthFormat::z24;
  const Plane<double> left = prober.draw_depths(scene);
  for (const SlopedTriangle& t : triangles) {
    each_depth(c, t, left, [&](glm::dvec2 sample, double step, double off) {
      out.most = std::max(out.most, off);
      ++out.pixels;
      for (std::size_t i = 0; i < out.fit.size(); ++i) {
        const auto arithmetic = static_cast<C::DepthArithmetic>(i);
        out.fit[i] += off <= kDoubleError + depth_error(arithmetic, t.p_win, sample, size) / step ? 1 : 0;
      }
    });
  }
}

}  // namespace

// Pixels of sloped triangles, each held to the interval of depths that round to its depth.
void learn_depth_arithmetic(Prober& prober) {
  const ConventionWords words = words_of("depth_arithmetic");
  C& c = prober.learned.conventions;
  if (prober.open_if_any_open(words, {"depth_format", "depth_rounding", kSampleWords.name})) return;
  constexpr int kFinest = 10;  // places at multiples of 2^-10 pixel are exact (probe_scene.h)
  // Corners on the grid where depths may use snapped ones; else off the grid, where edge equations in float lose more.
  const int bits = c.depth_corners != C::DepthCorners::as_they_are && c.subpixel_bits != C::kFloat
                       ? std::min(c.subpixel_bits, kFinest)
                       : kFinest;
  Interpolated of;
  count(prober, {64, 64}, large_and_near(), of);
  count(prober, {2048, 8}, long_and_low(), of);
  count(prober, {512, 512}, small_and_far(bits), of);
  count(prober, {512, 512}, long_and_aslant(bits), of);
  const std::size_t exact = of.fit.front();
  std::string evidence = fmt::format("{} of {} depths are rounded from the exact depth", exact, of.pixels);
  if (exact < of.pixels) evidence += fmt::format("; others by up to {:.3g} steps more than rounding", of.most);
  const auto first = std::ranges::find(of.fit, of.pixels);  // from the least errors to the largest
  if (first == of.fit.end()) return prober.fits_none(words, evidence);
  c.depth_arithmetic = static_cast<C::DepthArithmetic>(first - of.fit.begin());
  prober.found(words, name_of(c.depth_arithmetic), evidence);
}

namespace {

constexpr int kSide = 64;                     // pixels
constexpr double kOfMatrices = 16 * 0x1p-24;  // window z: of corners by float matrices

// A triangle in perspective: near and far plane, and its corners' w. Window positions and z_clip are exact in float,
// and window z lies in the far half.
struct View {
  const char* name;
  double near, far;
  std::array<double, 3> w;
  // Window z of a point.
  double z(double of_w, C::ClipDepth volume) const {
    const double out = far / (far - near) * (1 - near / of_w);
    return volume == C::ClipDepth::zero_to_w ? 2 * out - 1 : out;
  }
};

// The far plane 1/512 behind the near one: a float's step of 1/w moves window z by some 500 of its own steps.
constexpr double kThin = 0x1p-13;
constexpr View kSteep = {"depth_of", 0.5, 0.5 + 8 * kThin, {0.5 + 5 * kThin, 0.5 + 6 * kThin, 0.5 + 7 * kThin}};
// Where a depth that is interpolated with perspective is far off, by window z and by 1/w.
constexpr View kWide = {"depth_of_wide", 0.5, 1, {11 / 16.0, 13 / 16.0, 15 / 16.0}};

// Depths in a view: all, and those as by window z and as by 1/w.
struct InPerspective {
  std::size_t pixels = 0, by_z = 0, by_inv_w = 0;
};

// Counts of the view's triangle, which is drawn.
void count_in_perspective(Prober& prober, const View& view, C::DepthArithmetic arithmetic, InPerspective& out) {
  constexpr std::array places = {glm::dvec2(3, 5), glm::dvec2(59, 12), glm::dvec2(21, 58)};
  const C& c = prober.learned.conventions;
  SlopedTriangle in_window;
  std::array<std::array<ProbeCorner, 3>, 1> corners;  // eye space
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = view.w[i];
    in_window.p_win[i] = {places[i], view.z(w, c.clip_depth)};
    corners[0][i] = {{w * (2.0 * places[i] / double{kSide} - 1.0), w}, glm::vec4(1), {}};
  }
  Scene scene = probe_frame(view.name, kSide, kSide);
  scene.projection = Perspective{90, view.near, view.far};
  add_triangles(scene, corners);
  scene.frame.depth = DepthFormat::z24;
  const double of_zero = view.z(std::numeric_limits<double>::infinity(), c.clip_depth);
  each_depth(c, in_window, prober.draw_depths(scene), [&](glm::dvec2 sample, double step, double off) {
    const auto fits = [&](std::optional<double> z_of_zero) {
      const double error = depth_error(arithmetic, in_window.p_win, sample, glm::dvec2(kSide), z_of_zero);
      return off <= kDoubleError + (kOfMatrices + error) / step ? 1 : 0;
    };
    ++out.pixels;
    out.by_z += fits(std::nullopt), out.by_inv_w += fits(of_zero);
  });
}

}  // namespace

// Pixels of triangles in perspective, held to the errors of window z that is interpolated, and of 1/w that is.
void learn_depth_of(Prober& prober) {
  const ConventionWords words = words_of("depth_of");
  C& c = prober.learned.conventions;
  if (prober.open_if_any_open(words, {"depth_format", "depth_rounding", kSampleWords.name})) return;
  const auto arithmetic =
      prober.is_open("depth_arithmetic") ? C::DepthArithmetic::in_float_from_origin : c.depth_arithmetic;
  InPerspective of;
  for (const View& view : {kSteep, kWide}) count_in_perspective(prober, view, arithmetic, of);
  const bool is_of_z = of.by_z == of.pixels;
  const std::string evidence = fmt::format("two views in perspective: {} of {} depths as by window z {}, {} as by 1/w",
                                           of.by_z, of.pixels, name_of(arithmetic), of.by_inv_w);
  if (!is_of_z && of.by_inv_w < of.pixels) return prober.fits_none(words, evidence);
  c.depth_of = is_of_z ? C::DepthOf::z : C::DepthOf::inv_w;
  prober.found(words, name_of(c.depth_of), evidence);
}

}  // namespace plumbline::learn
