#include <array>
#include <cmath>

#include "faults/lists.h"
#include "faults/variants.h"
#include "kernels/shade.h"

namespace plumbline::faults {

namespace {

using TexturedAttributes = pipeline::SurfaceAttributes<float>;

Color<float> without_fog(const pipeline::Surface& surface, bool front, const TexturedAttributes& attributes) {
  Draw clear = *surface.draw;
  clear.fog.reset();
  pipeline::Surface other = surface;
  other.draw = &clear;
  return pipeline::shade<float>(other, front, attributes);
}

// of_fragment * the fragment's colour + of_fog * the fog's.
Color<float> mixed(const Fog& fog, const Color<float>& color, float of_fragment, float of_fog) {
  return {of_fragment * color.r + of_fog * fog.color.r, of_fragment * color.g + of_fog * fog.color.g,
          of_fragment * color.b + of_fog * fog.color.b, color.a};
}

// Stage shade, whose fog is mix(fog, the colour without fog, surface, p_eye).
template <auto mix>
pipeline::Shaded fogged_by(const pipeline::Surface& surface, bool front, const TexturedAttributes& attributes) {
  if (!surface.draw->fog) return {pipeline::shade<float>(surface, front, attributes)};
  const Color<float> color = without_fog(surface, front, attributes);
  return {mix(*surface.draw->fog, color, surface, attributes[Varying::position])};
}

float factor_of(const Fog& fog, const Color<float>& p_eye) { return pipeline::fog_factor<float>(fog, p_eye.b); }

Color<float> with_alpha(const Fog& fog, const Color<float>& color, const pipeline::Surface&,
                        const Color<float>& p_eye) {
  const float f = factor_of(fog, p_eye);
  Color<float> out = mixed(fog, color, f, 1 - f);
  out.a *= f;
  return out;
}

Color<float> added(const Fog& fog, const Color<float>& color, const pipeline::Surface&, const Color<float>& p_eye) {
  return mixed(fog, color, 1, 1 - factor_of(fog, p_eye));
}

Color<float> turned_round(const Fog& fog, const Color<float>& color, const pipeline::Surface&,
                          const Color<float>& p_eye) {
  const float f = factor_of(fog, p_eye);
  return mixed(fog, color, 1 - f, f);
}

// Linear fog whose factor is above 1 before its start, and below 0 beyond its end.
Color<float> unclamped(const Fog& fog, const Color<float>& color, const pipeline::Surface&, const Color<float>& p_eye) {
  const bool is_linear = fog.mode == Fog::Mode::linear;
  const float f = is_linear ? (fog.end - std::abs(p_eye.b)) / (fog.end - fog.start) : factor_of(fog, p_eye);
  return mixed(fog, color, f, 1 - f);
}

Color<float> by_radius(const Fog& fog, const Color<float>& color, const pipeline::Surface&, const Color<float>& p_eye) {
  const float f = pipeline::fog_factor<float>(fog, std::hypot(p_eye.r, p_eye.g, p_eye.b));
  return mixed(fog, color, f, 1 - f);
}

Color<float> by_window_z(const Fog& fog, const Color<float>& color, const pipeline::Surface& surface,
                         const Color<float>& p_eye) {
  const Matrices<float> m = pipeline::matrices(*surface.scene, *surface.draw);
  const Vec4<float> p_clip = m.projection * Vec4<float>(p_eye.r, p_eye.g, p_eye.b, 1);
  const float f = pipeline::fog_factor<float>(fog, p_clip.z / p_clip.w * m.win_scale.z + m.win_translate.z);
  return mixed(fog, color, f, 1 - f);
}

constexpr std::array kFog = {
    stage_fault("shade.fogged_alpha", "fog takes alpha too", put<&Stages::shade, fogged_by<with_alpha>>),
    stage_fault("shade.fog_added", "fog is added to a colour, which does not fade into it",
                put<&Stages::shade, fogged_by<added>>, "godotengine/godot#12454"),
    stage_fault("shade.fog_near", "fog is thick near the eye, and thin far away",
                put<&Stages::shade, fogged_by<turned_round>>),
    stage_fault("shade.fog_unclamped", "the factor of linear fog is not clamped to [0, 1]",
                put<&Stages::shade, fogged_by<unclamped>>),
    stage_fault("shade.fog_radial", "fog is of the distance from the eye, which is to be declared (fog_distance)",
                put<&Stages::shade, fogged_by<by_radius>>),
    stage_fault("shade.fog_by_window_z", "fog is of window z, not of the distance from the eye",
                put<&Stages::shade, fogged_by<by_window_z>>),
};

}  // namespace

std::span<const Fault> of_fog() { return kFog; }

}  // namespace plumbline::faults
