// Stages 5 to 11 for as many pixels at a time as the number type R holds (lanes.h).
//
// Template parameters are R, the stage functions (so that a test can put another in the place of one, and a program its
// fragment(), program.h) and the Tap; a draw's state is asked once for all of R's pixels. NoTap ships: hidden fragments
// are left as soon as that is known. A tap that wants every fragment sees them all, and the planes come out the same,
// bit for bit.
#pragma once

#include <optional>
#include <utility>

#include "pipeline/attributes.h"
#include "pipeline/coverage.h"
#include "pipeline/depth.h"
#include "pipeline/fragment_tests.h"
#include "pipeline/lanes.h"
#include "pipeline/merge.h"
#include "pipeline/shade.h"
#include "pipeline/surface.h"

namespace plumbline::pipeline {

/// From a pixel's centre to where each of its values is taken, in 1/256 pixel.
struct Places {
  glm::ivec2 coverage, depth, color;
};

inline constexpr int kTile = 64;  ///< pixels, either way

/// The stage functions of the fragment half; a variant inherits them and hides some by its own. Attributes and colours
/// are of whatever types the functions hand to each other.
struct FragmentStages {
  static AttributeSetup attribute_setup(const WindowTriangle<float>& triangle, std::uint32_t) {
    return pipeline::attribute_setup(triangle);
  }
  /// Where a pass of multisampling looks, `sample` being the pass' own.
  static Places places(glm::ivec2 sample) { return {sample, sample, {0, 0}}; }
  static PixelBounds bounds(const WindowTriangle<float>& triangle) { return pixel_bounds(triangle); }
  static Edges edges(const WindowTriangle<float>& triangle) { return edges_of(triangle); }
  static void visit_thin_pixels(const WindowTriangle<float>& line_or_point, glm::ivec2 origin, int size, auto visit) {
    pipeline::visit_thin_pixels(line_or_point, origin, size, visit);
  }
  /// Coverage and depth are handed all that is known of the triangle (TriangleSetup).
  template <class R>
  static Mask<R> coverage(const auto& s, const Pixels<R>& p) {
    return pipeline::coverage<R>(s.edges, p);
  }
  template <class R>
  static Mask<R> scissor(const Scissor& box, const Pixels<R>& p) {
    return pipeline::scissor<R>(box, p);
  }
  static DepthSetup depth_setup(const WindowTriangle<float>& triangle, const DepthState& state) {
    return pipeline::depth_setup(triangle, state);
  }
  template <class R>
  static R depth(const auto& s, const Pixels<R>& p) {
    return pipeline::depth<R>(s.depth_plane, from_anchor<R>(s.planes, p));
  }
  template <class R>
  static Mask<R> depth_passes(DepthFunc func, R incoming, R stored) {
    return compares<R>(func, incoming, stored);
  }
  template <class R>
  static Color<R> attributes(const auto& s, const AttributeSetup& of, const Pixels<R>& p) {
    return mean<R>(of, weights<R>(s.perspective, from_anchor<R>(s.planes, p)));
  }
  template <class R>
  static Color<R> shade(const Color<R>& attributes) {
    return pipeline::shade<R>(attributes);
  }
  template <class R>
  static FilteredTexel<R> texture(const TextureSetup& setup, const TexCoords<R>& at, const Gradients<R>& gradients) {
    return pipeline::texture<R>(setup, at, gradients);
  }
  /// The colour of a surface that is not plain.
  static constexpr bool has_surfaces = true;
  template <class R>
  static Color<R> shade_surface(const Surface& surface, bool front, const SurfaceAttributes<R>& attributes) {
    return pipeline::shade_surface<R>(surface, front, attributes);
  }
  /// Of the fragments that pass the depth test (where there is a stencil test: of all), those that are not discarded.
  template <class R>
  static Mask<R> kept(Mask<R> passes, const Color<R>&) {
    return passes;
  }
  template <class R>
  static Mask<R> alpha_passes(const AlphaTest& test, R alpha, float scale) {
    return pipeline::alpha_passes<R>(test, alpha, scale);
  }
  template <class R>
  static Mask<R> stencil_test(const StencilFace& face, Mask<R> alive, Mask<R> nearer, std::uint8_t* at) {
    return pipeline::stencil_test<R>(face, alive, nearer, at);
  }
  template <class R>
  static Color<R> merge(const Color<R>& color, float scale) {
    return pipeline::merge<R>(color, scale);
  }
  template <class R>
  static Color<R> blend(const Blend& state, const Color<R>& source, const Color<R>& stored, float scale) {
    return pipeline::blend<R>(state, source, stored, scale);
  }
  template <class R>
  static Color<R> logic(LogicOp op, const Color<R>& source, const Color<R>& stored, float scale) {
    return pipeline::logic<R>(op, source, stored, scale);
  }
  /// A draw's merge state, asked for once.
  static Merge merge_state(const Merge& of_draw) { return of_draw; }
};

/// What of a draw's state is looked at per block.
struct BlockState {
  DepthState depth;
  DepthFunc depth_func;
  std::optional<Scissor> scissor;
  std::optional<AlphaTest> alpha_test;
  std::optional<Stencil> stencil;
  Merge merge;
  const Surface* surface;  ///< null: plain
};

/// Where the next pixels' values are: depth and colour in the frame's formats, as floats.
struct Stored {
  float* depth;
  float* color[4];
  std::uint8_t* stencil;

  template <class R>
  Color<R> load_color() const {
    return {load<R>(color[0]), load<R>(color[1]), load<R>(color[2]), load<R>(color[3])};
  }
  template <class R>
  void store_color(Mask<R> kept, const Color<R>& merged, const glm::bvec4& channels) const {
    if (channels.r) store(kept, merged.r, color[0]);
    if (channels.g) store(kept, merged.g, color[1]);
    if (channels.b) store(kept, merged.b, color[2]);
    if (channels.a) store(kept, merged.a, color[3]);
  }
};
/// Whether a fragment's colour replaces what is there.
inline bool is_opaque(const Merge& state) {
  const glm::bvec4& channels = state.color_mask;
  return !state.blend && !state.logic_op && channels.r && channels.g && channels.b && channels.a;
}
/// The same of rgba8, red in the lowest byte.
struct StoredCodes {
  float* depth;
  std::uint32_t* color;
  std::uint8_t* stencil;

  template <class R>
  Color<R> load_color() const {
    const Int<R> held = load_packed<R>(color), most(255);
    return {to_float(held & most), to_float(shifted_right<8>(held) & most), to_float(shifted_right<16>(held) & most),
            to_float(shifted_right<24>(held) & most)};
  }
  /// merge() and store_color() at once.
  template <class M, class R>
  void store_merged(M kept, const Color<R>& shaded) const {
    store_packed(kept, packed_merge(shaded), color);
  }
  template <class R>
  void store_color(Mask<R> kept, const Color<R>& merged, const glm::bvec4& channels) const {
    if (!channels.r && !channels.g && !channels.b && !channels.a) return;
    const Int<R> codes = packed_codes(merged.r, merged.g, merged.b, merged.a);
    if (channels.r && channels.g && channels.b && channels.a) return store_packed(kept, codes, color);
    const std::uint32_t written = (channels.r ? 0xffu : 0u) | (channels.g ? 0xff00u : 0u) |
                                  (channels.b ? 0xff0000u : 0u) | (channels.a ? 0xff000000u : 0u);
    const Int<R> to(static_cast<std::int32_t>(written)), other(static_cast<std::int32_t>(~written));
    store_packed(kept, (codes & to) | (load_packed<R>(color) & other), color);
  }
};

/// Of the fragments `kept`, depth and colour into the frame.
template <class R, class Stages>
[[gnu::always_inline]] inline void write(const Stages& stages, const Merge& state, Mask<R> kept, R z,
                                         const Color<R>& shaded, float color_scale, const auto& to) {
  if (state.depth_mask) store(kept, z, to.depth);
  if constexpr (std::is_same_v<Stages, FragmentStages> && requires { to.store_merged(kept, shaded); }) {
    if (is_opaque(state)) return to.store_merged(kept, shaded);
  }
  const Color<R> merged = [&]() -> Color<R> {
    if (!state.blend && !state.logic_op) return stages.template merge<R>(shaded, color_scale);
    const Color<R> stored = to.template load_color<R>();
    if (state.logic_op) return stages.template logic<R>(*state.logic_op, shaded, stored, color_scale);
    return stages.template blend<R>(*state.blend, shaded, stored, color_scale);
  }();
  to.template store_color<R>(kept, merged, state.color_mask);
}

/// What a frame's formats come to.
struct Formats {
  double depth_scale;    ///< the largest depth code, or 0 for float
  float color_scale;     ///< the largest colour code, or 0 for float
  glm::ivec2 sample{0};  ///< from a pixel's centre to where it is covered, in 1/256 pixel (scene/antialias.h)
};

/// All that stages 5 to 11 want to know of a triangle.
template <class Attributes = AttributeSetup>
struct TriangleSetup {
  std::uint32_t triangle;  ///< its place among the window triangles
  std::uint32_t primitive;
  bool front;  ///< or a line or point
  PixelBounds bounds;
  Edges edges;
  BarycentricPlanes planes;
  DepthSetup depth;
  DepthPlane depth_plane;
  PerspectiveSetup perspective;
  Attributes attributes;
  const SurfaceSetup* surface = nullptr;  ///< null: plain
};
template <class Stages>
using SetupOf = TriangleSetup<decltype(std::declval<const Stages&>().attribute_setup({}, 0))>;

/// (x0, y0): the lower left pixel of the tile.
template <class Stages>
SetupOf<Stages> set_up(const Stages& stages, const WindowTriangle<float>& t, std::uint32_t triangle,
                       const DepthState& depth_state, glm::ivec2 sample, int x0, int y0) {
  const BarycentricPlanes planes = planes_of(t, x0, y0);
  const DepthSetup depth = stages.depth_setup(t, depth_state);
  const DepthPlane plane = depth_plane(depth, planes);
  const PerspectiveSetup perspective = perspective_setup(t, planes);
  const auto attributes = stages.attribute_setup(t, triangle);
  if (sample == glm::ivec2(0)) {
    return {triangle, t.primitive, t.front,     stages.bounds(t), stages.edges(t), planes,
            depth,    plane,       perspective, attributes,       nullptr};
  }
  const Places places = stages.places(sample);
  const WindowTriangle<float> to_cover = as_seen_from(t, places.coverage);
  return {triangle,
          t.primitive,
          t.front,
          stages.bounds(to_cover),
          stages.edges(to_cover),
          moved(planes, places.color),
          depth,
          moved(plane, places.depth - places.color),
          perspective,
          attributes,
          nullptr};
}

/// What a surface's fragments want of the triangle besides. `varying`: each of the varyings at its corners.
template <class Stages>
SurfaceSetup set_up_surface(const Stages& stages, const Surface& surface, const WindowTriangle<float>& t,
                            std::uint32_t triangle, const auto& varying, const BarycentricPlanes& planes) {
  SurfaceSetup out;
  out.surface = &surface;
  out.front = t.front;
  for (const Varying v : surface.carried) {
    out.varyings[static_cast<std::size_t>(v)] = stages.attribute_setup(with_varying(t, varying(v)), triangle);
  }
  if (surface.texture) out.gradients = gradient_setup(t, varying(Varying::texture), planes);
  return out;
}

/// Stage 7 of a surface: every varying as the colour; and stage 8. `kAll`: or of texture coordinates only s and t.
template <class R, bool kAll, class Stages>
[[gnu::always_inline]] inline SurfaceAttributes<R> surface_attributes(const Stages& stages, const auto& of,
                                                                      const SurfaceSetup& s, const Pixels<R>& p) {
  SurfaceAttributes<R> out;
  if constexpr (std::is_same_v<Stages, FragmentStages>) {  // all have the same weights
    const Weights<R> k = weights<R>(of.perspective, from_anchor<R>(of.planes, p));
    out.color = mean<R>(of.attributes, k);
    for (const Varying v : s.surface->carried) {
      const AttributeSetup& setup = s.varyings[static_cast<std::size_t>(v)];
      out[v] = kAll || v != Varying::texture ? mean<R>(setup, k) : mean<R, 2>(setup, k);
    }
  } else {
    out.color = stages.template attributes<R>(of, of.attributes, p);
    for (const Varying v : s.surface->carried) {
      out[v] = stages.template attributes<R>(of, s.varyings[static_cast<std::size_t>(v)], p);
    }
  }
  if (s.surface->texture) {
    const Color<R>& st = out[Varying::texture];
    const TextureSetup& texture = *s.surface->texture;
    const Offset<R> at = from_anchor<R>(of.planes, p);
    const Gradients<R> g = gradients<R>(s.gradients, at, value_at<R>(of.perspective.sum, at));
    if constexpr (!kAll && std::is_same_v<Stages, FragmentStages>) {
      out.texel.color = texel_color<R>(texture, {st.r, st.g}, g);
    } else {
      out.texel = stages.template texture<R>(texture, {st.r, st.g}, g);
    }
  }
  return out;
}

/// Of the block whose lower left pixel is (x, y) in the tile, its first pixel's place.
inline int block_offset(int x, int y) {
  static_assert(kBlock == 4 && kTile == 64);
  return (y >> 2 << 8) + (x >> 2 << 4);
}

/// A square of the frame, stored block by block; colour and depth in the frame's formats, as floats.
struct Tile {
  int x0, y0;  ///< its lower left pixel
  alignas(64) float depth[kTile * kTile];
  alignas(64) float color[4][kTile * kTile];
  alignas(64) std::uint8_t stencil[kTile * kTile];  ///< left alone where the frame has none

  int offset(int x, int y) const { return block_offset(x - x0, y - y0); }
  Stored at(int place) {
    return {depth + place, {color[0] + place, color[1] + place, color[2] + place, color[3] + place}, stencil + place};
  }
};
/// Of rgba8 frames: half the memory, written out as it is.
struct PackedTile {
  int x0, y0;
  alignas(64) float depth[kTile * kTile];
  alignas(64) char apart[2112];  ///< so that a pixel's depth and colour are not 16 KiB apart: stores would stall loads
  alignas(64) std::uint32_t color[kTile * kTile];
  alignas(64) std::uint8_t stencil[kTile * kTile];
  alignas(64) float farthest[kTile * kTile / kBlockPixels];  ///< of each block: none of its depths is greater
  float farthest_of_all;

  int offset(int x, int y) const { return block_offset(x - x0, y - y0); }
  StoredCodes at(int place) { return {depth + place, color + place, stencil + place}; }
};

/// The tap that ships.
struct NoTap {
  static constexpr bool every_fragment = false;
  template <class R>
  void fragments(const auto& /*setup*/, const Pixels<R>&, Mask<R>, Mask<R>, R, const auto&, const auto&) {}
};

// The scissor box, and stages 6 to 11, for the pixels `p`, which are stored from `place` on.
template <class R, class Stages, class Tap>
void covered_pixels(const Stages& stages, const BlockState& state, const auto& s, const Pixels<R>& p, Mask<R> covered,
                    int place, float color_scale, auto& tile, Tap& tap) {
  if (state.scissor) {
    covered = covered & stages.template scissor<R>(*state.scissor, p);
    if (!any(covered)) return;
  }
  const R z = stages.template depth<R>(s, p);
  const auto stored = tile.at(place);
  const Mask<R> nearer = covered & stages.template depth_passes<R>(state.depth_func, z, load<R>(stored.depth));
  if constexpr (!Tap::every_fragment) {
    if (!any(nearer) && !state.stencil) return;
  }
  const auto finish = [&](const auto& attributes, const auto& shaded) {
    Mask<R> kept = stages.template kept<R>(state.stencil ? covered : nearer, shaded);
    if (state.alpha_test) {
      kept = kept & stages.template alpha_passes<R>(*state.alpha_test, Color<R>(shaded).a, color_scale);
    }
    if (state.stencil) {
      const StencilFace& face = s.front ? state.stencil->front : state.stencil->back;
      kept = nearer & stages.template stencil_test<R>(face, kept, nearer, stored.stencil);
    }
    tap.template fragments<R>(s, p, covered, kept, z, attributes, shaded);
    write<R>(stages, state.merge, kept, z, Color<R>(shaded), color_scale, stored);
  };
  if constexpr (!Tap::every_fragment && Stages::has_surfaces) {
    // Depth alone: nothing asks what colour it would be.
    const auto& channels = state.merge.color_mask;
    if (!state.alpha_test && !channels.r && !channels.g && !channels.b && !channels.a) {
      return finish(Color<R>{}, Color<R>{});
    }
  }
  if constexpr (Stages::has_surfaces && requires { s.surface; }) {
    if (s.surface != nullptr) {
      const SurfaceAttributes<R> attributes = surface_attributes<R, Tap::every_fragment>(stages, s, *s.surface, p);
      const SurfaceSetup& setup = *s.surface;
      return finish(attributes, stages.template shade_surface<R>(*setup.surface, setup.front, attributes));
    }
  }
  const auto attributes = stages.template attributes<R>(s, s.attributes, p);
  finish(attributes, stages.template shade<R>(attributes));
}

/// A line's or point's pixels, in their order; those that follow each other and lie in the same lanes, together.
template <class R, class Stages, class Tap>
void thin_fragments(const Stages& stages, const BlockState& state, const WindowTriangle<float>& line_or_point,
                    const SetupOf<Stages>& s, float color_scale, auto& tile, Tap& tap) {
  constexpr int kLanes = Lanes<R>::width;
  glm::ivec2 block(0);  // the lanes' own: its first pixel, and the first lane's place in it
  int first = 0;
  unsigned lanes = 0;
  const auto paint = [&] {
    if (lanes == 0) return;
    covered_pixels<R>(stages, state, s, block_pixels<R>(block.x, block.y, first), mask_of<R>(lanes),
                      tile.offset(block.x, block.y) + first, color_scale, tile, tap);
  };
  stages.visit_thin_pixels(line_or_point, {tile.x0, tile.y0}, kTile, [&](glm::ivec2 pixel) {
    const glm::ivec2 at = pixel & (kBlock - 1);
    const int place = at.y * kBlock + at.x, lane = place & (kLanes - 1);
    if (pixel - at != block || place - lane != first || (lanes >> lane & 1u) != 0) {
      paint();
      block = pixel - at, first = place - lane, lanes = 0;
    }
    lanes |= 1u << lane;
  });
  paint();
}

}  // namespace plumbline::pipeline
