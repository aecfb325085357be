// Stage 9's error, from its attributes' and its own arithmetic.
#pragma once

#include <array>
#include <span>

#include "capture/stages.h"
#include "check/bounds/bounds.h"
#include "scene/scene.h"

namespace plumbline::check {

/// A fragment's attributes, or how far each may be off.
struct FragmentFours {
  Vec4<double> color{0};
  std::array<Vec4<double>, kVaryings> varyings{};
  Vec4<double> texel{0};
  std::span<const LightSource<double>> lights{};  ///< recorded ones; none of errors
  Vec4<double>& operator[](Varying v) { return varyings[static_cast<std::size_t>(v)]; }
  const Vec4<double>& operator[](Varying v) const { return varyings[static_cast<std::size_t>(v)]; }
};
/// Columns of fragment number `i`: a span into the records.
FragmentFours fours_of(const Records<double>& records, std::size_t i);

/// Per channel: what attributes off by `errors` and, in float, the `roundings` of each step come to.
/// Light per fragment: light_bounds.h, 4 u for one, of a normal brought to unit length; infinite where a light may come
/// or go. Texture environment: texture_bounds.h. The sum of colours: their errors, and 1 u. Fog: |df| |C -
/// C_fog| + f |dC|; df = density f |dz| (exp), 2 density^2 c f |dz| (exp2), |dz| / |end - start| (linear), and f's own:
/// its argument's rounding, which the exponential makes absolute, and its underflow.
Vec4<double> shade_error(const Scene& scene, const Draw& draw, const FragmentFours& attributes,
                         const FragmentFours& errors, const Roundings& roundings);

}  // namespace plumbline::check
