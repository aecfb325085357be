// Our renderer by conventions of colours that OpenGL leaves open.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "faults/faults.h"
#include "kernels/shade.h"
#include "pipeline/geometry.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::test {

// Factor of linear fog that is not clamped; others are in [0, 1].
inline float unclamped_fog_factor(const Fog& fog, float z_eye) {
  if (fog.mode != Fog::Mode::linear) return pipeline::fog_factor<float>(fog, z_eye);
  return (fog.end - std::abs(z_eye)) / (fog.end - fog.start);
}

inline float z_of(const glm::vec3& p_eye) { return p_eye.z; }
inline float length_of(const glm::vec3& p_eye) { return glm::length(p_eye); }

/// Stage light, which leaves fog factors of vertices, by their distance(p_eye), for their eye-space z.
template <auto factor, auto distance>
void light_with_fog_factors(const pipeline::LightInput& in, std::vector<pipeline::Attributes>& out) {
  const std::size_t first = out.size();
  pipeline::light(in, out);
  for (std::size_t i = 0; in.draw.fog && i < in.vertices.size(); ++i)
    out[first + i][Varying::position].b = factor(*in.draw.fog, distance(glm::vec3(in.vertices[i].p_eye)));
}

/// Stage shade, with factors of fog of what is interpolated in place of the fragment's eye-space z.
template <auto factor>
pipeline::Shaded shade_with_fog_factors(const pipeline::Surface& surface, bool front,
                                        const pipeline::SurfaceAttributes<float>& attributes) {
  Draw clear = *surface.draw;
  clear.fog.reset();
  pipeline::Surface without = surface;
  without.draw = &clear;
  const pipeline::Color<float> color = pipeline::shade<float>(without, front, attributes);
  if (!surface.draw->fog) return {color};
  const float f = factor(*surface.draw->fog, attributes[Varying::position].b);
  const glm::vec3& fog = surface.draw->fog->color;
  return {{f * color.r + (1 - f) * fog.r, f * color.g + (1 - f) * fog.g, f * color.b + (1 - f) * fog.b, color.a}};
}

inline float clamped_factor(const Fog&, float interpolated) { return std::clamp(interpolated, 0.0f, 1.0f); }

/// `fog_factor` per_vertex: interpolated as other attributes are. `factor`: factors of vertices.
template <auto factor, auto distance = z_of>
std::unique_ptr<Renderer> make_fog_by_vertices() {
  pipeline::Stages stages = pipeline::production_stages();
  stages.light = light_with_fog_factors<factor, distance>;
  stages.shade = shade_with_fog_factors<clamped_factor>;
  return pipeline::make_pipeline(stages);
}

/// `fog_distance` eye_radial.
inline std::unique_ptr<Renderer> make_radial_fog() {
  return pipeline::make_pipeline(faults::named("shade.fog_radial").stages());
}

inline pipeline::Color<float> as_codes(const pipeline::Color<float>& color) {
  const auto code = [](float v) { return std::round(std::clamp(v, 0.0f, 1.0f) * 255) / 255; };
  return {code(color.r), code(color.g), code(color.b), code(color.a)};
}

/// Stage light, whose colours are codes of 8 bits, so many of them too bright.
template <int too_bright>
void light_in_codes(const pipeline::LightInput& in, std::vector<pipeline::Attributes>& out) {
  const std::size_t first = out.size();
  pipeline::light(in, out);
  for (std::size_t i = first; i < out.size(); ++i) {
    Vec4<float>& color = out[i].color();
    const pipeline::Color<float> code = as_codes({color.r, color.g, color.b, color.a});
    constexpr float kMore = too_bright / 255.0f;
    color = {code.r + kMore, code.g + kMore, code.b + kMore, code.a};
  }
}

/// `vertex_colors` in_codes, in frames of 8 bits.
template <int too_bright = 0>
std::unique_ptr<Renderer> make_vertices_in_codes() {
  pipeline::Stages stages = pipeline::production_stages();
  stages.light = light_in_codes<too_bright>;
  return pipeline::make_pipeline(stages);
}

/// Stage attributes that takes every w for 1 where it interpolates colours, or all but colours.
template <bool of_colors>
pipeline::Color<float> affine_in_part(const pipeline::TriangleSetup& t, const pipeline::AttributeSetup& of,
                                      const pipeline::Pixels<float>& at) {
  static const auto kRight = pipeline::production_stages().attributes;
  if ((&of == t.attributes.data()) != of_colors) return kRight(t, of, at);
  const pipeline::PerspectiveSetup none = pipeline::perspective_setup({1, 1, 1}, t.planes, t.perspective.in_blocks);
  return pipeline::mean<float>(of, pipeline::weights<float>(none, pipeline::from_anchor<float>(t.planes, at)));
}
/// `color_interpolation` affine; of_colors false: `interpolation` affine, `color_interpolation` perspective.
template <bool of_colors = true>
std::unique_ptr<Renderer> make_affine_colors() {
  pipeline::Stages stages = pipeline::production_stages();
  stages.attributes = affine_in_part<of_colors>;
  return pipeline::make_pipeline(stages);
}

inline pipeline::FilteredTexel<float> texel_in_codes(const pipeline::TextureSetup& t,
                                                     const pipeline::TexCoords<float>& at,
                                                     const pipeline::Gradients<float>& g) {
  const pipeline::FilteredTexel<float> right = pipeline::texture<float>(t, at, g);
  return {as_codes(right.color), right.lod};
}

inline pipeline::Shaded shade_in_codes(const pipeline::Surface& surface, bool front,
                                       const pipeline::SurfaceAttributes<float>& attributes) {
  pipeline::SurfaceAttributes<float> codes = attributes;
  codes.color = as_codes(attributes.color);
  return {as_codes(pipeline::shade<float>(surface, front, codes))};
}

/// `fragment_colors` in_codes, in frames of 8 bits: interpolated colours, texels and shaded colours are rounded.
inline pipeline::Stages stages_in_codes() {
  pipeline::Stages stages = pipeline::production_stages();
  stages.texture = texel_in_codes;
  stages.shade = shade_in_codes;
  return stages;
}

}  // namespace plumbline::test
