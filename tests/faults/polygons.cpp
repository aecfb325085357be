#include <algorithm>
#include <array>
#include <utility>

#include "faults/lists.h"
#include "faults/variants.h"
#include "pipeline/clip.h"
#include "pipeline/window.h"

namespace plumbline::faults {

namespace {

using pipeline::Assembly;
using Polygons = ClipPolygons<float>;
using Corners = std::vector<ClipVertex<float>>;
using Triangles = std::vector<WindowTriangle<float>>;

// The stage at other planes; where depths are clamped there are none to get wrong.
template <auto planes>
void cut_at(const Assembly& assembly, Polygons& out) {
  if (assembly.depth_clamp) return pipeline::clip(assembly, out);
  pipeline::clip_at(planes(), assembly, out);
}

constexpr auto kNoNear = [] {
  const auto p = pipeline::view_volume();
  return std::array<Vec4<float>, 5>{p[0], p[1], p[2], p[3], p[5]};
};
constexpr auto kNoFar = [] { return pipeline::view_volume().first<5>(); };
// 0 <= z for -w <= z.
constexpr auto kNearAtZero = [] {
  const auto p = pipeline::view_volume();
  return std::array<Vec4<float>, 6>{p[0], p[1], p[2], p[3], Vec4<float>(0, 0, 1, 0), p[5]};
};

// The stage with other positions.
template <auto change>
void clip_moved(const Assembly& assembly, Polygons& out) {
  std::vector<Vertex<float>> moved(assembly.vertices.begin(), assembly.vertices.end());
  for (Vertex<float>& v : moved) change(v.p_clip);
  Assembly wrong = assembly;
  wrong.vertices = moved;
  pipeline::clip(wrong, out);
}

constexpr auto kNearFlattened = [](Vec4<float>& p) { p.z = std::max(p.z, -p.w); };
constexpr auto kWSignLost = [](Vec4<float>& p) { p = p.w < 0 ? -p : p; };

// The stage, what it makes of each primitive changed: change(corners) may take some away.
template <auto change>
void clip_changed(const Assembly& assembly, Polygons& out) {
  Polygons right;
  pipeline::clip(assembly, right);
  for (const ClipPolygon& p : right.polygons) {
    const auto from = right.vertices.begin() + p.first;
    Corners corners(from, from + p.count);
    change(corners);
    out.polygons.push_back(
        {p.primitive, static_cast<std::uint32_t>(out.vertices.size()), static_cast<std::uint32_t>(corners.size())});
    out.vertices.insert(out.vertices.end(), corners.begin(), corners.end());
  }
}

// A cut's corner has the attributes of the one before it.
constexpr auto kAttributesNotCut = [](Corners& corners) {
  const auto of_mesh =
      std::find_if(corners.rbegin(), corners.rend(), [](const ClipVertex<float>& c) { return !c.cut; });
  if (of_mesh == corners.rend()) return;
  Vec4<float> color = of_mesh->color;
  for (ClipVertex<float>& c : corners) {
    if (c.cut) c.color = color;
    color = c.color;
  }
};

constexpr auto kCornerLost = [](Corners& corners) {
  if (corners.size() > 3) corners.pop_back();
};

constexpr auto kReversed = [](Corners& corners) {
  if (corners.size() > 3) std::reverse(corners.begin(), corners.end());
};

// Each primitive by itself, as change(its corners, its assembly) has it; false: it is left out.
template <auto change>
void clip_each(const Assembly& assembly, Polygons& out) {
  for (std::size_t i = 0; i < assembly.triangles.size(); ++i) {
    std::array<Vertex<float>, 3> vertices;
    std::array<Lit<float>, 3> lit;
    for (int k = 0; k < 3; ++k) {
      vertices[static_cast<std::size_t>(k)] = assembly.vertices[assembly.triangles[i][k]];
      lit[static_cast<std::size_t>(k)] = assembly.lit[assembly.triangles[i][k]];
    }
    if (!change(assembly.shading, vertices, lit)) continue;
    const glm::uvec3 corners(0, 1, 2);
    Assembly one = assembly;
    one.vertices = vertices;
    one.lit = lit;
    one.triangles = {&corners, 1};
    one.first_primitive = assembly.first_primitive + static_cast<std::uint32_t>(i);
    pipeline::clip(one, out);
  }
}
using ThreeVertices = std::array<Vertex<float>, 3>;
using ThreeLit = std::array<Lit<float>, 3>;

// x / w of a corner behind the eye has the other sign.
constexpr auto kDividedFirst = [](Shading, const ThreeVertices& vertices, const ThreeLit&) {
  for (int i = 0; i < 2; ++i) {
    int right = 0, left = 0;
    for (const Vertex<float>& v : vertices) {
      right += v.p_clip[i] / v.p_clip.w > 1;
      left += v.p_clip[i] / v.p_clip.w < -1;
    }
    if (right == 3 || left == 3) return false;
  }
  return true;
};

constexpr auto kFirstProvokes = [](Shading shading, const ThreeVertices&, ThreeLit& lit) {
  if (shading == Shading::flat) lit[2] = lit[0];
  return true;
};

// The stage under other matrices, or a draw that says something else.
template <auto change>
void window_under(const Matrices<float>& matrices, const Draw& draw, const Polygons& polygons,
                  std::span<const ClipPolygon> of_draw, Triangles& out) {
  Matrices<float> wrong_matrices = matrices;
  Draw wrong = draw;
  change(wrong_matrices, wrong);
  pipeline::to_window(wrong_matrices, wrong, polygons, of_draw, out);
}

constexpr auto kModeOfOtherFace = [](Matrices<float>&, Draw& d) { std::swap(d.front_mode, d.back_mode); };
constexpr auto kOtherSideCulled = [](Matrices<float>&, Draw& d) {
  if (d.cull != Cull::none) d.cull = d.cull == Cull::front ? Cull::back : Cull::front;
};
constexpr auto kCulledByModel = [](Matrices<float>& m, Draw& d) {
  if (glm::determinant(Mat3<float>(m.model_view)) < 0) kOtherSideCulled(m, d);
};
constexpr auto kRowsFromAbove = [](Matrices<float>& m, Draw&) { m.win_scale.y = -m.win_scale.y; };

// The stage, its corners snapped otherwise. Triangles of no area are gone.
template <auto snap>
void snapped_otherwise(const Matrices<float>& matrices, const Draw& draw, const Polygons& polygons,
                       std::span<const ClipPolygon> of_draw, Triangles& out) {
  Triangles made;
  pipeline::to_window(matrices, draw, polygons, of_draw, made);
  for (Triangle& t : made) {
    for (WindowVertex<float>& v : t.v) v.snapped = snap(v);
    const std::int64_t area = pipeline::snapped_area(t);
    if (t.corners == 3 && area == 0) continue;
    if (t.corners == 3) t.front = area > 0;
    out.push_back(t);
  }
}

constexpr auto kTruncated = [](const WindowVertex<float>& v) {
  return glm::ivec2((glm::vec2(v.p_win) - 0.5f) * static_cast<float>(kSubpixel));
};
constexpr auto kWholeRows = [](const WindowVertex<float>& v) {
  return glm::ivec2(v.snapped.x, (v.snapped.y + kSubpixel / 2) / kSubpixel * kSubpixel);
};
constexpr auto kHalfAPixelOff = [](const WindowVertex<float>& v) { return v.snapped + kSubpixel / 2; };

void z_not_divided(const Matrices<float>& matrices, const Draw& draw, const Polygons& polygons,
                   std::span<const ClipPolygon> of_draw, Triangles& out) {
  Polygons wrong = polygons;
  for (ClipVertex<float>& v : wrong.vertices) v.p_clip.z *= v.p_clip.w;
  pipeline::to_window(matrices, draw, wrong, of_draw, out);
}

void facing_turned(const Matrices<float>& matrices, const Draw& draw, const Polygons& polygons,
                   std::span<const ClipPolygon> of_draw, Triangles& out) {
  const std::size_t first = out.size();
  pipeline::to_window(matrices, draw, polygons, of_draw, out);
  for (Triangle& t : std::span(out).subspan(first)) t.front = t.front != (t.corners == 3);
}

void diagonals_drawn(const Matrices<float>& matrices, const Draw& draw, const Polygons& polygons,
                     std::span<const ClipPolygon> of_draw, Triangles& out) {
  if (draw.front_mode == PolygonMode::fill && draw.back_mode == PolygonMode::fill)
    return pipeline::to_window(matrices, draw, polygons, of_draw, out);
  Polygons fans;
  for (const ClipPolygon& p : of_draw) {
    if (p.count < 3) return pipeline::to_window(matrices, draw, polygons, of_draw, out);
    for (std::uint32_t i = 2; i < p.count; ++i) {
      fans.polygons.push_back({p.primitive, static_cast<std::uint32_t>(fans.vertices.size()), 3});
      for (const std::uint32_t k : {0u, i - 1, i}) fans.vertices.push_back(polygons.vertices[p.first + k]);
    }
  }
  pipeline::to_window(matrices, draw, fans, fans.polygons, out);
}

// An edge begins at the corner that it ends in, but the first.
void edges_of_one_corner(const Matrices<float>& matrices, const Draw& draw, const Polygons& polygons,
                         std::span<const ClipPolygon> of_draw, Triangles& out) {
  const std::size_t first = out.size();
  pipeline::to_window(matrices, draw, polygons, of_draw, out);
  for (std::size_t i = first + 1; i < out.size(); ++i) {
    Triangle& edge = out[i];
    if (edge.corners == 2 && out[i - 1].primitive == edge.primitive) edge.v[0] = edge.v[1];
  }
}

template <auto function>
constexpr Fault of_clip(std::string_view name, std::string_view changes, std::string_view report = {}) {
  return {name, changes, Stage::clip, put<&Geometry::clip, function>, report};
}
template <auto function>
constexpr Fault of_window(std::string_view name, std::string_view changes, std::string_view report = {}) {
  return {name, changes, Stage::window, put<&Geometry::window, function>, report};
}

constexpr std::array kPolygons = {
    of_clip<cut_at<kNoNear>>("clip.no_near_plane", "nothing is cut at the near plane"),
    of_clip<cut_at<kNoFar>>("clip.no_far_plane", "nothing is cut at the far plane"),
    of_clip<cut_at<kNearAtZero>>("clip.near_at_zero", "the near plane lies at z = 0, where another library has it",
                                 "jdahlstrom/retrofire#3"),
    of_clip<clip_moved<kNearFlattened>>(
        "clip.near_flattened", "what is before the near plane is moved onto it, not cut", "Vita3K/Vita3K#4110"),
    of_clip<clip_moved<kWSignLost>>("clip.w_sign_lost",
                                    "what is behind the eye is taken for its mirror image before it"),
    of_clip<clip_each<kDividedFirst>>("clip.left_out_after_division",
                                      "triangles are left out by x/w and y/w, behind the eye too", "vindar/tgx#47"),
    of_clip<clip_each<kFirstProvokes>>("clip.first_vertex_provokes", "flat triangles have their first corner's colour",
                                       "flyinghead/flycast#1681"),
    of_clip<clip_changed<kAttributesNotCut>>("clip.attributes_not_cut",
                                             "a cut's corner has the attributes of the corner before it",
                                             "Victormeriqui/Consol3#20"),
    of_clip<clip_changed<kCornerLost>>("clip.corner_lost", "a cut polygon loses its last corner"),
    of_clip<clip_changed<kReversed>>("clip.winding_reversed", "cut polygons run the other way round"),
    of_window<window_under<kModeOfOtherFace>>(
        "window.mode_of_other_face", "front faces are drawn in the back faces' polygon mode, and back faces in theirs"),
    of_window<window_under<kOtherSideCulled>>("window.other_side_culled", "front faces are culled for back faces"),
    of_window<window_under<kCulledByModel>>("window.culled_by_model", "a mirrored model's other faces are culled",
                                            "antverdovsky/Honeycomb-Game-Engine#2"),
    of_window<window_under<kRowsFromAbove>>("window.y_flipped", "y runs downwards"),
    of_window<snapped_otherwise<kTruncated>>("window.snap_truncates",
                                             "window positions are truncated to 1/256 pixel, not rounded"),
    of_window<snapped_otherwise<kWholeRows>>(
        "window.whole_rows", "corners' y are rounded to whole pixels, their x are not", "gonetz/GLideN64#1731"),
    of_window<snapped_otherwise<kHalfAPixelOff>>("window.half_pixel_off",
                                                 "corners lie half a pixel too far right and up"),
    of_window<facing_turned>("window.facing_turned", "triangles whose corners are clockwise are front faces"),
    of_window<z_not_divided>("window.z_not_divided", "window z is not divided by w"),
    of_window<diagonals_drawn>("window.diagonals_drawn",
                               "the edges of a cut triangle's fan are drawn, not those of its polygon"),
    of_window<edges_of_one_corner>("window.edges_of_one_corner", "an edge begins at the corner that it ends in"),
};

}  // namespace

std::span<const Fault> of_polygons() { return kPolygons; }

}  // namespace plumbline::faults
