#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "faults/faults.h"
#include "faults/lists.h"
#include "faults/variants.h"
#include "pipeline/geometry.h"

namespace plumbline::faults {

namespace {

using pipeline::Attributes;
using pipeline::ClipVertex;
using pipeline::DrawInput;
using pipeline::Polygon;
using pipeline::ShadedTriangle;
using Triangles = std::vector<ShadedTriangle>;

// Clipping at other planes; with depth clamp, which has no near and far plane to get wrong, the right clipping.
template <auto planes>
void cut_at(const DrawInput& input, Polygon& polygon) {
  if (input.depth_clamp) return pipeline::clip(input, polygon);
  pipeline::clip_at(planes(), polygon);
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

void cut_far_off(const DrawInput& input, Polygon& polygon) {
  constexpr float kTimes = 8;
  const auto near_and_far = pipeline::view_volume().subspan<4>();
  const std::array<Vec4<float>, 6> planes = {Vec4<float>(-1, 0, 0, kTimes),
                                             Vec4<float>(1, 0, 0, kTimes),
                                             Vec4<float>(0, -1, 0, kTimes),
                                             Vec4<float>(0, 1, 0, kTimes),
                                             near_and_far[0],
                                             near_and_far[1]};
  pipeline::clip_at(std::span(planes).first(input.depth_clamp ? 4 : 6), polygon);
}

// Clipping of a polygon whose positions `change` altered.
template <auto change>
void clip_moved(const DrawInput& input, Polygon& polygon) {
  for (ClipVertex& v : polygon.corners) change(v.p_clip);
  pipeline::clip(input, polygon);
}

constexpr auto kNearFlattened = [](Vec4<float>& p) { p.z = std::max(p.z, -p.w); };
constexpr auto kWSignLost = [](Vec4<float>& p) { p = p.w < 0 ? -p : p; };

// Clipping, followed by `change` of the clipped polygon.
template <auto change>
void clip_changed(const DrawInput& input, Polygon& polygon) {
  pipeline::clip(input, polygon);
  change(polygon);
}

// Corners made by a cut have the attributes of the corner before.
constexpr auto kAttributesNotCut = [](Polygon& polygon) {
  const Attributes* before = nullptr;
  for (const ClipVertex& c : polygon.corners) {
    if (!c.cut) before = &c.attributes;
  }
  if (before == nullptr) return;
  Attributes attributes = *before;
  for (ClipVertex& c : polygon.corners) {
    if (c.cut) c.attributes = attributes;
    attributes = c.attributes;
  }
};

constexpr auto kCornerLost = [](Polygon& polygon) {
  if (polygon.corners.size() > 3) polygon.corners.pop_back();
};

constexpr auto kReversed = [](Polygon& polygon) {
  if (polygon.corners.size() > 3) std::reverse(polygon.corners.begin(), polygon.corners.end());
};

// Polygons outside of one side by x / w or y / w are dropped: behind the eye these quotients have the other sign.
void left_out_after_division(const DrawInput& input, Polygon& polygon) {
  for (int i = 0; i < 2; ++i) {
    std::size_t right = 0, left = 0;
    for (const ClipVertex& v : polygon.corners) {
      right += v.p_clip[i] / v.p_clip.w > 1;
      left += v.p_clip[i] / v.p_clip.w < -1;
    }
    if (right == polygon.corners.size() || left == polygon.corners.size()) return polygon.corners.clear();
  }
  pipeline::clip(input, polygon);
}

// Facing by x/w and y/w before anything is cut: a corner behind the eye is mirrored, which turns the triangle over.
void culled_before_clip(const DrawInput& input, Polygon& polygon) {
  const Cull cull = input.draw->cull;
  if (polygon.corners.size() == 3 && cull != Cull::none) {
    const auto at = [&](std::size_t i) {
      const Vec4<float>& p = polygon.corners[i].p_clip;
      return glm::vec2(p.x / p.w, p.y / p.w);
    };
    const glm::vec2 a = at(1) - at(0), b = at(2) - at(0);
    const bool is_front = a.x * b.y - a.y * b.x > 0;
    if (is_front == (cull == Cull::front)) return polygon.corners.clear();
  }
  pipeline::clip(input, polygon);
}

Polygon first_provokes(const DrawInput& input, const glm::uvec3& corners, std::span<const Vertex<float>> vertices,
                       std::span<const Attributes> attributes) {
  Polygon polygon = pipeline::assemble(input, corners, vertices, attributes);
  if (input.draw->shading != Shading::flat) return polygon;
  const Attributes& first = attributes[corners[0]];
  for (ClipVertex& v : polygon.corners) {
    v.attributes.color() = first.color();
    for (const Varying varying : kAllVaryings) {
      if (is_lit(varying)) v.attributes[varying] = first[varying];
    }
  }
  return polygon;
}

// Stage under the matrices, or the draw, that `change` altered.
template <auto change>
void window_under(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  DrawInput wrong = input;
  Draw wrong_draw = *input.draw;
  wrong.draw = &wrong_draw;
  change(wrong.matrices, wrong_draw);
  pipeline::to_window(wrong, polygon, out);
}

constexpr auto kModeOfOtherFace = [](Matrices<float>&, Draw& d) { std::swap(d.front_mode, d.back_mode); };
constexpr auto kOtherSideCulled = [](Matrices<float>&, Draw& d) {
  if (d.cull != Cull::none) d.cull = d.cull == Cull::front ? Cull::back : Cull::front;
};
constexpr auto kCulledByModel = [](Matrices<float>& m, Draw& d) {
  if (glm::determinant(Mat3<float>(m.model_view)) < 0) kOtherSideCulled(m, d);
};
constexpr auto kRowsFromAbove = [](Matrices<float>& m, Draw&) { m.win_scale.y = -m.win_scale.y; };

// Stage window by another snapping. Triangles without area are gone.
template <auto snap>
void snapped_otherwise(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  Triangles made;
  pipeline::to_window(input, polygon, made);
  for (ShadedTriangle& t : made) {
    for (pipeline::WindowVertex& v : t.v) v.snapped = snap(v);
    const std::int64_t area = pipeline::snapped_area(t);
    if (t.corners == 3 && area == 0) continue;
    if (t.corners == 3) t.front = area > 0;
    out.push_back(t);
  }
}

constexpr auto kTruncated = [](const pipeline::WindowVertex& v) {
  return glm::ivec2((glm::vec2(v.p_win) - 0.5f) * static_cast<float>(kSubpixel));
};
constexpr auto kWholeRows = [](const pipeline::WindowVertex& v) {
  return glm::ivec2(v.snapped.x, (v.snapped.y + kSubpixel / 2) / kSubpixel * kSubpixel);
};
constexpr auto kHalfAPixelOff = [](const pipeline::WindowVertex& v) { return v.snapped + kSubpixel / 2; };

enum class To { down, up, nearest };
template <To way>
float whole(float p) {
  return way == To::up ? std::ceil(p) : std::floor(way == To::down ? p : p + 0.5f);
}

// Corners in whole pixels (`centre`: plus a half), for coverage and for interpolation.
template <bool centre, To x = To::down, To y = x>
void in_whole_pixels(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  Triangles made;
  pipeline::to_window(input, polygon, made);
  constexpr float kPart = centre ? 0.5f : 0;
  for (ShadedTriangle& t : made) {
    for (pipeline::WindowVertex& v : t.v) {
      const glm::vec2 from = glm::vec2(v.p_win) - kPart, p = glm::vec2(whole<x>(from.x), whole<y>(from.y)) + kPart;
      v.p_win.x = p.x, v.p_win.y = p.y;
      v.snapped = glm::ivec2((p - 0.5f) * static_cast<float>(kSubpixel));
    }
    const std::int64_t area = pipeline::snapped_area(t);
    if (t.corners == 3 && area == 0) continue;
    if (t.corners == 3) t.front = area > 0;
    out.push_back(t);
  }
}

void z_not_divided(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  Polygon wrong = polygon;
  for (ClipVertex& v : wrong.corners) v.p_clip.z *= v.p_clip.w;
  pipeline::to_window(input, wrong, out);
}

// Each corner's window z is 1/w: proportional to the nearness, not to the depth.
void z_of_inv_w(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  const std::size_t first = out.size();
  pipeline::to_window(input, polygon, out);
  for (ShadedTriangle& t : std::span(out).subspan(first)) {
    for (pipeline::WindowVertex& v : t.v) v.p_win.z = v.inv_w;
  }
}

// Facing by x and y before the division by w. Where the view volume's axis is its middle, it is the sign of z of the
// face's normal in eye space: right without perspective alone.
void culled_by_eye_normal(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  if (polygon.corners.size() < 3) return pipeline::to_window(input, polygon, out);
  float area = 0;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Vec4<float>&a = polygon.corners[i].p_clip, &b = polygon.corners[(i + 1) % polygon.corners.size()].p_clip;
    area += a.x * b.y - a.y * b.x;
  }
  const bool is_front = area > 0;
  const Cull cull = input.draw->cull;
  if (cull != Cull::none && is_front == (cull == Cull::front)) return;
  Draw draw = *input.draw;
  draw.cull = Cull::none;
  DrawInput unculled = input;
  unculled.draw = &draw;
  const std::size_t first = out.size();
  pipeline::to_window(unculled, polygon, out);
  for (ShadedTriangle& t : std::span(out).subspan(first)) t.front = is_front;
}

void facing_turned(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  const std::size_t first = out.size();
  pipeline::to_window(input, polygon, out);
  for (ShadedTriangle& t : std::span(out).subspan(first)) t.front = t.front != (t.corners == 3);
}

void diagonals_drawn(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  const bool filled = is_filled(*input.draw);
  if (filled || polygon.corners.size() < 3) return pipeline::to_window(input, polygon, out);
  for (std::size_t i = 2; i < polygon.corners.size(); ++i) {
    Polygon triangle{polygon.primitive, {}};
    for (const std::size_t k : {std::size_t{0}, i - 1, i}) triangle.corners.push_back(polygon.corners[k]);
    pipeline::to_window(input, triangle, out);
  }
}

// Edges of an outline, but the first, begin at their end.
void edges_of_one_corner(const DrawInput& input, const Polygon& polygon, Triangles& out) {
  const std::size_t first = out.size();
  pipeline::to_window(input, polygon, out);
  for (std::size_t i = first + 1; i < out.size(); ++i) {
    ShadedTriangle& edge = out[i];
    if (edge.corners == 2) edge.v[0] = edge.v[1], edge.attributes[0] = edge.attributes[1];
  }
}

constexpr std::array kPolygons = {
    stage_fault("clip.no_near_plane", "nothing is cut at the near plane", put<&Stages::clip, cut_at<kNoNear>>),
    stage_fault("clip.no_far_plane", "nothing is cut at the far plane", put<&Stages::clip, cut_at<kNoFar>>),
    stage_fault("clip.near_at_zero", "the near plane lies at z = 0, where another library has it",
                put<&Stages::clip, cut_at<kNearAtZero>>, "jdahlstrom/retrofire#3"),
    stage_fault("clip.near_flattened", "what is before the near plane is moved onto it, not cut",
                put<&Stages::clip, clip_moved<kNearFlattened>>, "Vita3K/Vita3K#4110"),
    stage_fault("clip.w_sign_lost", "what is behind the eye is taken for its mirror image before it",
                put<&Stages::clip, clip_moved<kWSignLost>>),
    stage_fault("clip.left_out_after_division", "triangles are left out by x/w and y/w, behind the eye too",
                put<&Stages::clip, left_out_after_division>, "vindar/tgx#47"),
    stage_fault("clip.culled_before_cut", "faces are culled by x/w and y/w, behind the eye too",
                put<&Stages::clip, culled_before_clip>),
    stage_fault("clip.first_vertex_provokes", "flat triangles have their first corner's colour",
                put<&Stages::assemble, first_provokes>, "flyinghead/flycast#1681"),
    stage_fault("clip.attributes_not_cut", "a cut's corner has the attributes of the corner before it",
                put<&Stages::clip, clip_changed<kAttributesNotCut>>, "Victormeriqui/Consol3#20"),
    stage_fault("clip.corner_lost", "a cut polygon loses its last corner",
                put<&Stages::clip, clip_changed<kCornerLost>>),
    stage_fault("clip.winding_reversed", "cut polygons run the other way round",
                put<&Stages::clip, clip_changed<kReversed>>),
    stage_fault("window.mode_of_other_face",
                "front faces are drawn in the back faces' polygon mode, and back faces in theirs",
                put<&Stages::window, window_under<kModeOfOtherFace>>),
    stage_fault("window.other_side_culled", "front faces are culled for back faces",
                put<&Stages::window, window_under<kOtherSideCulled>>),
    stage_fault("window.culled_by_model", "a mirrored model's other faces are culled",
                put<&Stages::window, window_under<kCulledByModel>>, "antverdovsky/Honeycomb-Game-Engine#2"),
    stage_fault("window.y_flipped", "y runs downwards", put<&Stages::window, window_under<kRowsFromAbove>>),
    stage_fault("window.snap_truncates", "window positions are truncated to 1/256 pixel, not rounded",
                put<&Stages::window, snapped_otherwise<kTruncated>>),
    stage_fault("window.whole_rows", "corners' y are rounded to whole pixels, their x are not",
                put<&Stages::window, snapped_otherwise<kWholeRows>>, "gonetz/GLideN64#1731"),
    stage_fault("window.whole_pixels", "corners are truncated to whole pixels",
                put<&Stages::window, in_whole_pixels<false>>),
    stage_fault("window.whole_centres", "corners are moved down to pixels' centres",
                put<&Stages::window, in_whole_pixels<true>>),
    stage_fault("window.whole_pixels_from_top", "corners are truncated to whole pixels, where y points down",
                put<&Stages::window, in_whole_pixels<false, To::down, To::up>>),
    stage_fault("window.whole_centres_from_top", "corners are moved left and up to pixels' centres",
                put<&Stages::window, in_whole_pixels<true, To::down, To::up>>),
    stage_fault("window.nearest_pixels", "corners are rounded to whole pixels",
                put<&Stages::window, in_whole_pixels<false, To::nearest>>),
    stage_fault("window.nearest_centres", "corners are moved to the nearest pixels' centres",
                put<&Stages::window, in_whole_pixels<true, To::nearest>>),
    stage_fault("window.half_pixel_off", "corners lie half a pixel too far right and up",
                put<&Stages::window, snapped_otherwise<kHalfAPixelOff>>),
    stage_fault("window.facing_turned", "triangles whose corners are clockwise are front faces",
                put<&Stages::window, facing_turned>),
    stage_fault("window.z_not_divided", "window z is not divided by w", put<&Stages::window, z_not_divided>),
    stage_fault("window.z_of_inv_w", "window z is 1/w", put<&Stages::window, z_of_inv_w>),
    stage_fault("window.culled_by_eye_normal",
                "faces are culled by the z of their normal in eye space, not by the side that is seen",
                put<&Stages::window, culled_by_eye_normal>),
    stage_fault("window.diagonals_drawn", "the edges of a cut triangle's fan are drawn, not those of its polygon",
                put<&Stages::window, diagonals_drawn>),
    stage_fault("window.edges_of_one_corner", "an edge begins at the corner that it ends in",
                put<&Stages::window, edges_of_one_corner>),
};

}  // namespace

std::span<const Fault> of_polygons() { return kPolygons; }

void use_guard_band(pipeline::Stages& stages) { put<&Stages::clip, cut_far_off>(stages); }

}  // namespace plumbline::faults
