// Applies a renderer's conventions: alters the scene so that OpenGL's rules draw it as the renderer does, and maps the
// renderer's capture to OpenGL's conventions.
#pragma once

#include <cmath>
#include <optional>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "scene/scene.h"

namespace plumbline {

/// Scene that OpenGL's rules draw as the renderer draws `scene`. Holds a copy where the conventions alter the scene;
/// else refers to `scene`, which must outlive this object.
///
/// `sample`: the picture is shifted by 1/2 - sample [pixels] (Pass::shift). `provoking_vertex` first: the corners of
/// each triangle are rotated, so that the first becomes the last. `depth_planes` clamped: GL_DEPTH_CLAMP. `alpha` none:
/// the frame's alpha is cleared to 1 and masked, unless the scene is_opaque().
/// `depth_format`: the frame's. The oracles handle a view volume of [0,w] in z (reference/arithmetic/project.cpp).
class SceneByConventions {
 public:
  SceneByConventions(const Scene& scene, const Conventions& conventions);
  SceneByConventions(const SceneByConventions&) = delete;
  SceneByConventions& operator=(const SceneByConventions&) = delete;
  const Scene& operator*() const { return altered_ ? *altered_ : scene_; }
  const Scene* operator->() const { return &**this; }

 private:
  const Scene& scene_;
  std::optional<Scene> altered_;
};

/// The depth buffer's format: the convention's, or the frame's where that is as_asked.
DepthFormat depth_format_of(const FrameFormat& frame, const Conventions& conventions);

/// The depth `z` [window space] as a buffer of float holds it that keeps depths in `range`: rounded there.
double rounded_in_range(Conventions::DepthRange range, double z);

/// Whether the frame's alpha is 1 whatever is drawn: alphas of the clear colour, of vertices, materials, texels and
/// borders are 1, and no draw blends or has a logic op.
bool is_opaque(const Scene& scene);

/// How colours of vertices are interpolated.
inline Conventions::Interpolation interpolation_of_colors(const Conventions& conventions) {
  switch (conventions.color_interpolation) {
    case Conventions::ColorInterpolation::as_others: break;
    case Conventions::ColorInterpolation::affine: return Conventions::Interpolation::affine;
    case Conventions::ColorInterpolation::perspective: return Conventions::Interpolation::perspective;
  }
  return conventions.interpolation;
}

/// Whether colours of vertices are codes of the frame's format before they are interpolated, and again where a triangle
/// is cut.
inline bool has_codes_of_vertices(const FrameFormat& frame, const Conventions& conventions) {
  return conventions.vertex_colors == Conventions::ColorNumbers::in_codes && color_scale(frame.color) > 0;
}

/// Whether colours of the frame's fragments are codes of its format before they are merged.
inline bool has_codes_of_fragments(const FrameFormat& frame, const Conventions& conventions) {
  return conventions.fragment_colors == Conventions::ColorNumbers::in_codes && color_scale(frame.color) > 0;
}

/// Range of the change that a rounding to codes makes to a value [codes]: half a code to either side, or one down or
/// up.
struct RoundingRange {
  double least, most;
};
inline RoundingRange range_of(Conventions::Rounding rounding) {
  return {-0.5 - middle_of(rounding), 0.5 - middle_of(rounding)};
}

/// Whether a value [codes] is a code, but for float's rounding of colours: 2^-16 code.
inline constexpr double kFloatOfCode = 0x1p-16;
inline bool is_code(double codes) { return std::abs(codes - std::nearbyint(codes)) <= kFloatOfCode; }

/// Maps a renderer's capture to OpenGL's conventions: reverses the rows of planes and fragments where `rows` is
/// from_top; maps planes.depth and records.depth to [0,1], near plane at 0; moves window positions by 1/2 - sample
/// [pixels]. Colours stay: their codes are judged by the rounding that the conventions declare.
void to_dialect(const Conventions& conventions, Capture& capture);

}  // namespace plumbline
