// Order of rows; range, format and rounding of depths.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kDepthsInRow = 16;

// Rectangles of 4 x 4 pixels, each at one depth.
Scene at_depths(const std::string& name, const std::vector<double>& depths) {
  Scene scene = probe_frame(name, 4 * kDepthsInRow, 4 * kDepthsInRow);
  std::vector<std::array<ProbeCorner, 3>> triangles;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const glm::dvec2 low(4.0 * static_cast<double>(i % kDepthsInRow), 4.0 * static_cast<double>(i / kDepthsInRow));
    for (const auto& t : rectangle(low, low + 4.0, depths[i], glm::vec4(1))) triangles.push_back(t);
  }
  add_triangles(scene, triangles);
  return scene;
}

// The depth in the middle of each of them; none: the renderer leaves no depths.
std::optional<std::vector<double>> depths_of(Prober& prober, const std::string& name,
                                             const std::vector<double>& depths) {
  const Plane<double> plane = prober.draw(at_depths(name, depths)).depth;
  if (plane.empty()) return std::nullopt;
  std::vector<double> out;
  for (std::size_t i = 0; i < depths.size(); ++i)
    out.push_back(plane(static_cast<int>(4 * (i % 16) + 2), static_cast<int>(4 * (i / 16) + 2)));
  return out;
}

// How many depths lie within `apart` of what the range makes of them.
std::size_t fitting(C::DepthRange range, const std::vector<double>& given, const std::vector<double>& left) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double z = range == C::DepthRange::minus_one_to_one ? 2 * given[i] - 1
                     : range == C::DepthRange::one_to_zero    ? 1 - given[i]
                                                              : given[i];
    out += std::abs(left[i] - z) < 1e-4 ? 1 : 0;
  }
  return out;
}

// Codes of n bits: how many depths are codes, within what a float loses, and how many of those are the nearest and the
// lower one. Depths are multiples of 2^-16 below 2/5: z (2^n - 1) lies z below a whole number.
struct Codes {
  std::size_t codes = 0, nearest = 0, lower = 0;
};
Codes codes_of(double bits, const std::vector<double>& given, const std::vector<double>& left) {
  const double scale = std::ldexp(1.0, static_cast<int>(bits)) - 1;
  Codes out;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double code = std::round(left[i] * scale), exact = given[i] * scale;
    out.codes += std::abs(left[i] * scale - code) < 0.26 ? 1 : 0;
    out.nearest += code == std::round(exact) ? 1 : 0;
    out.lower += code == std::floor(exact) ? 1 : 0;
  }
  return out;
}

void learn_format(Prober& prober) {
  const ConventionWords format = words_of("depth_format"), rounding = words_of("depth_rounding");
  std::vector<double> given;
  for (int i = 0; i < 256; ++i) given.push_back((2000 + 97 * i) / 65536.0);
  const std::vector<double> left = depths_of(prober, "depth_codes", given).value();
  const auto count = [&](std::size_t n) { return fmt::format("{} of {} depths", n, given.size()); };
  const Codes of_16 = codes_of(16, given, left), of_24 = codes_of(24, given, left);
  std::size_t is_float = 0;  // multiples of 2^-16 are
  for (std::size_t i = 0; i < given.size(); ++i) is_float += left[i] == given[i] ? 1 : 0;
  C& c = prober.learned.conventions;
  const auto take = [&](C::Depth found, const Codes* codes, std::size_t fits) {
    c.depth_format = found;
    prober.found(format, name_of(found), count(fits) + (codes == nullptr ? " as floats" : " are its codes"));
    if (codes == nullptr) return prober.found(rounding, "nearest", "depths are floats");
    c.depth_rounding = codes->lower > codes->nearest ? C::Rounding::down : C::Rounding::nearest;
    prober.found(rounding, name_of(c.depth_rounding), count(std::max(codes->lower, codes->nearest)));
  };
  if (of_16.codes == given.size() && std::max(of_16.nearest, of_16.lower) * 50 >= given.size() * 49)
    return take(C::Depth::z16, &of_16, of_16.codes);
  if (is_float * 50 >= given.size() * 49) return take(C::Depth::z32f, nullptr, is_float);
  if (std::max(of_24.nearest, of_24.lower) * 50 >= given.size() * 49) {
    take(C::Depth::z24, &of_24, of_24.codes);
    c.depth_format = C::Depth::as_asked;  // the probe asks for 24 bits
    prober.learned.rows[prober.learned.rows.size() - 2].value = "as_asked";
    return;
  }
  prober.open(format, "depths are neither codes of 16 or 24 bits nor floats");
  prober.open(rounding, "likewise");
}

}  // namespace

void learn_rows(Prober& prober) {
  Scene scene = probe_frame("rows", 16, 16);
  add_triangles(scene, rectangle({0, 0}, {16, 8}, 0.5, glm::vec4(1)));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  std::size_t below = 0, above = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) (y < 8 ? below : above) += is_white(color(x, y)) ? 1 : 0;
  }
  const glm::vec4 first = color(0, 0);
  if (std::ranges::all_of(color.values(), [&](const glm::vec4& c) { return c == first || !(c == c); }))
    prober.contradicts("a white rectangle in the lower half of a black picture: every pixel has one colour or is NaN");
  if (prober.draw(scene).color.values() != color.values()) prober.contradicts("one scene drawn twice differs");
  if (std::max(below, above) < std::min(below, above) + 64) {
    prober.contradicts(fmt::format("a rectangle of 128 pixels in the lower half: {} pixels there, {} in the upper half",
                                   below, above));
    return prober.open(words_of("rows"), "neither half holds the rectangle");
  }
  const C::Rows rows = below > above ? C::Rows::from_bottom : C::Rows::from_top;
  prober.learned.conventions.rows = rows;
  prober.found(words_of("rows"), name_of(rows), fmt::format("{} of 128 pixels", std::max(below, above)));
}

void learn_depths(Prober& prober) {
  const ConventionWords range = words_of("depth_range");
  const std::vector<double> given = {0.125, 0.25, 0.5, 0.75, 0.875};
  const auto left = depths_of(prober, "depth_range", given);
  if (!left) {
    for (const char* name : {"depth_range", "depth_format", "depth_rounding"})
      prober.open(words_of(name), "it leaves no planes.depth");
    return;
  }
  for (const auto found : {C::DepthRange::zero_to_one, C::DepthRange::minus_one_to_one, C::DepthRange::one_to_zero}) {
    if (fitting(found, given, *left) != given.size()) continue;
    prober.learned.conventions.depth_range = found;
    prober.found(range, name_of(found), fmt::format("{} of {} depths", given.size(), given.size()));
    return learn_format(prober);
  }
  prober.open(range,
              fmt::format("0.125, 0.25, 0.5, 0.75 and 0.875 are left as {:.4g}, {:.4g}, {:.4g}, {:.4g} and {:.4g}",
                          (*left)[0], (*left)[1], (*left)[2], (*left)[3], (*left)[4]));
  for (const char* name : {"depth_format", "depth_rounding"}) prober.open(words_of(name), "the range is open");
}

// A rectangle moved towards the eye by many units, in depths of 24 and of 16 bits, beside one that is not.
void learn_offset_unit(Prober& prober) {
  C& c = prober.learned.conventions;
  if (c.depth_format == C::Depth::z32f) return prober.open(kOffsetWords, "depths are floats, whose unit is their step");
  std::string evidence;
  try {
    for (const DepthFormat format : {DepthFormat::z24, DepthFormat::z16}) {
      const bool codes_of_16 = format == DepthFormat::z16 || c.depth_format == C::Depth::z16;
      const double units = codes_of_16 ? 14336 : 14336 * 256, scale = codes_of_16 ? 65535 : 16777215;
      double left[2] = {0, 0};
      for (const int moved : {0, 1}) {
        Scene scene = at_depths("offset_unit", {0.75});
        scene.frame.depth = format;
        scene.draws[0].polygon_offset = {0, static_cast<float>(-units * moved)};
        const Plane<double> depth = prober.draw(scene).depth;
        if (depth.empty()) return prober.open(kOffsetWords, "it leaves no planes.depth");
        left[moved] = depth(2, 2);
      }
      const double codes = (left[0] - left[1]) * scale, unit = codes / units;
      if (!(unit > 0.01)) return prober.open(kOffsetWords, "an offset moves nothing");
      (format == DepthFormat::z16 ? c.offset_unit.y : c.offset_unit.x) = std::round(unit * 1e4) / 1e4;
      evidence +=
          fmt::format("{}{} units are {:.0f} codes", format == DepthFormat::z16 ? ", of 16 bits " : "", units, codes);
    }
    prober.found(kOffsetWords, fmt::format("{:.4g}, {:.4g}", c.offset_unit.x, c.offset_unit.y), evidence);
  } catch (const Unsupported& e) {
    prober.open(kOffsetWords, e.what());
  }
}

}  // namespace plumbline::learn
