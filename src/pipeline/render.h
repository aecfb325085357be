// A scene in, a frame out: the whole pipeline, stages 0 to 11.
#pragma once

#include "pipeline/capture_tap.h"
#include "pipeline/draw.h"
#include "pipeline/resolve.h"
#include "pipeline/tiles.h"

namespace plumbline::pipeline {

/// Stages 5 to 11 as functions, instantiated from a set of fragment stages (fragment.h).
struct FragmentFunctions {
  void (*draw)(const DrawList&, const FrameFormat&, Frame&, NoTap&);
  void (*draw_tapped)(const DrawList&, const FrameFormat&, Frame&, CaptureTap&);
  // One stage at one pixel, for calling it alone.
  float (*depth)(const TriangleSetup<>&, const Pixels<float>&);
  Color<float> (*attributes)(const TriangleSetup<>&, const Pixels<float>&);
  FilteredTexel<float> (*texture)(const TextureSetup&, const TexCoords<float>&, const Gradients<float>&);
  Color<float> (*shade)(const Color<float>&);
  Color<float> (*shade_surface)(const Surface&, bool front, const SurfaceAttributes<float>&);
  /// Alpha, stencil and depth test: whether a fragment is drawn. Changes the stencil value.
  bool (*passes)(const Draw&, bool front, float z, const Color<float>& shaded, float color_scale, const Stored&);
  void (*write)(const Merge&, float z, const Color<float>& shaded, float color_scale, const Stored&);
  TriangleSetup<> (*set_up)(const WindowTriangle<float>&, std::uint32_t, const DepthState&, glm::ivec2 sample, int x0,
                            int y0);
};

template <class S>
bool depth_passes_for(DepthFunc func, float incoming, float stored) {
  switch (func) {
    case DepthFunc::never: return S::template depth_passes<DepthFunc::never, float>(incoming, stored);
    case DepthFunc::less: return S::template depth_passes<DepthFunc::less, float>(incoming, stored);
    case DepthFunc::equal: return S::template depth_passes<DepthFunc::equal, float>(incoming, stored);
    case DepthFunc::less_equal: return S::template depth_passes<DepthFunc::less_equal, float>(incoming, stored);
    case DepthFunc::greater: return S::template depth_passes<DepthFunc::greater, float>(incoming, stored);
    case DepthFunc::not_equal: return S::template depth_passes<DepthFunc::not_equal, float>(incoming, stored);
    case DepthFunc::greater_equal: return S::template depth_passes<DepthFunc::greater_equal, float>(incoming, stored);
    case DepthFunc::always: return S::template depth_passes<DepthFunc::always, float>(incoming, stored);
  }
  return false;
}

template <class S>
bool passes(const Draw& draw, bool front, float z, const Color<float>& shaded, float color_scale, const Stored& at) {
  const bool nearer = depth_passes_for<S>(draw.depth_func, z, *at.depth);
  if (draw.alpha_test && !S::template alpha_passes<float>(*draw.alpha_test, shaded.a, color_scale)) return false;
  if (!draw.stencil) return nearer;
  const StencilFace& face = front ? draw.stencil->front : draw.stencil->back;
  return S::template stencil_test<float>(face, true, nearer, at.stencil) && nearer;
}

template <class S>
FragmentFunctions fragment_functions() {
  FragmentFunctions f;
  f.draw = [](const DrawList& list, const FrameFormat& format, Frame& frame, NoTap& tap) {
    draw_tiles<float>(S(), list, format, frame, tap);
  };
  f.draw_tapped = [](const DrawList& list, const FrameFormat& format, Frame& frame, CaptureTap& tap) {
    draw_tiles<float>(S(), list, format, frame, tap);
  };
  f.depth = [](const TriangleSetup<>& s, const Pixels<float>& p) {
    return S::template depth<float>(s, barycentric<float>(s.planes, p));
  };
  f.attributes = [](const TriangleSetup<>& s, const Pixels<float>& p) {
    return S::template attributes<float>(s.attributes, barycentric<float>(s.planes, p));
  };
  f.texture = S::template texture<float>;
  f.shade = S::template shade<float>;
  f.shade_surface = S::template shade_surface<float>;
  f.write = [](const Merge& state, float z, const Color<float>& shaded, float color_scale, const Stored& to) {
    write<float>(S(), S::merge_state(state), true, z, shaded, color_scale, to);
  };
  f.passes = passes<S>;
  f.set_up = [](const WindowTriangle<float>& t, std::uint32_t triangle, const DepthState& depth, glm::ivec2 sample,
                int x0, int y0) { return set_up(S(), t, triangle, depth, sample, x0, y0); };
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
/// Draws the scene.
Frame render(const Scene& scene);
/// Draws it with other stage functions.
Frame render(const Scene& scene, const Stages& stages);

}  // namespace plumbline::pipeline
