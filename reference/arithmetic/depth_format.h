// What a frame keeps of a depth, and which depths it lets pass.
#pragma once

#include "scene/scene.h"

namespace plumbline::math {

/// Window z, clamped to [0,1], as the format's number: code / (2^n - 1), rounded to nearest, half to even (z8: half
/// up, int(z + .5)); z32f: as float.
double in_format(DepthFormat format, double z_win);

/// Whether `incoming func stored` holds, as glDepthFunc has it.
bool passes(DepthFunc func, double incoming, double stored);

}  // namespace plumbline::math
