// Meshes written out, with normals, colours and texture coordinates of their own; meshes of the format's generators.
#include <algorithm>

#include "campaign/hard/builder.h"

namespace plumbline::hard {
namespace {

std::string points_text(const std::vector<Point>& positions) {
  std::vector<std::string> out;
  for (const Point& p : positions) out.push_back(json_numbers({p[0], p[1], p[2]}));
  return json_array(out);
}

// Normals of unit length, exactly or to nine digits.
std::string normals_text(Builder& b, std::size_t count) {
  static constexpr std::array<Point, 8> kNormals = {{{0, 0, 1},
                                                     {0, 0, -1},
                                                     {0, 1, 0},
                                                     {1, 0, 0},
                                                     {0.6, 0, 0.8},
                                                     {-0.6, 0.8, 0},
                                                     {0.48, 0.6, 0.64},
                                                     {0.577350269, 0.577350269, 0.577350269}}};
  std::vector<Point> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(kNormals[static_cast<std::size_t>(b.choose.count(0, 7))]);
  return points_text(out);
}

// Texture coordinates at texels' borders and centres, equal at all corners, stretched far, or compressed.
std::string texcoords_text(Builder& b, std::size_t count) {
  Choices& c = b.choose;
  const double parts = c.of({1, 2, 8, 16, 64}), times = c.of({0, 0.01, 1, 1, 2, 16, 200}),
               aside = c.of({0, 0, 0.5, -3, 100});
  std::vector<std::string> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = c.count(0, static_cast<int>(parts)) / parts, t = c.count(0, static_cast<int>(parts)) / parts;
    out.push_back(json_numbers({s * times + aside, t * times + aside}));
  }
  return json_array(out);
}

HardMesh written_out(Builder& b) {
  Choices& c = b.choose;
  const Shape of = shape(b);
  const std::size_t n = of.positions.size();
  std::vector<std::string> indices;
  for (const auto& t : of.triangles) indices.push_back(json_numbers({1.0 * t[0], 1.0 * t[1], 1.0 * t[2]}));
  const bool alone = n == 3 && of.triangles.size() == 1 && c.chance(50);
  Object out("positions", points_text(of.positions));
  if (!alone) out.put("indices", json_array(indices));
  if (!alone && c.chance(50)) out.put("normals", normals_text(b, n));
  if (!b.one_color && c.chance(60)) out.put("colors", rgba_list(b, n));
  const bool textured = c.chance(40);
  if (textured) out.put("texcoords", texcoords_text(b, n));
  return {Object(alone ? "triangle" : "triangles", out.text()).text(), textured};
}

// A rectangle parallel to the picture, from half to twice the frame's size, or a unit quad.
HardMesh quad(Builder& b) {
  Choices& c = b.choose;
  Object out;
  const bool unit = c.chance(30) && !b.view.clamps;
  if (!unit) {
    const double w = b.view.width, h = b.view.height, x0 = w * c.of({0, 0.25, -0.5}), x1 = w * c.of({1, 0.75, 1.5}),
                 y0 = h * c.of({0, 0.25, -0.5}), y1 = h * c.of({1, 0.75, 1.5});
    const double usual = std::min(b.view.near + 2, (b.view.near + b.view.far) / 2);
    const double d = c.chance(70) ? usual : std::clamp(distance(b), 0.01, 1000.0);
    out.put("positions",
            points_text({b.view.at(x0, y0, d), b.view.at(x1, y0, d), b.view.at(x1, y1, d), b.view.at(x0, y1, d)}));
  }
  if (!b.one_color && c.chance(40)) out.put("colors", rgba_list(b, 4));
  if (c.chance(40)) out.put("texcoords", texcoords_text(b, 4));
  return {Object("quad", out.text()).text(), true, false, unit};
}

HardMesh lines_or_points(Builder& b) {
  Choices& c = b.choose;
  b.has_line_or_point = true;
  Shape of = shape(b);
  if (of.positions.size() < 2) of.positions.push_back(of.positions.front());
  Object out("positions", points_text(of.positions));
  const bool lines = c.chance(60);
  if (lines) {
    std::vector<std::string> indices;
    for (std::size_t i = 1; i < of.positions.size(); ++i) {
      indices.push_back(json_numbers({static_cast<double>(i - 1), static_cast<double>(i)}));
    }
    out.put("indices", json_array(indices));
  }
  if (c.chance(70)) out.put("colors", rgba_list(b, of.positions.size()));
  return {Object(lines ? "lines" : "points", out.text()).text(), false, true};
}

HardMesh made(Builder& b) {
  Choices& c = b.choose;
  const std::string_view kind =
      c.word({"grid", "cube", "uv_sphere", "globe", "icosphere", "torus_knot", "revolution", "soup"});
  Object out;
  if (kind == "grid") out.put("columns", c.count(1, 4)).put("rows", c.count(1, 4));
  if (kind == "uv_sphere" || kind == "globe") out.put("slices", c.count(3, 9)).put("stacks", c.count(2, 6));
  if (kind == "icosphere") out.put("subdivisions", c.count(0, 1));
  if (kind == "torus_knot") {
    const bool plain = c.chance(50);
    out.put("p", plain ? 1 : 2).put("q", plain ? c.of({1, 2, 3}) : c.of({1, 3, 5}));
    out.put("segments", c.count(3, 16)).put("sides", c.count(3, 5)).put("tube", c.of({0.05, 0.1, 0.25}));
  }
  if (kind == "revolution") {
    const double foot = c.of({0, 0.5, 1}), top = foot == 0 ? c.of({0.5, 1}) : c.of({0, 0.5, 1});
    out.put("profile", json_array({json_numbers({foot, -1}), json_numbers({1, -0.5}), json_numbers({0.5, 0.5}),
                                   json_numbers({top, 1})}));
    out.put("steps", c.count(1, 4)).put("slices", c.count(3, 8));
  }
  if (kind == "soup") {
    out.put("triangles", c.count(1, 30)).put("seed", c.count(0, 9999));
    out.put("extent", c.of({0.5, 1, 2})).put("size", c.of({0.05, 0.5, 2}));
  }
  return {Object(kind, out.text()).text(), kind == "grid" || kind == "cube" || kind == "globe", false, true};
}

}  // namespace

HardMesh mesh(Builder& b) {
  switch (b.choose.count(0, 9)) {
    case 0: return made(b);
    case 1: return lines_or_points(b);
    case 2: return quad(b);
    default: return written_out(b);
  }
}

HardMesh triangles_mesh(Builder& b) {
  switch (b.choose.count(0, 7)) {
    case 0: return b.one_color || b.view.clamps ? quad(b) : made(b);  // a soup has colours, and leaves the view
    case 1: return quad(b);
    default: return written_out(b);
  }
}

std::string place_made(Builder& b) {
  Choices& c = b.choose;
  const double d = std::clamp(distance(b), -1.0, 30.0), x = c.number(0, 1), y = c.number(0, 1);
  const Point at = b.view.at(x * b.view.width, y * b.view.height, d);
  const double size = b.view.of_pixels ? c.of({1, 4, 16, 40}) : c.of({0.1, 0.5, 1, 2, 5});
  std::vector<std::string> out{Object("translate", json_numbers({at[0], at[1], at[2]})).text()};
  if (c.chance(60)) {
    const std::vector<double> axis = c.chance(50) ? std::vector<double>{0, 1, 0} : std::vector<double>{1, 2, 3};
    const double degrees = c.of({30, 45, 90, 180, -90, c.number(-180, 180)});
    out.push_back(Object("rotate", Object("degrees", json(degrees)).put_numbers("axis", axis).text()).text());
  }
  const bool even = c.chance(60), mirrored = c.chance(10);
  const double flat = even ? size : size * c.of({0.001, 0.5, 2});
  out.push_back(Object("scale", json_numbers({mirrored ? -size : size, flat, size})).text());
  return json_array(out);
}

}  // namespace plumbline::hard
