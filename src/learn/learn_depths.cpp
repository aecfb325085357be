// Order of rows; range, format and rounding of depths.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kDepthsInRow = 16;

// Rectangles of 4 x 4 pixels, each at one depth.
Scene at_depths(const Prober& prober, const std::string& name, const std::vector<double>& depths) {
  Scene scene = probe_frame(name, 4 * kDepthsInRow, 4 * kDepthsInRow);
  std::vector<std::array<ProbeCorner, 3>> triangles;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const glm::dvec2 low(4.0 * static_cast<double>(i % kDepthsInRow), 4.0 * static_cast<double>(i / kDepthsInRow));
    for (const auto& t : rectangle(low, low + 4.0, in_volume(prober.learned.conventions, depths[i]), glm::vec4(1)))
      triangles.push_back(t);
  }
  add_triangles(scene, triangles);
  return scene;
}

// Depths of rectangles that are drawn: given, and left; and the given depths of others.
struct Depths {
  std::vector<double> given, left, lost;
};

// Depth of each rectangle, at a pixel inside one of its two triangles.
Depths depths_of(Prober& prober, const std::string& name, const std::vector<double>& depths,
                 DepthFormat format = DepthFormat::z24) {
  Scene scene = at_depths(prober, name, depths);
  scene.frame.depth = format;
  const Planes planes = prober.draw_with_depths(scene);
  Depths out;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const int x = static_cast<int>(4 * (i % kDepthsInRow) + 1), y = static_cast<int>(4 * (i / kDepthsInRow) + 2);
    if (!is_white(planes.color(x, y))) {
      out.lost.push_back(depths[i]);
    } else {
      out.given.push_back(depths[i]), out.left.push_back(planes.depth(x, y));
    }
  }
  return out;
}

// Number of depths left within 1e-4 of the given ones mapped to the range.
std::size_t fitting(C::DepthRange range, const Depths& depths) {
  const auto& [given, left, lost] = depths;
  std::size_t out = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double z = range == C::DepthRange::minus_one_to_one ? 2 * given[i] - 1
                     : range == C::DepthRange::one_to_zero    ? 1 - given[i]
                                                              : given[i];
    out += std::abs(left[i] - z) < 1e-4 ? 1 : 0;
  }
  return out;
}

constexpr std::array kRoundings = {C::Rounding::nearest, C::Rounding::down, C::Rounding::up};

// Multiples of 2^-16: 128 below 1/4, then 128 above 3/5. z (2^n - 1) lies z below a whole number, so that the nearest
// code of n bits, n = 16 or 24, is the upper one of the first 128, and the lower one of the others.
std::vector<double> given_depths() {
  std::vector<double> out;
  for (int i = 0; i < 128; ++i) out.push_back((2000 + 97 * i) / 65536.0);
  for (int i = 0; i < 128; ++i) out.push_back((40000 + 97 * i) / 65536.0);
  return out;
}

// Largest rounding of a depth that is left as a float in the renderer's range [window z].
double float_rounding(double z, C::DepthRange range) {
  const double scale = range == C::DepthRange::minus_one_to_one ? 2 : 1;
  const auto stored = static_cast<float>(std::abs(range == C::DepthRange::zero_to_one   ? z
                                                  : range == C::DepthRange::one_to_zero ? 1 - z
                                                                                        : 2 * z - 1));
  return static_cast<double>(std::nextafter(stored, 2.0f) - stored) / 2 / scale;
}

// Counts of depths as codes of n bits: those that are codes, but for float_rounding(); those within a code of the given
// depth; those equal to each rounding of it.
struct Codes {
  std::size_t codes = 0, near = 0;
  std::array<std::size_t, kRoundings.size()> fits{};
  std::size_t most() const { return *std::ranges::max_element(fits); }
};
Codes codes_of(double bits, const Depths& depths, C::DepthRange range) {
  const auto& [given, left, lost] = depths;
  const double scale = std::ldexp(1.0, static_cast<int>(bits)) - 1;
  Codes out;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double code = std::round(left[i] * scale), exact = given[i] * scale;
    out.codes += std::abs(left[i] * scale - code) < 0.01 + scale * float_rounding(left[i], range) ? 1 : 0;
    out.near += std::abs(code - exact) < 1 ? 1 : 0;
    for (std::size_t k = 0; k < kRoundings.size(); ++k) out.fits[k] += code == rounded(kRoundings[k], exact) ? 1 : 0;
  }
  return out;
}

bool nearly_all(std::size_t n, std::size_t of) { return n * 50 >= of * 49; }

// Finds depth_rounding from the codes of n depths.
void learn_rounding(Prober& prober, const Codes& codes, std::size_t n) {
  const ConventionWords words = words_of("depth_rounding");
  const std::string evidence = fmt::format("{} of {} depths", codes.most(), n);
  if (!nearly_all(codes.most(), n)) return prober.fits_none(words, evidence + " at most are explained by one rounding");
  if (std::ranges::count(codes.fits, codes.most()) > 1)
    return prober.open(words, "the depths that are drawn do not tell roundings apart");
  C& c = prober.learned.conventions;
  c.depth_rounding = kRoundings[static_cast<std::size_t>(std::ranges::max_element(codes.fits) - codes.fits.begin())];
  prober.found(words, name_of(c.depth_rounding), evidence);
}

// Depth format and rounding of a renderer that leaves 24-bit codes where a 24-bit frame asks for them. A 16-bit frame
// shows the rounding, which float arithmetic hides at 24 bits: from z 1/2 on, floats hold no half of a code.
void learn_16_bits(Prober& prober, const Codes& codes, std::size_t n) {
  C& c = prober.learned.conventions;
  const auto found = [&](C::Depth format, const std::string& evidence) {
    c.depth_format = format;
    prober.found(words_of("depth_format"), name_of(format), evidence);
  };
  const std::string of_24 = fmt::format("{} of {} depths are within a code of 24 bits", codes.near, n);
  try {
    const Depths depths = depths_of(prober, "depth_codes_16", given_depths(), DepthFormat::z16);
    const Codes of_16 = codes_of(16, depths, c.depth_range), still = codes_of(24, depths, c.depth_range);
    if (of_16.codes == n) {
      found(C::Depth::as_asked, of_24 + ", of 16 bits where those are asked for");
      return learn_rounding(prober, of_16, n);
    }
    if (nearly_all(still.near, n)) {
      found(C::Depth::z24, of_24 + ", where 16 are asked for as well");
      return learn_rounding(prober, codes, n);
    }
  } catch (const Unsupported&) {  // it draws no depths of 16 bits
  }
  found(C::Depth::as_asked, of_24 + ", which are asked for");
  learn_rounding(prober, codes, n);
}

void learn_format(Prober& prober) {
  const ConventionWords format = words_of("depth_format"), rounding = words_of("depth_rounding");
  const Depths depths = depths_of(prober, "depth_codes", given_depths());
  const auto& [given, left, lost] = depths;
  const auto is_same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  if (!std::ranges::equal(depths_of(prober, "depth_codes", given_depths()).left, left, is_same))
    prober.unexplained("one scene's depths, drawn twice, differ");
  const std::size_t n = given.size();
  const C::DepthRange range = prober.learned.conventions.depth_range;
  const Codes of_16 = codes_of(16, depths, range), of_24 = codes_of(24, depths, range);
  constexpr double kFourRoundings = 0x1p-22;    // of floats below 1
  std::size_t is_float = 0, is_near_float = 0;  // multiples of 2^-16 are floats
  for (std::size_t i = 0; i < n; ++i) {
    is_float += left[i] == given[i] ? 1 : 0;
    is_near_float += std::abs(left[i] - given[i]) <= kFourRoundings ? 1 : 0;
  }
  const auto take = [&](C::Depth found, std::size_t fits, const char* as) {
    prober.learned.conventions.depth_format = found;
    prober.found(format, name_of(found), fmt::format("{} of {} depths are {}", fits, n, as));
  };
  if (of_16.codes == n && nearly_all(of_16.most(), n)) {
    take(C::Depth::z16, of_16.codes, "codes of 16 bits");
    return learn_rounding(prober, of_16, n);
  }
  if (nearly_all(is_float, n)) {
    take(C::Depth::z32f, is_float, "floats");
    return prober.found(rounding, "nearest", "depths are floats");
  }
  const auto are_codes_of = [&](int bits) { return nearly_all(codes_of(bits, depths, range).codes, n); };
  const bool are_codes = std::ranges::any_of(std::array{17, 18, 19, 20, 21, 22, 23, 24}, are_codes_of);
  if (nearly_all(is_near_float, n) && !are_codes) {
    take(C::Depth::z32f, is_near_float, "within four roundings of float, and no codes: floats");
    return prober.found(rounding, "nearest", "depths are floats");
  }
  if (nearly_all(of_24.near, n)) return learn_16_bits(prober, of_24, n);
  double least = 0, most = 0;
  for (std::size_t i = 0; i < n; ++i)
    least = std::min(least, left[i] - given[i]), most = std::max(most, left[i] - given[i]);
  prober.fits_none(format,
                   fmt::format("the depths given are left neither as codes of 16 or 24 bits nor as floats: {:+.2g} "
                               "to {:+.2g} off",
                               least, most));
  prober.open(rounding, "the format is open");
}

}  // namespace

// A rectangle in the lower left quarter.
void learn_rows(Prober& prober) {
  const ConventionWords words = words_of("rows");
  Scene scene = probe_frame("rows", 16, 16);
  add_triangles(scene, rectangle({0, 0}, {8, 8}, kFlatDepth, glm::vec4(1)));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  std::array<std::size_t, 4> in_quarter{};  // lower left, lower right, upper left, upper right
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x)
      in_quarter[static_cast<std::size_t>(y / 8 * 2 + x / 8)] += is_white(color(x, y)) ? 1 : 0;
  }
  const glm::vec4 first = color(0, 0);
  prober.sees_nothing =
      std::ranges::all_of(color.values(), [&](const glm::vec4& c) { return c == first || !(c == c); });
  if (prober.sees_nothing)
    prober.unexplained("a white rectangle in a quarter of a black picture: every pixel has one colour or is NaN");
  const std::size_t most = *std::ranges::max_element(in_quarter),
                    all = std::accumulate(in_quarter.begin(), in_quarter.end(), std::size_t{0});
  const std::string evidence =
      all == 0 ? "a rectangle of 64 pixels in the lower left quarter: no pixel is white"
               : fmt::format(
                     "a rectangle of 64 pixels in the lower left quarter: of {} white pixels {} are there, {} in "
                     "the lower right, {} in the upper left, {} in the upper right",
                     all, in_quarter[0], in_quarter[1], in_quarter[2], in_quarter[3]);
  if (most < 32 || 2 * most <= all) return prober.fits_none(words, evidence);
  if (most == in_quarter[1] || most == in_quarter[3])
    prober.unexplained("columns are counted from the right: " + evidence);
  const C::Rows rows = most == in_quarter[0] || most == in_quarter[1] ? C::Rows::from_bottom : C::Rows::from_top;
  prober.learned.conventions.rows = rows;
  prober.found(words, name_of(rows), fmt::format("{} of 64 pixels", most));
}

void learn_depths(Prober& prober) {
  constexpr std::size_t kFewest = 3;  // depths that tell a range
  const ConventionWords range = words_of("depth_range");
  const Depths depths = depths_of(prober, "depth_range", {0.125, 0.25, 0.5, 0.75, 0.875});
  const auto& [given, left, lost] = depths;
  const auto text = [](const std::vector<double>& of) { return fmt::format("{:.4g}", fmt::join(of, ", ")); };
  if (!lost.empty()) prober.unexplained(fmt::format("rectangles at depth {} are not drawn", text(lost)));
  for (const auto found : {C::DepthRange::zero_to_one, C::DepthRange::minus_one_to_one, C::DepthRange::one_to_zero}) {
    if (given.size() < kFewest || fitting(found, depths) != given.size()) continue;
    prober.learned.conventions.depth_range = found;
    prober.found(range, name_of(found), fmt::format("{} of {} depths", given.size(), given.size() + lost.size()));
    return learn_format(prober);
  }
  prober.fits_none(range, given.empty() ? "no rectangle is drawn"
                                        : fmt::format("depths {} are left as {}", text(given), text(left)));
  for (const char* name : {"depth_format", "depth_rounding"}) prober.open(words_of(name), "the range is open");
}

}  // namespace plumbline::learn
