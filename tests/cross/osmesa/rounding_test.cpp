// How float colours are rounded to codes, at every boundary between two: ours, exact's and OSMesa's.
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "renderers/pipeline_renderer.h"
#include "tests/cross/thin_scenes.h"

namespace plumbline::test {
namespace {

constexpr int kCodes = 256;

/// A point in each pixel, flat, four values of `values` each its colour; as many rows as that takes.
Scene scene_of(std::vector<float> values, ColorFormat format) {
  while (values.size() % (4 * kCodes) != 0) values.push_back(0);
  const auto pixels = static_cast<int>(values.size() / 4);
  Scene scene = pixel_scene(kCodes, pixels / kCodes);
  scene.frame.color = format;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec4> colors;
  for (int i = 0; i < pixels; ++i) {
    positions.emplace_back(static_cast<float>(i % kCodes) + 0.5f, static_cast<float>(i / kCodes) + 0.5f, 0);
    const auto at = 4 * static_cast<std::size_t>(i);
    colors.emplace_back(values[at], values[at + 1], values[at + 2], values[at + 3]);
  }
  add(scene, thin_mesh(Topology::points, positions, colors)).shading = Shading::flat;
  return scene;
}

/// For every code, the float nearest to the middle between it and the next, and those just below and above.
std::vector<float> boundaries(int largest) {
  std::vector<float> values;
  for (int k = 0; k < largest; ++k) {
    const auto middle = static_cast<float>((k + 0.5) / largest);
    values.insert(values.end(), {std::nextafter(middle, 0.0f), middle, std::nextafter(middle, 1.0f)});
  }
  return values;
}

struct Rounding {
  int nearest = 0, other = 0;  ///< codes that are the nearest, and not
  double farthest = 0;         ///< of the others, from the middle between two codes, in codes
};
Rounding rounding_of(const Plane<glm::vec4>& color, const std::vector<float>& values, int largest) {
  Rounding out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::vec4& c = color.values()[i / 4];
    const double code = std::round(static_cast<double>(c[static_cast<int>(i % 4)]) * largest);
    const double exact = static_cast<double>(values[i]) * largest, off = std::abs(code - exact);
    if (off <= 0.5) {
      ++out.nearest;
    } else {
      ++out.other;
      out.farthest = std::max(out.farthest, off - 0.5);
    }
  }
  return out;
}

Plane<glm::vec4> color_of(Renderer& renderer, const Scene& scene) {
  Capture capture = renderer.capture(scene, {});
  EXPECT_EQ(capture.planes.shaded.size(), capture.planes.color.size());
  return capture.planes.color;
}

TEST(Rounding, GoesToTheNearestCodeButForTheRoundingOfTheProduct) {
  const auto ours = pipeline::make_pipeline();
  const auto exact = exact::make_exact();
  const auto osmesa = make_opengl();
  const std::pair<ColorFormat, int> formats[] = {
      {ColorFormat::rgba8, 255}, {ColorFormat::rgba12, 4095}, {ColorFormat::rgba16, 65535}};
  for (const auto& [format, largest] : formats) {
    const std::vector<float> values = boundaries(largest);
    const Scene scene = scene_of(values, format);
    const double half_ulp = (largest + 1) * 0x1p-25;  // of the product, in codes
    const Rounding mine = rounding_of(color_of(*ours, scene), values, largest);
    if (format == ColorFormat::rgba16) {
      EXPECT_EQ(mine.other, 0) << "its product is exact";
    } else {
      EXPECT_GT(mine.nearest, mine.other);
      EXPECT_LE(mine.farthest, half_ulp) << largest;
    }
    // Exact hands out colours that are not rounded to codes: each value itself.
    const Plane<glm::vec4> unrounded = color_of(*exact, scene);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(unrounded.values()[i / 4][static_cast<int>(i % 4)], values[i]) << largest;
    }
    if (format == ColorFormat::rgba12) continue;  // OpenGL gives 16 bits
    const Rounding theirs = rounding_of(color_of(*osmesa, scene), values, largest);
    EXPECT_GT(theirs.nearest, theirs.other) << largest;
    EXPECT_LE(theirs.farthest, half_ulp) << largest;
    RecordProperty("osmesa_other_" + std::to_string(largest), theirs.other);
    RecordProperty("ours_other_" + std::to_string(largest), mine.other);
    fmt::print("of {} boundary values of {}: ours {} not nearest, OSMesa {}\n", values.size(), largest, mine.other,
               theirs.other);
  }
}

TEST(Rounding, EveryCodeIsItsOwn) {
  const auto ours = pipeline::make_pipeline();
  const auto osmesa = make_opengl();
  std::vector<float> values;
  for (int k = 0; k <= 65535; ++k) values.push_back(static_cast<float>(k / 65535.0));
  const Scene scene = scene_of(values, ColorFormat::rgba16);
  for (Renderer* renderer : {ours.get(), osmesa.get()}) {
    const Plane<glm::vec4> color = color_of(*renderer, scene);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(color.values()[i / 4][static_cast<int>(i % 4)], static_cast<float>(i) / 65535.0f) << i;
    }
  }
}

}  // namespace
}  // namespace plumbline::test
