// Outcomes of a fragment's depth, alpha and stencil tests, of one number or of an interval: for judges.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace plumbline {

/// Outcomes of `v func reference` over v in [lo, hi], lo <= hi (glDepthFunc, glAlphaFunc); lo or hi of NaN: any v.
struct Outcomes {
  bool may_pass, may_fail;
};
Outcomes outcomes(CompareFunc func, double lo, double hi, double reference);

/// Window z in [0,1] as the format's number: code / (2^n - 1), the nearest code, half to even (z8: half up); z32f: as
/// float.
double depth_in_format(DepthFormat format, double z_win);

/// Whether every depth passes against the held depth: by less_equal against 1 and by greater_equal against 0, because
/// depths are always limited to [0,1] (OpenGL 2.1 spec 3.5.5; Vulkan 1.2 "Depth Bias": depths of floats, too).
bool passes_all_over(DepthFunc func, double held);

/// Outcomes of the alpha test for an alpha in [lo, hi] (OpenGL 2.1 spec 4.1.4, 4.5 compatibility 17.3.4): where the
/// frame's format has codes, the nearest codes of alpha and reference are compared, half to even.
Outcomes alpha_outcomes(const AlphaTest& test, ColorFormat format, double lo, double hi);

/// Stencil test, (reference & mask) func (held & mask) (OpenGL 2.1 spec 4.1.5). `held`: the stored value.
bool stencil_passes(const StencilFace& face, std::uint8_t held);
/// Stencil value after the stencil and depth tests. `held`: the value before; `passes_depth`: the depth test passes.
std::uint8_t stencil_after(const StencilFace& face, bool passes_depth, std::uint8_t held);

}  // namespace plumbline
