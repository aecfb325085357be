// Generated meshes and images against their formulas, each written a second time: every renderer reads the same scene,
// so that no comparison of pictures can see a generator's mistake.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "scene/mesh/mesh_shapes.h"
#include "scene/mesh/mesh_solids.h"
#include "scene/texture/texture_images.h"

namespace plumbline {
namespace {

constexpr double kHalfTurn = std::numbers::pi, kNear = 1e-6;

void expect_near(const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::distance(a, b), kNear); }

/// The point of the unit sphere at s (longitude, from +z towards +x) and t (latitude, from the south pole).
glm::dvec3 on_sphere(double s, double t) {
  const double longitude = 2 * kHalfTurn * s, latitude = kHalfTurn * (t - 0.5);
  return {std::cos(latitude) * std::sin(longitude), std::sin(latitude), std::cos(latitude) * std::cos(longitude)};
}

double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The triangles' area in the texture's square; each is wound as the square is.
double textured_area(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const double area = twice_area(mesh.texcoords[t.x], mesh.texcoords[t.y], mesh.texcoords[t.z]) / 2;
    EXPECT_GT(area, 0);
    sum += area;
  }
  return sum;
}

TEST(GeneratedData, AGlobesVerticesLieWhereTheirTextureCoordinatesSay) {
  constexpr int kSlices = 7, kStacks = 5;
  const Mesh mesh = make_globe(kSlices, kStacks);
  ASSERT_EQ(mesh.positions.size(), static_cast<std::size_t>((kSlices + 1) * (kStacks + 1)));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const int column = static_cast<int>(i) % (kSlices + 1), row = static_cast<int>(i) / (kSlices + 1);
    const bool pole = row == 0 || row == kStacks;
    const double s = (column + (pole ? 0.5 : 0)) / kSlices, t = 1 - row / static_cast<double>(kStacks);
    EXPECT_NEAR(mesh.texcoords[i].x, s, kNear);
    EXPECT_NEAR(mesh.texcoords[i].y, t, kNear);
    expect_near(mesh.positions[i], on_sphere(s, t));
    EXPECT_EQ(mesh.normals[i], mesh.positions[i]);
    if (pole) {
      EXPECT_EQ(mesh.positions[i], glm::vec3(0, row == 0 ? 1 : -1, 0));
    }
    if (column == kSlices) {
      EXPECT_EQ(mesh.positions[i], mesh.positions[i - kSlices]);
    }
  }
  EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * kSlices * (kStacks - 1)));
  EXPECT_NEAR(textured_area(mesh), 1 - 1.0 / kStacks, kNear);  // of a pole's row every second triangle is a point
}

TEST(GeneratedData, AnUvSpheresVerticesLieOnItsRings) {
  constexpr int kSlices = 6, kStacks = 4;
  const Mesh mesh = make_uv_sphere(kSlices, kStacks);
  for (std::size_t i = 1; i + 1 < mesh.positions.size(); ++i) {
    const int row = (static_cast<int>(i) - 1) / kSlices + 1, column = (static_cast<int>(i) - 1) % kSlices;
    expect_near(mesh.positions[i],
                on_sphere(column / static_cast<double>(kSlices), 1 - row / static_cast<double>(kStacks)));
  }
}

TEST(GeneratedData, ASquaresTextureIsTheWholeImage) {
  const Mesh grid = make_grid(4, 3), cube = make_cube();
  for (std::size_t i = 0; i < grid.positions.size(); ++i) {
    expect_near({grid.texcoords[i], 0}, {(glm::dvec2(grid.positions[i]) + 1.0) / 2.0, 0});
  }
  EXPECT_NEAR(textured_area(grid), 1, kNear);
  EXPECT_NEAR(textured_area(cube), 6, kNear);
  for (std::size_t i = 0; i < cube.positions.size(); ++i) {
    EXPECT_EQ(glm::abs(cube.positions[i]), glm::vec3(1));
    EXPECT_EQ(glm::abs(cube.texcoords[i] - 0.5f), glm::vec2(0.5f));
    EXPECT_EQ(glm::dot(cube.normals[i], cube.positions[i]), 1);
    EXPECT_EQ(glm::length(cube.normals[i]), 1);
  }
}

TEST(GeneratedData, ATorusKnotsVerticesLieOnItsTube) {
  const TorusKnot knot{.p = 2, .q = 3, .segments = 40, .sides = 9, .tube = 0.1};
  const Mesh mesh = make_torus_knot(knot);
  const auto curve = [&](double turn) {
    const double around = 2 * kHalfTurn * knot.p * turn, through = 2 * kHalfTurn * knot.q * turn;
    const double radius = 0.6 + 0.25 * std::cos(through);
    return glm::dvec3(radius * std::cos(around), radius * std::sin(around), 0.25 * std::sin(through));
  };
  ASSERT_EQ(mesh.positions.size(), 360u);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double turn = static_cast<double>(i / 9) / knot.segments;
    expect_near(mesh.positions[i], curve(turn) + knot.tube * glm::dvec3(mesh.normals[i]));
    const glm::dvec3 tangent = glm::normalize(curve(turn + 1e-5) - curve(turn - 1e-5));
    EXPECT_NEAR(glm::dot(glm::dvec3(mesh.normals[i]), tangent), 0, 1e-5);
    const glm::dvec3 next(mesh.normals[i / 9 * 9 + (i + 1) % 9]);  // sides are 40 degrees apart
    if (i % 9 != 8) {
      EXPECT_NEAR(glm::dot(glm::dvec3(mesh.normals[i]), next), std::cos(2 * kHalfTurn / 9), kNear);
    }
  }
}

TEST(GeneratedData, ARevolutionsVerticesHaveTheProfilesRadii) {
  const std::vector<glm::dvec2> profile{{0, -1}, {0.5, -0.5}, {0.75, 0.25}, {0, 1}};
  const Mesh mesh = make_revolution(profile, 8);
  ASSERT_EQ(mesh.positions.size(), 18u);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec2 point = profile[i == 0 ? 0 : i == 17 ? 3 : (i - 1) / 8 + 1];
    const double angle = 2 * kHalfTurn * static_cast<double>((i - 1) % 8) / 8;
    expect_near(mesh.positions[i], {point.x * std::sin(angle), point.y, point.x * std::cos(angle)});
  }
}

TEST(GeneratedData, AnUvGridsLinesBeginItsCells) {
  for (const auto& [width, height, columns, rows] :
       {std::array{8, 8, 2, 4}, std::array{9, 5, 4, 2}, std::array{3, 7, 1, 7}}) {
    const TextureLevel grid = make_uv_grid(width, height, columns, rows);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        // A cell's border at k width / columns is left of texel x's centre, and not left of x - 1's.
        const auto begins = [](int i, int size, int cells) {
          for (int k = 0; k < cells; ++k) {
            const int border = 2 * k * size, centre = (2 * i + 1) * cells;  // both times 2 cells
            if (border <= centre && border > centre - 2 * cells) return true;
          }
          return false;
        };
        const bool line = begins(x, width, columns) || begins(y, height, rows);
        expect_near(glm::dvec3(grid.at(x, y)), {(2 * x + 1) / (2.0 * width), (2 * y + 1) / (2.0 * height), line});
        EXPECT_EQ(grid.at(x, y).a, 1);
      }
    }
  }
}

/// Values of a program of its own (lowbias32 of Wellons' hash-prospector, in Python).
TEST(GeneratedData, NoiseIsLowbias32OfThePlace) {
  const TextureLevel noise = make_noise(4, 6, 7);
  EXPECT_EQ(noise.at(0, 0), glm::vec4(191, 93, 48, 75) / 255.0f);
  EXPECT_EQ(noise.at(3, 1), glm::vec4(114, 130, 98, 37) / 255.0f);
  EXPECT_EQ(noise.at(2, 5), glm::vec4(113, 148, 244, 94) / 255.0f);
}

}  // namespace
}  // namespace plumbline
