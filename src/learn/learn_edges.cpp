// Where a pixel is sampled, the grid of window positions, and who owns a sample on an edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;
using Triangles = std::vector<std::array<ProbeCorner, 3>>;

constexpr int kLong = 1024, kStrip = 4, kStrips = 16;

ProbeCorner corner(int along, double a, double b) {
  return {along == 0 ? glm::dvec3(a, b, 0.5) : glm::dvec3(b, a, 0.5), glm::vec4(1), {}};
}

// An edge that rises by one pixel over 1,024, and starts `offset` above a row's lower border (`along` 0; else a
// column's left one): of the row, so many samples lie below it that the edge's place is told to 1/1024 pixel.
struct Rise {
  double offset;  // as given
  int count;      // samples below the edge
};
std::vector<Rise> rises(Prober& prober, int along, const std::vector<double>& offsets) {
  std::vector<Rise> out;
  for (std::size_t first = 0; first < offsets.size(); first += kStrips) {
    const std::size_t n = std::min<std::size_t>(kStrips, offsets.size() - first);
    const int across = kStrip * kStrips;
    Scene scene = along == 0 ? probe_frame("grid_y", kLong, across) : probe_frame("grid_x", across, kLong);
    Triangles triangles;
    for (std::size_t i = 0; i < n; ++i) {
      const double low = kStrip * static_cast<double>(i), at = low + 2 + offsets[first + i];
      for (const auto& t : quad({corner(along, 0, low + 0.25), corner(along, kLong, low + 0.25),
                                 corner(along, kLong, at + 1), corner(along, 0, at)}))
        triangles.push_back(t);
    }
    add_triangles(scene, triangles);
    const Plane<glm::vec4> color = prober.draw(scene).color;
    for (std::size_t i = 0; i < n; ++i) {
      int count = 0;
      for (int row = 0; row < kStrip; ++row) {
        for (int k = 0; k < kLong; ++k) {
          const int b = kStrip * static_cast<int>(i) + row;
          count += is_white(along == 0 ? color(k, b) : color(b, k)) ? 1 : 0;
        }
      }
      out.push_back({offsets[first + i], count});
    }
  }
  return out;
}

// Offsets snapped to a grid; nothing where two places are as near.
std::optional<double> snapped(double offset, int bits, C::Rounding rounding) {
  if (bits == C::kFloat) return offset;
  const double place = std::ldexp(offset, bits);
  if (rounding == C::Rounding::nearest && place - std::floor(place) == 0.5) return std::nullopt;
  return std::ldexp(rounded(rounding, place), -bits);
}

// A grid explains the rises where the sample's place comes out the same from all of them.
struct Grid {
  int bits = C::kFloat;
  C::Rounding rounding = C::Rounding::nearest;
  double sample = 0.5;
  std::size_t probes = 0;
  double scatter = 0;  // of the sample's place [pixels]
};
std::optional<Grid> grid_of(const std::vector<Rise>& rises) {
  constexpr double kSlack = 2.0 / kLong;  // ties, and the rounding of an edge function
  const auto explains = [&](int bits, C::Rounding rounding) -> std::optional<Grid> {
    double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0;
    std::size_t n = 0;
    for (const Rise& rise : rises) {
      const auto at = snapped(rise.offset, bits, rounding);
      if (!at) continue;
      // Samples below: 1,024 (3 + offset - sample) of the strip's four rows; 1,024 fewer where those of its first row
      // lie below the strip's edge, at 1/4.
      const double below = 3 + *at - static_cast<double>(rise.count) / kLong,
                   sample = below > 0.999 ? below - 1 : below;
      least = std::min(least, sample), most = std::max(most, sample), sum += sample;
      ++n;
    }
    if (n == 0 || most - least > kSlack) return std::nullopt;
    return Grid{bits, rounding, sum / static_cast<double>(n), n, most - least};
  };
  // The one by which it scatters least; of as good ones the finest.
  std::optional<Grid> best = explains(C::kFloat, C::Rounding::nearest);
  for (int bits = 9; bits >= 0; --bits) {
    for (const C::Rounding rounding : {C::Rounding::nearest, C::Rounding::down, C::Rounding::up}) {
      const auto grid = explains(bits, rounding);
      if (grid && (!best || grid->scatter < best->scatter - 0.5 / kLong)) best = grid;
    }
  }
  return best;
}

// The lowest left pixel drawn of a rectangle in which pixel (3, 3) is the lowest left sample.
glm::dvec2 lowest_left(Prober& prober, glm::dvec2 sample) {
  Scene scene = probe_frame("shift", 16, 16);
  add_triangles(scene, rectangle(sample + 2.75, sample + 9.75, 0.5, glm::vec4(1)));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  glm::dvec2 out(16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x)
      if (is_white(color(x, y))) out = glm::min(out, glm::dvec2(x, y));
  }
  return out;
}

}  // namespace

void learn_grid(Prober& prober) {
  const ConventionWords bits = words_of("subpixel_bits"), rounding = words_of("subpixel_rounding");
  std::vector<double> offsets;
  for (int k = 0; k < 64; ++k) offsets.push_back(k / 1024.0);
  for (int k = 0; k < 64; ++k) offsets.push_back((16 * k + 5) / 1024.0);
  std::array<std::optional<Grid>, 2> grids;
  try {
    for (const int along : {0, 1}) grids[static_cast<std::size_t>(along)] = grid_of(rises(prober, along, offsets));
  } catch (const Unsupported& e) {
    for (const ConventionWords& words : {kSampleWords, bits, rounding}) prober.open(words, e.what());
    return;
  }
  const auto &rows = grids[0], &columns = grids[1];
  if (!rows || !columns) {
    prober.unexplained("edges moved by 1/1024 pixel go by no grid");
    for (const ConventionWords& words : {kSampleWords, bits, rounding})
      prober.open(words, "no grid explains the edges");
    return;
  }
  if (rows->bits != columns->bits || rows->rounding != columns->rounding) {
    prober.unexplained("window positions go by one grid in x, by another in y");
    for (const ConventionWords& words : {kSampleWords, bits, rounding})
      prober.open(words, "edges contradict each other");
    return;
  }
  const std::size_t explained = rows->probes + columns->probes;
  const std::string evidence = fmt::format("{} of {} edges that moved by 1/1024 pixel", explained, 2 * offsets.size());
  if (explained < offsets.size())
    prober.unexplained(fmt::format("window positions go by no grid: the best one explains {}", evidence));
  C& c = prober.learned.conventions;
  const auto placed = [](double at) {
    return std::abs(at - std::round(2 * at) / 2) < 0.003 ? std::round(2 * at) / 2 : at;
  };
  const glm::dvec2 sample = {placed(columns->sample), placed(rows->sample)};
  const bool in_pixel = glm::clamp(sample, 0.0, 1.0) == sample;
  const glm::dvec2 shift = rows->bits == 0 || rows->bits == 1 ? glm::dvec2(0) : lowest_left(prober, sample) - 3.0;
  if (!in_pixel || shift != glm::dvec2(0)) {
    prober.unexplained(fmt::format("a sample lies outside its pixel: at {}, and {}, {} whole pixels away",
                                   sample_text(sample), -shift.x, -shift.y));
    for (const ConventionWords& words : {kSampleWords, bits, rounding}) prober.open(words, "the picture is shifted");
    return;
  }
  c.sample = sample;
  c.subpixel_bits = rows->bits;
  c.subpixel_rounding = rows->rounding;
  prober.found(kSampleWords, sample_text(c.sample), evidence);
  prober.found(bits, bits_text(c.subpixel_bits),
               evidence + (c.subpixel_bits == C::kFloat ? " (or 10 bits or more)" : ""));
  prober.found(rounding, c.subpixel_bits == C::kFloat ? "nearest" : name_of(c.subpixel_rounding), evidence);
}

namespace {

// Coverage of one triangle.
Plane<glm::vec4> alone(Prober& prober, const std::string& name, int size, const std::array<ProbeCorner, 3>& triangle) {
  Scene scene = probe_frame(name, size, size);
  add_triangles(scene, std::span(&triangle, 1));
  return prober.draw(scene).color;
}

// Samples on inner edges of a fan: in how many of its triangles they are.
struct Shared {
  std::size_t none = 0, one = 0, more = 0;
};
Shared shared_edges(Prober& prober, glm::dvec2 sample) {
  constexpr int kFan = 16;
  const glm::dvec2 middle = glm::dvec2(8) + sample;
  const std::array<glm::dvec2, 8> around = {{{6, 0}, {6, 6}, {0, 6}, {-6, 6}, {-6, 0}, {-6, -6}, {0, -6}, {6, -6}}};
  Plane<int> count(kFan, kFan);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto at = [&](glm::dvec2 p) { return ProbeCorner{{p, 0.5}, glm::vec4(1), {}}; };
    const Plane<glm::vec4> color =
        alone(prober, "fan", kFan, {at(middle), at(middle + around[i]), at(middle + around[(i + 1) % 8])});
    for (std::size_t k = 0; k < count.size(); ++k) count.values()[k] += is_white(color.values()[k]) ? 1 : 0;
  }
  Shared out;
  for (int y = 3; y < 14; ++y) {
    for (int x = 3; x < 14; ++x) {
      const int dx = std::abs(x - 8), dy = std::abs(y - 8);
      if (dx != 0 && dy != 0 && dx != dy) continue;
      ++(count(x, y) == 0 ? out.none : count(x, y) == 1 ? out.one : out.more);
    }
  }
  return out;
}

}  // namespace

void learn_ties(Prober& prober) {
  const ConventionWords words = words_of("tie_rule");
  C& c = prober.learned.conventions;
  if (std::ranges::find(c.open, kSampleWords.name) != c.open.end())
    return prober.open(words, "the sample's place is open");
  const double steps = c.subpixel_bits == C::kFloat ? 1024 : std::ldexp(1.0, c.subpixel_bits);
  if (c.sample * steps != glm::round(c.sample * steps)) {
    return prober.open(words, "no edge can be laid through a sample: its place is not on the grid");
  }
  try {
    Scene scene = probe_frame("edges", 16, 16);
    add_triangles(scene, rectangle(glm::dvec2(3) + c.sample, glm::dvec2(9) + c.sample, 0.5, glm::vec4(1)));
    const Plane<glm::vec4> color = prober.draw(scene).color;
    const bool left = is_white(color(3, 6)), right = is_white(color(9, 6)), bottom = is_white(color(6, 3)),
               top = is_white(color(6, 9));
    const Shared shared = shared_edges(prober, c.sample);
    const std::size_t all = shared.none + shared.one + shared.more;
    const std::string evidence = fmt::format("{} of {} samples on a fan's edges are in one triangle", shared.one, all);
    using enum C::TieRule;
    if (left != right && bottom != top && shared.one == all) {
      c.tie_rule = left ? (bottom ? left_bottom : left_top) : (bottom ? right_bottom : right_top);
    } else if (shared.one == all) {
      c.tie_rule = any;
    } else if (left && right && bottom && top && shared.none == 0) {
      c.tie_rule = inclusive;
    } else if (!left && !right && !bottom && !top && shared.more == 0) {
      c.tie_rule = exclusive;
    } else {
      return prober.fits_none(
          words, fmt::format("of {} samples on a fan's edges, {} are in no triangle (cracks), {} in several", all,
                             shared.none, shared.more));
    }
    prober.found(words, name_of(c.tie_rule), evidence);
  } catch (const Unsupported& e) {
    prober.open(words, e.what());
  }
}

}  // namespace plumbline::learn
