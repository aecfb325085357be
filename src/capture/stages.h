// The map: what each stage of the pipeline hands on to the next, in the order in which the data flows.
//
// Every renderer speaks in these records. The pipeline holds them in float; captures, and the exact reference, hold
// them in double (float to double loses nothing). The space of a position is the suffix of its name:
//   p_model  model space          p_clip  clip space, before the division: inside is -w <= x, y, z <= w
//   p_eye    eye space, right-handed, looking down -z
//   p_win    window space: x, y in pixels from the lower left corner, centres at half-integers; z in [0,1], 0 near
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "capture/varying.h"

namespace plumbline {

enum class Stage {
  matrices,
  vertex,
  light,
  clip,
  window,
  coverage,
  depth,
  attributes,
  texture,
  shade,
  visibility,
  merge,
  resolve
};
/// A set of stages.
class StageSet {
 public:
  constexpr StageSet() = default;
  constexpr StageSet(std::initializer_list<Stage> stages) {
    for (Stage s : stages) add(s);
  }
  static constexpr StageSet all();
  constexpr void add(Stage s) { bits_ |= 1u << static_cast<unsigned>(s); }
  constexpr bool has(Stage s) const { return (bits_ >> static_cast<unsigned>(s) & 1u) != 0; }
  constexpr bool any() const { return bits_ != 0; }
  constexpr bool operator==(const StageSet&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

struct Scene;
bool textured(const Scene& scene);
bool antialiased(const Scene& scene);

/// Owner of a record. Stages of pixels hand on planes alone.
enum class Per { light, draw, vertex, clip_vertex, polygon, triangle, fragment, pixel };

struct StageRow {
  std::string_view name;
  Per per;
  StageSet inputs;                           ///< stages whose records it reads
  bool (*in_scene)(const Scene&) = nullptr;  ///< whether a scene has the stage; null: every scene has
};
/// The table of the stages, in order.
inline constexpr std::array<StageRow, 13> kStages = [] {
  using enum Stage;
  return std::array<StageRow, 13>{{{"matrices", Per::draw, {}},
                                   {"vertex", Per::vertex, {matrices}},
                                   {"light", Per::vertex, {matrices, vertex}},
                                   {"clip", Per::polygon, {vertex, light}},
                                   {"window", Per::triangle, {matrices, clip}},
                                   {"coverage", Per::fragment, {window}},
                                   {"depth", Per::fragment, {window, coverage}},
                                   {"attributes", Per::fragment, {window, coverage}},
                                   {"texture", Per::fragment, {window, coverage, attributes}, textured},
                                   {"shade", Per::fragment, {matrices, window, coverage, attributes, texture}},
                                   {"visibility", Per::fragment, {window, coverage, depth, shade}},
                                   {"merge", Per::pixel, {window, coverage, depth, shade}},
                                   {"resolve", Per::pixel, {merge}, antialiased}}};
}();
constexpr const StageRow& row_of(Stage stage) { return kStages[static_cast<std::size_t>(stage)]; }
constexpr std::string_view name_of(Stage stage) { return row_of(stage).name; }
constexpr Per per(Stage stage) { return row_of(stage).per; }
constexpr StageSet inputs_of(Stage stage) { return row_of(stage).inputs; }
inline bool has_stage(const Scene& scene, Stage stage) {
  return row_of(stage).in_scene == nullptr || row_of(stage).in_scene(scene);
}

inline constexpr std::array<std::string_view, kStages.size()> kStageNames = [] {
  std::array<std::string_view, kStages.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kStages[i].name;
  return names;
}();
/// Every stage, in order.
inline constexpr std::array<Stage, kStages.size()> kAllStages = [] {
  std::array<Stage, kStages.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Stage>(i);
  return all;
}();
constexpr StageSet StageSet::all() {
  StageSet set;
  for (const Stage stage : kAllStages) set.add(stage);
  return set;
}
constexpr StageSet stages_where(auto holds) {
  StageSet set;
  for (const Stage stage : kAllStages) {
    if (holds(row_of(stage))) set.add(stage);
  }
  return set;
}
/// Stages before there are fragments, and those whose records are fragments'.
inline constexpr StageSet kGeometryStages = stages_where([](const StageRow& row) { return row.per < Per::fragment; });
inline constexpr StageSet kFragmentStages = stages_where([](const StageRow& row) { return row.per == Per::fragment; });

template <class T>
using Vec2 = glm::vec<2, T>;
template <class T>
using Vec3 = glm::vec<3, T>;
template <class T>
using Vec4 = glm::vec<4, T>;
template <class T>
using Mat3 = glm::mat<3, 3, T>;
template <class T>
using Mat4 = glm::mat<4, 4, T>;

// 0. A draw's transforms become matrices (column vectors, GLM's column-major storage), built in double and rounded
//    once to float, entries below 1e-12 to 0.
template <class T>
struct Matrices {
  Mat4<T> model_view;  ///< p_eye = model_view * p_model
  Mat4<T> projection;  ///< p_clip = projection * p_eye
  Mat3<T> normal;      ///< inverse transpose of model_view's upper 3x3
  Vec3<T> win_scale;   ///< p_win = p_ndc * win_scale + win_translate
  Vec3<T> win_translate;
};
//    The camera takes the scene's lights to eye space, too: built in double, rounded once to float.
template <class T>
struct LightSource {
  Vec4<T> p_eye;     ///< a point light's place, w = 1; of a directional light the direction towards it, w = 0
  Vec3<T> spot_eye;  ///< direction in which a spot light shines, as long as the scene's; 0 of any other light
};

// 1. Each vertex of the mesh is transformed, once.
template <class T>
struct Vertex {
  Vec4<T> p_eye;
  Vec4<T> p_clip;
  Vec3<T> n_eye;  ///< unit length, unless the draw has it otherwise (scene.h, Normals)
};

// 2. Each vertex is lit (or takes its own colour): rgba clamped to [0,1], as GL clamps vertex colours. Varyings
//    (varying.h) are stored beside the colour; from here on they are clipped and interpolated as it is.
template <class T>
struct Lit {
  Vec4<T> color;
};

// 3. Each triangle is assembled (flat shading: every corner takes the provoking vertex' colour) and cut at the six
//    planes of the view volume to a convex polygon; one that lies outside leaves none. A line is cut to a line, a point
//    is kept or not: polygons of 2 vertices, and of 1.
template <class T>
struct ClipVertex {
  Vec4<T> p_clip;
  Vec4<T> color;
  bool cut;  ///< made by a cut, not a vertex of the mesh
};
struct ClipPolygon {
  std::uint32_t primitive;  ///< numbered over the scene (scene.h, DrawRange)
  std::uint32_t first;      ///< index of its first vertex
  std::uint32_t count;      ///< 3 to 9, up to kMostPolygonVertices by rounding; of a line 2, of a point 1
};
/// Six planes cut a triangle to 9 vertices. With rounding, to no more than these (pipeline/clip.cpp).
inline constexpr std::uint32_t kMostPolygonVertices = 28;
template <class T>
struct ClipPolygons {
  std::vector<ClipVertex<T>> vertices;
  std::vector<ClipPolygon> polygons;  ///< in draw order
};

// 4. Each polygon is divided by w, moved to the window, and becomes a fan of triangles: corners (i-1, i, 0). Positions
//    are snapped to 1/256 pixel; facing is the sign of the snapped area. Culled triangles and those of zero snapped
//    area are gone. A line is a degenerate triangle whose last corner is repeated, a point one of three equal corners;
//    they face the front, and none is culled. A polygon that is not filled (scene.h, PolygonMode) becomes its edges,
//    beginning with the edge that ends in its first corner, or its corners. The sign of the whole polygon's snapped
//    area (0: back) decides facing, and with it mode and culling; the edges or corners keep this facing.
inline constexpr int kSubpixel = 256;
template <class T>
struct WindowVertex {
  Vec3<T> p_win;
  T inv_w;             ///< 1 / w_clip
  glm::ivec2 snapped;  ///< round_half_even((p_win - 1/2) * 256): pixel (i, j)'s centre is (256 i, 256 j)
  Vec4<T> color;
};
template <class T>
struct WindowTriangle {
  std::array<WindowVertex<T>, 3> v;
  std::uint32_t primitive;
  bool front;                 ///< counter-clockwise in the window
  std::uint32_t corners = 3;  ///< 2 of a line, 1 of a point
  std::uint32_t width = 1;    ///< pixels: of a line, or the side of a point's square
};

// 5. Each triangle covers the pixels whose centres are inside its snapped edges, or on an edge that rule left_bottom
//    gives to it: one whose interior lies to its right (+x), or, if it is horizontal, above (+y). A line covers the
//    pixels that the diamond-exit rule names, a point the pixel that it lies in (OpenGL 2.1, sections 3.4.1 and 3.3). A
//    wide line is moved by (width - 1) / 2 down its minor axis, and each of its pixels is one of `width` in a column
//    (y-major: a row); a wide point is the square of pixels about the centre (odd) or corner (even) of pixels that is
//    nearest (3.4.2, 3.3).
struct Covered {
  std::uint32_t triangle;  ///< index into the window triangles
  std::uint16_t x, y;      ///< pixel
};
/// Key that sorts fragments: by triangle, from the lowest row, from the left.
inline auto draw_order(const Covered& c) { return std::tuple(c.triangle, c.y, c.x); }

// 6. Each covered pixel (a fragment from here on) gets its depth: the plane through p_win at the centre, clamped to
//    [0,1], in the frame's depth format: window z, n-bit codes as code / (2^n - 1). A plain number per fragment.
//    Along a line, z and attributes go by the projection of the centre onto it; a point has its own.

// 7. Attributes, perspective-correct: the colour, and each varying that the draw carries.
template <class T>
struct Attributes {
  Vec4<T> color;
};

// 8. The texture, filtered at the fragment: source components (Cs, As) of OpenGL 2.1's table 3.21, and the level of
//    detail lambda, bias and limits applied. (0, 0, 0, 1) and 0 where the draw has no texture.
template <class T>
struct Texel {
  Vec4<T> color{0, 0, 0, 1};
  T lod = 0;
};

// 9. The fragment's colour, not yet clamped or rounded to the frame's format.
template <class T>
struct Shaded {
  Vec4<T> color;
};

// 10. Visibility: the fragments that pass every test, in draw order at each pixel; the last of them is the winner
//     (capture.h, planes.id).
struct Drawn {
  bool drawn;
};

// 11. The fragments drawn are merged, in draw order, into the frame: planes of final colour and depth (capture.h).

// 12. An antialiased scene goes through stages 0 to 11 in passes, each of them a scene of its own; their frames are
//     resolved: each pixel's colour is the mean of its samples' (scene/antialias.h).

/// What stages 0 to 10 hand on for a whole scene. Empty: not asked for, or not shown.
template <class T>
struct Records {
  std::vector<Matrices<T>> matrices;         ///< per draw
  std::vector<LightSource<T>> lights;        ///< of the scene, in its order; stage 0 hands them on beside matrices
  std::vector<Vertex<T>> vertices;           ///< all draws' vertices, in draw order (scene.h, DrawRange)
  std::vector<Lit<T>> lit;                   ///< beside vertices
  ClipPolygons<T> polygons;                  ///< of the primitives that are not wholly outside
  std::vector<WindowTriangle<T>> triangles;  ///< in draw order
  std::vector<Covered> covered;              ///< by triangle, then y, then x: the fragments
  std::vector<T> depth;                      ///< beside covered
  std::vector<Attributes<T>> attributes;     ///< beside covered
  std::vector<Texel<T>> texels;              ///< beside covered; empty where no draw has a texture
  std::vector<Shaded<T>> shaded;             ///< beside covered
  std::vector<Drawn> drawn;                  ///< beside covered
  Varyings<T> varyings;                      ///< beside them all
};

}  // namespace plumbline
