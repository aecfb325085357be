#include "scene/mesh_json.h"

#include <algorithm>

#include <fmt/format.h>

#include "scene/mesh_file.h"
#include "scene/mesh_shapes.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

Mesh read_file(const JsonNode& node, std::span<const fs::path> folders) {
  const fs::path name = node.text();
  const bool climbs = std::find(name.begin(), name.end(), "..") != name.end();
  if (name.is_absolute() || climbs) node.refuse("a path below the scene's folder or an asset folder, without \"..\"");
  for (const fs::path& folder : folders) {
    if (!fs::is_regular_file(folder / name)) continue;
    try {
      return load_mesh(folder / name);
    } catch (const MeshError& error) {
      node.refuse("a mesh file that can be used", error.what());
    }
  }
  std::string looked;
  for (const fs::path& folder : folders) looked += fmt::format("{}{}", looked.empty() ? "" : ", ", folder.string());
  node.refuse("a mesh file", fmt::format("no file \"{}\" in {} (scripts/setup installs the package glmark2-data, whose "
                                         "models the scenes use)",
                                         name.string(), looked));
}

std::vector<glm::vec3> read_positions(const JsonNode& node, std::size_t least, std::size_t most) {
  std::vector<glm::vec3> positions;
  for (const JsonNode& p : node.elements(least, most)) {
    positions.emplace_back(p.vector<3>(-kLargestCoordinate, kLargestCoordinate));
  }
  return positions;
}

std::vector<glm::vec4> read_colors(const JsonNode& node, std::size_t count) {
  std::vector<glm::vec4> colors;
  if (const auto list = node.find("colors")) {
    for (const JsonNode& c : list->elements(count, count)) colors.emplace_back(c.vector<4>(0, 1));
  }
  return colors;
}

Mesh read_triangle(const JsonNode& node) {
  node.only({"positions", "colors"});
  return make_triangles(read_positions(node["positions"], 3, 3), {{0, 1, 2}}, read_colors(node, 3));
}

Mesh read_triangles(const JsonNode& node) {
  node.only({"positions", "indices", "colors"});
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
  return make_triangles(std::move(positions), std::move(triangles), std::move(colors));
}

int read_count(const JsonNode& node, int least, int most) { return static_cast<int>(node.integer(least, most)); }

Mesh read_soup(const JsonNode& node) {
  node.only({"triangles", "seed", "extent", "size"});
  return make_soup(read_count(node["triangles"], 1, 1'000'000),
                   static_cast<std::uint64_t>(node["seed"].integer(0, INT64_MAX)),
                   node["extent"].number(0, kLargestCoordinate / 2), node["size"].number(0, kLargestCoordinate / 2));
}

}  // namespace

Mesh read_mesh(const JsonNode& node, std::span<const fs::path> folders) {
  constexpr int kMost = 2048;
  const std::string_view kind = node.one_of({"file", "triangle", "triangles", "grid", "uv_sphere", "soup"});
  const JsonNode what = node[kind];
  if (kind == "file") return read_file(what, folders);
  if (kind == "triangle") return read_triangle(what);
  if (kind == "triangles") return read_triangles(what);
  if (kind == "soup") return read_soup(what);
  if (kind == "grid") {
    what.only({"columns", "rows"});
    return make_grid(read_count(what["columns"], 1, kMost), read_count(what["rows"], 1, kMost));
  }
  what.only({"slices", "stacks"});
  return make_uv_sphere(read_count(what["slices"], 3, kMost), read_count(what["stacks"], 2, kMost));
}

}  // namespace plumbline
