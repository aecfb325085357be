// The light equation at one point (OpenGL 2.1 spec, section 2.14.1), and note 000's in its place.
#pragma once

#include <array>
#include <vector>

#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::pipeline {

/// A light in eye space.
struct EyeLight {
  bool directional;
  Vec3<float> vector;  ///< unit direction towards it, or its place
  bool attenuates, has_cone;
  Vec3<float> attenuation;  ///< k0, k1, k2
  Vec3<float> cone;         ///< unit direction to which it shines
  float cos_cutoff, exponent;
};

/// What does not change within a draw.
struct Illumination {
  LightModel model;
  std::vector<EyeLight> lights;
};
Illumination illumination(const Scene& scene);

/// What a material makes of the light: emission and ambient light, and each light's colours times its own.
struct Reflectance {
  struct Answer {
    Vec3<float> ambient, diffuse, specular;
  };
  Vec3<float> base;
  std::array<Answer, 8> answers;  ///< beside the lights
  float shininess, alpha;
};
Reflectance reflectance(const Scene& scene, const Material& material);

/// rgba, clamped to [0,1]; alpha is the diffuse material's. Where a normal faces away from a light, its diffuse and
/// specular terms are 0; outside a light's cone, its ambient one too. `n_eye` need not be of unit length.
Vec4<float> lit(const Illumination& illumination, const Reflectance& reflectance, const Vec3<float>& p_eye,
                const Vec3<float>& n_eye);

}  // namespace plumbline::pipeline
