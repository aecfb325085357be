#include "check/compare/compare_bits.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace plumbline::check {

namespace {

// Bits: an unsigned integer as wide as Real.
template <class Bits, class Real>
double steps_apart(Real a, Real b, double scale) {
  if (std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b)) return 0;
  return std::max(difference(a, b) * (scale > 0 ? scale : 1), 0x1p-1074);
}

std::string unit_of(double scale) { return scale > 0 ? fmt::format("1/{}", scale) : "1"; }

}  // namespace

Measurement compare_color_bits(const Plane<glm::vec4>& a, const Plane<glm::vec4>& b, ColorFormat format) {
  const double scale = color_scale(format);
  constexpr const char* kFields[] = {"r", "g", "b", "a"};
  return compare_planes(a, b, unit_of(scale), [&](Meter& meter, int x, int y) {
    for (int c = 0; c < 4; ++c) {
      const float v = a(x, y)[c], w = b(x, y)[c];  // conversion to double would quiet a signalling NaN
      meter.value(steps_apart<std::uint32_t>(v, w, scale), 0, {x, y, -1, kFields[c]}, v, w);
    }
  });
}

Measurement compare_depth_bits(const Plane<double>& a, const Plane<double>& b, DepthFormat format) {
  const double scale = depth_scale(format);
  return compare_planes(a, b, unit_of(scale), [&](Meter& meter, int x, int y) {
    const double v = a(x, y), w = b(x, y);
    meter.value(steps_apart<std::uint64_t>(v, w, scale), 0, {x, y, -1, "z"}, v, w);
  });
}

Measurement compare_picture(const FrameFormat& format, const Planes& candidate, const Planes& reference) {
  Measurement out = worse(compare_color_bits(candidate.color, reference.color, format.color),
                          compare_depth_bits(candidate.depth, reference.depth, format.depth));
  if (format.stencil == StencilFormat::none) return out;
  return worse(std::move(out), compare_equal(candidate.stencil, reference.stencil, "stencil"));
}

}  // namespace plumbline::check
