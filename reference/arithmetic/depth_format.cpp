#include "reference/arithmetic/depth_format.h"

#include <algorithm>
#include <cmath>

namespace plumbline::math {

double in_format(DepthFormat format, double z_win) {
  const double z = std::clamp(z_win, 0.0, 1.0), scale = depth_scale(format);
  switch (format) {
    case DepthFormat::z8: return std::round(z * scale) / scale;
    case DepthFormat::z16:
    case DepthFormat::z24: return std::nearbyint(z * scale) / scale;
    case DepthFormat::z32f: break;
  }
  return static_cast<double>(static_cast<float>(z));
}

bool passes(DepthFunc func, double incoming, double stored) {
  switch (func) {
    case DepthFunc::never: return false;
    case DepthFunc::less: return incoming < stored;
    case DepthFunc::equal: return incoming == stored;
    case DepthFunc::less_equal: return incoming <= stored;
    case DepthFunc::greater: return incoming > stored;
    case DepthFunc::not_equal: return incoming != stored;
    case DepthFunc::greater_equal: return incoming >= stored;
    case DepthFunc::always: return true;
  }
  return false;
}

}  // namespace plumbline::math
