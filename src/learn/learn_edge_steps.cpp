// Edges whose x is added up from row to row in fixed point.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/float_depth.h"
#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kFrameColumns = 128, kFrameRows = 1024, kStripColumns = 8,
              kSteepTriangles = kFrameColumns / kStripColumns, kLowerSide = 6;

// A triangle whose lower side is the bottom of a strip of 8 columns, and whose corner on top lies `shift` columns right
// of the strip, `rows` above it [pixels]. Fixed point holds neither side's slope, shift / rows and (shift - 6) / rows,
// and at most one sample lies on a side. The first row and the last, whose samples may lie on the lower side and on the
// corner, do not count.
struct Steep {
  int low, shift, rows;
  bool counts(int row) const { return row > 0 && row < rows - 1; }
};
std::vector<Steep> steep_triangles() {
  std::vector<Steep> out;
  for (int i = 0; i < kSteepTriangles; ++i)
    out.push_back({kStripColumns * i, 1 + (3 * i) % (kLowerSide - 1), 1001 - 6 * i});
  return out;
}

std::vector<int> samples_drawn(Prober& prober, const std::vector<Steep>& triangles) {
  Scene scene = probe_frame("edge_steps", kFrameColumns, kFrameRows);
  std::vector<std::array<ProbeCorner, 3>> corners;
  for (const Steep& t : triangles) {
    const auto at = [](int x, int y) { return ProbeCorner{{x, y, kFlatDepth}, glm::vec4(1), {}}; };
    corners.push_back({at(t.low, 0), at(t.low + kLowerSide, 0), at(t.low + t.shift, t.rows)});
  }
  add_triangles(scene, corners);
  const Plane<glm::vec4> color = prober.draw(scene).color;
  std::vector<int> out;
  for (const Steep& t : triangles) {
    out.push_back(0);
    for (int y = 0; y < kFrameRows; ++y) {
      for (int x = t.low; x < t.low + kStripColumns; ++x) out.back() += t.counts(y) && is_white(color(x, y)) ? 1 : 0;
    }
  }
  return out;
}

enum class Slopes { exact, to_nearest, down, towards_0 };

double in_bits(double slope, int bits, Slopes rounding) {
  const double steps = std::ldexp(slope, bits);
  switch (rounding) {
    case Slopes::exact: return slope;
    case Slopes::to_nearest: return std::ldexp(std::round(steps), -bits);
    case Slopes::down: return std::ldexp(std::floor(steps), -bits);
    case Slopes::towards_0: return std::ldexp(std::trunc(steps), -bits);
  }
  return slope;
}

// Samples between a triangle's sides whose slopes are of so many fraction bits.
int samples_between(const Steep& t, glm::dvec2 sample, int bits, Slopes rounding) {
  const double rows = t.rows, left = in_bits(t.shift / rows, bits, rounding),
               right = in_bits((t.shift - kLowerSide) / rows, bits, rounding);
  const auto first_beyond = [&](double x) { return static_cast<int>(std::ceil(x - sample.x)); };
  int out = 0;
  for (int y = 0; y < t.rows; ++y) {
    const double above = y + sample.y;
    if (t.counts(y)) out += std::max(first_beyond(kLowerSide + right * above) - first_beyond(left * above), 0);
  }
  return out;
}

// Largest difference of a triangle's samples from those drawn.
int most_apart(const std::vector<Steep>& triangles, const std::vector<int>& drawn, glm::dvec2 sample, int bits,
               Slopes rounding) {
  int out = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    out = std::max(out, std::abs(drawn[i] - samples_between(triangles[i], sample, bits, rounding)));
  return out;
}

// Difference that sums in float explain [samples]: by the displacement of each row of both sides.
double most_by_float_sums(const Conventions& conventions) {
  WindowBox box(glm::dvec2(0));
  box.add({kFrameColumns, kFrameRows});
  return 2.0 * kFrameRows * edge_displacement(conventions, box, {kFrameColumns, kFrameRows}).x;
}

// Fewest apart, then most bits; of fixed point that explains all triangles but for the roundings of both sides' first
// x, and a sample on a side. Slopes of few bits, which may round more, are off by many more samples.
struct Fixed {
  int bits, apart;
};
std::optional<Fixed> fixed_of(const std::vector<Steep>& triangles, const std::vector<int>& drawn, glm::dvec2 sample) {
  constexpr int kFewest = 8, kMost = 19;
  std::optional<Fixed> best;
  for (int bits = kMost; bits >= kFewest; --bits) {
    const double most = 1 + std::ldexp(4.0 * kFrameRows, -bits);
    for (const Slopes rounding : {Slopes::to_nearest, Slopes::down, Slopes::towards_0}) {
      const int apart = most_apart(triangles, drawn, sample, bits, rounding);
      if (apart <= most && (!best || apart < best->apart)) best = {bits, apart};
    }
  }
  return best;
}

}  // namespace

void learn_edge_steps(Prober& prober) {
  constexpr int kMostDeclared = 16, kOfTies = 2;
  const ConventionWords words = words_of("edge_bits");
  C& c = prober.learned.conventions;
  if (prober.open_if_any_open(words, {kSampleWords.name})) return;
  const std::vector<Steep> triangles = steep_triangles();
  const std::vector<int> drawn = samples_drawn(prober, triangles);
  const auto evidence = [&](int apart) {
    return fmt::format("samples of {} steep triangles of 1,000 rows, {} off at most", triangles.size(), apart);
  };
  const int of_exact = most_apart(triangles, drawn, c.sample, 0, Slopes::exact);
  if (of_exact <= kOfTies + most_by_float_sums(c)) return prober.found(words, "float", evidence(of_exact));
  const std::optional<Fixed> fixed = fixed_of(triangles, drawn, c.sample);
  if (!fixed) return prober.open(words, evidence(of_exact) + ", as by no number of bits");
  c.edge_bits = std::min(fixed->bits, kMostDeclared);
  prober.found(words, bits_text(c.edge_bits), evidence(fixed->apart));
}

}  // namespace plumbline::learn
