#include "faults/faults.h"

#include <algorithm>
#include <array>
#include <utility>

#include "faults/antialias.h"
#include "faults/light.h"
#include "faults/notes.h"
#include "faults/textures.h"
#include "faults/variants.h"
#include "pipeline/carry.h"
#include "pipeline/clip.h"
#include "pipeline/light.h"
#include "pipeline/matrices.h"
#include "pipeline/vertex.h"
#include "pipeline/window.h"

namespace plumbline::faults {

namespace {

Matrices<float> fov_taken_horizontally(const Scene& scene, const Draw& draw) {
  Matrices<float> m = pipeline::matrices(scene, draw);
  if (std::holds_alternative<Perspective>(scene.projection)) {
    const float aspect = static_cast<float>(scene.frame.width) / static_cast<float>(scene.frame.height);
    m.projection[0][0] *= aspect;
    m.projection[1][1] *= aspect;
  }
  return m;
}

Matrices<float> depth_range_not_mapped(const Scene& scene, const Draw& draw) {
  Matrices<float> m = pipeline::matrices(scene, draw);
  m.win_scale.z = m.win_translate.z = 0.5f;
  return m;
}

void normals_by_model_view(const Matrices<float>& matrices, Normals normals, const Mesh& mesh,
                           std::vector<Vertex<float>>& out) {
  Matrices<float> wrong = matrices;
  wrong.normal = Mat3<float>(matrices.model_view);
  pipeline::transform(wrong, normals, mesh, out);
}

void lights_in_world_space(const Scene& scene, const Draw& draw, std::span<const Vertex<float>> vertices,
                           std::vector<Lit<float>>& out) {
  Scene wrong = scene;
  wrong.dialect = Dialect::gl;
  wrong.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};  // eye space is the world
  pipeline::light(wrong, draw, vertices, out);
}

// Of the vertices before their cut: the fog of a primitive that reaches behind the eye grows towards it.
void positions_by_distance(const Scene& scene, const Draw& draw, Varying varying,
                           std::span<const Vertex<float>> vertices, std::vector<Vec4<float>>& out) {
  const std::size_t first = out.size();
  pipeline::carry(scene, draw, varying, vertices, out);
  if (varying != Varying::position) return;
  for (std::size_t i = first; i < out.size(); ++i) out[i].z = std::abs(out[i].z);
}

void normals_not_renormalised(const Matrices<float>& matrices, Normals, const Mesh& mesh,
                              std::vector<Vertex<float>>& out) {
  pipeline::transform(matrices, Normals::as_they_are, mesh, out);
}

void no_near_plane(const pipeline::Assembly& assembly, ClipPolygons<float>& out) {
  const auto planes = pipeline::view_volume();
  const std::array<Vec4<float>, 5> kept = {planes[0], planes[1], planes[2], planes[3], planes[5]};
  pipeline::clip_at(kept, assembly, out);
}

void snapped_by_truncation(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
                           std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out) {
  const std::size_t first = out.size();
  pipeline::to_window(matrices, draw, polygons, of_draw, out);
  for (std::size_t i = first; i < out.size(); ++i) {
    for (WindowVertex<float>& v : out[i].v) v.snapped = glm::ivec2((glm::vec2(v.p_win) - 0.5f) * 256.0f);
    if (out[i].corners == 3) out[i].front = pipeline::snapped_area(out[i]) > 0;
  }
}

struct LineEndDrawn : pipeline::FragmentStages {
  static std::vector<glm::ivec2> thin_pixels(const WindowTriangle<float>& t, glm::ivec2 origin, int size) {
    std::vector<glm::ivec2> pixels = pipeline::thin_pixels(t, origin, size);
    WindowTriangle<float> end{{t.v[1], t.v[1], t.v[1]}, t.primitive, true, 1};
    for (const glm::ivec2 last : pipeline::thin_pixels(end, origin, size)) {
      if (std::find(pixels.begin(), pixels.end(), last) == pixels.end()) pixels.push_back(last);
    }
    return pixels;
  }
};

struct SteepLinesTorn : pipeline::FragmentStages {
  static std::vector<glm::ivec2> thin_pixels(const WindowTriangle<float>& t, glm::ivec2 origin, int size) {
    std::vector<glm::ivec2> pixels = pipeline::thin_pixels(t, origin, size);
    std::vector<glm::ivec2> one_per_column;
    for (const glm::ivec2 p : pixels) {
      if (one_per_column.empty() || one_per_column.back().x != p.x) one_per_column.push_back(p);
    }
    return one_per_column;
  }
};

// Every pixel of the thin line becomes a row of an x-major line, a column of a y-major one.
struct LinesWidenedAlong : pipeline::FragmentStages {
  static std::vector<glm::ivec2> thin_pixels(const WindowTriangle<float>& t, glm::ivec2 origin, int size) {
    if (t.corners != 2 || t.width == 1) return pipeline::thin_pixels(t, origin, size);
    WindowTriangle<float> thin = t;
    thin.width = 1;
    const auto width = static_cast<int>(t.width);
    const glm::ivec2 d = glm::abs(t.v[1].snapped - t.v[0].snapped),
                     along = d.x >= d.y ? glm::ivec2(1, 0) : glm::ivec2(0, 1);
    std::vector<glm::ivec2> pixels;
    for (const glm::ivec2 p : pipeline::thin_pixels(thin, origin - width, size + 2 * width)) {
      for (int k = 0; k < width; ++k) {
        const glm::ivec2 q = p + along * (k - width / 2), in_box = q - origin;
        const bool inside = in_box.x >= 0 && in_box.y >= 0 && in_box.x < size && in_box.y < size;
        if (inside && std::find(pixels.begin(), pixels.end(), q) == pixels.end()) pixels.push_back(q);
      }
    }
    return pixels;
  }
};

struct PointsOffByHalf : pipeline::FragmentStages {
  static std::vector<glm::ivec2> thin_pixels(const WindowTriangle<float>& t, glm::ivec2 origin, int size) {
    WindowTriangle<float> moved = t;
    if (t.corners == 1) moved.v[0].snapped += kSubpixel / 2;
    return pipeline::thin_pixels(moved, origin, size);
  }
};

void mode_of_other_face(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
                        std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out) {
  Draw wrong = draw;
  std::swap(wrong.front_mode, wrong.back_mode);
  pipeline::to_window(matrices, wrong, polygons, of_draw, out);
}

void diagonals_drawn(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
                     std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out) {
  if (draw.front_mode == PolygonMode::fill && draw.back_mode == PolygonMode::fill)
    return pipeline::to_window(matrices, draw, polygons, of_draw, out);
  ClipPolygons<float> fans;
  for (const ClipPolygon& p : of_draw) {
    if (p.count < 3) return pipeline::to_window(matrices, draw, polygons, of_draw, out);
    for (std::uint32_t i = 2; i < p.count; ++i) {
      fans.polygons.push_back({p.primitive, static_cast<std::uint32_t>(fans.vertices.size()), 3});
      for (const std::uint32_t k : {0u, i - 1, i}) fans.vertices.push_back(polygons.vertices[p.first + k]);
    }
  }
  pipeline::to_window(matrices, draw, fans, fans.polygons, out);
}

struct TruncatedDepth : pipeline::FragmentStages {
  template <class R>
  static R depth(const auto& setup, const pipeline::Barycentric<R>& b) {
    const pipeline::DepthSetup& s = setup.depth;
    const double z = pipeline::clamp01(s.z0 + b.l1 * s.dz1 + b.l2 * s.dz2);
    return s.scale == 0.0 ? static_cast<float>(z) : static_cast<float>(static_cast<std::int64_t>(z * s.scale));
  }
};

struct FoggedAlpha : pipeline::FragmentStages {
  template <class R>
  static pipeline::Color<R> shade_surface(const pipeline::Surface& surface, bool front,
                                          const pipeline::SurfaceAttributes<R>& attributes) {
    pipeline::Color<R> color = pipeline::shade_surface<R>(surface, front, attributes);
    if (surface.draw->fog) color.a *= pipeline::fog_factor<R>(*surface.draw->fog, attributes[Varying::position].b);
    return color;
  }
};

struct LessEqualForLess : pipeline::FragmentStages {
  template <DepthFunc func, class R>
  static pipeline::Mask<R> depth_passes(R incoming, R stored) {
    constexpr DepthFunc kWrong = func == DepthFunc::less ? DepthFunc::less_equal : func;
    return pipeline::depth_passes<kWrong, R>(incoming, stored);
  }
};

struct TruncatedColor : pipeline::FragmentStages {
  template <class R>
  static pipeline::Color<R> merge(const pipeline::Color<R>& color, float scale) {
    if (scale == 0.0f) return color;
    const auto code = [&](R v) { return static_cast<R>(static_cast<int>(pipeline::clamp01(v) * scale)); };
    return {code(color.r), code(color.g), code(color.b), code(color.a)};
  }
};

struct ScissorWithItsFarSides : pipeline::FragmentStages {
  template <class R>
  static pipeline::Mask<R> scissor(const Scissor& box, const pipeline::Pixels<R>& p) {
    return pipeline::scissor<R>({box.x, box.y, box.width + 1, box.height + 1}, p);
  }
};

struct OffsetWithoutSlope : pipeline::FragmentStages {
  static pipeline::DepthSetup depth_setup(const WindowTriangle<float>& triangle, const pipeline::DepthState& state) {
    pipeline::DepthState wrong = state;
    wrong.offset.factor = 0;
    return pipeline::depth_setup(triangle, wrong);
  }
};

struct AlphaAtTheReferenceKept : pipeline::FragmentStages {
  template <class R>
  static pipeline::Mask<R> alpha_passes(const AlphaTest& test, R alpha, float scale) {
    const bool greater = test.func == CompareFunc::greater;
    return pipeline::alpha_passes<R>({greater ? CompareFunc::greater_equal : test.func, test.reference}, alpha, scale);
  }
};

struct SwappedDepthOps : pipeline::FragmentStages {
  template <class R>
  static pipeline::Mask<R> stencil_test(const StencilFace& face, pipeline::Mask<R> alive, pipeline::Mask<R> nearer,
                                        std::uint8_t* at) {
    StencilFace wrong = face;
    std::swap(wrong.pass, wrong.depth_fail);
    return pipeline::stencil_test<R>(wrong, alive, nearer, at);
  }
};

struct SidesOfLogicOpSwapped : pipeline::FragmentStages {
  template <class R>
  static pipeline::Color<R> logic(LogicOp op, const pipeline::Color<R>& source, const pipeline::Color<R>& stored,
                                  float scale) {
    const LogicOp wrong = op == LogicOp::and_reverse    ? LogicOp::and_inverted
                          : op == LogicOp::and_inverted ? LogicOp::and_reverse
                                                        : op;
    return pipeline::logic<R>(wrong, source, stored, scale);
  }
};

struct SwappedFactors : pipeline::FragmentStages {
  static Merge merge_state(const Merge& of_draw) {
    Merge wrong = of_draw;
    if (wrong.blend) {
      std::swap(wrong.blend->rgb.source, wrong.blend->rgb.destination);
      std::swap(wrong.blend->alpha.source, wrong.blend->alpha.destination);
    }
    return wrong;
  }
};

struct IgnoredColorMask : pipeline::FragmentStages {
  static Merge merge_state(const Merge& of_draw) {
    return {of_draw.blend, glm::bvec4(true), of_draw.depth_mask, of_draw.logic_op};
  }
};

constexpr std::array kFaults = {
    Fault{"matrices.fov_horizontal", "the vertical field of view is taken for the horizontal one", Stage::matrices,
          with_geometry<&Geometry::matrices, fov_taken_horizontally>},
    Fault{"matrices.depth_range_not_mapped", "every draw's depths fill [0,1], whatever its depth range",
          Stage::matrices, with_geometry<&Geometry::matrices, depth_range_not_mapped>},
    Fault{"vertex.normals_by_model_view", "normals go by the model-view matrix, not its inverse transpose",
          Stage::vertex, with_geometry<&Geometry::vertex, normals_by_model_view>},
    Fault{"vertex.not_renormalised", "normals are not brought to unit length after the model's scale", Stage::vertex,
          with_geometry<&Geometry::vertex, normals_not_renormalised>},
    Fault{"light.world_space", "lights are not brought to eye space", Stage::light,
          with_geometry<&Geometry::light, lights_in_world_space>},
    Fault{"light.distance_at_vertices", "the distance for fog is taken at the vertices and interpolated", Stage::light,
          with_geometry<&Geometry::carry, positions_by_distance>},
    Fault{"clip.no_near_plane", "nothing is cut at the near plane", Stage::clip,
          with_geometry<&Geometry::clip, no_near_plane>},
    Fault{"window.snap_truncates", "window positions are truncated to 1/256 pixel, not rounded", Stage::window,
          with_geometry<&Geometry::window, snapped_by_truncation>},
    Fault{"window.mode_of_other_face",
          "front faces are drawn in the back faces' polygon mode, and back faces in theirs", Stage::window,
          with_geometry<&Geometry::window, mode_of_other_face>},
    Fault{"window.diagonals_drawn", "the edges of a cut triangle's fan are drawn, not those of its polygon",
          Stage::window, with_geometry<&Geometry::window, diagonals_drawn>},
    Fault{"coverage.inclusive_edges", "pixels on any edge are covered: shared edges are painted twice", Stage::coverage,
          with_fragment<Ties<AllEdgesIn>>},
    Fault{"coverage.scissor_inclusive", "the scissor box has one column and one row too many", Stage::coverage,
          with_fragment<ScissorWithItsFarSides>},
    Fault{"coverage.line_end_drawn", "a line's last pixel is drawn too: lines that meet paint it twice",
          Stage::coverage, with_fragment<LineEndDrawn>},
    Fault{"coverage.steep_lines_torn", "lines are stepped along x in every octant: steep ones have gaps",
          Stage::coverage, with_fragment<SteepLinesTorn>},
    Fault{"coverage.lines_widened_along", "wide lines are widened along their major axis, not across it",
          Stage::coverage, with_fragment<LinesWidenedAlong>},
    Fault{"coverage.points_off_by_half", "points' squares lie half a pixel too far right and up", Stage::coverage,
          with_fragment<PointsOffByHalf>},
    Fault{"depth.truncated", "depth codes are truncated, not rounded", Stage::depth, with_fragment<TruncatedDepth>},
    Fault{"depth.offset_without_slope", "a polygon offset is of its units alone", Stage::depth,
          with_fragment<OffsetWithoutSlope>},
    Fault{"attributes.affine", "attributes are interpolated without perspective", Stage::attributes,
          with_fragment<AffineAttributes>},
    Fault{"shade.fogged_alpha", "fog takes alpha too", Stage::shade, with_fragment<FoggedAlpha>},
    Fault{"visibility.less_equal", "an equal depth passes where only a smaller one may", Stage::visibility,
          with_fragment<LessEqualForLess>},
    Fault{"visibility.alpha_at_reference", "an alpha equal to the reference passes where only a greater one may",
          Stage::visibility, with_fragment<AlphaAtTheReferenceKept>},
    Fault{"visibility.stencil_ops_swapped", "the stencil op of a depth that fails is taken for that of one that passes",
          Stage::visibility, with_fragment<SwappedDepthOps>},
    Fault{"merge.truncated", "colours are truncated to codes, not rounded", Stage::merge,
          with_fragment<TruncatedColor>},
    Fault{"merge.factors_swapped", "blending takes the source's factor for the destination's, and the other way round",
          Stage::merge, with_fragment<SwappedFactors>},
    Fault{"merge.logic_op_sides", "a logic op turns the wrong one over: s & ~d for ~s & d", Stage::merge,
          with_fragment<SidesOfLogicOpSwapped>},
    Fault{"merge.color_mask_ignored", "masked channels are written", Stage::merge, with_fragment<IgnoredColorMask>},
    Fault{"coverage.samples_mirrored", "the samples' y is counted downwards in the pixel", Stage::coverage,
          with_fragment<MirroredSamples>},
    Fault{"depth.of_centre", "all samples of a pixel have the depth at its centre", Stage::depth,
          with_fragment<DepthOfCentre>},
    Fault{"attributes.of_sample", "a sample's colour is that at its own place, not at the pixel's centre",
          Stage::attributes, with_fragment<ColorOfSample>},
    Fault{"resolve.truncated", "the mean of a pixel's samples is truncated to a code, not rounded", Stage::resolve,
          with_resolve<truncated_mean, truncated_mean>},
    Fault{"resolve.weights_swapped", "two of the six taps have each other's weight", Stage::resolve,
          with_resolve<pipeline::mean_of_four, mean_of_swapped>},
};

// The light's own list, where the lights stand.
std::vector<Fault> with_those_of_other_files() {
  std::vector<Fault> out(kFaults.begin(), kFaults.end());
  out.insert(out.end(), of_light().begin(), of_light().end());
  out.insert(out.end(), of_textures().begin(), of_textures().end());
  return out;
}

}  // namespace

std::span<const Fault> of_stages() {
  static const std::vector<Fault> kAll = with_those_of_other_files();
  return kAll;
}

std::vector<Fault> all() {
  std::vector<Fault> out(of_stages().begin(), of_stages().end());
  out.insert(out.end(), of_notes().begin(), of_notes().end());
  return out;
}

}  // namespace plumbline::faults
