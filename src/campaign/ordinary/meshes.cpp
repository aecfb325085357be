// Meshes: written out, or made by the format's generators.
#include <fmt/format.h>

#include "campaign/ordinary/builder.h"

namespace plumbline::ordinary {
namespace {

std::string point(double x, double y, double z) { return json_numbers({x, y, z}); }

// Lines that join each of `count` positions with the next, and the last with the first if `closed`.
std::string chain(int count, bool closed) {
  std::vector<std::string> out;
  for (int i = 0; i + 1 < count; ++i) out.push_back(fmt::format("[{}, {}]", i, i + 1));
  if (closed && count > 2) out.push_back(fmt::format("[{}, 0]", count - 1));
  return json_array(out);
}

Object revolution(Builder& b) {
  Choices& c = b.choose;
  Object out;
  const std::string_view shape = c.word({"cylinder", "cone", "vase", "bowl"});
  if (shape == "cylinder") {
    const double r = c.of({0.3, 0.5, 1});
    out.put("profile", fmt::format("[[{0}, -1], [{0}, -0.5], [{0}, 0.5], [{0}, 1]]", json(r)));
  } else if (shape == "cone") {
    out.put("profile", "[[1, -1], [0.66, -0.33], [0.33, 0.33], [0, 1]]");
  } else if (shape == "vase") {
    const double foot = c.number(0.2, 0.6), low = c.number(0.5, 1.2), high = c.number(0.5, 1.2);
    out.put("profile", fmt::format("[[{}, -1], [{}, -0.5], [{}, 0.2], [0.3, 0.4], [0.3, 0.6], [0.3, 0.8], [0.5, 1]]",
                                   json(foot), json(low), json(high)));
  } else {
    out.put("profile", "[[0, -0.6], [0.7, -0.6], [1, -0.2], [1, 0.4]]");
  }
  out.put("steps", c.count(1, 6)).put("slices", c.of({6, 8, 12, 16, 20, 24}));
  return Object("revolution", out.text());
}

Object torus_knot(Builder& b) {
  Choices& c = b.choose;
  Object out;
  if (c.chance(50)) {
    const double pairs = c.of({1, 2, 3, 4});
    out.put("p", pairs == 1 ? 1 : 2).put("q", pairs == 1 ? c.of({1, 2}) : c.of({3, 5, 7}));
  }
  out.put("segments", c.count(12, 64)).put("sides", c.count(3, 8));
  if (c.chance(40)) out.put("tube", c.of({0.05, 0.1, 0.15, 0.2, 0.25}));
  return Object("torus_knot", out.text());
}

}  // namespace

Object floor_mesh(Builder& b, double y) {
  Choices& c = b.choose;
  const double r = b.reach * c.of({1, 1, 1.5, 2, 2, 3, 5, 10});
  if (c.chance(25)) {  // a grid of the format, laid down by the draw's transforms
    return Object("grid", Object().put("columns", c.count(1, 12)).put("rows", c.count(1, 12)).text());
  }
  Object out;
  out.put("positions", json_array({point(-r, y, r), point(r, y, r), point(r, y, -r), point(-r, y, -r)}));
  if (c.chance(15)) out.put("colors", rgba_array(b, 4));
  if (c.chance(60)) {
    const double times = c.of({1, 2, 3, 4, 4, 5, 8, 8, 10, 16, 20, c.number(0.5, 12)});
    out.put("texcoords", fmt::format("[[0, 0], [{0}, 0], [{0}, {0}], [0, {0}]]", json(times)));
  }
  return Object("quad", out.text());
}

Object wall_mesh(Builder& b) {
  Choices& c = b.choose;
  const double r = b.reach * c.of({1, 1, 1.5, 2}), top = b.reach * c.of({0.5, 1, 1.5}),
               z = -b.reach * c.of({1, 1, 1.5, 2});
  const double low = -b.reach / 3;
  Object out;
  out.put("positions", json_array({point(-r, low, z), point(r, low, z), point(r, top, z), point(-r, top, z)}));
  if (c.chance(20)) out.put("colors", rgba_array(b, 4));
  if (c.chance(40)) {
    const double times = c.of({1, 2, 3, 4});
    out.put("texcoords",
            fmt::format("[[0, 0], [{0}, 0], [{0}, {1}], [0, {1}]]", json(times), json(c.of({1, 2, times}))));
  }
  return Object("quad", out.text());
}

Solid solid(Builder& b) {
  Choices& c = b.choose;
  const std::string_view kind = c.word({"cube", "cube", "cube", "uv_sphere", "uv_sphere", "globe", "globe", "icosphere",
                                        "torus_knot", "revolution", "revolution"});
  if (kind == "cube") return {Object("cube", "{}"), true, 1};
  if (kind == "uv_sphere" || kind == "globe") {
    const double slices = c.chance(80) ? c.of({6, 8, 12, 16, 16, 20, 24}) : c.count(3, 24);
    const double stacks = c.chance(80) ? c.of({4, 6, 8, 8, 12}) : c.count(2, 16);
    return {Object(kind, Object().put("slices", slices).put("stacks", stacks).text()), kind == "globe", 1};
  }
  if (kind == "icosphere") return {Object(kind, Object().put("subdivisions", c.of({0, 1, 2, 2, 3})).text()), false, 1};
  if (kind == "torus_knot") return {torus_knot(b), false, 1};
  return {revolution(b), false, 1};
}

Solid model(Builder& b) {
  const std::string_view file = b.choose.word({"asteroid-low.3ds", "asteroid-low.3ds", "asteroid-low.3ds", "cube.3ds",
                                               "cube.3ds", "cube.3ds", "horse.3ds", "pyramid.obj", "pyramid.obj"});
  return {Object("file", json_string(file)), file != "cube.3ds", 1};
}

Object axes_mesh(Builder& b) {
  const double r = b.reach / 2;
  Object out;
  out.put("positions",
          json_array({point(0, 0, 0), point(r, 0, 0), point(0, 0, 0), point(0, r, 0), point(0, 0, 0), point(0, 0, r)}));
  out.put("indices", "[[0, 1], [2, 3], [4, 5]]");
  out.put("colors", "[[1, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [0, 0, 1, 1]]");
  return Object("lines", out.text());
}

Object wire_grid_mesh(Builder& b) {
  const int half = b.choose.count(1, 6);
  const double step = b.reach / half, y = -b.reach / 3;
  std::vector<std::string> positions, indices;
  for (int i = -half; i <= half; ++i) {
    const auto first = positions.size();
    for (const double end : {-b.reach, b.reach}) positions.push_back(point(i * step, y, end));
    for (const double end : {-b.reach, b.reach}) positions.push_back(point(end, y, i * step));
    indices.push_back(fmt::format("[{}, {}], [{}, {}]", first, first + 1, first + 2, first + 3));
  }
  return Object("lines", Object().put("positions", json_array(positions)).put("indices", json_array(indices)).text());
}

Object curve_mesh(Builder& b) {
  Choices& c = b.choose;
  const int count = c.count(3, 16);
  std::vector<std::string> positions;
  for (int i = 0; i < count; ++i) {
    const double x = b.reach * (2.0 * i / (count - 1) - 1);
    positions.push_back(c.chance(50) ? json_numbers({x, c.number(-1, 1) * b.reach / 2, 0})
                                     : json_numbers({x, c.number(-1, 1), c.number(-1, 1) * b.reach}));
  }
  Object out("positions", json_array(positions));
  out.put("indices", chain(count, c.chance(30)));
  if (c.chance(50)) out.put("colors", rgba_array(b, count));
  return Object("lines", out.text());
}

Object star_mesh(Builder& b, int count) {
  Choices& c = b.choose;
  std::vector<std::string> positions;
  for (int i = 0; i < count; ++i) {
    positions.push_back(
        json_numbers({c.number(-1, 1) * b.reach, c.number(-0.3, 1) * b.reach, c.number(-1, 1) * b.reach}));
  }
  Object out("positions", json_array(positions));
  if (c.chance(60)) out.put("colors", rgba_array(b, count));
  return Object("points", out.text());
}

}  // namespace plumbline::ordinary
