// What to draw. Plain data that knows no renderer; every renderer reads the same numbers.
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

/// The conventions under which a scene's numbers are read: window origin, pixel centre, handedness, where the eye is...
/// `gl`: OpenGL. `gzrender`: CSCI-580's GzRender; world and camera space are left-handed. `games101`: GAMES101.
/// `tinyrenderer`: TinyRenderer.
enum class Dialect { gl, gzrender, games101, tinyrenderer };

/// Whether row 0 is the picture's uppermost.
constexpr bool rows_from_top(Dialect dialect) { return dialect == Dialect::gzrender; }

/// What a mesh is made of.
enum class Topology { triangles, lines, points };
/// How many corners a primitive has: 3, 2 or 1.
constexpr std::uint32_t corner_count(Topology topology) { return 3 - static_cast<std::uint32_t>(topology); }

/// An indexed mesh in model space. Every primitive has three indices, so that loops over corners need no case: a line
/// repeats its last, a point has three equal ones.
struct Mesh {
  std::vector<glm::vec3> positions;   ///< model space, finite
  std::vector<glm::vec3> normals;     ///< unit length, as many as positions
  std::vector<glm::vec4> colors;      ///< empty, or as many as positions: rgba, nominally [0,1]
  std::vector<glm::uvec3> triangles;  ///< indices of positions; the last corner is the provoking vertex
  Topology topology = Topology::triangles;
  std::vector<glm::vec2> texcoords{};  ///< s, t; empty, or as many as positions
};

struct Translate {
  glm::dvec3 by;
  bool operator==(const Translate&) const = default;
};
/// Counter-clockwise about `axis` (looked at from its tip), which need not be of unit length but not zero.
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
/// glOrtho; in `games101` near and far are coordinates, far < near.
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
/// w = 1 - z/c, in `tinyrenderer`: the eye at (0, 0, c); where c = |eye - center|, that is the camera's.
struct Pinhole {
  double c;  ///< > 0
};
using Projection = std::variant<Perspective, Orthographic, Frustum, ViewPlane, Pinhole>;

/// A point light's cone (OpenGL 2.1 spec 2.14.1: GL_SPOT_...).
struct Spot {
  glm::dvec3 direction{0, 0, -1};  ///< world space, of any length: where it shines to
  double cutoff_degrees = 90;      ///< [0, 90], from the axis
  float exponent = 0;              ///< [0, 128]
};

struct Light {
  enum class Kind { directional, point };
  Kind kind = Kind::directional;
  glm::dvec3 vector{0, 0, 1};  ///< world space: towards the light (directional; any length), or its place (point)
  glm::vec3 ambient{0};
  glm::vec3 diffuse{1};
  glm::vec3 specular{1};
  glm::vec3 attenuation{1, 0, 0};  ///< of a point light: k0, k1, k2 >= 0 of 1 / (k0 + k1 d + k2 d^2); not all 0
  std::optional<Spot> spot{};      ///< of a point light; without it, it shines to all sides
};

/// glLightModel, and what the course notes have in its place.
struct LightModel {
  enum class Specular {
    half_vector,  ///< (N.H)^s, H halfway between light and eye: OpenGL's (Blinn)
    reflection    ///< (R.E)^s, R the light's direction mirrored at N: note 000's (Phong)
  };
  enum class Sides {
    one,  ///< normals are as they are
    two,  ///< back faces are lit by the normal turned over, and by the back's material (GL_LIGHT_MODEL_TWO_SIDE)
    flip  ///< GzRender's: N.L and N.E both negative: N is turned over; of different signs: the light does not count
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

/// glColorMaterial, both faces: what of the material a vertex colour stands for. Where the mesh has none, nothing.
enum class ColorMaterial { none, ambient, diffuse, ambient_and_diffuse, specular, emission };

/// What becomes of normals in eye space (OpenGL 2.1 spec 2.11.3): unit length; divided by how much a uniform scale
/// lengthens them; or neither.
enum class Normals { normalize, rescale, as_they_are };

/// phong: a lit draw's fragments are lit, each at the interpolated position and normal, which is brought to unit length
/// whatever Normals says; its vertices have the colours that they would have unlit. (GLSL programs, note 000.)
enum class Shading { flat, gouraud, phong };
enum class Cull { none, back, front };
enum class PolygonMode { fill, line, point };
enum class ColorFormat { rgba8, rgba12, rgba16, rgba32f };  ///< 12 bits a channel: GzRender's 0..4095 (note 000)
enum class DepthFormat { z8, z16, z24, z32f };              ///< 8 bits: tinyrenderer's z-buffer (note 002)
enum class StencilFormat { none, s8 };

/// glBlendFuncSeparate's factors. As a destination's, source_alpha_saturate is not allowed.
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

/// source * its factor (equation) destination * its factor; min and max are of the two without factors.
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

/// Pixels [x, x + width) x [y, y + height), rows counted as the dialect's; it may reach beyond the frame.
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
  float start = 0;     ///< distances, not equal; linear
  float end = 1;
};

/// How a fragment that is drawn goes into the frame.
struct Merge {
  std::optional<Blend> blend;   ///< none: it replaces what is there
  glm::bvec4 color_mask{true};  ///< channels that are written
  bool depth_mask = true;       ///< whether its depth is written
  /// Logic op of colour codes, in blending's place (OpenGL 2.1 spec 4.1.10). In a float frame the colour replaces what
  /// is stored.
  std::optional<LogicOp> logic_op = std::nullopt;
};

/// A mesh, placed, with the state it is drawn under. Counter-clockwise in the window is the front.
struct Draw {
  std::uint32_t mesh = 0;                 ///< index into Scene::meshes
  std::vector<Transform> transforms;      ///< in the order written, as glTranslate... would be: the last acts first
  Material material;                      ///< of both faces
  std::optional<Material> back_material;  ///< of back faces, where there is one and light has two sides
  bool lit = true;                        ///< false: the mesh's colours, or the material's diffuse
  ColorMaterial color_material = ColorMaterial::none;
  Normals normals = Normals::normalize;
  Shading shading = Shading::gouraud;
  Cull cull = Cull::none;
  /// glPolygonMode: what is left of a triangle after clipping is filled, or its edges are drawn as lines, or its
  /// corners as points. All are boundary edges (OpenGL 2.1 spec 3.5.4), those that clipping makes too; there are no
  /// edge flags.
  PolygonMode front_mode = PolygonMode::fill, back_mode = PolygonMode::fill;
  int line_width = 1;  ///< pixels, [1, 16]
  int point_size = 1;  ///< pixels, [1, 64]: the side of a square
  DepthFunc depth_func = DepthFunc::less;
  DepthRange depth_range;
  PolygonOffset polygon_offset;
  std::optional<AlphaTest> alpha_test;
  std::optional<Stencil> stencil;  ///< in a frame that has stencil values
  std::optional<Fog> fog;
  Merge merge;
  std::optional<Scissor> scissor;      ///< no pixel outside of it is covered
  std::optional<DrawTexture> texture;  ///< the mesh then has texture coordinates
};

/// Where light falls: on the vertices, or on the fragments.
inline bool is_lit_per_vertex(const Draw& draw) { return draw.lit && draw.shading != Shading::phong; }
inline bool is_lit_per_fragment(const Draw& draw) { return draw.lit && draw.shading == Shading::phong; }

/// Samples that a pixel's colour is the mean of (antialias.h); `none`: the colour at the pixel's centre.
struct Antialias {
  enum class Kind {
    none,
    multisample,  ///< OpenGL's: coverage and depth of four samples, one colour
    supersample,  ///< a frame `factor` times as wide and as high
    taps          ///< GzRender's: six pictures, each moved by part of a pixel
  };
  Kind kind = Kind::none;
  int factor = 1;  ///< of supersample, [1, 8]
};

/// What an antialiased scene's passes differ by.
struct Pass {
  glm::dvec2 shift{0};        ///< of the whole picture, in pixels of the window
  std::optional<int> sample;  ///< coverage and depth are those of OpenGL's sample 0 to 3, colours the pixel centre's
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
  Pass pass = {};  ///< as passes_of() sets it (antialias.h)
};

struct Scene {
  std::string name;                ///< group/file, without the ending
  std::string path;                ///< the file it was read from, empty if made in memory
  std::vector<std::string> files;  ///< of JSON, that it was read from: that and what it includes, as they were read
  std::vector<std::string> notes;  ///< what of its mesh files is left out: "file: ...", for people
  std::string description;         ///< what must be seen, and why
  Dialect dialect = Dialect::gl;
  FrameFormat frame;
  Camera camera;
  Projection projection = Perspective{45, 1, 100};  ///< one of the dialect's
  bool depth_clamp = false;  ///< no near and far plane: depths beyond are clamped to the draw's range (GL_DEPTH_CLAMP)
  LightModel light_model;
  std::vector<Light> lights;  ///< at most 8
  std::vector<Texture> textures;
  std::vector<Mesh> meshes;
  std::vector<Draw> draws;  ///< in draw order
};

/// Whether any draw has a texture.
inline bool textured(const Scene& scene) {
  return std::any_of(scene.draws.begin(), scene.draws.end(), [](const Draw& d) { return d.texture.has_value(); });
}
/// One of the colours that light gives a vertex: of the front or the back, and the specular term alone, or what is left
/// without it. Where the light model keeps nothing apart, the front's is all.
struct LitPart {
  bool back = false, secondary = false;
};
/// The material that makes that part of a lit draw's colour, what the vertex colour stands for replaced by it (OpenGL
/// 2.1 spec 2.14.3); null: the mesh has none. Of the secondary part, alpha means nothing.
Material lit_material(const Scene& scene, const Draw& draw, LitPart part, const glm::vec4* color);

/// Whether any draw makes primitives of that topology, by its mesh or by its polygon modes.
bool draws(const Scene& scene, Topology topology);
/// Whether a pixel's colour is that of its last fragment alone: nothing is blended, combined or masked.
inline bool colors_replace(const Scene& scene) {
  return std::all_of(scene.draws.begin(), scene.draws.end(),
                     [](const Draw& d) { return !d.merge.blend && !d.merge.logic_op && glm::all(d.merge.color_mask); });
}
/// Whether every fragment that is drawn leaves its depth.
inline bool depths_replace(const Scene& scene) {
  return std::all_of(scene.draws.begin(), scene.draws.end(), [](const Draw& d) { return d.merge.depth_mask; });
}

/// Where one draw's vertices and triangles lie in arrays that run over all draws, in draw order.
/// A **primitive** is numbered so, over the whole scene: `first_primitive + index of the mesh's triangle` (line,
/// point).
struct DrawRange {
  std::uint32_t first_vertex, vertex_count;
  std::uint32_t first_primitive, primitive_count;
};

/// One range per draw.
std::vector<DrawRange> draw_ranges(const Scene& scene);
/// The same in memory that is kept.
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

/// One step of the depth format at window depth z: 1/(2^n - 1); for z32f the larger of z's ULP and 2^-24.
double depth_step(DepthFormat format, double z_win);

/// r of a triangle whose largest window z is `z_max` (PolygonOffset), as Mesa has it where OpenGL leaves it open: two
/// steps of a unorm format; of float 2^(e - 23), e the exponent of z_max.
double polygon_offset_unit(DepthFormat format, double z_max);

}  // namespace plumbline
