// Scenes from JSON files.
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

#include "scene/scene.h"

namespace plumbline {

/// The message is: file: at "JSON pointer": expected ..., found ...
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SceneFileOptions {
  /// Where mesh files are looked for, after the scene's own folder; by default where the build was told.
  std::vector<std::filesystem::path> asset_folders = {PLUMBLINE_ASSETS};
};

/// Reads a scene: one JSON object (comments allowed). Every key but those marked * may be left out and then has
/// scene.h's default; nothing else may be in the file. Editors find the same in tests/scenes/scene.schema.json.
///
///   $schema        the schema's place, for editors
///   include        files that this one builds on, below
///   description *  what must be seen, and why
///   dialect        "gl", "gzrender", "games101", "tinyrenderer": how all other numbers are read (dialect/dialect.h)
///   frame          width, height: 1 to 16384; color: "rgba8", "rgba12", "rgba16", "rgba32f"; depth: "z8", "z16",
///                  "z24", "z32f"; clear_color: [r, g, b, a]; clear_depth; stencil: "none", "s8"; clear_stencil;
///                  antialias: {"samples": 4}, {"supersample": 1 to 8} or {"taps": "gzrender"} (antialias.h)
///   camera         eye, center, up: [x, y, z]
///   projection     gl            {"perspective": {fov_y *: degrees, near *, far *}}, {"orthographic": {left *,
///                                right *, bottom *, top *, near *, far *}} or {"frustum": {the same six, the sides
///                                on the near plane}}
///                  games101      perspective or orthographic, near and far being z coordinates: far < near < 0
///                  gzrender      {"x_pi": {fov *: degrees}}
///                  tinyrenderer  {"pinhole": {c: the distance of eye and center where it is not given}}
///   ambient        [r, g, b], the light model's
///   light_model    local_viewer: true, false; specular: "half_vector", "reflection"; sides: "one", "two",
///                  "flip"; separate_specular: true, false (LightModel)
///   lights         up to 8 of {"directional": [x, y, z] or "point": [x, y, z], ambient, diffuse, specular: [r, g, b]};
///                  beside point attenuation: [k0, k1, k2] and spot: {direction *: [x, y, z], cutoff *: degrees from 0
///                  to 90, exponent: 0 to 128}
///   textures       {name: {image *, format, texels, min, mag, wrap_s, wrap_t, border, lod_bias, min_lod, max_lod,
///                  base_level, max_level}}, at most 64 (texture.h; what is left out has OpenGL's initial value)
///     image *      one of  "file": "wood.png", a PNG, JPEG, TGA or EXR file (texture_file.h)
///                          "texels": rows of [r, g, b, a], the first at t = 0
///                          "checker": {width, height, columns, rows, colors: 2 x [r, g, b, a]}, "bricks": the same
///                          "gradient": {width, height, colors: at 4 corners}, "uv_grid": {width, height, columns,
///                          rows}, "noise": {width, height, seed}                           (texture_images.h)
///     format       "alpha", "luminance", "luminance_alpha", "intensity", "rgb", "rgba"; else the file's, or rgba
///     texels       "unorm8", "float32"
///     min, mag     OpenGL's filters, wrap_s and wrap_t its wraps: names of MinFilter, MagFilter, Wrap
///     border       [r, g, b, a]
///   defaults       of all draws: any of a draw's keys but mesh. A draw's own count before them, of a material key by
///                  key
///   draws *        1 to 4096 of
///     mesh *       one of  "file": "bunny.obj", an OBJ, 3DS, PLY, glTF or GLB file (mesh_file.h)
///                          "triangle": {positions *: [[x, y, z] x 3], colors: [[r, g, b, a] x 3],
///                          texcoords: [[s, t] x 3]}
///                          "triangles": {positions *, indices *: [[i, j, k], ...], normals: of unit length, else
///                          area-weighted; colors, texcoords}
///                          "lines": {positions *, indices *: [[i, j], ...], colors}
///                          "points": {positions *, colors}: each a point; normals of both are +z
///                          "quad": {positions: [[x, y, z] x 4], else the square of grid; colors; texcoords, else
///                          the unit square's}
///                          "grid": {columns *, rows *}, "uv_sphere" and "globe": {slices *, stacks *}
///                          (mesh_shapes.h)
///                          "soup": {triangles *, seed *, extent *, size *}
///                          "cube": {}, "icosphere": {subdivisions *: 0 to 8}                (mesh_solids.h)
///                          "torus_knot": {segments *, sides *, p, q, tube}
///                          "revolution": {profile *: [[radius, y] x (3 n + 1)], Bézier curves; steps *, slices *}
///     transforms   a list of {"translate": [x, y, z]}, {"rotate": {degrees *, axis *: [x, y, z]}},
///                  {"scale": [x, y, z]}
///     material     ambient, diffuse, specular, emission: [r, g, b, a]; shininess: 0 to 128. Where neither the draw nor
///                  the defaults have one, a mesh file's materials count; a file of several becomes several draws
///     back_material  likewise, of back faces where light has two sides; without it, they have material's
///     lit          true, false
///     color_material  "none", "ambient", "diffuse", "ambient_and_diffuse", "specular", "emission": what of the
///                  material is the mesh's colours, where it has some
///     normals      "normalize", "rescale", "as_they_are"
///     shading      "flat", "gouraud", "phong"
///     fog          {"linear": {color: [r, g, b], start *, end *}}, or "exp" or "exp2": {color, density *}: of eye
///                  distances
///     cull         "none", "back", "front"
///     depth_func   "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always". Where
///                  nothing is said: what is nearer, which in games101 and tinyrenderer is "greater"; and clear_depth
///                  is then 0
///     depth_range  [near, far]: the window z of the near and the far plane; [0, 1]
///     polygon_offset  {factor, units}
///     alpha_test   {func *: one of depth_func's, reference: [0, 1]}
///     stencil      {func, reference, mask, fail, depth_fail, pass, write_mask, back: {the same, of back faces}}:
///                  numbers from 0 to 255, and OpenGL's ops (all names: StencilOp); the frame needs stencil "s8"
///     front_mode, back_mode  "fill", "line", "point": what is drawn of front and back faces
///     line_width   pixels, an integer from 1 to 16
///     point_size   pixels a side, an integer from 1 to 64
///     scissor      [x, y, width, height]: the pixels that may be covered; 0 to 16384 each
///     depth_mask   true, false: whether depth is written
///     blend        {source, destination, equation, alpha: {source, destination, equation}, color: [r, g, b, a]}:
///                  OpenGL's factors ("one" and "zero" where they are left out) and equations ("add", "subtract",
///                  "reverse_subtract", "min", "max"), alpha's as rgb's where it has none. All names: BlendFactor
///     logic_op     one of OpenGL's 16 (LogicOp; "and", "xor" ...)
///     color_mask   [r, g, b, a], each true or false: whether it is written
///     texture      {name *: one of the textures, environment: "replace", "modulate", "decal", "blend", "add", color:
///                  blend's [r, g, b, a]}; the mesh needs texture coordinates: "texcoords": [[s, t], ...] beside
///                  positions, a file's own, or those of quad, grid, cube and globe
///
/// Colours are in [0,1], lights' and ambient 0 or more. Coordinates go up to +-1e6, all draws' triangles to 2^24.
/// Numbers that scene.h holds as float are rounded here, once. Draws of an equal mesh share it.
///
/// What a file says is a patch of what it includes (RFC 7396, JSON merge patch; scene_json.h): objects are merged key
/// by key, null takes a key away, everything else, arrays too, is replaced. Parts that are no scenes are called
/// *.part.json. Names of meshes and included files are looked for in the scene's folder, then in the asset folders.
/// They may lead into these and below, and nowhere else, whatever links and ".." they go through.
///
/// The scene's name is "folder/file", without the ending. Throws SceneError.
Scene load_scene(const std::filesystem::path& file, const SceneFileOptions& options = {});

/// The scene files that `paths` name: files as they are; of folders all *.json in them and below, sorted, but for
/// *.part.json (what scenes include) and *.schema.json.
/// Throws SceneError if a path does not exist, or nothing is found.
std::vector<std::filesystem::path> find_scenes(std::span<const std::filesystem::path> paths);

}  // namespace plumbline
