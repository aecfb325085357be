// Depth formats and the depth test.
#pragma once

#include "scene/scene.h"

namespace plumbline::math {

/// Window z, clamped to [0,1] and rounded to the format: code / (2^n - 1) of the nearest code, half to even (z8: half
/// up, int(z + .5)); z32f: the nearest float.
double in_format(DepthFormat format, double z_win);

/// Depth test: `incoming func stored` (glDepthFunc).
bool passes(DepthFunc func, double incoming, double stored);

}  // namespace plumbline::math
