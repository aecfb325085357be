// Stages 6 to 11 of fragments of one triangle, line or point, as many at a time as R has lanes.
#pragma once

#include <array>
#include <optional>

#include "kernels/coverage.h"
#include "kernels/shade.h"
#include "kernels/visibility.h"
#include "painter/tile.h"

namespace plumbline::pipeline {

/// Kernel that paints a draw. `any`: paint_run() (paint_tile.h), for any state and primitive. The others serve common
/// states of filled triangles (paint_opaque.h) and of lines (paint_lines.h) in frames of rgba8 and z24; frames of other
/// colours, and the targets float and SSE4, use paint_run() all the same.
enum class PaintKernel { any, replaces, blends_over, depth_only, shades, lines };

/// Per-draw input of stages 5 to 11.
struct PaintDraw {
  const Draw* draw;
  DepthState depth;
  const Surface* surface;  ///< null: the fragments' colour is the interpolated one, or not needed (depth_only)
  PaintKernel kernel;

  bool flat() const { return draw->shading == Shading::flat; }
};

/// Per-triangle input of stages 6 and 7 in one tile.
struct FragmentSetup {
  bool front;
  Anchor anchor;
  DepthPlane depth_plane;
  PerspectiveSetup perspective;
  AttributeSetup attributes;  ///< the colour's
};
/// Per-triangle input of stages 7 to 9 in one tile: the surface, and the setup of each varying that the surface
/// carries.
struct SurfaceSetup {
  const Surface* surface;
  std::array<AttributeSetup, kVaryings> varyings;
  GradientSetup gradients;  ///< of the texture coordinates, where there is a texture
};

/// Stages 7 and 8: colour, the surface's varyings, and the texel without its lod.
template <class R>
[[gnu::always_inline]] inline SurfaceAttributes<R> surface_attributes(const FragmentSetup& of, const SurfaceSetup& s,
                                                                      const Pixels<R>& p) {
  SurfaceAttributes<R> out;
  const Offset<R> at = from_anchor<R>(of.anchor, p);
  const Weights<R> k = weights<R>(of.perspective, at);
  out.color = mean<R>(of.attributes, k);
  for (const Varying v : s.surface->carried) {
    out[v] = mean<R>(s.varyings[index_of(v)], k);
  }
  if (s.surface->texture) {
    const Color<R>& st = out[Varying::texture];
    const Gradients<R> g = gradients<R>(s.gradients, at, value_at<R>(of.perspective.sum, at));
    out.texel.color = texel_color<R>(*s.surface->texture, {st.r, st.g}, g);
  }
  return out;
}

/// Whether a fragment's colour replaces the stored one, in all channels.
inline bool is_opaque(const Merge& state) { return !state.blend && !state.logic_op && glm::all(state.color_mask); }
/// Stage 11: depth and colour of the fragments `kept` into the tile, at the addresses `to`.
template <class R>
[[gnu::always_inline]] inline void write(const Merge& state, Mask<R> kept, R z, const Color<R>& shaded,
                                         float color_scale, const auto& to) {
  if (state.depth_mask) store(kept, z, to.depth);
  if constexpr (requires { to.store_merged(kept, shaded); }) {
    if (is_opaque(state)) return to.store_merged(kept, shaded);
  }
  const Color<R> merged = [&]() -> Color<R> {
    if (!state.blend && !state.logic_op) return merge<R>(shaded, color_scale);
    const Color<R> stored = to.template load_color<R>();
    if (state.logic_op) return logic<R>(*state.logic_op, shaded, stored, color_scale);
    return blend<R>(*state.blend, shaded, stored, color_scale);
  }();
  to.template store_color<R>(kept, merged, state.color_mask);
}

/// Scissor and stages 6 to 11 of the fragments `covered` at the pixels `p`, whose values begin at index `place` of the
/// tile's arrays.
template <class R>
void paint_fragments(const Draw& draw, const FragmentSetup& s, const std::optional<SurfaceSetup>& surface,
                     const Pixels<R>& p, Mask<R> covered, int place, float color_scale, auto& tile) {
  if (draw.scissor) {
    covered = covered & scissor<R>(*draw.scissor, p);
    if (!any(covered)) return;
  }
  const R z = depth<R>(s.depth_plane, from_anchor<R>(s.anchor, p));
  const auto stored = tile.at(place);
  const Mask<R> passes_depth = covered & compares<R>(draw.depth_func, z, Lanes<R>::load(stored.depth));
  if (!any(passes_depth) && !draw.stencil) return;
  const bool needs_color = draw.alpha_test || glm::any(draw.merge.color_mask);
  Color<R> shaded{};
  if (needs_color && surface) {
    shaded = shade<R>(*surface->surface, s.front, surface_attributes<R>(s, *surface, p));
  } else if (needs_color) {
    shaded = mean<R>(s.attributes, weights<R>(s.perspective, from_anchor<R>(s.anchor, p)));
  }
  Mask<R> kept = draw.stencil ? covered : passes_depth;
  if (draw.alpha_test) kept = kept & alpha_passes<R>(*draw.alpha_test, shaded.a, color_scale);
  if (draw.stencil) {
    const StencilFace& face = s.front ? draw.stencil->front : draw.stencil->back;
    kept = passes_depth & stencil_test<R>(face, kept, passes_depth, stored.stencil);
  }
  write<R>(draw.merge, kept, z, shaded, color_scale, stored);
}

}  // namespace plumbline::pipeline
