// Scenes of random triangles, kind by kind, the same on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene/mesh/mesh_shapes.h"
#include "scene/scene.h"

namespace plumbline {

/// splitmix64 (Steele, Lea, Flood 2014): uniform in [0, 1).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double in(double low, double high) { return low + (high - low) * unit(); }
  int below(int n) { return static_cast<int>(unit() * n); }

 private:
  std::uint64_t state_;
};

/// A kind of triangle: three corners in the eye space of its projection.
struct SceneKind {
  std::string name;
  bool perspective;
  std::function<std::array<glm::vec3, 3>(Random&)> corners;
};

inline constexpr int kRandomSize = 48;  ///< the orthographic frame's sides: one unit is a pixel

inline std::vector<SceneKind> kinds() {
  using Corners = std::array<glm::vec3, 3>;
  const auto around = [](Random& r, double x, double y, double size) {
    return glm::vec3(x + r.in(-size, size), y + r.in(-size, size), r.in(-9, -1));
  };
  const auto centred = [=](double size) {
    return [=](Random& r) {
      const double x = r.in(0, kRandomSize), y = r.in(0, kRandomSize);
      return Corners{around(r, x, y, size), around(r, x, y, size), around(r, x, y, size)};
    };
  };
  return {
      {"sub-pixel", false, centred(0.4)},
      {"small", false, centred(3)},
      {"large", false, centred(40)},
      {"slivers", false,
       [](Random& r) {
         const glm::dvec2 a(r.in(0, kRandomSize), r.in(0, kRandomSize)), b(r.in(0, kRandomSize), r.in(0, kRandomSize));
         const glm::dvec2 c = a + (b - a) * r.unit() + glm::dvec2(r.in(-1, 1), r.in(-1, 1)) * std::exp2(r.in(-12, 0));
         return Corners{glm::vec3(a, r.in(-9, -1)), glm::vec3(b, r.in(-9, -1)), glm::vec3(c, r.in(-9, -1))};
       }},
      {"on centres", false,
       [](Random& r) {
         Corners out;
         for (glm::vec3& p : out) p = {r.below(kRandomSize) + 0.5, r.below(kRandomSize) + 0.5, r.in(-9, -1)};
         return out;
       }},
      {"on halves and corners", false,
       [](Random& r) {
         Corners out;
         for (glm::vec3& p : out) p = {r.below(2 * kRandomSize) / 2.0, r.below(2 * kRandomSize) / 2.0, r.in(-9, -1)};
         return out;
       }},
      {"beyond the viewport", false, centred(1e4)},
      {"grazing", true,
       [](Random& r) {
         Corners out;
         const double slope = r.in(-1e-3, 1e-3);
         for (glm::vec3& p : out) {
           const double z = -std::exp2(r.in(0, 6.5));
           p = {r.in(-1, 1) * z, slope * z - 0.01, z};
         }
         return out;
       }},
      {"cut by several planes", true,
       [](Random& r) {
         Corners out;
         for (glm::vec3& p : out) p = {r.in(-150, 150), r.in(-150, 150), r.in(-150, 50)};
         return out;
       }},
      {"through the eye", true,
       [](Random& r) {
         Corners out;
         for (glm::vec3& p : out) p = {r.in(-2, 2), r.in(-2, 2), r.in(-3, 2)};
         return out;
       }},
  };
}

/// A scene of `count` triangles of a kind; formats and state vary with the seed.
inline Scene scene_of_triangles(const SceneKind& kind, int count, std::uint64_t seed) {
  Random r(seed * 1000003 + 17);
  Scene scene;
  scene.name = "random/" + kind.name + " " + std::to_string(seed);
  scene.frame.width = kRandomSize;
  scene.frame.height = kRandomSize - (kind.perspective ? 11 : 0);
  scene.frame.color = seed % 2 == 0 ? ColorFormat::rgba8 : ColorFormat::rgba32f;
  constexpr DepthFormat kFormats[] = {DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f};
  scene.frame.depth = kFormats[seed % 3];
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  if (kind.perspective) {
    scene.projection = Perspective{75, 0.5, 100};
  } else {
    scene.projection = Orthographic{0, kRandomSize, 0, kRandomSize, 0, 10};
  }
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::vec4> colors;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    triangles.emplace_back(first, first + 1, first + 2);
    for (const glm::vec3& p : kind.corners(r)) {
      positions.push_back(p);
      colors.emplace_back(r.unit(), r.unit(), r.unit(), 1);
    }
  }
  scene.meshes.push_back(make_triangles(std::move(positions), std::move(triangles), std::move(colors)));
  Draw draw;
  draw.lit = false;
  draw.shading = seed % 5 == 0 ? Shading::flat : Shading::gouraud;
  draw.cull = seed % 7 == 0 ? Cull::back : Cull::none;
  draw.depth_func = seed % 4 == 0 ? DepthFunc::less_equal : DepthFunc::less;
  scene.draws.push_back(draw);
  return scene;
}

}  // namespace plumbline
