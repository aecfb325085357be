// Draws that nothing is seen through, and the state of lines and points.
#include <fmt/format.h>

#include "campaign/ordinary/builder.h"

namespace plumbline::ordinary {
namespace {

void maybe_texture(Builder& b, Object& draw, int percent) {
  if (b.choose.chance(percent)) draw.put("texture", draw_texture(b, add_texture(b)));
}

void maybe_material(Builder& b, Object& draw) {
  if (b.choose.chance(80)) draw.put("material", material(b));
}

// State of lines and points: mostly unlit, in colours of their own.
void add_line_or_point_state(Builder& b, Object& draw) {
  b.has_line_or_point = true;
  draw.put("lit", b.choose.chance(92) ? "false" : "true");
  if (b.choose.chance(60)) draw.put("material", Object("diffuse", json_numbers(opaque(b))).text());
}

}  // namespace

std::string place(Builder& b, const Solid& solid) {
  Choices& c = b.choose;
  std::vector<std::string> out;
  const double size = b.reach / 3 * c.of({0.5, 0.5, 0.75, 1, 1, 1, c.number(0.2, 1.5)}) / solid.size;
  const double on_floor = c.chance(40) ? size - b.reach / 3 : c.number(-0.5, 1) * b.reach / 3;
  if (c.chance(80)) out.push_back(translate({c.number(-0.8, 0.8) * b.reach, on_floor, c.number(-0.8, 0.8) * b.reach}));
  if (c.chance(45)) {
    const std::vector<double> axis =
        c.chance(60) ? std::vector<double>{0, 1, 0} : std::vector<double>{c.of({0, 1, 1}), 1, c.of({0, 1, 0.5})};
    out.push_back(rotate(c.of({15, 20, 30, 45, 45, 60, 90, 120, -30, c.number(-180, 180)}), axis));
  }
  if (size != 1 || c.chance(10)) {
    const bool even = c.chance(80);
    out.push_back(even ? scale({size, size, size})
                       : scale({size, size * c.of({0.5, 1.5, 2, -1}), size * c.of({0.5, 1, 0.2})}));
  }
  return json_array(out);
}

void add_floor(Builder& b) {
  const double y = -b.reach / 3;
  Object draw;
  const Object mesh = floor_mesh(b, y);
  draw.put("mesh", mesh);
  if (mesh.has("grid")) {
    const double r = b.reach * b.choose.of({1, 1.5, 2, 4});
    draw.put("transforms", json_array({translate({0, y, 0}), rotate(-90, {1, 0, 0}), scale({r, r, 1})}));
  }
  maybe_texture(b, draw, 60);
  maybe_material(b, draw);
  if (b.choose.chance(30)) draw.put("lit", "false");
  if (b.choose.chance(8)) draw.put_word("shading", b.choose.word({"flat", "phong"}));
  b.draws.push_back(draw);
}

void add_wall(Builder& b) {
  Object draw("mesh", wall_mesh(b).text());
  maybe_texture(b, draw, 55);
  maybe_material(b, draw);
  if (b.choose.chance(40)) draw.put("lit", "false");
  b.draws.push_back(draw);
}

void add_solids(Builder& b) {
  Choices& c = b.choose;
  const int kinds = static_cast<int>(c.of({1, 1, 1, 2, 2, 3}));
  for (int i = 0; i < kinds; ++i) {
    const Solid what = c.chance(5) ? model(b) : solid(b);
    const int instances = static_cast<int>(c.of({1, 1, 1, 1, 1, 2, 3}));
    for (int j = 0; j < instances; ++j) {
      Object draw("mesh", what.mesh.text());
      draw.put("transforms", place(b, what));
      if (what.textured) maybe_texture(b, draw, 50);
      maybe_material(b, draw);
      add_solid_state(b, draw);
      b.draws.push_back(draw);
    }
  }
}

void add_lines(Builder& b) {
  const std::string_view kind = b.choose.word({"axes", "axes", "grid", "curve"});
  Object draw("mesh", (kind == "axes" ? axes_mesh(b) : kind == "grid" ? wire_grid_mesh(b) : curve_mesh(b)).text());
  add_line_or_point_state(b, draw);
  if (b.choose.chance(35)) draw.put("line_width", b.choose.of({1, 2, 2, 3, 3, 4, 5, 8}));
  b.draws.push_back(draw);
}

void add_points(Builder& b) {
  Object draw("mesh", star_mesh(b, b.choose.count(1, 40)).text());
  add_line_or_point_state(b, draw);
  if (b.choose.chance(60)) draw.put("point_size", b.choose.of({1, 2, 2, 3, 4, 5, 8, 10}));
  b.draws.push_back(draw);
}

// The first triangle of every course, or a few of them; sometimes strewn about.
void add_triangles(Builder& b) {
  Choices& c = b.choose;
  Object draw;
  if (c.chance(20)) {
    Object soup;
    soup.put("triangles", c.count(3, 40)).put("seed", c.count(1, 999));
    soup.put("extent", b.reach * 0.6).put("size", b.reach * c.of({0.1, 0.2, 0.3}));
    draw.put("mesh", Object("soup", soup.text()));
  } else {
    const bool textbook = c.chance(40);
    std::vector<std::string> corners;
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {0.0, 1.0}}) {
      const double r = b.reach / 2;
      corners.push_back(
          textbook ? json_numbers({x, y, 0})
                   : json_numbers({(x + c.number(-0.5, 0.5)) * r, (y + c.number(-0.5, 0.5)) * r, c.number(-1, 1) * r}));
    }
    Object triangle("positions", json_array(corners));
    if (c.chance(30)) {
      triangle.put("colors", "[[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]]");
    } else if (c.chance(50)) {
      triangle.put("colors", rgba_array(b, 3));
    }
    const bool textured = c.chance(30);
    if (textured) triangle.put("texcoords", "[[0, 0], [1, 0], [0.5, 1]]");
    draw.put("mesh", Object("triangle", triangle.text()));
    if (textured) draw.put("texture", draw_texture(b, add_texture(b)));
  }
  if (c.chance(60)) draw.put("lit", "false");
  if (c.chance(20))
    draw.put("color_material",
             json_string(c.word({"ambient_and_diffuse", "diffuse", "ambient", "emission", "specular"})));
  add_solid_state(b, draw);
  b.draws.push_back(draw);
}

}  // namespace plumbline::ordinary
