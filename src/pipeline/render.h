// A scene in, a frame out: the whole pipeline, stages 0 to 11.
#pragma once

#include <functional>

#include "pipeline/capture_tap.h"
#include "pipeline/draw.h"
#include "pipeline/resolve.h"
#include "pipeline/tiles.h"

namespace plumbline::pipeline {

/// Stages 5 to 11 as functions, made of a set of fragment stages (fragment.h).
struct FragmentFunctions {
  std::function<void(const DrawList&, const FrameFormat&, Frame&, NoTap&)> draw;
  std::function<void(const DrawList&, const FrameFormat&, Frame&, CaptureTap&)> draw_tapped;
  // One stage at one pixel, for calling it alone.
  std::function<float(const TriangleSetup<>&, const Pixels<float>&)> depth;
  std::function<Color<float>(const TriangleSetup<>&, const Pixels<float>&)> attributes;
  std::function<FilteredTexel<float>(const TextureSetup&, const TexCoords<float>&, const Gradients<float>&)> texture;
  std::function<Color<float>(const Color<float>&)> shade;
  std::function<Color<float>(const Surface&, bool front, const SurfaceAttributes<float>&)> shade_surface;
  /// Alpha, stencil and depth test: whether a fragment is drawn. Changes the stencil value.
  std::function<bool(const Draw&, bool front, float z, const Color<float>& shaded, float color_scale, const Stored&)>
      passes;
  std::function<void(const Merge&, float z, const Color<float>& shaded, float color_scale, const Stored&)> write;
  std::function<TriangleSetup<>(const WindowTriangle<float>&, std::uint32_t, const DepthState&, glm::ivec2 sample,
                                int x0, int y0)>
      set_up;
};

template <class S>
bool passes(const S& stages, const Draw& draw, bool front, float z, const Color<float>& shaded, float color_scale,
            const Stored& at) {
  const bool nearer = stages.template depth_passes<float>(draw.depth_func, z, *at.depth);
  if (draw.alpha_test && !stages.template alpha_passes<float>(*draw.alpha_test, shaded.a, color_scale)) return false;
  if (!draw.stencil) return nearer;
  const StencilFace& face = front ? draw.stencil->front : draw.stencil->back;
  return stages.template stencil_test<float>(face, true, nearer, at.stencil) && nearer;
}

template <class S>
FragmentFunctions fragment_functions(const S& s = S()) {
  FragmentFunctions f;
  f.draw = [s](const DrawList& list, const FrameFormat& format, Frame& frame, NoTap& tap) {
    draw_tiles<float>(s, list, format, frame, tap);
  };
  f.draw_tapped = [s](const DrawList& list, const FrameFormat& format, Frame& frame, CaptureTap& tap) {
    draw_tiles<float>(s, list, format, frame, tap);
  };
  f.depth = [s](const TriangleSetup<>& setup, const Pixels<float>& p) { return s.template depth<float>(setup, p); };
  f.attributes = [s](const TriangleSetup<>& setup, const Pixels<float>& p) {
    return s.template attributes<float>(setup, setup.attributes, p);
  };
  f.texture = [s](const TextureSetup& texture, const TexCoords<float>& at, const Gradients<float>& gradients) {
    return s.template texture<float>(texture, at, gradients);
  };
  f.shade = [s](const Color<float>& attributes) { return s.template shade<float>(attributes); };
  f.shade_surface = [s](const Surface& surface, bool front, const SurfaceAttributes<float>& attributes) {
    return s.template shade_surface<float>(surface, front, attributes);
  };
  f.write = [s](const Merge& state, float z, const Color<float>& shaded, float color_scale, const Stored& to) {
    write<float>(s, s.merge_state(state), true, z, shaded, color_scale, to);
  };
  f.passes = [s](const Draw& draw, bool front, float z, const Color<float>& shaded, float color_scale,
                 const Stored& at) { return passes(s, draw, front, z, shaded, color_scale, at); };
  f.set_up = [s](const WindowTriangle<float>& t, std::uint32_t triangle, const DepthState& depth, glm::ivec2 sample,
                 int x0, int y0) { return set_up(s, t, triangle, depth, sample, x0, y0); };
  return f;
}

/// Every stage function of the pipeline.
struct Stages {
  GeometryStages geometry;
  FragmentFunctions fragment;
  ResolveStage resolve = {};
};
/// Those of this folder.
Stages production_stages();

/// The frames of an antialiased scene's passes.
std::vector<Frame> render_passes(const Scene& scene, const Stages& stages);
/// Draws the scene, stage by stage as these functions do.
Frame render(const Scene& scene, const Stages& stages);
/// Draws it as fast as this machine can (painter.h): the same bits.
Frame render(const Scene& scene);

}  // namespace plumbline::pipeline
