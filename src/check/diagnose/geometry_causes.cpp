// Known causes of stages 0 to 4.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

#include "check/bounds/matched_by_primitive.h"
#include "check/diagnose/known_causes.h"
#include "check/polygons/legal_polygon.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

double aspect(const Scene& scene) { return static_cast<double>(scene.frame.width) / scene.frame.height; }

// Scale (size - 1) / size of the frame along x and y; 1 along z.
glm::dvec3 one_less(const Scene& scene) {
  const glm::dvec3 size(scene.frame.width, scene.frame.height, 1);
  return {(size.x - 1) / size.x, (size.y - 1) / size.y, 1};
}

// Window positions off by so many half pixels.
template <int dx, int dy>
void moved_by(Matrices<double>& m) {
  m.win_translate += glm::dvec3(0.5 * dx, 0.5 * dy, 0);
}

Cull other(Cull cull) { return cull == Cull::back ? Cull::front : cull == Cull::front ? Cull::back : Cull::none; }
LightModel::Specular other(LightModel::Specular specular) {
  using enum LightModel::Specular;
  return specular == reflection ? half_vector : reflection;
}

void leave_out_camera(Scene& scene) { scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}; }
void eye_space_is_the_world(Scene& scene) {
  scene.dialect = Dialect::gl;
  leave_out_camera(scene);
}

// Detector of fixed point: all numbers expected off the multiples of 2^-16 are multiples, within 2^-10 of the expected
// ones. Floats of 128 and more are always multiples.
class FixedPoint {
 public:
  void add(const auto& is, const auto& expected) {
    constexpr double kNear = 0x1p-10;  // what sums of rounded products may be off
    for (glm::length_t i = 0; i < is.length(); ++i) {
      if (is_multiple(expected[i]) || !(std::abs(expected[i]) < 128)) continue;
      ++off_grid_;
      fixed_ += is_multiple(is[i]) && std::abs(is[i] - expected[i]) <= kNear ? 1 : 0;
    }
  }
  bool shows() const { return off_grid_ >= kLeast && fixed_ == off_grid_; }

 private:
  static constexpr std::size_t kLeast = 4;
  static bool is_multiple(double v) { return std::nearbyint(v * 0x1p16) == v * 0x1p16; }
  std::size_t off_grid_ = 0, fixed_ = 0;
};

bool has_fixed_matrices(const Evidence& e) {
  const std::vector<Matrices<double>>&is = e.candidate.records.matrices, &expected = e.expected.records.matrices;
  FixedPoint numbers;
  for (std::size_t i = 0; i < std::min(is.size(), expected.size()); ++i) {
    for (glm::length_t column = 0; column < 4; ++column) {
      numbers.add(is[i].model_view[column], expected[i].model_view[column]);
      numbers.add(is[i].projection[column], expected[i].projection[column]);
    }
  }
  return numbers.shows();
}

bool has_fixed_vertices(const Evidence& e) {
  const std::vector<Vertex<double>>&is = e.candidate.records.vertices, &expected = e.expected.records.vertices;
  FixedPoint numbers;
  for (std::size_t i = 0; i < std::min(is.size(), expected.size()); ++i) {
    numbers.add(is[i].p_eye, expected[i].p_eye);
    numbers.add(is[i].p_clip, expected[i].p_clip);
  }
  return numbers.shows();
}
constexpr std::string_view kFixedPoint =
    "its numbers are multiples of 2^-16: fixed point; numbers below 0.76 are coarser than 1 part in 10^5 (OpenGL 2.1, "
    "2.1.1)";

// Whether a vertex is beyond a plane (polygons/legal_polygon.h, distances), by more than rounding.
bool outside(const ClipVertex<double>& v, std::size_t plane) {
  return distances(v.p_clip)[plane] < -1e-5 * (std::abs(v.p_clip.w) + std::abs(v.p_clip[static_cast<int>(plane / 2)]));
}

// Whether the candidate's polygons reach beyond `plane`, the expected ones do not, and no other plane is crossed.
template <std::size_t plane>
bool not_cut(const Evidence& e) {
  bool any = false;
  for (const ClipVertex<double>& v : e.candidate.records.polygons.vertices) {
    for (std::size_t p = 0; p < 6; ++p) {
      if (outside(v, p) && p != plane) return false;
      any = any || outside(v, p);
    }
  }
  return any && std::ranges::none_of(e.expected.records.polygons.vertices,
                                     [](const ClipVertex<double>& v) { return outside(v, plane); });
}

// True: visit(mine, theirs) holds for each primitive with a polygon on either side; null: that side has no polygon.
bool each_polygon(const Evidence& e, auto visit) {
  using Run = std::span<const ClipPolygon>;
  bool all = true;
  matched_by_primitive(Run(e.candidate.records.polygons.polygons), Run(e.expected.records.polygons.polygons),
                       [&](Run mine, Run theirs) {
                         all = all && visit(mine.empty() ? nullptr : &mine[0], theirs.empty() ? nullptr : &theirs[0]);
                       });
  return all;
}

bool cut_polygons_dropped(const Evidence& e) {
  const auto& vertices = e.expected.records.polygons.vertices;
  bool any = false;
  const bool all = each_polygon(e, [&](const ClipPolygon* mine, const ClipPolygon* theirs) {
    if (theirs == nullptr) return false;
    if (mine != nullptr) return mine->count == theirs->count;
    any = true;
    return std::any_of(vertices.begin() + theirs->first, vertices.begin() + theirs->first + theirs->count,
                       [](const ClipVertex<double>& v) { return v.cut; });
  });
  return any && all;
}

bool one_vertex_lost(const Evidence& e) {
  const auto &mine_of = e.candidate.records.polygons.vertices, &theirs_of = e.expected.records.polygons.vertices;
  bool any = false;
  const bool all = each_polygon(e, [&](const ClipPolygon* mine, const ClipPolygon* theirs) {
    if (theirs == nullptr || mine == nullptr) return theirs != nullptr && theirs->count == 3;
    any = any || mine->count + 1 == theirs->count;
    if (mine->count != theirs->count && mine->count + 1 != theirs->count) return false;
    for (std::uint32_t i = 0; i < mine->count; ++i) {  // what is left stands where it should, and has its colour
      const Vec4<double>&p = mine_of[mine->first + i].p_clip, &color = mine_of[mine->first + i].color;
      const double near = 1e-5 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + std::abs(p.w));
      if (std::none_of(theirs_of.begin() + theirs->first, theirs_of.begin() + theirs->first + theirs->count,
                       [&](const ClipVertex<double>& v) {
                         return glm::distance(v.p_clip, p) <= near && glm::distance(v.color, color) <= 1e-3;
                       }))
        return false;
    }
    return true;
  });
  return any && all;
}

// Whether cut vertices have a corner's colour, not an interpolated one.
bool not_interpolated_at_cuts(const Evidence& e) {
  const std::vector<Lit<double>>& corners = e.candidate.records.lit;
  const auto copied = [&](const ClipVertex<double>& v) {
    return !v.cut ||
           std::ranges::any_of(corners, [&](const Lit<double>& l) { return glm::distance(l.color, v.color) < 1e-6; });
  };
  const bool cuts = std::ranges::any_of(e.candidate.records.polygons.vertices, &ClipVertex<double>::cut);
  return cuts && e.candidate.records.polygons.polygons.size() == e.expected.records.polygons.polygons.size() &&
         std::ranges::all_of(e.candidate.records.polygons.vertices, copied) &&
         !std::ranges::all_of(e.expected.records.polygons.vertices, copied);
}

void first_vertex_provokes(const Scene& scene, const Capture& in, Capture& made) {
  const DrawIndex draws(scene);
  for (const ClipPolygon& p : made.records.polygons.polygons) {
    if (draws.draw(p.primitive)->shading != Shading::flat) continue;
    for (std::uint32_t i = 0; i < p.count; ++i)
      made.records.polygons.vertices[p.first + i].color = in.records.lit[draws.corners(p.primitive).x].color;
  }
}

// Whether `snapped` of all corners is what `rounded` makes of their own positions.
template <class Round>
bool all_snapped_by(const Evidence& e, Round rounded) {
  bool any = false;
  for (const WindowTriangle<double>& t : e.candidate.records.triangles) {
    for (const WindowVertex<double>& v : t.v) {
      for (int c = 0; c < 2; ++c) {
        const double at = (v.p_win[c] - 0.5) * kSubpixel;
        if (v.snapped[c] != rounded(at)) return false;
        any = any || rounded(at) != std::nearbyint(at);
      }
    }
  }
  return any;
}

// Without the clamp, a negative N.L subtracts the diffuse light of the negated normal.
bool lit_without_clamp(const Evidence& e) {
  Scene diffuse = e.scene, ambient = e.scene;
  change_all(diffuse.lights, [](Light& l) { l.specular = glm::vec3(0); });
  change_all(ambient.lights, [](Light& l) { l.specular = l.diffuse = glm::vec3(0); });
  Capture turned = e.candidate;
  for (Vertex<double>& v : turned.records.vertices) v.n_eye = -v.n_eye;
  const auto behind = e.referee->run_stage(diffuse, Stage::light, turned).records.lit;
  const auto none = e.referee->run_stage(ambient, Stage::light, turned).records.lit;
  const auto &mine = e.candidate.records.lit, &theirs = e.expected.records.lit;
  if (mine.size() != theirs.size() || behind.size() != mine.size()) return false;
  std::size_t differ = 0, explained = 0;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (std::abs(mine[i].color[c] - theirs[i].color[c]) < 1e-5) continue;
      const double without = theirs[i].color[c] - (behind[i].color[c] - none[i].color[c]);
      ++differ;
      explained += std::abs(mine[i].color[c] - std::clamp(without, 0.0, 1.0)) < 1e-5 ? 1 : 0;
    }
  }
  return differ > 0 && (differ - explained) * 50 <= differ;
}

using S = Stage;

constexpr std::array kGeometryCauses = {
    made<[](const Scene& s, Matrices<double>& m) { m.projection[0][0] *= aspect(s), m.projection[1][1] *= aspect(s); }>(
        S::matrices, "matrices.fov_horizontal",
        "the vertical field of view is taken for the horizontal one: x and y scaled by the aspect"),
    made<[](const Scene& s, Matrices<double>& m) { m.projection[0][0] *= aspect(s); }>(
        S::matrices, "matrices.aspect_ignored", "aspect: x not scaled by h/w"),
    made<[](const Scene& s, Matrices<double>& m) { m.projection[0][0] *= aspect(s) * aspect(s); }>(
        S::matrices, "matrices.aspect_inverted", "aspect: x scaled by w/h for h/w"),
    made<[](Matrices<double>& m) { m.projection[2][2] *= -1, m.projection[3][2] *= -1; }>(
        S::matrices, "matrices.near_far_swapped", "near and far changed places: the projection's z row is negated"),
    made<[](Matrices<double>& m) { m.win_scale.z = m.win_translate.z = 0.5; }>(
        S::matrices, "matrices.depth_range_not_mapped", "z not mapped by the depth range: every draw fills [0,1]"),
    made<[](Matrices<double>& m) { m.win_scale.y *= -1; }>(
        S::matrices, "matrices.y_flipped", "y mirrored: the window's origin is taken for the upper left corner"),
    made<[](const Scene& s, Matrices<double>& m) { m.win_scale *= one_less(s), m.win_translate *= one_less(s); }>(
        S::matrices, "matrices.size_less_one", "the viewport is scaled by width - 1 and height - 1"),
    made<[](Matrices<double>& m) { m.win_translate -= glm::dvec3(0.5, 0.5, 0); }>(
        S::matrices, "matrices.half_pixel_less",
        "window positions half a pixel too low in x and y: pixel centres at integers"),
    given<[](Rotate& r) { r.degrees = -r.degrees; }>(S::matrices, "matrices.rotations_reversed",
                                                     "rotations turn the other way"),
    given<[](Rotate& r) { r.degrees *= 180 / std::numbers::pi; }>(S::matrices, "matrices.degrees_for_radians",
                                                                  "angles in degrees are taken for radians"),
    given<[](Draw& d) { std::ranges::reverse(d.transforms); }>(S::matrices, "matrices.transforms_reversed",
                                                               "transforms are multiplied in the other order"),
    given<leave_out_camera>(S::matrices, "matrices.camera_ignored", "the camera is left out of the model-view"),
    made<[](Matrices<double>& m) { m.normal = Mat3<double>(m.model_view); }>(
        S::matrices, "matrices.normal_by_model_view",
        "the normal matrix is the model-view's, not its inverse transpose"),
    seen(S::matrices, "matrices.fixed_point", kFixedPoint, has_fixed_matrices),
    seen(S::vertex, "vertex.fixed_point", kFixedPoint, has_fixed_vertices),
    given<[](Matrices<double>& m) { m.normal = Mat3<double>(m.model_view); }>(
        S::vertex, "vertex.normals_by_model_view", "normals go by the model-view matrix, not its inverse transpose"),
    given<[](Draw& d) { d.normals = Normals::as_they_are; }>(
        S::vertex, "vertex.not_renormalised", "normals differ by scale: not brought back to unit length"),
    made<[](Vertex<double>& v) { v.n_eye = -v.n_eye; }>(S::vertex, "vertex.normals_reversed",
                                                        "normals point the other way"),
    given<[](Matrices<double>& m) { m.model_view[3] = Vec4<double>(0, 0, 0, 1); }>(
        S::vertex, "vertex.translation_lost", "positions are taken for directions (w = 0): translations are lost"),
    given<[](Matrices<double>& m) {
      m.model_view = glm::transpose(m.model_view), m.projection = glm::transpose(m.projection);
    }>(S::vertex, "vertex.transposed", "matrices' rows are taken for their columns"),
    given<[](Scene& s, Capture& in) { eye_space_is_the_world(s), in.records.lights.clear(); }>(
        S::light, "light.world_space", "lights are not brought to eye space"),
    seen(S::light, "light.negative_not_clamped", "negative N.L not clamped: lights behind a surface darken it",
         lit_without_clamp),
    given<[](Light& l) { l.attenuation = glm::vec3(1, 0, 0); }>(
        S::light, "light.attenuation_left_out", "lights do not fade with distance: attenuation left out"),
    given<[](Scene& s) { s.light_model.ambient = glm::vec3(0); }>(S::light, "light.ambient_left_out",
                                                                  "the light model's ambient light is left out"),
    given<[](Scene& s) { s.light_model.ambient *= static_cast<float>(s.lights.size()); }>(
        S::light, "light.ambient_per_light", "the light model's ambient light is added once for each light"),
    given<[](Light& l) { l.specular = glm::vec3(0); }>(S::light, "light.specular_left_out",
                                                       "specular light is left out"),
    given<[](Light& l) { l.spot.reset(); }>(S::light, "light.cones_ignored", "spot lights shine to all sides"),
    given<[](Scene& s) { s.light_model.specular = other(s.light_model.specular); }>(
        S::light, "light.reflection_for_half_vector",
        "highlights by the mirrored light, (R.E)^s, for the half vector's (N.H)^s, or the other way round"),
    given<[](Scene& s) { s.light_model.local_viewer = !s.light_model.local_viewer; }>(
        S::light, "light.viewer_turned", "a local viewer is taken for one infinitely far away, or the other way round"),
    given<[](Scene& s) { s.light_model.sides = LightModel::Sides::one; }>(S::light, "light.one_sided",
                                                                          "back faces are lit as front faces are"),
    given<[](Draw& d) { d.color_material = ColorMaterial::none; }>(S::light, "light.color_material_ignored",
                                                                   "vertex colours do not stand for the material"),
    given<[](Material& m) { m.emission = glm::vec4(0, 0, 0, m.emission.a); }>(S::light, "light.emission_left_out",
                                                                              "emission is left out"),
    seen(S::clip, "clip.near_not_cut", "polygons reach through the near plane, and through no other: it is left out",
         not_cut<4>),
    seen(S::clip, "clip.far_not_cut", "polygons reach through the far plane, and through no other: it is left out",
         not_cut<5>),
    seen(S::clip, "clip.cut_dropped", "what is lacking are triangles that a plane cuts: dropped whole",
         cut_polygons_dropped),
    seen(S::clip, "clip.vertex_lost", "polygons that differ have one vertex less each", one_vertex_lost),
    seen(S::clip, "clip.not_interpolated",
         "all vertices that cuts made have a corner's colour: not interpolated at the cut", not_interpolated_at_cuts),
    made<first_vertex_provokes>(S::clip, "clip.first_vertex_provokes",
                                "flat triangles have their first vertex' colour, not their last one's"),
    given<[](Matrices<double>& m) { m.win_scale.y *= -1; }>(S::window, "window.y_flipped",
                                                            "y mirrored: window origin flipped"),
    given<[](Matrices<double>& m) { m.win_scale.x *= -1; }>(S::window, "window.x_flipped", "x mirrored"),
    given<moved_by<1, 1>>(S::window, "window.half_pixel_more",
                          "positions differ by (0.5, 0.5): pixel centre added twice"),
    given<moved_by<-1, -1>>(S::window, "window.half_pixel_less",
                            "positions differ by (-0.5, -0.5): pixel centres at integers"),
    given<moved_by<0, 2>>(S::window, "window.y_one_more", "every position at y+1: y off by one"),
    given<moved_by<0, -2>>(S::window, "window.y_one_less", "every position at y-1: y off by one"),
    given<[](const Scene& s, Matrices<double>& m) { m.win_scale *= one_less(s), m.win_translate *= one_less(s); }>(
        S::window, "window.size_less_one", "x and y scaled by width - 1 and height - 1"),
    given<[](Matrices<double>& m) { m.win_scale.z = 1, m.win_translate.z = 0; }>(
        S::window, "window.z_not_mapped",
        "z not mapped by the depth range: it is still the normalised device coordinate"),
    seen(S::window, "window.snap_truncates", "window positions truncated to 1/256 pixel, not rounded",
         [](const Evidence& e) { return all_snapped_by(e, [](double v) { return std::trunc(v); }); }),
    seen(S::window, "window.snap_floors", "window positions rounded down to 1/256 pixel, not to the nearest",
         [](const Evidence& e) { return all_snapped_by(e, [](double v) { return std::floor(v); }); }),
    given<[](Draw& d) { d.cull = other(d.cull); }>(S::window, "window.cull_other_face",
                                                   "winding mirrored for culling: the other faces are culled"),
    given<[](Draw& d) { d.cull = Cull::none; }>(S::window, "window.cull_ignored", "faces are kept that the draw culls"),
    KnownCause{S::window, "window.winding_mirrored", "winding mirrored: clockwise triangles are taken for the front",
               [](Scene& s, Capture&) {
                 change_all(s.draws, [](Draw& d) { std::swap(d.front_mode, d.back_mode), d.cull = other(d.cull); });
               },
               [](const Scene&, const Capture&, Capture& c) {
                 change_all(c.records.triangles, [](auto& t) { t.front = t.corners == 3 ? !t.front : t.front; });
               }},
    given<[](Draw& d) { std::swap(d.front_mode, d.back_mode); }>(
        S::window, "window.mode_of_other_face", "front faces have the back faces' polygon mode, and back faces theirs"),
};

}  // namespace

std::span<const KnownCause> geometry_causes() { return kGeometryCauses; }

}  // namespace plumbline::check
