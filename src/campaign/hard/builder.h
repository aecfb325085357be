// Builder of a hard scene: each source file of this folder adds parts of the scene.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "campaign/text/choices.h"
#include "campaign/text/json_text.h"

namespace plumbline::hard {

using campaign::Choices;
using campaign::json;
using campaign::json_array;
using campaign::json_lines;
using campaign::json_numbers;
using campaign::json_string;
using campaign::Object;

using Point = std::array<double, 3>;

/// Camera of a hard scene: maps points of the frame, at a distance from the eye, to the world.
struct View {
  Point eye{0, 0, 5}, center{}, up{0, 1, 0};
  Point right{1, 0, 0}, upward{0, 1, 0}, forward{0, 0, -1};  ///< axes of the eye, of unit length
  int width = 64, height = 64;                               ///< of the frame [pixels]
  double half_height = 0, slope = 1;  ///< of the frame at distance d: half_height + slope d [world units]
  double aspect = 1;                  ///< the frame's width by its height, in the world
  double near = 1, far = 100;         ///< distances of the planes that clip
  bool of_pixels = false;             ///< world units are pixels: x and y are window coordinates, exactly
  bool clamps = false;  ///< at() moves points into the view volume, a hundredth of its size or more from its sides

  /// World point that is seen at (x, y) [pixels from the frame's lower left corner], at this distance from the eye.
  Point at(double x, double y, double distance) const;
};

struct Builder {
  Choices choose;
  std::string dialect = "gl";
  View view;
  bool has_stencil = false;        ///< of the frame
  bool has_line_or_point = false;  ///< lines, points, or polygons drawn as such
  std::string_view color_format = "rgba8";
  bool opaque = false;     ///< alphas are 1
  bool one_color = false;  ///< meshes have no colours of their own
  Object textures;
  std::vector<std::string> texture_names;
  std::vector<bool> decal_fits;  ///< of each: decal is defined for its format

  explicit Builder(Choices choices) : choose(std::move(choices)) {}
};

/// Triangles by their corners.
struct Shape {
  std::vector<Point> positions;
  std::vector<std::array<int, 3>> triangles;
};

// The scene around the draws (view.cpp).
void choose_view(Builder& b);
Object frame(Builder& b);
Object projection(Builder& b);  ///< may move the eye
Object camera(const Builder& b);
/// A distance from the eye: mostly between near and far, at times on or beside one, behind the eye, or near zero.
double distance(Builder& b);

// Shapes (shapes.cpp).
Shape shape(Builder& b);

// Draws' meshes (meshes.cpp).
struct HardMesh {
  std::string text;
  bool textured = false;  ///< the mesh has texture coordinates
  bool line_or_point = false;
  bool made = false;  ///< by a generator of the format: about the origin, of about unit size
};
HardMesh mesh(Builder& b);
HardMesh triangles_mesh(Builder& b);  ///< no lines, no points
std::string place_made(Builder& b);   ///< transforms that bring a generator's mesh into view

// Surfaces and light (surfaces.cpp).
std::vector<double> rgb(Builder& b);
std::vector<double> rgba(Builder& b);
std::string rgba_list(Builder& b, std::size_t count);
Object material(Builder& b);
Object fog(Builder& b);
std::string lights(Builder& b);
Object light_model(Builder& b);

// Textures (textures.cpp).
void add_textures(Builder& b);
Object draw_texture(Builder& b);

// State of a draw's fragments (fragments.cpp).
void add_fragment_state(Builder& b, Object& draw);

}  // namespace plumbline::hard
