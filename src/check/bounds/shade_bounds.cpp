#include "check/bounds/shade_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/bounds/texture_bounds.h"
#include "check/bounds/units.h"
#include "reference/arithmetic/bounded.h"
#include "reference/arithmetic/fog.h"
#include "reference/arithmetic/light_bounds.h"

namespace plumbline::check {

ShadeInputs shade_inputs_of(const Records<double>& records, std::size_t i) {
  ShadeInputs out;
  if (i < records.attributes.size()) out.color = records.attributes[i].color;
  for (const Varying v : kAllVaryings) {
    if (i < records.varyings[v].fragments.size()) out[v] = records.varyings[v].fragments[i];
  }
  if (i < records.texels.size()) out.texel = records.texels[i].color;
  out.lights = records.lights;
  return out;
}

namespace {

// The error of a fragment's light.
Vec4<double> light_error(const Scene& scene, const Draw& draw, LitPart part, const ShadeInputs& attributes,
                         const ShadeInputs& errors, const Roundings& roundings) {
  const Vec4<double> anything(std::numeric_limits<double>::infinity());
  const auto length = [](const Vec4<double>& four) { return glm::length(Vec3<double>(four)); };
  const double n = length(attributes[Varying::normal]), dn = length(errors[Varying::normal]);
  if (!(n > 2 * dn)) return anything;
  Vertex<double> at{};
  at.p_eye = attributes[Varying::position];
  at.n_eye = Vec3<double>(attributes[Varying::normal]) / (part.back ? -n : n);
  const bool colors = !scene.meshes[draw.mesh].colors.empty() && draw.color_material != ColorMaterial::none;
  const double d_color = colors ? glm::length(errors.color) : 0;
  const math::LightBounds bounds =
      math::light_bounds(scene, math::material_of(scene, draw, part, attributes.color), at,
                         {length(errors[Varying::position]), math::chord(dn / n) + 4 * u, d_color}, attributes.lights);
  if (!std::isfinite(bounds.magnitude.x) || bounds.jump != Vec3<double>(0)) return anything;
  return Vec4<double>(bounds.inherited + 4 * roundings.count * u * bounds.magnitude, d_color + u);
}

// The larger of both faces' errors. `specular`: of the separate specular colour.
Vec4<double> light_error(const Scene& scene, const Draw& draw, bool specular, const ShadeInputs& attributes,
                         const ShadeInputs& errors, const Roundings& roundings) {
  Vec4<double> largest = light_error(scene, draw, {false, specular}, attributes, errors, roundings);
  if (scene.light_model.sides == LightModel::Sides::two)
    largest = glm::max(largest, light_error(scene, draw, {true, specular}, attributes, errors, roundings));
  return largest;
}

}  // namespace

Vec4<double> shade_error(const Scene& scene, const Draw& draw, const ShadeInputs& attributes, const ShadeInputs& errors,
                         const Roundings& roundings) {
  Vec4<double> color = attributes.color, error = errors.color;
  Vec4<double> low = color, high = color;  // range of the colour, which light per fragment leaves unknown here
  const bool per_fragment = is_lit_per_fragment(draw), summed = draw.lit && scene.light_model.separate_specular;
  if (per_fragment) {
    error = light_error(scene, draw, false, attributes, errors, roundings);
    low = Vec4<double>(0), high = Vec4<double>(1);
  }
  if (draw.texture) {
    const TextureFormat format = scene.textures.at(draw.texture->texture).format;
    const auto after = [&](const Vec4<double>& before) {
      return environ_error(format, *draw.texture, before, error, attributes.texel, errors.texel, roundings);
    };
    const Environed dark = after(low), bright = per_fragment ? after(high) : dark;  // the error is largest at either
    error = glm::max(dark.error, bright.error);
    low = glm::min(dark.color, bright.color), high = glm::max(dark.color, bright.color);
    color = dark.color;
  }
  if (summed) {
    const Vec4<double> apart =
        per_fragment ? light_error(scene, draw, true, attributes, errors, roundings) : errors[Varying::secondary];
    error += Vec4<double>(Vec3<double>(apart) + roundings(1), 0);
    low = glm::max(low, Vec4<double>(0)), high = Vec4<double>(1);  // the sum is clamped (OpenGL 2.1 spec 3.9)
  }
  if (draw.fog) {
    const auto [f, df] =
        math::fog_factor(*draw.fog, {attributes[Varying::position].z, errors[Varying::position].z}, roundings);
    for (int c = 0; c < 3; ++c) {
      const double of_fog = draw.fog->color[c];
      if (per_fragment || summed)  // as far from the fog's as it can be
        color[c] = std::abs(low[c] - of_fog) > std::abs(high[c] - of_fog) ? low[c] : high[c];
      const double magnitude = f * std::abs(color[c]) + (1 - f) * of_fog;
      error[c] = df * (std::abs(color[c] - of_fog) + error[c]) + f * error[c] + roundings(magnitude);
      color[c] = f * color[c] + (1 - f) * of_fog;
    }
  }
  // An open texel makes NaN of infinity times 0: the colour is open, too.
  for (int c = 0; c < 4; ++c) error[c] = std::isfinite(error[c]) ? error[c] : std::numeric_limits<double>::infinity();
  return error;
}

}  // namespace plumbline::check
