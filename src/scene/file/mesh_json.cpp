#include "scene/file/mesh_json.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "scene/json/scene_values.h"
#include "scene/mesh/mesh_shapes.h"
#include "scene/mesh/mesh_solids.h"
#include "scene/mesh/polygon.h"

namespace plumbline {
namespace {

constexpr int kMostCells = 2048;  // along one side of a generator's mesh

int read_count(const JsonNode& node, int least, int most) { return static_cast<int>(node.integer(least, most)); }

void require_triangles_left(const JsonNode& node, std::size_t count, std::size_t most) {
  if (count <= most) return;
  node.refuse(fmt::format("at most {} triangles in all, of which {} are left", kMostPrimitives, most),
              fmt::format("{} more", count));
}

std::vector<MeshPart> read_file(const JsonNode& node, const AssetFolders& folders, std::size_t most_triangles) {
  const std::filesystem::path file =
      folders.find(node, "a mesh file (scripts/setup installs those of the package glmark2-data)");
  try {
    std::vector<MeshPart> parts = load_mesh(file, folders, most_triangles);
    if (std::string& note = parts.front().note; !note.empty()) note = fmt::format("{}: {}", file.string(), note);
    return parts;
  } catch (const MeshError& error) {
    node.refuse("a mesh file that can be used", error.what());
  }
}

std::vector<glm::vec3> read_positions(const JsonNode& node, std::size_t least, std::size_t most) {
  std::vector<glm::vec3> positions;
  for (const JsonNode& p : node.elements(least, most)) positions.emplace_back(read_point(p));
  return positions;
}

std::vector<glm::vec4> read_colors(const JsonNode& node, std::size_t count) {
  std::vector<glm::vec4> colors;
  if (const auto list = node.find("colors")) {
    for (const JsonNode& c : list->elements(count, count)) colors.emplace_back(c.vector<4>(0, 1));
  }
  return colors;
}

std::vector<glm::vec2> read_texcoords(const JsonNode& node, std::size_t count) {
  constexpr double kLargest = 16384;
  std::vector<glm::vec2> texcoords;
  if (const auto list = node.find("texcoords")) {
    for (const JsonNode& c : list->elements(count, count)) texcoords.emplace_back(c.vector<2>(-kLargest, kLargest));
  }
  return texcoords;
}

/// Empty where the file has none.
std::vector<glm::vec3> read_normals(const JsonNode& node, std::size_t count) {
  constexpr double kFromUnitLength = 1e-3;  // above sqrt(3) * 5e-4, the error of components of three decimals
  std::vector<glm::vec3> normals;
  if (const auto list = node.find("normals")) {
    for (const JsonNode& n : list->elements(count, count)) {
      normals.emplace_back(read_point(n));
      if (!(std::abs(glm::length(normals.back()) - 1) <= kFromUnitLength)) n.refuse("a normal of unit length");
    }
  }
  return normals;
}

Mesh read_triangle(const JsonNode& node) {
  node.only({"positions", "colors", "texcoords"});
  Mesh mesh = make_triangles(read_positions(node["positions"], 3, 3), {{0, 1, 2}}, read_colors(node, 3));
  mesh.texcoords = read_texcoords(node, 3);
  return mesh;
}

Mesh read_triangles(const JsonNode& node) {
  node.only({"positions", "indices", "normals", "colors", "texcoords"});
  std::vector<glm::vec3> positions = read_positions(node["positions"], 3, SIZE_MAX);
  std::vector<glm::uvec3> triangles;
  for (const JsonNode& triangle : node["indices"].elements(1, SIZE_MAX)) {
    const std::vector<JsonNode> corners = triangle.elements(3, 3);
    glm::uvec3 t;
    for (int k = 0; k < 3; ++k) {
      t[k] = static_cast<std::uint32_t>(
          corners[static_cast<std::size_t>(k)].integer(0, static_cast<std::int64_t>(positions.size()) - 1));
    }
    if (t.x == t.y || t.y == t.z || t.z == t.x) {
      triangle.refuse("three different indices", fmt::format("[{}, {}, {}]", t.x, t.y, t.z));
    }
    triangles.push_back(t);
  }
  std::vector<glm::vec4> colors = read_colors(node, positions.size());
  std::vector<glm::vec2> texcoords = read_texcoords(node, positions.size());
  std::vector<glm::vec3> normals = read_normals(node, positions.size());
  Mesh mesh = make_triangles(std::move(positions), std::move(triangles), std::move(colors));
  if (!normals.empty()) mesh.normals = std::move(normals);
  mesh.texcoords = std::move(texcoords);
  return mesh;
}

/// Mesh of lines or points. All normals are +z, as lines and points have none of their own.
Mesh line_or_point_mesh(std::vector<glm::vec3> positions, std::vector<glm::uvec3> primitives,
                        std::vector<glm::vec4> colors, Topology topology) {
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0, 0, 1));
  return {std::move(positions), std::move(normals), std::move(colors), std::move(primitives), topology};
}

Mesh read_lines(const JsonNode& node) {
  node.only({"positions", "indices", "colors"});
  std::vector<glm::vec3> positions = read_positions(node["positions"], 2, SIZE_MAX);
  std::vector<glm::uvec3> lines;
  for (const JsonNode& line : node["indices"].elements(1, SIZE_MAX)) {
    const std::vector<JsonNode> ends = line.elements(2, 2);
    const auto last = static_cast<std::int64_t>(positions.size()) - 1;
    const auto a = static_cast<std::uint32_t>(ends[0].integer(0, last));
    const auto b = static_cast<std::uint32_t>(ends[1].integer(0, last));
    if (a == b) line.refuse("two different indices", fmt::format("[{}, {}]", a, b));
    lines.emplace_back(a, b, b);
  }
  std::vector<glm::vec4> colors = read_colors(node, positions.size());
  return line_or_point_mesh(std::move(positions), std::move(lines), std::move(colors), Topology::lines);
}

Mesh read_points(const JsonNode& node) {
  node.only({"positions", "colors"});
  std::vector<glm::vec3> positions = read_positions(node["positions"], 1, SIZE_MAX);
  std::vector<glm::uvec3> points;
  for (std::uint32_t i = 0; i < positions.size(); ++i) points.emplace_back(i);
  std::vector<glm::vec4> colors = read_colors(node, positions.size());
  return line_or_point_mesh(std::move(positions), std::move(points), std::move(colors), Topology::points);
}

Mesh read_quad(const JsonNode& node) {
  node.only({"positions", "colors", "texcoords"});
  std::vector<glm::vec3> p{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  if (const auto given = node.find("positions")) {
    p = read_positions(*given, 4, 4);
    const std::vector<glm::dvec3> corners(p.begin(), p.end());
    if (const std::string fault = polygon_fault(corners); !fault.empty()) {
      given->refuse("a flat quad that does not cross itself", fault);
    }
  }
  // Cut along a diagonal that lies inside the quad: in a concave quad (an arrowhead) one of the two lies outside.
  const auto half = [&](int a, int b, int c) {
    const auto at = [&](int i) { return glm::dvec3(p[static_cast<std::size_t>(i)]); };
    return glm::cross(at(b) - at(a), at(c) - at(a));
  };
  std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 2, 3}};
  if (!(glm::dot(half(0, 1, 2), half(0, 2, 3)) > 0)) triangles = {{1, 2, 3}, {1, 3, 0}};
  Mesh mesh = make_triangles(std::move(p), std::move(triangles), read_colors(node, 4));
  mesh.texcoords = read_texcoords(node, 4);
  if (mesh.texcoords.empty()) mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return mesh;
}

Mesh read_soup(const JsonNode& node, std::size_t most_triangles) {
  node.only({"triangles", "seed", "extent", "size"});
  const int triangles = read_count(node["triangles"], 1, 4'000'000);
  require_triangles_left(node, static_cast<std::size_t>(triangles), most_triangles);
  return make_soup(triangles, static_cast<std::uint64_t>(node["seed"].integer(0, INT64_MAX)),
                   node["extent"].number(0, kLargestCoordinate / 2), node["size"].number(0, kLargestCoordinate / 2));
}

Mesh read_grid(const JsonNode& node, std::size_t most_triangles) {
  node.only({"columns", "rows"});
  const int columns = read_count(node["columns"], 1, kMostCells), rows = read_count(node["rows"], 1, kMostCells);
  require_triangles_left(node, 2u * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), most_triangles);
  return make_grid(columns, rows);
}

/// `make`: make_uv_sphere or make_globe.
Mesh read_sphere(const JsonNode& node, Mesh (*make)(int slices, int stacks), std::size_t most_triangles) {
  node.only({"slices", "stacks"});
  const int slices = read_count(node["slices"], 3, kMostCells), stacks = read_count(node["stacks"], 2, kMostCells);
  require_triangles_left(node, 2u * static_cast<std::size_t>(slices) * static_cast<std::size_t>(stacks - 1),
                         most_triangles);
  return make(slices, stacks);
}

Mesh read_icosphere(const JsonNode& node, std::size_t most_triangles) {
  node.only({"subdivisions"});
  const int subdivisions = read_count(node["subdivisions"], 0, 8);
  require_triangles_left(node, 20u << 2 * subdivisions, most_triangles);
  return make_icosphere(subdivisions);
}

Mesh read_torus_knot(const JsonNode& node, std::size_t most_triangles) {
  constexpr int kMostTurns = 64;
  node.only({"p", "q", "segments", "sides", "tube"});
  TorusKnot knot;
  if (const auto n = node.find("p")) knot.p = read_count(*n, 1, kMostTurns);
  if (const auto n = node.find("q")) knot.q = read_count(*n, 1, kMostTurns);
  if (const auto n = node.find("tube")) knot.tube = n->number(1e-3, 0.25);
  knot.segments = read_count(node["segments"], 3, kMostCells);
  knot.sides = read_count(node["sides"], 3, kMostCells);
  if (std::gcd(knot.p, knot.q) != 1) {
    node.refuse("p and q without a common divisor", fmt::format("{} and {}", knot.p, knot.q));
  }
  require_triangles_left(node, 2u * static_cast<std::size_t>(knot.segments) * static_cast<std::size_t>(knot.sides),
                         most_triangles);
  return make_torus_knot(knot);
}

Mesh read_revolution(const JsonNode& node, std::size_t most_triangles) {
  constexpr std::size_t kMostCurves = 64;
  node.only({"profile", "steps", "slices"});
  const JsonNode profile = node["profile"];
  std::vector<glm::dvec2> control;
  for (const JsonNode& point : profile.elements(4, 3 * kMostCurves + 1)) {
    control.push_back(point.vector<2>(-kLargestCoordinate, kLargestCoordinate));
    if (control.back().x < 0) point[0u].refuse("a radius of 0 or more");
  }
  if (control.size() % 3 != 1) profile.refuse("3 n + 1 points: cubic Bézier curves, neighbours sharing one");
  const int steps = read_count(node["steps"], 1, kMostCells), slices = read_count(node["slices"], 3, kMostCells);
  const std::size_t curves = control.size() / 3;
  require_triangles_left(node, 2u * static_cast<std::size_t>(slices) * static_cast<std::size_t>(steps) * curves,
                         most_triangles);
  const std::vector<glm::dvec2> points = bezier_profile(control, steps);
  if (std::any_of(points.begin() + 1, points.end() - 1, [](const glm::dvec2& p) { return p.x < kSmallestLength; })) {
    profile.refuse("radii over 0 between the profile's ends", "one of 0");
  }
  if (points.size() == 2 && points[0].x <= 0 && points[1].x <= 0) profile.refuse("a radius over 0", "none");
  return make_revolution(points, slices);
}

Mesh make(std::string_view kind, const JsonNode& node, std::size_t most_triangles) {
  if (kind == "triangle") return read_triangle(node);
  if (kind == "triangles") return read_triangles(node);
  if (kind == "lines") return read_lines(node);
  if (kind == "points") return read_points(node);
  if (kind == "quad") return read_quad(node);
  if (kind == "grid") return read_grid(node, most_triangles);
  if (kind == "uv_sphere") return read_sphere(node, make_uv_sphere, most_triangles);
  if (kind == "globe") return read_sphere(node, make_globe, most_triangles);
  if (kind == "icosphere") return read_icosphere(node, most_triangles);
  if (kind == "torus_knot") return read_torus_knot(node, most_triangles);
  if (kind == "revolution") return read_revolution(node, most_triangles);
  if (kind == "soup") return read_soup(node, most_triangles);
  node.only({});
  return make_cube();
}

}  // namespace

std::vector<MeshPart> read_mesh(const JsonNode& node, const AssetFolders& folders, std::size_t most_triangles) {
  const std::string_view kind = node.one_of({"file", "triangle", "triangles", "lines", "points", "quad", "grid", "cube",
                                             "uv_sphere", "globe", "icosphere", "torus_knot", "revolution", "soup"});
  if (kind == "file") return read_file(node[kind], folders, most_triangles);
  return {{make(kind, node[kind], most_triangles), std::nullopt, ""}};
}

}  // namespace plumbline
