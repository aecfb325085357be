// Sample position, and grid of window positions.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;
using Triangles = std::vector<std::array<ProbeCorner, 3>>;

// A strip's rows, and the distance to the next strip, whose lower side is kept off this strip's upper samples. Frames
// have 2^n pixels a side, so that corners on the grid stay there in float.
constexpr int kLong = 1024, kStrip = 4, kPitch = 8, kStrips = 16;

ProbeCorner corner(int along, double a, double b) {
  return {along == 0 ? glm::dvec3(a, b, kFlatDepth) : glm::dvec3(b, a, kFlatDepth), glm::vec4(1), {}};
}

// A nearly horizontal edge (`along` 0; else nearly vertical) that starts `offset` above the lower border of its strip's
// third row and rises by `rise` over 1,024 pixels. The samples below the edge give its position to rise/1024 pixel.
struct Edge {
  double offset, rise;  // as given [pixels]
  int count;            // samples of the strip's four rows that the triangles cover
};
enum class Side { below, above };  // the triangles' side of the edge

// Sum of the columns' samples. A column that holds fewer than both its neighbours (the first and the last: than its one
// neighbour) counts as the lower of these: tie rules take samples on a strip's ends, or on the diagonal of its two
// triangles. Without them, counts grow or fall by one step.
int without_gaps(const std::vector<int>& counts) {
  int sum = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const int before = counts[k == 0 ? k + 1 : k - 1], after = counts[k + 1 == counts.size() ? k - 1 : k + 1];
    sum += std::max(counts[k], std::min(before, after));
  }
  return sum;
}

std::vector<Edge> edges(Prober& prober, int along, double rise, const std::vector<double>& offsets,
                        Side side = Side::below) {
  std::vector<Edge> out;
  for (std::size_t first = 0; first < offsets.size(); first += kStrips) {
    const std::size_t n = std::min<std::size_t>(kStrips, offsets.size() - first);
    const int across = kPitch * kStrips;
    Scene scene = along == 0 ? probe_frame("grid_y", kLong, across) : probe_frame("grid_x", across, kLong);
    Triangles triangles;
    for (std::size_t i = 0; i < n; ++i) {
      const double low = kPitch * static_cast<double>(i), at = low + 2 + offsets[first + i];
      const double to = low + (side == Side::below ? 0.25 : 3.75);
      std::array corners = {corner(along, 0, to), corner(along, kLong, to), corner(along, kLong, at + rise),
                            corner(along, 0, at)};
      const bool is_clockwise = (along == 0) != (side == Side::below);
      if (is_clockwise) std::swap(corners[1], corners[3]);  // a renderer may drop back faces
      for (const auto& t : quad(corners)) triangles.push_back(t);
    }
    add_triangles(scene, triangles);
    const Plane<glm::vec4> color = prober.draw(scene).color;
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<int> counts(kLong, 0);
      for (int k = 0; k < kLong; ++k) {
        for (int row = 0; row < kStrip; ++row) {
          const int b = kPitch * static_cast<int>(i) + row;
          counts[static_cast<std::size_t>(k)] += is_white(along == 0 ? color(k, b) : color(b, k)) ? 1 : 0;
        }
      }
      out.push_back({offsets[first + i], rise, without_gaps(counts)});
    }
  }
  return out;
}

// The offset snapped to a grid; nullopt: half way between two positions, under rounding to nearest.
std::optional<double> snapped(double offset, int bits, C::Rounding rounding) {
  if (bits == C::kFloat) return offset;
  const double place = std::ldexp(offset, bits);
  if (rounding == C::Rounding::nearest && place - std::floor(place) == 0.5) return std::nullopt;
  return std::ldexp(rounded(rounding, place), -bits);
}

// A grid, and the sample position that edges imply under it. The grid explains the edges if all imply nearly one
// position.
struct Grid {
  int bits = C::kFloat;
  C::Rounding rounding = C::Rounding::nearest;
  double sample = 0.5;
  std::size_t probes = 0, all = 0;
  double scatter = 0;  // of the sample's place [pixels]
  bool explains = false;
  std::size_t outliers = 0;  // edges that are left out: pixels are lost there, or added
};
// `lost_rows`: 1 where the samples of the strip's lowest row lie below the triangles' lower side, at 1/4 of the row.
// `most_outliers`: so many edges may be left out. nullopt: all edges lie half way between two positions of the grid.
std::optional<Grid> implied(const std::vector<Edge>& edges, int bits, C::Rounding rounding, int lost_rows,
                            std::size_t most_outliers) {
  std::vector<double> samples;
  for (const Edge& edge : edges) {
    const auto at = snapped(edge.offset, bits, rounding);
    if (at) samples.push_back(*at + edge.rise * (3 - lost_rows - static_cast<double>(edge.count) / kLong));
  }
  if (samples.empty()) return std::nullopt;
  std::ranges::sort(samples);
  const std::size_t n = samples.size() - std::min(most_outliers, samples.size() / 2);
  auto first = samples.begin();  // of the n that lie nearest to each other
  const auto spread = [&](auto at) { return *(at + static_cast<std::ptrdiff_t>(n) - 1) - *at; };
  for (auto at = samples.begin(); at + static_cast<std::ptrdiff_t>(n) <= samples.end(); ++at) {
    if (spread(at) < spread(first)) first = at;
  }
  // Largest scatter that ties, an edge function's rounding, and corners on a grid too fine to be measured may cause.
  const double most_scatter = 3.5 * edges.front().rise / kLong, scatter = spread(first);
  double sample = std::accumulate(first, first + static_cast<std::ptrdiff_t>(n), 0.0) / static_cast<double>(n);
  if (edges.front().rise == 1 && sample > 0.999) --sample;  // the lowest row was lost although lost_rows is 0
  const auto lies_elsewhere = [&](double at) { return std::abs(at - *first) > most_scatter; };
  const auto outliers =
      static_cast<std::size_t>(most_outliers > 0 ? std::ranges::count_if(samples, lies_elsewhere) : 0);
  return Grid{bits,    rounding, sample, samples.size() - outliers, edges.size(), scatter, scatter <= most_scatter,
              outliers};
}

// Best grid: of those that explain the edges, the one of least scatter, the finest of equals; else kFloat.
std::optional<Grid> grid_of(const std::vector<Edge>& edges, int least_bits, int most_bits, int lost_rows,
                            std::size_t most_outliers) {
  const std::optional<Grid> without = implied(edges, C::kFloat, C::Rounding::nearest, lost_rows, most_outliers);
  std::optional<Grid> best = without;
  for (int bits = most_bits; bits >= least_bits; --bits) {
    for (const C::Rounding rounding : {C::Rounding::nearest, C::Rounding::down, C::Rounding::up}) {
      const auto grid = implied(edges, bits, rounding, lost_rows, most_outliers);
      if (grid && grid->explains &&
          (!best || !best->explains || grid->scatter < best->scatter - 0.5 * edges.front().rise / kLong))
        best = grid;
    }
  }
  return best;
}

// The grid of all edges; where none explains them, that of 15 edges in 16: a mistake at the frame's border moves single
// edges.
std::optional<Grid> grid_of(const std::vector<Edge>& edges, int least_bits, int most_bits, int lost_rows) {
  const std::optional<Grid> of_all = grid_of(edges, least_bits, most_bits, lost_rows, 0);
  if (of_all && of_all->explains) return of_all;
  const std::optional<Grid> of_most = grid_of(edges, least_bits, most_bits, lost_rows, edges.size() / kStrips);
  return of_most && of_most->explains ? of_most : of_all;
}

// Finds the grid from edges moved in steps of 1/1024 pixel, on and off the grids' positions; if that grid is finer than
// 8 bits, from edges near the sample, moved in steps of 1/16384 pixel.
constexpr int kMostBits = 12;
std::optional<Grid> grid_along(Prober& prober, int along) {
  std::vector<double> offsets;
  for (int k = 0; k < 64; ++k) offsets.push_back(k / 1024.0);
  for (int k = 0; k < 64; ++k) offsets.push_back((15 * k + 5.25) / 1024.0);
  const auto grid = grid_of(edges(prober, along, 1, offsets), 0, 9, 0);
  if (!grid || !grid->explains || (grid->bits != C::kFloat && grid->bits <= 8)) return grid;
  constexpr double rise = 1.0 / 16;
  const double first = std::floor((grid->sample - rise / 2) * 1024) / 1024;
  offsets.clear();
  for (int k = 0; k < 64; ++k) offsets.push_back(first + k / 16384.0);
  return grid_of(edges(prober, along, rise, offsets), 9, kMostBits, grid->sample < 0.25 ? 1 : 0);
}

// Sample position from edges with their triangles above. Triangles that reach beyond their edges bias this estimate
// upwards, and the one from edges with their triangles below downwards.
double place_from_above(Prober& prober, int along, const Grid& grid) {
  std::vector<double> offsets;
  for (int k = 0; k < 64; ++k) offsets.push_back(k / 1024.0);
  double sum = 0;
  int n = 0;
  const int lost_rows = grid.sample > 0.75 ? 1 : 0;  // above the strip's upper edge
  for (const Edge& edge : edges(prober, along, 1, offsets, Side::above)) {
    const auto at = snapped(edge.offset, grid.bits, grid.rounding);
    if (!at) continue;
    sum += *at + static_cast<double>(edge.count) / kLong + lost_rows - 1;
    ++n;
  }
  return n > 0 ? sum / n : grid.sample;
}

// Reach of triangles beyond their edges [pixels]: half the difference of the sample's positions from both sides. Sets
// grid.sample to the positions' mean. A position at a multiple of 1/2 is kept.
double reach_of(Prober& prober, int along, Grid& grid) {
  if (std::abs(grid.sample - std::round(2 * grid.sample) / 2) < 1.5 / kLong) return 0;
  const double above = place_from_above(prober, along, grid), reach = (above - grid.sample) / 2;
  if (std::abs(reach) < 1.75 / kLong) return 0;
  grid.sample = (grid.sample + above) / 2;
  return reach;
}

// The lowest left pixel drawn of a rectangle whose lowest left sample is that of pixel (3, 3).
glm::dvec2 lowest_left(Prober& prober, glm::dvec2 sample) {
  Scene scene = probe_frame("shift", 16, 16);
  add_triangles(scene, rectangle(sample + 2.75, sample + 9.75, kFlatDepth, glm::vec4(1)));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  constexpr int kHalf = 4;  // of the rectangle's side: single pixels, or its border, do not count
  std::array<int, 16> in_column{}, in_row{};
  for (std::size_t y = 0; y < 16; ++y) {
    for (std::size_t x = 0; x < 16; ++x) {
      if (is_white(color(static_cast<int>(x), static_cast<int>(y)))) ++in_column[x], ++in_row[y];
    }
  }
  const auto first = [](const std::array<int, 16>& counts) {
    return static_cast<double>(std::ranges::find_if(counts, [](int n) { return n >= kHalf; }) - counts.begin());
  };
  return {first(in_column), first(in_row)};
}

// Moves a sample from a pixel's lower or left border to the opposite one where the picture is shifted by -1 pixel:
// edges give a sample's position modulo one pixel.
void take_far_border(double& sample, double& shift) {
  if (sample == 0 && shift == -1) sample = 1, shift = 0;
}

// Sample of a renderer whose corners and edges lie on whole pixels: a sample at a pixel's border may lie at the border
// opposite, with the other side's tie rule. Pixels along a diagonal decide, except those whose samples lie on an edge.
glm::dvec2 sample_by_diagonal(Prober& prober, glm::dvec2 sample) {
  constexpr int kSize = 16, kLow = 2, kHigh = 13;
  Scene scene = probe_frame("diagonal", kSize, kSize);
  const std::array<ProbeCorner, 3> triangle = {
      {{{kLow, kLow, kFlatDepth}}, {{kHigh, kLow, kFlatDepth}}, {{kLow, kHigh, kFlatDepth}}}};
  add_triangles(scene, std::span(&triangle, 1));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  const auto is_off = [](double v) { return v == 0 || v == 1; };
  const auto wrong_by = [&](const glm::dvec2& at) {
    int wrong = 0;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const glm::dvec2 p = glm::dvec2(x, y) + at - static_cast<double>(kLow);
        const double inside = std::min({p.x, p.y, kHigh - kLow - p.x - p.y});  // 0 on an edge
        if (inside != 0) wrong += is_white(color(x, y)) != (inside > 0);
      }
    }
    return wrong;
  };
  glm::dvec2 best = sample;
  for (const bool other_x : {false, true}) {
    for (const bool other_y : {false, true}) {
      if ((other_x && !is_off(sample.x)) || (other_y && !is_off(sample.y))) continue;
      const glm::dvec2 at(other_x ? 1 - sample.x : sample.x, other_y ? 1 - sample.y : sample.y);
      if (wrong_by(at) < wrong_by(best)) best = at;
    }
  }
  return best;
}

// Grids of rows and of columns.
struct Grids {
  std::optional<Grid> rows, columns;
  bool explain() const { return rows && columns && rows->explains && columns->explains; }
  // Whether y is rounded down where x is rounded up, or up where x is rounded down.
  bool turn_y() const {
    const auto is = [&](C::Rounding of_x, C::Rounding of_y) {
      return columns->rounding == of_x && rows->rounding == of_y;
    };
    return is(C::Rounding::down, C::Rounding::up) || is(C::Rounding::up, C::Rounding::down);
  }
  bool differ() const { return rows->bits != columns->bits || (rows->rounding != columns->rounding && !turn_y()); }
  double scatter() const {  // of the sample's place [pixels]
    return rows && columns ? std::max(rows->scatter, columns->scatter) : std::numeric_limits<double>::infinity();
  }
};
// Grids that edges imply. Reports triangles that cover samples beyond their edges, or too few.
Grids grids_of(Prober& prober) {
  Grids out;
  double reach = 0;
  for (const int along : {0, 1}) {
    std::optional<Grid>& grid = (along == 0 ? out.rows : out.columns) = grid_along(prober, along);
    const double beyond = grid && grid->explains ? reach_of(prober, along, *grid) : 0;
    if (std::abs(beyond) > std::abs(reach)) reach = beyond;
  }
  if (reach != 0) {
    prober.unexplained(fmt::format("triangles have too {} samples, as if their edges lay {:.4f} pixel farther {}",
                                   reach > 0 ? "many" : "few", std::abs(reach), reach > 0 ? "out" : "in"));
  }
  return out;
}

// The sample's place that the grids imply: at a multiple of 1/2 where it may be there. nullopt, with a finding: the
// picture is shifted.
std::optional<glm::dvec2> sample_of(Prober& prober, const Grids& grids) {
  const double of_mean = grids.explain() ? 0 : grids.scatter() / 2, uncertain = 1.5 / kLong + of_mean;
  const auto placed = [&](double at) {
    return (std::abs(at - std::round(2 * at) / 2) < uncertain ? std::round(2 * at) / 2 : at) + 0.0;  // -0 is 0
  };
  glm::dvec2 sample = {placed(grids.columns->sample), placed(grids.rows->sample)};
  const bool in_pixel = glm::clamp(sample, 0.0, 1.0) == sample;
  const int bits = grids.rows->bits;
  glm::dvec2 shift = bits == 0 || bits == 1 ? glm::dvec2(0) : lowest_left(prober, sample) - 3.0;
  for (const int axis : {0, 1}) take_far_border(sample[axis], shift[axis]);
  if (in_pixel && bits == 0) sample = sample_by_diagonal(prober, sample);
  if (in_pixel && shift == glm::dvec2(0)) return sample;
  prober.unexplained(fmt::format("{}: the sample is at {}, and the picture is shifted by {:.0f}, {:.0f} pixels",
                                 in_pixel ? "the picture is shifted" : "a sample lies outside its pixel",
                                 sample_text(sample), shift.x + 0.0, shift.y + 0.0));
  return std::nullopt;
}

// Samples that renderers choose; edges that a mistake moves imply others.
bool is_at_sixteenth(const glm::dvec2& sample) {
  const glm::dvec2 off = glm::abs(16.0 * sample - glm::round(16.0 * sample)) / 16.0;
  return std::max(off.x, off.y) < 1.5 / kLong;
}

}  // namespace

void learn_grid(Prober& prober) {
  constexpr double kMostScatter = 0.125;  // [pixels] at which a sample's place is still known
  const ConventionWords bits = words_of("subpixel_bits"), rounding = words_of("subpixel_rounding"),
                        window_y = words_of("window_y");
  const auto open_all = [&](const char* why) {
    for (const ConventionWords& words : {kSampleWords, bits, rounding, window_y}) prober.open(words, why);
  };
  const Grids grids = grids_of(prober);
  if (!grids.explain()) {
    const bool is_known = std::isfinite(grids.scatter());
    prober.unexplained("edges that are moved in small steps go by no grid" +
                       (is_known ? fmt::format(": they scatter by {:.3f} pixel", grids.scatter()) : ""));
    if (!(grids.scatter() <= kMostScatter)) return open_all("no grid explains the edges");
  } else if (grids.differ()) {
    const auto text = [](const Grid& grid) {
      return fmt::format("{} bits, rounded {}", bits_text(grid.bits), name_of(grid.rounding));
    };
    prober.unexplained(fmt::format("window positions go by one grid in x ({}), by another in y ({})",
                                   text(*grids.columns), text(*grids.rows)));
    return open_all("edges contradict each other");
  }
  const std::size_t probes = grids.rows->probes + grids.columns->probes, all = grids.rows->all + grids.columns->all;
  const std::string evidence = fmt::format("{} of {} edges that are moved in small steps", probes, all);
  if (2 * probes < all)
    prober.unexplained(fmt::format("window positions go by no grid: the best one explains {}", evidence));
  const std::optional<glm::dvec2> sample = sample_of(prober, grids);
  if (!sample) return open_all("the picture is shifted");
  C& c = prober.learned.conventions;
  c.sample = *sample;
  const std::string doubt =
      std::string(grids.explain() ? "" : ", which scatter about it") +
      (is_at_sixteenth(c.sample) ? "" : ", no multiple of 1/16 pixel: a mistake may move the edges");
  prober.found(kSampleWords, sample_text(c.sample), evidence + doubt);
  if (const std::size_t outliers = grids.rows->outliers + grids.columns->outliers; grids.explain() && outliers > 0)
    prober.unexplained(fmt::format("{} of {} edges lie elsewhere: pixels are lost or added there", outliers, all));
  if (!grids.explain()) {
    for (const ConventionWords& words : {bits, rounding, window_y}) prober.open(words, "no grid explains the edges");
    return;
  }
  c.subpixel_bits = grids.rows->bits;
  c.subpixel_rounding = grids.columns->rounding;
  c.window_y = grids.turn_y() ? C::WindowY::down : C::WindowY::up;
  prober.found(bits, bits_text(c.subpixel_bits),
               evidence + (c.subpixel_bits == C::kFloat ? fmt::format(" (or {} bits or more)", kMostBits + 1) : ""));
  if (c.subpixel_bits == C::kFloat) c.subpixel_rounding = C::Rounding::nearest, c.window_y = C::WindowY::up;
  const bool is_rounded = c.subpixel_bits != C::kFloat;
  prober.found(rounding, name_of(c.subpixel_rounding), is_rounded ? evidence : "positions are not snapped");
  prober.found(window_y, name_of(c.window_y),
               c.subpixel_rounding != C::Rounding::nearest
                   ? fmt::format("y is rounded {}", name_of(grids.rows->rounding))
                   : "positions are not rounded down or up: y may point either way");
}

}  // namespace plumbline::learn
