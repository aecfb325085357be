// The scene: meshes, draws, lights, view and frame format. Plain data that knows no renderer; every renderer reads the
// same numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "scene/fragment_state.h"
#include "scene/texture.h"

namespace plumbline {

/// Conventions under which a scene's numbers are read: window origin, pixel centre, handedness, position of the eye...
/// `gl`: OpenGL. `gzrender`: CSCI-580's GzRender; world and camera space are left-handed. `games101`: GAMES101.
/// `tinyrenderer`: TinyRenderer.
enum class Dialect { gl, gzrender, games101, tinyrenderer };

/// True: row 0 is the top row of the picture.
constexpr bool rows_from_top(Dialect dialect) { return dialect == Dialect::gzrender; }

/// Kind of a mesh's primitives.
enum class Topology { triangles, lines, points };
/// Corners of one primitive: 3, 2 or 1.
constexpr std::uint32_t corner_count(Topology topology) { return 3 - static_cast<std::uint32_t>(topology); }

/// An indexed mesh in model space. Every primitive has three indices, so that loops over corners need no case: a line
/// repeats its second index, a point has three equal indices.
struct Mesh {
  std::vector<glm::vec3> positions;   ///< model space, finite
  std::vector<glm::vec3> normals;     ///< unit length, as many as positions
  std::vector<glm::vec4> colors;      ///< empty, or as many as positions: rgba, nominally [0,1]
  std::vector<glm::uvec3> triangles;  ///< primitives: indices of positions; the last corner is the provoking vertex
  Topology topology = Topology::triangles;
  std::vector<glm::vec2> texcoords{};  ///< s, t; empty, or as many as positions
};

struct Translate {
  glm::dvec3 by;
  bool operator==(const Translate&) const = default;
};
/// Rotation about `axis` (any length but 0), counter-clockwise as seen from the axis' tip.
struct Rotate {
  double degrees;
  glm::dvec3 axis;
  bool operator==(const Rotate&) const = default;
};
struct Scale {
  glm::dvec3 by;
  bool operator==(const Scale&) const = default;
};
using Transform = std::variant<Translate, Rotate, Scale>;

/// gluLookAt's camera. In `gzrender`, `eye` is c, the middle of the view plane, and `center` l.
struct Camera {
  glm::dvec3 eye{0, 0, 5};
  glm::dvec3 center{0, 0, 0};
  glm::dvec3 up{0, 1, 0};
};

/// gluPerspective; the aspect is the frame's width / height. `gl`: 0 < near < far are distances. `games101`: far < near
/// < 0 are coordinates.
struct Perspective {
  double fov_y_degrees;  ///< (0, 180)
  double near;
  double far;
};
/// glOrtho, in `gl`: near < far are distances of either sign. `games101`: near and far are coordinates, far < near.
struct Orthographic {
  double left, right, bottom, top, near, far;
};
/// glFrustum, in `gl`: left, right, bottom and top on the near plane. 0 < near < far.
struct Frustum {
  double left, right, bottom, top, near, far;
};
/// X_pi, in `gzrender`: x and y in [-1, 1] on the view plane z = 0, the eye at (0, 0, -d), 1/d = tan(fov/2).
struct ViewPlane {
  double fov_degrees;  ///< (0, 180)
};
/// w = 1 - z/c, in `tinyrenderer`: the eye is at (0, 0, c), which is Camera::eye where c = |eye - center|.
struct Pinhole {
  double c;  ///< > 0
};
using Projection = std::variant<Perspective, Orthographic, Frustum, ViewPlane, Pinhole>;

/// A point light's cone (OpenGL 2.1 spec 2.14.1: GL_SPOT_...).
struct Spot {
  glm::dvec3 direction{0, 0, -1};  ///< from the light along the cone's axis; world space, any length but 0
  double cutoff_degrees = 90;      ///< [0, 90], from the axis
  float exponent = 0;              ///< [0, 128]
};

struct Light {
  enum class Kind { directional, point };
  Kind kind = Kind::directional;
  glm::dvec3 vector{0, 0, 1};  ///< world space: direction to the light (directional; any length) or position (point)
  glm::vec3 ambient{0};
  glm::vec3 diffuse{1};
  glm::vec3 specular{1};
  glm::vec3 attenuation{1, 0, 0};  ///< of a point light: k0, k1, k2 >= 0 of 1 / (k0 + k1 d + k2 d^2); not all 0
  std::optional<Spot> spot{};      ///< of a point light; nullopt: the light shines in all directions
};

/// glLightModel, extended by the course notes' variants (`reflection`, `flip`).
struct LightModel {
  enum class Specular {
    half_vector,  ///< (N.H)^s, H halfway between light and eye: OpenGL's (Blinn)
    reflection    ///< (R.E)^s, R the light's direction mirrored at N: note 000's (Phong)
  };
  enum class Sides {
    one,  ///< both faces are lit by N
    two,  ///< back faces are lit by -N and the back material (GL_LIGHT_MODEL_TWO_SIDE)
    flip  ///< GzRender's: -N where N.L and N.E are both negative; if their signs differ, only the ambient term is left
  };
  glm::vec3 ambient{0};
  bool local_viewer = false;  ///< the eye is at eye space's origin, else infinitely far away along +z
  Specular specular = Specular::half_vector;
  Sides sides = Sides::one;
  bool separate_specular = false;  ///< the specular term is added after texturing
};

/// glMaterial.
struct Material {
  glm::vec4 ambient{0.2f, 0.2f, 0.2f, 1};
  glm::vec4 diffuse{0.8f, 0.8f, 0.8f, 1};  ///< also the colour of an unlit mesh without vertex colours
  glm::vec4 specular{0, 0, 0, 1};
  glm::vec4 emission{0, 0, 0, 1};
  float shininess = 0;  ///< [0, 128]
};

/// Material colours that the vertex colour replaces, on both faces (glColorMaterial); of a mesh without colours, none.
enum class ColorMaterial { none, ambient, diffuse, ambient_and_diffuse, specular, emission };

/// Treatment of normals in eye space (OpenGL 2.1 spec 2.11.3): brought to unit length (GL_NORMALIZE), multiplied by the
/// model-view matrix' uniform scale (GL_RESCALE_NORMAL), or neither.
enum class Normals { normalize, rescale, as_they_are };

/// Interpolation of a draw's colours. `phong`: a lit draw is lit per fragment, by the interpolated position and the
/// interpolated normal, which is normalised whatever Normals says; vertex colours are those of an unlit draw. (GLSL
/// programs, note 000.)
enum class Shading { flat, gouraud, phong };
enum class Cull { none, back, front };
enum class PolygonMode { fill, line, point };
enum class ColorFormat { rgba8, rgba12, rgba16, rgba32f };  ///< 12 bits a channel: GzRender's 0..4095 (note 000)
enum class DepthFormat { z8, z16, z24, z32f };              ///< 8 bits: tinyrenderer's z-buffer (note 002)
enum class StencilFormat { none, s8 };

/// glBlendFuncSeparate's factors. source_alpha_saturate is allowed as a source factor only.
enum class BlendFactor {
  zero,
  one,
  source_color,
  one_minus_source_color,
  destination_color,
  one_minus_destination_color,
  source_alpha,
  one_minus_source_alpha,
  destination_alpha,
  one_minus_destination_alpha,
  constant_color,
  one_minus_constant_color,
  constant_alpha,
  one_minus_constant_alpha,
  source_alpha_saturate
};
enum class BlendEquation { add, subtract, reverse_subtract, min, max };

/// (colour * factor of the source) `equation` (colour * factor of the destination); min and max ignore the factors.
struct BlendTerm {
  BlendFactor source = BlendFactor::one;
  BlendFactor destination = BlendFactor::zero;
  BlendEquation equation = BlendEquation::add;
  bool operator==(const BlendTerm&) const = default;
};
/// glBlendFuncSeparate, glBlendEquationSeparate, glBlendColor (OpenGL 2.1 spec 4.1.8).
struct Blend {
  BlendTerm rgb, alpha;
  glm::vec4 color{0};  ///< the constant colour, [0,1]
};

/// Pixels [x, x + width) x [y, y + height), rows counted as in the dialect; the box may reach beyond the frame.
struct Scissor {
  int x = 0, y = 0;           ///< [0, 16384]
  int width = 0, height = 0;  ///< [0, 16384]
  bool holds(int px, int py) const { return px >= x && px < x + width && py >= y && py < y + height; }
};

/// glFog: a fragment's colour becomes f * colour + (1 - f) * the fog's; alpha stays. f of the distance c = |z_eye|:
/// (end - c) / (end - start), exp(-density c) or exp(-(density c)^2), clamped to [0,1] (OpenGL 2.1 spec 3.10).
struct Fog {
  enum class Mode { linear, exp, exp2 };
  Mode mode = Mode::exp;
  glm::vec3 color{0};  ///< [0,1]
  float density = 1;   ///< >= 0; exp, exp2
  float start = 0;     ///< linear: start and end are distances, not equal
  float end = 1;
};

/// State of the write to the frame, after all tests.
struct Merge {
  std::optional<Blend> blend;   ///< nullopt: the colour replaces the stored one
  glm::bvec4 color_mask{true};  ///< channels that are written
  bool depth_mask = true;       ///< depth is written
  /// Logic op of colour codes, in blending's place (OpenGL 2.1 spec 4.1.10). In a float frame the colour replaces the
  /// stored one.
  std::optional<LogicOp> logic_op = std::nullopt;
};

/// One draw: a mesh, its transforms and its state. Triangles that are counter-clockwise in the window face the front.
struct Draw {
  std::uint32_t mesh = 0;                 ///< index into Scene::meshes
  std::vector<Transform> transforms;      ///< in the order of glTranslate... calls: the last acts first on a vertex
  Material material;                      ///< of both faces
  std::optional<Material> back_material;  ///< of back faces under Sides::two; nullopt: `material`
  bool lit = true;                        ///< false: the mesh's colours, or the material's diffuse
  ColorMaterial color_material = ColorMaterial::none;
  Normals normals = Normals::normalize;
  Shading shading = Shading::gouraud;
  Cull cull = Cull::none;
  /// glPolygonMode: the clipped triangle is filled, or its edges are drawn as lines, or its corners as points. All
  /// edges, those made by clipping too, are boundary edges (OpenGL 2.1 spec 3.5.4); there are no edge flags.
  PolygonMode front_mode = PolygonMode::fill, back_mode = PolygonMode::fill;
  int line_width = 1;  ///< pixels, [1, 16]
  int point_size = 1;  ///< pixels, [1, 64]: the side of a square
  DepthFunc depth_func = DepthFunc::less;
  DepthRange depth_range;
  PolygonOffset polygon_offset;
  std::optional<AlphaTest> alpha_test;
  std::optional<Stencil> stencil;  ///< only where the frame has stencil values
  std::optional<Fog> fog;
  Merge merge;
  std::optional<Scissor> scissor;      ///< pixels outside are not covered
  std::optional<DrawTexture> texture;  ///< requires texture coordinates in the mesh and both polygon modes fill
};

/// True: triangles of either facing are filled.
inline bool is_filled(const Draw& draw) {
  return draw.front_mode == PolygonMode::fill && draw.back_mode == PolygonMode::fill;
}

/// True: the draw is lit at its vertices; at its fragments.
inline bool is_lit_per_vertex(const Draw& draw) { return draw.lit && draw.shading != Shading::phong; }
inline bool is_lit_per_fragment(const Draw& draw) { return draw.lit && draw.shading == Shading::phong; }

/// Samples whose weighted mean is a pixel's colour (antialias.h); `none`: the colour at the pixel's centre.
struct Antialias {
  enum class Kind {
    none,
    multisample,  ///< OpenGL's: coverage and depth of four samples, one colour
    supersample,  ///< one picture, `factor` times as wide and as high
    taps          ///< GzRender's: six pictures, each moved by a fraction of a pixel
  };
  Kind kind = Kind::none;
  int factor = 1;  ///< of supersample, [1, 8]
};

/// State in which the passes of an antialiased scene differ.
struct Pass {
  glm::dvec2 shift{0};        ///< shift of the whole picture [pixels]
  std::optional<int> sample;  ///< OpenGL's sample [0, 3] that decides coverage and depth; colours are at the centre
};

struct FrameFormat {
  int width = 256;   ///< pixels, [1, 16384]
  int height = 256;  ///< pixels, [1, 16384]
  ColorFormat color = ColorFormat::rgba8;
  DepthFormat depth = DepthFormat::z24;
  glm::vec4 clear_color{0, 0, 0, 1};
  double clear_depth = 1;  ///< window z, [0,1]
  StencilFormat stencil = StencilFormat::none;
  std::uint8_t clear_stencil = 0;
  Antialias antialias = {};
  Pass pass = {};  ///< set by passes_of() (antialias.h)
};

struct Scene {
  std::string name;                ///< folder/file, without the ending
  std::string path;                ///< scene file; empty if the scene was made in memory
  std::vector<std::string> files;  ///< the scene file and the JSON files it includes, in the order they were read
  std::vector<std::string> notes;  ///< parts of mesh files that were left out: "file: ...", for people
  std::string description;         ///< what the picture must show, and why
  Dialect dialect = Dialect::gl;
  FrameFormat frame;
  Camera camera;
  Projection projection = Perspective{45, 1, 100};  ///< one of the dialect's
  bool depth_clamp = false;  ///< no near and far plane: depths are clamped to the draw's depth range (GL_DEPTH_CLAMP)
  LightModel light_model;
  std::vector<Light> lights;  ///< at most 8
  std::vector<Texture> textures;
  std::vector<Mesh> meshes;
  std::vector<Draw> draws;  ///< in draw order
};

/// True: a draw has a texture.
bool textured(const Scene& scene);
/// True: the frame is resolved from passes (scene/antialias.h).
bool antialiased(const Scene& scene);
/// Selector of one of a vertex' lit colours. `back`: the back face's. `secondary`: the specular term alone, which the
/// primary colour lacks under LightModel::separate_specular, and has otherwise.
struct LitPart {
  bool back = false, secondary = false;
};
/// Material of one part of a lit draw's colour. `color`: the vertex colour, which replaces the material colours of
/// Draw::color_material (OpenGL 2.1 spec 2.14.3); null: the mesh has no colours. The secondary part's alpha has no
/// meaning.
Material lit_material(const Scene& scene, const Draw& draw, LitPart part, const glm::vec4* color);

/// True: a draw may make primitives of that topology, by its mesh or by a polygon mode.
bool may_draw(const Scene& scene, Topology topology);
/// True: a pixel's colour is the last drawn fragment's: no draw has blending, a logic op or a colour mask.
inline bool colors_replace(const Scene& scene) {
  return std::all_of(scene.draws.begin(), scene.draws.end(),
                     [](const Draw& d) { return !d.merge.blend && !d.merge.logic_op && glm::all(d.merge.color_mask); });
}
/// True: every drawn fragment writes its depth: all draws set depth_mask.
inline bool depths_replace(const Scene& scene) {
  return std::all_of(scene.draws.begin(), scene.draws.end(), [](const Draw& d) { return d.merge.depth_mask; });
}

/// One draw's range in arrays of all draws' vertices and primitives, in draw order.
/// The number of a **primitive** in the scene is `first_primitive` + its index in Mesh::triangles.
struct DrawRange {
  std::uint32_t first_vertex, vertex_count;
  std::uint32_t first_primitive, primitive_count;
};

/// One range per draw.
std::vector<DrawRange> draw_ranges(const Scene& scene);
/// Overload that writes into `out`, whose memory is reused.
void draw_ranges(const Scene& scene, std::vector<DrawRange>& out);

/// The largest code of a colour channel (2^8-1, 2^12-1, 2^16-1); 0 for rgba32f.
constexpr double color_scale(ColorFormat format) {
  switch (format) {
    case ColorFormat::rgba8: return 255.0;
    case ColorFormat::rgba12: return 4095.0;
    case ColorFormat::rgba16: return 65535.0;
    case ColorFormat::rgba32f: return 0.0;
  }
  return 0.0;
}

/// The largest depth code of a unorm format (2^8-1, 2^16-1, 2^24-1); 0 for z32f.
constexpr double depth_scale(DepthFormat format) {
  switch (format) {
    case DepthFormat::z8: return 255.0;
    case DepthFormat::z16: return 65535.0;
    case DepthFormat::z24: return 16777215.0;
    case DepthFormat::z32f: return 0.0;
  }
  return 0.0;
}

/// One step of the depth format at window depth `z_win`: 1/(2^n - 1); for z32f the larger of the ULP at z_win and
/// 2^-24.
double depth_step(DepthFormat format, double z_win);

/// r of PolygonOffset, for a triangle whose largest window z is `z_max`: 2^(e - 23) for z32f, e the exponent of z_max
/// (-126 or more); for a unorm format, where OpenGL leaves r open, Mesa's two steps.
double polygon_offset_unit(DepthFormat format, double z_max);

}  // namespace plumbline
