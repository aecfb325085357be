// Error bound of stage 9 (shade): errors of its inputs, and its own roundings.
#pragma once

#include <array>
#include <span>

#include "capture/stages.h"
#include "check/bounds/bounds.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Inputs of stage 9 for one fragment, or the error of each.
struct ShadeInputs {
  Vec4<double> color{0};
  std::array<Vec4<double>, kVaryings> varyings{};
  Vec4<double> texel{0};
  std::span<const LightSource<double>> lights{};  ///< recorded ones; none of errors
  Vec4<double>& operator[](Varying v) { return varyings[static_cast<std::size_t>(v)]; }
  const Vec4<double>& operator[](Varying v) const { return varyings[static_cast<std::size_t>(v)]; }
};
/// Inputs of fragment number `i`; 0 for a column that the records lack. `lights` points into the records.
ShadeInputs shade_inputs_of(const Records<double>& records, std::size_t i);

/// Error of the shaded colour, per channel: of inputs off by `errors`, and of each step's `roundings` in float.
/// Light per fragment: light_bounds.h, 4 u of its magnitude per rounding; infinite where a light may come or go, or
/// the normal may vanish. Texture environment: texture_bounds.h. Sum of colours: both errors, and 1 u. Fog: |df| |C -
/// C_fog| + f |dC|; df = density f |dz| (exp), 2 density^2 c f |dz| (exp2), |dz| / |end - start| (linear), and f's own:
/// its argument's rounding, which the exponential makes absolute, and its underflow.
Vec4<double> shade_error(const Scene& scene, const Draw& draw, const ShadeInputs& attributes, const ShadeInputs& errors,
                         const Roundings& roundings);

}  // namespace plumbline::check
