// Stage 8: texture filtering, from OpenGL 2.1's equations (3.8.7 to 3.8.9), on real numbers; and stage 9's environment.
#pragma once

#include <glm/glm.hpp>

#include "capture/conventions.h"
#include "capture/legal.h"
#include "reference/arithmetic/bounded.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Rules of levels of detail and filters, by a renderer's conventions (level_rules()).
struct LevelRules {
  bool approximate = false;               ///< rho is approximated within OpenGL's limits (2.1, 3.8.8)
  bool magnified_to_zero = false;         ///< magnified up to a lambda of 0, whatever the filters
  bool half_way_either = false;           ///< half way between two levels, either may be the nearest
  int weight_bits = Conventions::kFloat;  ///< fraction bits of the weights of texels and levels
};
LevelRules level_rules(const Conventions& conventions);
/// Lower row of the 2 x 2 square of row `y`. Squares begin at the first row: at the lowest one, or at the highest one.
inline int lower_row_of_square(Conventions::Rows rows, int height, int y) {
  const int shift = rows == Conventions::Rows::from_top ? height & 1 : 0;
  return ((y + shift) & ~1) - shift;
}

/// LOD lambda, with the texture's bias and limits (equations 3.17 to 3.22), from the derivatives of (s, t) by window x
/// and y [1 / pixel]; where these are 0, min_lod.
double level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy);

/// The least and the greatest lambda of the specification and of Mesa, from the same derivatives. Mesa's drivers take a
/// logarithm of rho squared that is linear between powers of two: lambda is up to 0.0431 too small (e + m - 1 for
/// log2(m 2^e) is up to 0.0861 too small; half of that). Mesa rounds the bias to the nearest 1/256 before its drivers
/// see it (st_atom_sampler.c; measured in 22.3.6): up to 1/512 below or above.
///
/// Under LevelRules::approximate, rho is anything from m = max(m_u, m_v) to m_u + m_v, m_u and m_v being the largest
/// absolute derivatives of the texel coordinates u and v (OpenGL 2.1, 3.8.8).
double smallest_level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy, const LevelRules& rules = {});
double largest_level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy, const LevelRules& rules = {});

/// The texture source components at (s, t), filtered at lambda; NaN where lambda is.
glm::dvec4 filtered_texel(const Texture& texture, glm::dvec2 st, double lambda, const LevelRules& rules = {});

/// Whether filtered_texel() depends on lambda.
bool depends_on_lambda(const Sampler& sampler);

/// Range of filtered_texel() over lambda in [lambda_lo, lambda_hi], with slopes and gaps around (s, t); widened by the
/// error of weights of `weight_bits`.
TexelRange texel_range(const Texture& texture, glm::dvec2 st, double lambda_lo, double lambda_hi,
                       const LevelRules& rules = {});

/// Function of a texture environment for one channel (tables 3.22 and 3.23). `alpha`: the channel is alpha.
struct ChannelFunction {
  TextureFormat format;
  TextureEnvironment environment;
  bool alpha;
};

/// One channel of the texture environment's result, by the operations `by` (bounded.h). `fragment`, `texel` and
/// `constant` (of the environment) are the values of that channel.
template <class Number, class Operations>
Number textured_channel(const ChannelFunction& function, Number fragment, Number texel, Number texel_alpha,
                        Number constant, const Operations& by) {
  using F = TextureFormat;
  using E = TextureEnvironment;
  const auto& [format, environment, alpha] = function;
  const bool intensity = format == F::intensity;
  if (alpha ? format == F::luminance || format == F::rgb || environment == E::decal : format == F::alpha)
    return fragment;
  switch (environment) {
    case E::replace: return texel;
    case E::decal: return by.mixed(fragment, texel, format == F::rgb ? Number{1} : texel_alpha);
    case E::blend:
      if (alpha && !intensity) break;
      return by.mixed(fragment, constant, texel);
    case E::add:
      if (alpha && !intensity) break;
      return by.clamped_sum(fragment, texel);
    case E::modulate: break;
  }
  return by.product(fragment, texel);
}

/// The texture environment's result. Environment `add` clamps to [0,1].
glm::dvec4 textured_color(TextureFormat format, const DrawTexture& state, const glm::dvec4& fragment,
                          const glm::dvec4& texel);

/// Texture coordinates and lambda, with their bounds.
struct BoundedPlace {
  glm::dvec2 st{0};
  glm::dvec2 bound{0};  ///< on the errors of s and of t
  double lambda = 0, lambda_lo = 0, lambda_hi = 0;
};
/// textured_color() of a fragment and a place with bounds. The bound is infinite where the error of (s, t) leaves open
/// which texel is the nearest, or reaches half a texel of a linearly filtered level.
BoundedFour bounded_textured_color(const Texture& texture, const DrawTexture& state, const BoundedFour& fragment,
                                   const BoundedPlace& place, const LevelRules& rules = {});

}  // namespace plumbline::math
