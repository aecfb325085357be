#include "capture/contradictions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace plumbline {

namespace {

using Lines = std::vector<std::string>;

// Statistics of a plane's numbers: how many there are, how many lie outside [0,1] or are not finite, and their range.
struct Range {
  std::size_t count = 0, outside = 0, not_finite = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool whole = true;  // all of them are whole numbers
  void add(double v) {
    ++count;
    if (!std::isfinite(v)) {
      ++not_finite;
      return;
    }
    low = std::min(low, v), high = std::max(high, v);
    outside += v < 0 || v > 1;
    whole = whole && v == std::floor(v);
  }
};

void check_range(const char* array, const Range& r, Lines& out) {
  if (r.not_finite > 0)
    out.push_back(fmt::format("{}: {} of {} values are NaN or infinite", array, r.not_finite, r.count));
  if (r.outside == 0) return;
  const bool codes = r.whole && r.high > 1;
  const char* probably = codes                        ? ": codes? code / (2^n - 1) is expected"
                         : r.low >= -1 && r.high <= 1 ? ": still in [-1,1]? z / 2 + 1/2 is expected"
                                                      : "";
  out.push_back(fmt::format("{}: {} of {} values are outside [0,1], from {:.6g} to {:.6g}{}", array, r.outside, r.count,
                            r.low, r.high, probably));
}

void check_depth(const Capture& c, Lines& out) {
  Range depth;
  for (const double z : c.planes.depth.values()) depth.add(z);
  check_range("planes.depth", depth, out);
  Range fragments;
  for (const double z : c.records.depth) fragments.add(z);
  check_range("depth.value", fragments, out);
}

void check_color(const Capture& c, Lines& out) {
  Range color;
  for (const glm::vec4& v : c.planes.color.values()) {
    for (int channel = 0; channel < 4; ++channel) color.add(static_cast<double>(v[channel]));
  }
  constexpr double kLeastCode = 15;  // a float frame may hold whole numbers: a few
  if (color.not_finite > 0 || (color.whole && color.high >= kLeastCode)) check_range("planes.color", color, out);
}

// Number of pixels at which two planes contradict each other: as they are, and with the first plane's rows reversed.
struct Apart {
  std::size_t as_is = 0, flipped = 0;
};
template <class A, class Contradicts>
Apart apart(const Plane<A>& a, int width, int height, const Contradicts& contradicts) {
  Apart out;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      out.as_is += contradicts(a(x, y), x, y);
      out.flipped += contradicts(a(x, height - 1 - y), x, y);
    }
  }
  return out;
}

void report(const Apart& apart, const char* array, const std::string& what, const char* other, Lines& out) {
  if (apart.as_is == 0) return;
  const std::string upside_down =
      apart.flipped == 0 ? fmt::format("; none, if its rows are turned over: is it, or {}, upside down?", other) : "";
  out.push_back(fmt::format("{}: {} pixels {}{}", array, apart.as_is, what, upside_down));
}

void check_winners(const Capture& c, Lines& out) {
  const Planes& p = c.planes;
  if (p.id.empty()) return;
  if (!p.count.empty()) {
    report(apart(p.id, c.width, c.height,
                 [&](std::int32_t id, int x, int y) { return id != kBackground && p.count(x, y) == 0; }),
           "planes.id", "have a winner where planes.count says that nothing is drawn", "planes.count", out);
  }
  if (p.color.empty()) return;
  // Pixels without a winner have one colour, that of the cleared frame.
  const auto background = [&](bool flipped) -> std::size_t {
    const glm::vec4* first = nullptr;
    std::size_t others = 0;
    for (int y = 0; y < c.height; ++y) {
      for (int x = 0; x < c.width; ++x) {
        if (p.id(x, flipped ? c.height - 1 - y : y) != kBackground) continue;
        if (first == nullptr) first = &p.color(x, y);
        others += p.color(x, y) != *first;
      }
    }
    return others;
  };
  report({background(false), background(true)}, "planes.id",
         "are background (-1) and differ in planes.color from the first such pixel", "planes.color", out);
}

// Contradictions of a capture without window triangles, which lines and points would have, too.
void check_window(const Capture& c, Lines& out) {
  if (!c.without_records.contains("window")) return;
  const auto drawn = [&](const char* array, std::ptrdiff_t pixels) {
    if (pixels > 0) out.push_back(fmt::format("window.*: no triangle, and {} shows {} drawn pixels", array, pixels));
  };
  const Planes& p = c.planes;
  drawn("planes.id", std::ranges::count_if(p.id.values(), [](std::int32_t id) { return id != kBackground; }));
  drawn("planes.count", std::ranges::count_if(p.count.values(), [](std::uint32_t n) { return n > 0; }));
  const auto differs = [&](const glm::vec4& color) { return color != p.color.values().front(); };
  drawn("planes.color", std::ranges::count_if(p.color.values(), differs));
}

// Corners of which nothing that follows can be judged.
void check_finite_corners(const Capture& c, Lines& out) {
  std::size_t places = 0, inv_w = 0, colors = 0, corners = 0;
  for (const WindowTriangle<double>& t : c.records.triangles) {
    for (const WindowVertex<double>& v : t.v) {
      ++corners;
      places += !std::isfinite(v.p_win.x + v.p_win.y);
      inv_w += !std::isfinite(v.inv_w);
      colors += !std::isfinite(v.color.r + v.color.g + v.color.b + v.color.a);
    }
  }
  const auto report_column = [&](const char* column, std::size_t count) {
    if (count > 0) out.push_back(fmt::format("{}: {} of {} corners are not finite", column, count, corners));
  };
  report_column("window.p_win", places);
  report_column("window.inv_w", inv_w);
  report_column("window.color", colors);
}

// Range of places [1/256 pixel from the first pixel's centre] that a coordinate p_win [pixels] may be snapped to, in a
// frame whose side along the axis is `length` pixels. Allowed besides the declared rounding: towards the frame beyond
// it, and towards the first pixel's centre before it, as (int)x is; of a coarse grid, positions that were rounded to
// 1/256 pixel first.
SnappedRange places_of(double p_win, int axis, int length, const Conventions& conventions, bool is_declared) {
  constexpr double kUndeclared = 2 * kSubpixel;  // a grid of whole pixels, whose sample may be anywhere in them
  const double steps = (p_win - 0.5) * kSubpixel, rounding = std::max(0x1p-20 * std::abs(steps), 0x1p-9);
  if (!is_declared) return {steps - kUndeclared, steps + kUndeclared};
  const double from_side = p_win - 0.5 + conventions.sample[axis];  // in the renderer's own window
  // A grid that is finer than window.snapped, or none, is rounded to it in any way.
  const bool is_fine = conventions.subpixel_bits == Conventions::kFloat || conventions.subpixel_bits > 8;
  if (is_fine) {
    const double own = (from_side - 0.5) * kSubpixel, moved = std::round(steps - own);  // as to_dialect() moves snapped
    return {std::floor(own - rounding) + moved, std::ceil(own + rounding) + moved};
  }
  const double cell = std::ldexp(kSubpixel, -conventions.subpixel_bits), error = cell > 1 ? 0.5 + rounding : rounding;
  return {snapped_range(conventions, axis, steps - error).least - (from_side > length ? cell : 0),
          snapped_range(conventions, axis, steps + error).most + (from_side < 0.5 ? cell : 0)};
}

// window.snapped against window.p_win, where both are handed out.
void check_snapped(const Capture& c, const Conventions& conventions, Lines& out) {
  if (c.records.triangles.empty() || c.derived.contains("window.snapped")) return;
  const auto is_open = [&](std::string_view name) { return leaves_open(conventions, name); };
  constexpr std::array<std::string_view, 4> kOfGrid = {"subpixel_bits", "sample", "subpixel_rounding", "window_y"};
  const bool is_declared = !(conventions == undeclared()) && std::ranges::none_of(kOfGrid, is_open);
  std::size_t apart = 0, corners = 0;
  std::string first;
  for (std::size_t i = 0; i < c.records.triangles.size(); ++i) {
    for (const WindowVertex<double>& v : c.records.triangles[i].v) {
      ++corners;
      const auto is_there = [&](int axis) {
        const int length = axis == 0 ? c.width : c.height;
        const auto [least, most] = places_of(v.p_win[axis], axis, length, conventions, is_declared);
        return !std::isfinite(v.p_win[axis]) || (v.snapped[axis] >= least && v.snapped[axis] <= most);
      };
      if (is_there(0) && is_there(1)) continue;
      if (apart++ == 0)
        first = fmt::format("record {} at ({:.9g} {:.9g}) pixel is snapped to ({} {}) / 256", i, v.p_win.x, v.p_win.y,
                            v.snapped.x, v.snapped.y);
    }
  }
  if (apart > 0)
    out.push_back(fmt::format("window.snapped: {} of {} corners are not window.p_win{}: {}", apart, corners,
                              is_declared ? ", rounded as the conventions declare" : "", first));
}

void check_coverage(const Capture& c, Lines& out) {
  const std::vector<Covered>& covered = c.records.covered;
  if (covered.empty() || c.planes.count.empty()) return;
  Plane<std::uint32_t> count(c.width, c.height);
  for (const Covered& f : covered) ++count(f.x, f.y);
  report(apart(count, c.width, c.height, [&](std::uint32_t n, int x, int y) { return n != c.planes.count(x, y); }),
         "coverage.y", "have another number of fragments than planes.count says", "planes.count", out);
}

// Contradictions of a plane of the winners: where the winner has one fragment at the pixel, the plane holds the
// fragment's record. Not called where fragments contradict planes.count: their pixels are in doubt.
template <class Record>
void check_plane_of_winner(const Capture& c, const Plane<glm::vec4>& plane, const std::vector<Record>& records,
                           const char* array, const char* column, Lines& out) {
  constexpr float kApart = 0x1p-20f;  // a few roundings of float, of numbers up to 1
  const Planes& p = c.planes;
  const Records<double>& r = c.records;
  if (plane.empty() || p.id.empty() || records.empty() || records.size() != r.covered.size()) return;
  Plane<std::uint32_t> fragments(c.width, c.height);
  Plane<glm::vec4> color(c.width, c.height);
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Covered& f = r.covered[i];
    if (f.triangle >= r.triangles.size()) continue;
    if (static_cast<std::int64_t>(r.triangles[f.triangle].primitive) != p.id(f.x, f.y)) continue;
    ++fragments(f.x, f.y);
    color(f.x, f.y) = glm::vec4(records[i].color);
  }
  const auto is_alike = [&](float v, float of_winner) {
    return v == of_winner || (std::isnan(v) && std::isnan(of_winner)) ||
           std::abs(v - of_winner) <= kApart * std::max(1.0f, std::abs(of_winner));
  };
  const auto differs = [&](const glm::vec4& v, int x, int y) {
    bool any = false;
    for (int i = 0; i < 4; ++i) any = any || !is_alike(v[i], color(x, y)[i]);
    return fragments(x, y) == 1 && any;
  };
  const std::string what = fmt::format("differ from {} of the winner's fragment", column);
  report(apart(plane, c.width, c.height, differs), array, what, "coverage.y", out);
}

void check_texels(const Capture& c, Lines& out) {
  check_plane_of_winner(c, c.planes.texel, c.records.texels, "planes.texel", "texture.color", out);
}
void check_shaded(const Capture& c, Lines& out) {
  check_plane_of_winner(c, c.planes.shaded, c.records.shaded, "planes.shaded", "shade.color", out);
}

double relative(const Vec4<double>& got, const Vec4<double>& expected) {
  double apart = 0, size = 0;
  for (int i = 0; i < 4; ++i) {
    apart = std::max(apart, std::abs(got[i] - expected[i]));
    size = std::max(size, std::abs(expected[i]));
  }
  return apart / std::max(size, 1e-30);
}

// Each p_clip must be some draw's projection * p_eye: records do not say which draw a vertex is of.
void check_matrices(const Capture& c, Lines& out) {
  constexpr double kApart = 1e-3;  // far beyond float's rounding, unless everything cancels
  const Records<double>& r = c.records;
  if (r.matrices.empty() || r.vertices.empty() || c.derived.contains("vertex.p_eye")) return;
  const auto fits = [&](const Vertex<double>& v, const Matrices<double>& m) {
    return relative(v.p_clip, m.projection * v.p_eye) <= kApart;
  };
  std::size_t wrong = 0, draw = 0;  // draw: of the vertex before, most often of this one, too
  for (const Vertex<double>& v : r.vertices) {
    if (fits(v, r.matrices[draw])) continue;
    const auto found = std::ranges::find_if(r.matrices, [&](const Matrices<double>& m) { return fits(v, m); });
    if (found == r.matrices.end()) ++wrong;
    if (found != r.matrices.end()) draw = static_cast<std::size_t>(found - r.matrices.begin());
  }
  if (wrong == 0) return;
  const bool is_transposed = std::ranges::all_of(r.vertices, [&](const Vertex<double>& v) {
    return std::ranges::any_of(r.matrices, [&](const Matrices<double>& m) {
      return relative(v.p_clip, glm::transpose(m.projection) * v.p_eye) <= kApart;
    });
  });
  out.push_back(fmt::format("vertex.p_clip: {} of {} are not matrices.projection * vertex.p_eye{}", wrong,
                            r.vertices.size(),
                            is_transposed ? "; all are, if it is transposed: matrices are column by column" : ""));
}

bool fragments_are_counted(const Capture& c) {
  Lines of_coverage;
  check_coverage(c, of_coverage);
  return of_coverage.empty();
}

}  // namespace

std::vector<std::string> contradictions_of(const Capture& capture, Stage stage, const Conventions& conventions) {
  Lines out;
  switch (stage) {
    case Stage::window:
      check_window(capture, out);
      check_finite_corners(capture, out);
      check_snapped(capture, conventions, out);
      break;
    case Stage::coverage: check_coverage(capture, out); break;
    case Stage::texture:
      if (fragments_are_counted(capture)) check_texels(capture, out);
      break;
    case Stage::shade:
      if (fragments_are_counted(capture)) check_shaded(capture, out);
      break;
    case Stage::visibility: check_winners(capture, out); break;
    default: break;
  }
  return out;
}

std::vector<std::string> contradictions(const Capture& capture) {
  Lines out;
  check_matrices(capture, out);
  check_window(capture, out);
  check_finite_corners(capture, out);
  check_snapped(capture, undeclared(), out);
  const std::size_t before = out.size();
  check_coverage(capture, out);
  const bool are_counted = out.size() == before;
  check_winners(capture, out);
  if (are_counted) check_texels(capture, out);
  if (are_counted) check_shaded(capture, out);
  check_depth(capture, out);
  check_color(capture, out);
  return out;
}

}  // namespace plumbline
