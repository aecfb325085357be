// Our renderer by conventions of textures and polygon offsets that OpenGL leaves open.
#pragma once

#include <cmath>

#include "kernels/texture.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::test {

using pipeline::FilteredTexel;
using pipeline::Gradients;
using pipeline::TexCoords;
using pipeline::TextureSetup;

/// level_of_detail `approximate`: rho is the sum of the largest derivatives of u and of v, OpenGL's upper limit (2.1,
/// 3.8.8).
inline FilteredTexel<float> by_largest_rho(const TextureSetup& t, const TexCoords<float>& at,
                                           const Gradients<float>& g) {
  const double q2 = static_cast<double>(g.q) * static_cast<double>(g.q);
  const auto larger = [&](double dx, double dy, double size) {
    return size * std::max(std::abs(dx), std::abs(dy)) / q2;
  };
  const double rho = larger(g.ds_dx, g.ds_dy, t.width) + larger(g.dt_dx, g.dt_dy, t.height);
  const double lambda = std::log2(std::max(rho, 1e-30)) + static_cast<double>(t.sampler.lod_bias);
  const float lod = pipeline::clamped(static_cast<float>(lambda), t.sampler.min_lod, t.sampler.max_lod);
  return {pipeline::sample<float>(t, at, lod), lod};
}

/// `magnified` up_to_zero.
inline FilteredTexel<float> magnified_up_to_zero(const TextureSetup& t, const TexCoords<float>& at,
                                                 const Gradients<float>& g) {
  TextureSetup other = t;
  other.c = other.magnified_rho2 = 0;
  return pipeline::texture<float>(other, at, g);
}

/// `half_way_level` either: the coarser of the two.
inline FilteredTexel<float> half_way_up(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  FilteredTexel<float> out = pipeline::texture<float>(t, at, g);
  if (out.lod > 0.5f && out.lod - std::floor(out.lod) == 0.5f)
    out.color = pipeline::sample<float>(t, at, out.lod + 0.125f);
  return out;
}

inline double to_nearest(double v) { return std::nearbyint(v); }
inline double towards_0(double v) { return std::trunc(v); }

/// `texture_bits` 6, or those given, of the base level.
template <int bits = 6, double (*round)(double) = to_nearest>
FilteredTexel<float> weights_of_bits(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const auto rounded = [](float coordinate, double size) {
    constexpr double kSteps = 1 << bits;
    const double texels = round((static_cast<double>(coordinate) * size - 0.5) * kSteps) / kSteps;
    return static_cast<float>((texels + 0.5) / size);
  };
  const FilteredTexel<float> out = pipeline::texture<float>(t, at, g);
  if (out.lod > static_cast<float>(t.c) && mipmaps(t.sampler.min)) return out;
  return pipeline::texture<float>(t, {rounded(at.s, t.width), rounded(at.t, t.height)}, g);
}

/// The base level, with weights a a (3 - 2 a).
inline FilteredTexel<float> smooth_weights(const TextureSetup& t, const TexCoords<float>& at,
                                           const Gradients<float>& g) {
  const auto smoothed = [](float coordinate, double size) {
    const double texels = static_cast<double>(coordinate) * size - 0.5, low = std::floor(texels), a = texels - low;
    return static_cast<float>((low + a * a * (3 - 2 * a) + 0.5) / size);
  };
  return pipeline::texture<float>(t, {smoothed(at.s, t.width), smoothed(at.t, t.height)}, g);
}

/// Samples that lie 0.03 texels too far.
inline FilteredTexel<float> moved_by_a_texels_part(const TextureSetup& t, const TexCoords<float>& at,
                                                   const Gradients<float>& g) {
  const auto moved = [](float coordinate, double size) { return coordinate + static_cast<float>(0.03 / size); };
  return pipeline::texture<float>(t, {moved(at.s, t.width), moved(at.t, t.height)}, g);
}

/// The scene under which a unit of polygon offset is one code, not two.
inline Scene with_half_of_offsets(Scene scene) {
  for (Draw& draw : scene.draws) draw.polygon_offset.units /= 2;
  return scene;
}

}  // namespace plumbline::test
