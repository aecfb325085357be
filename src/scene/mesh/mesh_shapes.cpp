#include "scene/mesh/mesh_shapes.h"

#include <cmath>
#include <numbers>

namespace plumbline {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the standard library's distributions differ from one library to the next.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// [0,1), a multiple of 2^-24.
  double unit() { return static_cast<double>(next() >> 40) * 0x1p-24; }
  /// [-1,1)
  double symmetric() { return 2 * unit() - 1; }

 private:
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

std::uint32_t index(int i) { return static_cast<std::uint32_t>(i); }

}  // namespace

std::vector<glm::vec3> area_weighted_normals(std::span<const glm::vec3> positions,
                                             std::span<const glm::uvec3> triangles) {
  std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
  for (const glm::uvec3& t : triangles) {
    const glm::dvec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
    const glm::dvec3 twice_area = glm::cross(b - a, c - a);
    for (int k = 0; k < 3; ++k) sums[t[k]] += twice_area;
  }
  std::vector<glm::vec3> normals;
  normals.reserve(sums.size());
  for (const glm::dvec3& sum : sums) {
    const double length = glm::length(sum);
    normals.push_back(std::isnormal(length) ? glm::vec3(sum / length) : glm::vec3(0, 0, 1));
  }
  return normals;
}

Mesh make_triangles(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles,
                    std::vector<glm::vec4> colors) {
  Mesh mesh;
  mesh.normals = area_weighted_normals(positions, triangles);
  mesh.positions = std::move(positions);
  mesh.colors = std::move(colors);
  mesh.triangles = std::move(triangles);
  return mesh;
}

Mesh make_grid(int columns, int rows) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.positions.emplace_back(-1 + 2.0 * i / columns, -1 + 2.0 * j / rows, 0);
      mesh.texcoords.emplace_back(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
    }
  }
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = index(j * (columns + 1) + i), b = a + 1, d = a + index(columns + 1), c = d + 1;
      mesh.triangles.emplace_back(a, b, c);
      mesh.triangles.emplace_back(a, c, d);
    }
  }
  return mesh;
}

Mesh make_uv_sphere(int slices, int stacks) {
  Mesh mesh;
  mesh.positions.emplace_back(0, 1, 0);
  for (int j = 1; j < stacks; ++j) {
    const double polar = std::numbers::pi * j / stacks;
    for (int i = 0; i < slices; ++i) {
      const double around = 2 * std::numbers::pi * i / slices;
      mesh.positions.emplace_back(std::sin(polar) * std::sin(around), std::cos(polar),
                                  std::sin(polar) * std::cos(around));
    }
  }
  mesh.positions.emplace_back(0, -1, 0);
  mesh.normals = mesh.positions;

  const std::uint32_t north = 0, south = index(static_cast<int>(mesh.positions.size()) - 1);
  const auto ring = [&](int j, int i) { return 1 + index((j - 1) * slices + i % slices); };
  for (int i = 0; i < slices; ++i) mesh.triangles.emplace_back(north, ring(1, i), ring(1, i + 1));
  for (int j = 1; j + 1 < stacks; ++j) {
    for (int i = 0; i < slices; ++i) {
      mesh.triangles.emplace_back(ring(j, i), ring(j + 1, i), ring(j + 1, i + 1));
      mesh.triangles.emplace_back(ring(j, i), ring(j + 1, i + 1), ring(j, i + 1));
    }
  }
  for (int i = 0; i < slices; ++i) mesh.triangles.emplace_back(ring(stacks - 1, i), south, ring(stacks - 1, i + 1));
  return mesh;
}

Mesh make_globe(int slices, int stacks) {
  Mesh mesh;
  for (int j = 0; j <= stacks; ++j) {
    const bool pole = j == 0 || j == stacks;
    // The first and the last ring lie exactly on the poles; the last vertex of a ring lies exactly on its first.
    const double polar = std::numbers::pi * j / stacks, radius = pole ? 0 : std::sin(polar);
    const double y = pole ? (j == 0 ? 1 : -1) : std::cos(polar);
    for (int i = 0; i <= slices; ++i) {
      const double around = 2 * std::numbers::pi * (i % slices) / slices;
      mesh.positions.emplace_back(radius * std::sin(around), y, radius * std::cos(around));
      mesh.texcoords.emplace_back((i + (pole ? 0.5 : 0)) / slices, 1 - static_cast<double>(j) / stacks);
    }
  }
  mesh.normals = mesh.positions;
  for (int j = 0; j < stacks; ++j) {
    for (int i = 0; i < slices; ++i) {
      const std::uint32_t a = index(j * (slices + 1) + i), b = a + 1, c = a + index(slices + 1), d = c + 1;
      if (j > 0) mesh.triangles.emplace_back(a, j + 1 < stacks ? d : c, b);
      if (j + 1 < stacks) mesh.triangles.emplace_back(a, c, d);
    }
  }
  return mesh;
}

Mesh make_soup(int triangles, std::uint64_t seed, double extent, double size) {
  Random random(seed);
  // Random numbers in separate statements: the compiler chooses the order in which arguments are evaluated.
  const auto cube = [&](double half) {
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) p[k] = half * random.symmetric();
    return p;
  };
  std::vector<glm::vec3> positions;
  std::vector<glm::vec4> colors;
  std::vector<glm::uvec3> corners;
  for (int t = 0; t < triangles; ++t) {
    const glm::dvec3 middle = cube(extent);
    for (int k = 0; k < 3; ++k) {
      positions.emplace_back(middle + cube(size));
      glm::dvec4 color(1);
      for (int c = 0; c < 3; ++c) color[c] = random.unit();
      colors.emplace_back(color);
    }
    corners.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
  }
  return make_triangles(std::move(positions), std::move(corners), std::move(colors));
}

}  // namespace plumbline
