// Builder of an ordinary scene: each source file of this folder adds parts of the scene.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "campaign/text/choices.h"
#include "campaign/text/json_text.h"

namespace plumbline::ordinary {

using campaign::Choices;
using campaign::json;
using campaign::json_array;
using campaign::json_lines;
using campaign::json_numbers;
using campaign::json_string;
using campaign::Object;

struct Builder {
  Choices choose;
  std::string dialect;  ///< "gl", "gzrender", "games101", "tinyrenderer"
  double reach = 3;     ///< solids stand within +-reach of the origin in x and z; the floor is at y = -reach / 3
  bool greater_is_nearer = false;  ///< the dialect's depth buffer
  int width = 64, height = 64;     ///< pixels
  bool wants_stencil = false;      ///< a draw tests the stencil buffer
  bool has_line_or_point = false;  ///< lines or points are drawn
  bool is_lit = true;              ///< lights stand in the scene
  int texture_count = 0;
  Object textures;
  std::vector<Object> draws;

  explicit Builder(Choices choices) : choose(std::move(choices)) {}
};

// Small values.
std::vector<double> color(Builder& b);          ///< r, g, b
std::vector<double> opaque(Builder& b);         ///< r, g, b, 1
std::vector<double> see_through(Builder& b);    ///< r, g, b, alpha below 1
std::string rgba_array(Builder& b, int count);  ///< opaque colours, now and then one with alpha below 1
std::string translate(const std::vector<double>& by);
std::string scale(const std::vector<double>& by);
std::string rotate(double degrees, const std::vector<double>& axis);
/// Depth functions of the scene's dialect that pass nearer fragments, and nearer or equally near ones.
std::string_view nearer(const Builder& b);
std::string_view nearer_or_equal(const Builder& b);

// Looks (looks.cpp).
Object material(Builder& b);
Object fog(Builder& b);
/// Adds a texture to the scene and returns its name.
std::string add_texture(Builder& b);
Object draw_texture(Builder& b, const std::string& name);
/// Adds state of a solid: shading, culling, polygon modes, normals, back material.
void add_solid_state(Builder& b, Object& draw);

// Meshes (meshes.cpp).
Object floor_mesh(Builder& b, double y);
Object wall_mesh(Builder& b);
/// A solid about the origin, of about unit size.
struct Solid {
  Object mesh;
  bool textured = false;  ///< the mesh has texture coordinates
  double size = 1;        ///< half of its extent
};
Solid solid(Builder& b);
Solid model(Builder& b);
Object axes_mesh(Builder& b);
Object wire_grid_mesh(Builder& b);
Object curve_mesh(Builder& b);
Object star_mesh(Builder& b, int count);

// Opaque draws (opaque_draws.cpp): each adds one or several.
std::string place(Builder& b, const Solid& solid);  ///< transforms that place the solid on the floor
void add_floor(Builder& b);
void add_wall(Builder& b);
void add_solids(Builder& b);
void add_lines(Builder& b);
void add_points(Builder& b);
void add_triangles(Builder& b);

// Effects (effects.cpp): each adds one or several draws.
void add_wireframe(Builder& b);
void add_decal(Builder& b);
void add_glass(Builder& b);
void add_glow(Builder& b);
void add_cut_out(Builder& b);
void add_mirror(Builder& b);
void add_shadow(Builder& b);
void add_outline(Builder& b);
void add_inset(Builder& b);
void add_oddity(Builder& b);  ///< a logic op, colour mask, depth range, depth function or blend

// Frame, camera, projection and lights (view.cpp).
Object frame(Builder& b);
Object camera(Builder& b);
Object projection(Builder& b);
std::string lights(Builder& b);
Object light_model(Builder& b);

}  // namespace plumbline::ordinary
