// Stage 8: texture filtering, from OpenGL 2.1's equations (3.8.7 to 3.8.9), on real numbers; and stage 9's environment.
#pragma once

#include <glm/glm.hpp>

#include "capture/conventions.h"
#include "capture/legal.h"
#include "reference/arithmetic/bounded.h"
#include "scene/scene.h"

namespace plumbline::math {

/// How a renderer finds levels and means of texels.
struct LevelRules {
  bool approximate = false;        ///< rho
  bool magnified_to_zero = false;  ///< up to a lambda of 0, whatever the filters
  bool half_way_either = false;    ///< the nearest level, where two are as near
  int weight_bits = Conventions::kFloat;
};
LevelRules level_rules(const Conventions& conventions);

/// lambda, with the texture's bias and limits (equations 3.17 to 3.22), from the derivatives of (s, t) by window x and
/// y; of no length, the least that is allowed.
double level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy);

/// The least and the greatest lambda of the specification and of Mesa, from the same derivatives.
/// Mesa's drivers take a logarithm that is linear between powers of two, of rho squared: up to 0.0431 below
/// (log2(m 2^e) as e + m - 1 is up to 0.0861 below; half of that). Mesa rounds the bias to the nearest 1/256 before its
/// drivers see it (st_atom_sampler.c; measured in 22.3.6): up to 1/512 below or above.
///
/// Where `rules` say that it is approximated, rho is anything from the largest absolute derivative of a texel
/// coordinate to the sum of the largest of each (OpenGL 2.1, 3.8.8).
double smallest_level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy, const LevelRules& rules = {});
double largest_level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy, const LevelRules& rules = {});

/// The texture source components at (s, t), filtered at lambda.
glm::dvec4 filtered_texel(const Texture& texture, glm::dvec2 st, double lambda, const LevelRules& rules = {});

/// Whether lambda makes a difference to it.
bool depends_on_lambda(const Sampler& sampler);

/// What filtered_texel() comes to where lambda is in an interval, and (s, t) not quite known.
TexelRange texel_range(const Texture& texture, glm::dvec2 st, double lambda_lo, double lambda_hi,
                       const LevelRules& rules = {});

/// One channel of a fragment's colour and a texel as one (tables 3.22 and 3.23), by the operations `by` (bounded.h).
/// `alpha`: it is alpha. Of `fragment`, `texel` and the environment's `constant`, that channel.
template <class Number, class Operations>
Number textured_channel(TextureFormat format, TextureEnvironment environment, bool alpha, Number fragment, Number texel,
                        Number texel_alpha, Number constant, const Operations& by) {
  using F = TextureFormat;
  using E = TextureEnvironment;
  const bool intensity = format == F::intensity;
  if (alpha ? format == F::luminance || format == F::rgb || environment == E::decal : format == F::alpha)
    return fragment;
  switch (environment) {
    case E::replace: return texel;
    case E::decal: return format == F::rgb ? texel : by.mixed(fragment, texel, texel_alpha);
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

/// All channels. Sums are clamped to [0,1].
glm::dvec4 textured_color(TextureFormat format, const DrawTexture& state, const glm::dvec4& fragment,
                          const glm::dvec4& texel);

/// The same where colour, texture coordinates and lambda are known to bounds: the value in the middle, and how far any
/// channel may be from it; infinite where it is open which texel is the nearest.
struct BoundedPlace {
  glm::dvec2 st{0};
  double bound = 0;  ///< of s and t
  double lambda = 0, lambda_lo = 0, lambda_hi = 0;
};
BoundedFour bounded_textured_color(const Texture& texture, const DrawTexture& state, const BoundedFour& fragment,
                                   const BoundedPlace& place, const LevelRules& rules = {});

}  // namespace plumbline::math
