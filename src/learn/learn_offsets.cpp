// Units of polygon offsets, by how far they move a rectangle.
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

// Displacement towards 0 of a rectangle at a depth, by a polygon offset of so many units [window z].
double moved_by(Prober& prober, const std::string& name, DepthFormat format, double depth, double units) {
  double left[2] = {0, 0};
  for (const int moved : {0, 1}) {
    Scene scene = probe_frame(name, 8, 8);
    scene.frame.depth = format;
    add_triangles(scene, rectangle({0, 0}, {8, 8}, in_volume(prober.learned.conventions, depth), glm::vec4(1)));
    scene.draws[0].polygon_offset = {0, static_cast<float>(-units * moved)};
    left[moved] = prober.draw_depths(scene)(1, 2);
  }
  return left[0] - left[1];
}

}  // namespace

// Units of depths of 24 and of 16 bits, in codes.
void learn_offset_unit(Prober& prober) {
  C& c = prober.learned.conventions;
  if (c.depth_format == C::Depth::z32f) return prober.open(kOffsetWords, "depths are floats");
  if (prober.open_if_any_open(kOffsetWords, {"depth_range", "depth_format"})) return;
  std::string evidence;
  glm::dvec2 units_of = c.offset_unit;
  for (const DepthFormat format : {DepthFormat::z24, DepthFormat::z16}) {
    const bool codes_of_16 =
        c.depth_format == C::Depth::z16 || (format == DepthFormat::z16 && c.depth_format != C::Depth::z24);
    const double units = codes_of_16 ? 14336 : 14336 * 256, scale = codes_of_16 ? 65535 : 16777215;
    double moved = 0;
    try {
      moved = moved_by(prober, "offset_unit", format, 0.75, units);
    } catch (const Unsupported& error) {
      if (evidence.empty()) throw;
      evidence += fmt::format("; depths of 16 bits: {}", error.what());
      break;
    }
    const double codes = moved * scale, unit = codes / units;
    if (!(unit > 0.01))
      return prober.fits_none(kOffsetWords, fmt::format("{} units move a depth by {:.0f} codes", units, codes));
    (format == DepthFormat::z16 ? units_of.y : units_of.x) = std::round(unit * 1e4) / 1e4;
    evidence += fmt::format("{}{} units move a depth of {} bits by {:.0f} codes", evidence.empty() ? "" : ", ", units,
                            codes_of_16 ? 16 : 24, codes);
  }
  c.offset_unit = units_of;
  prober.found(kOffsetWords, fmt::format("{:.4g}, {:.4g}", c.offset_unit.x, c.offset_unit.y), evidence);
}

// Unit of depths of floats. The step of floats at 3/4 is 4 times that at 3/16.
void learn_float_offset_unit(Prober& prober) {
  C& c = prober.learned.conventions;
  if (c.depth_format != C::Depth::z32f && c.depth_format != C::Depth::as_asked)
    return prober.open(kFloatOffsetWords, "depths have codes");
  if (prober.open_if_any_open(kFloatOffsetWords, {"depth_range", "depth_format"})) return;
  constexpr double kUnits = 0x1p19, kStep = 0x1p-24;  // of 3/4
  // A renderer of floats alone may refuse a frame that asks for floats.
  const DepthFormat format = c.depth_format == C::Depth::z32f ? DepthFormat::z24 : DepthFormat::z32f;
  const double large = moved_by(prober, "float_offset_unit", format, 0.75, kUnits) / kUnits,
               small = moved_by(prober, "float_offset_unit", format, 0.1875, kUnits) / kUnits;
  const auto is_near = [](double a, double b) { return std::abs(a - b) <= 1e-4 * b; };
  const std::string evidence = fmt::format("{} units move a depth of 3/4 by {:.4g}, one of 3/16 by {:.4g}", kUnits,
                                           large * kUnits, small * kUnits);
  if (is_near(large, kStep) && is_near(small, kStep / 4))
    return prober.found(kFloatOffsetWords, "the step of floats", evidence);
  if (!(large > 0) || !(small > 0)) return prober.fits_none(kFloatOffsetWords, evidence);
  if (!is_near(small, large)) return prober.open(kFloatOffsetWords, evidence);
  const double power = std::exp2(std::round(std::log2(large)));  // what depths in float leave of it
  c.float_offset_unit = is_near(large, power) ? power : large;
  prober.found(kFloatOffsetWords, fmt::format("{:.4g}", c.float_offset_unit), evidence);
}

}  // namespace plumbline::learn
