#include "capture/fragment_outcomes.h"

#include <algorithm>
#include <cmath>

namespace plumbline {

Outcomes outcomes(CompareFunc func, double lo, double hi, double reference) {
  const bool is_fixed = func == CompareFunc::never || func == CompareFunc::always;
  if (!is_fixed && (std::isnan(lo) || std::isnan(hi))) return {true, true};
  const bool less = lo < reference, equal = lo <= reference && reference <= hi, greater = hi > reference;
  switch (func) {
    case CompareFunc::never: return {false, true};
    case CompareFunc::less: return {less, equal || greater};
    case CompareFunc::equal: return {equal, less || greater};
    case CompareFunc::less_equal: return {less || equal, greater};
    case CompareFunc::greater: return {greater, less || equal};
    case CompareFunc::not_equal: return {less || greater, equal};
    case CompareFunc::greater_equal: return {equal || greater, less};
    case CompareFunc::always: return {true, false};
  }
  return {true, true};
}

double depth_in_format(DepthFormat format, double z_win) {
  const double scale = depth_scale(format);
  if (format == DepthFormat::z32f) return static_cast<double>(static_cast<float>(z_win));
  return (format == DepthFormat::z8 ? std::round(z_win * scale) : std::nearbyint(z_win * scale)) / scale;
}

bool passes_all_over(DepthFunc func, double held) {
  return (func == DepthFunc::less_equal && held == 1) || (func == DepthFunc::greater_equal && held == 0);
}

Outcomes alpha_outcomes(const AlphaTest& test, ColorFormat format, double lo, double hi) {
  const double reference = test.reference, scale = color_scale(format);
  if (scale == 0) return outcomes(test.func, lo, hi, reference);
  const auto code = [&](double v) { return std::nearbyint(std::clamp(v, 0.0, 1.0) * scale); };
  return outcomes(test.func, code(lo), code(hi), code(reference));
}

bool stencil_passes(const StencilFace& face, std::uint8_t held) {
  const double mine = face.reference & face.mask, theirs = held & face.mask;
  return outcomes(face.func, mine, mine, theirs).may_pass;
}

std::uint8_t stencil_after(const StencilFace& face, bool passes_depth, std::uint8_t held) {
  const StencilOp op = !stencil_passes(face, held) ? face.fail : passes_depth ? face.pass : face.depth_fail;
  int value = held;
  switch (op) {
    case StencilOp::keep: break;
    case StencilOp::zero: value = 0; break;
    case StencilOp::replace: value = face.reference; break;
    case StencilOp::increment: value = std::min(held + 1, 255); break;
    case StencilOp::increment_wrap: value = held + 1; break;
    case StencilOp::decrement: value = std::max(held - 1, 0); break;
    case StencilOp::decrement_wrap: value = held - 1; break;
    case StencilOp::invert: value = ~value; break;
  }
  return static_cast<std::uint8_t>((held & ~face.write_mask) | (value & face.write_mask));
}

}  // namespace plumbline
