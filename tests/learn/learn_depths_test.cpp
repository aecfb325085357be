// Arithmetics of depths that plumb learn finds.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/learn/altered_renderers.h"

namespace plumbline::learn {
namespace {

// Depths that no other probe looks at are some codes off: float arithmetic up to a bound, and a finding beyond it. Far
// from the origin, edge equations lose more than differences do.
TEST(LearnDepths, InFloatAreFound) {
  using enum C::DepthArithmetic;
  const auto learned_of = [](double codes, int least_side) {
    return learned(std::make_unique<Altered>(pipeline::make_pipeline(), [=](Capture& c) {
      for (int y = 0; c.planes.depth.height() >= least_side && y < c.planes.depth.height(); ++y) {
        for (int x = 3; x < c.planes.depth.width(); x += 8) c.planes.depth(x, y) += codes / 16777215;
      }
    }));
  };
  EXPECT_EQ(learned_of(0, 0).depth_arithmetic, in_double);
  for (const double codes : {1.0, -3.0}) EXPECT_EQ(learned_of(codes, 0).depth_arithmetic, in_float) << codes;
  EXPECT_EQ(learned_of(1000, 512).depth_arithmetic, in_float_from_origin);
  const C stepped = learned(std::make_unique<Altered>(pipeline::make_pipeline(), [](Capture& c) {
    for (int x = 0; c.planes.depth.width() >= 2048 && x < 2048; ++x) {
      for (int y = 0; y < c.planes.depth.height(); ++y) c.planes.depth(x, y) += (x / 4) / 16777215.0;
    }
  }));
  EXPECT_EQ(stepped.depth_arithmetic, in_float_stepped);
  OfAlteredScenes of_edges;
  of_edges.after = [](const Scene& scene, Capture& c) {
    if (scene.frame.width != 512 || scene.meshes[0].triangles.size() != 1) return;
    for (double& z : c.planes.depth.values()) z += 3e4 / 16777215;
  };
  EXPECT_EQ(learn(of_edges).conventions.depth_arithmetic, in_float_stepped_edges) << "a sliver's depths are far off";
  for (const auto& [codes, least_side] : {std::pair(1000.0, 0), std::pair(1e7, 512)}) {
    const C wrong = learned_of(codes, least_side);
    EXPECT_EQ(wrong.depth_arithmetic, in_float_from_origin) << "none fits: attributes are held to the widest";
    EXPECT_TRUE(std::ranges::any_of(wrong.unexplained,
                                    [](const std::string& line) { return line.starts_with("depth_arithmetic: "); }));
  }
  const C unseen =
      learned(std::make_unique<Altered>(pipeline::make_pipeline(), [](Capture& c) { c.planes.depth = {}; }));
  EXPECT_EQ(unseen.depth_arithmetic, in_float_from_origin) << "open, and as wide as can be";
  EXPECT_NE(std::ranges::find(unseen.open, "depth_arithmetic"), unseen.open.end());
  const C none = learned_of(std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_NE(std::ranges::find(none.open, "depth_arithmetic"), none.open.end());
}

// Depths of a steep view go by c - k / w, 1/w a float; or are wrong by more than that.
TEST(LearnDepths, OfInvWAreFound) {
  const auto learned_of = [](double factor, double codes) {
    OfAlteredScenes renderer;
    renderer.after = [=](const Scene& scene, Capture& c) {
      const auto* view = std::get_if<Perspective>(&scene.projection);
      const double of_zero = view != nullptr ? view->far / (view->far - view->near) : 0;
      for (double& z : c.planes.depth.values()) {
        if (scene.name.starts_with("probe/depth_of") && z < 1) {
          const double near = view->near, inv_w = (of_zero - z) / (of_zero * near);
          z = of_zero - factor * static_cast<double>(static_cast<float>(inv_w)) * of_zero * near;
        } else if (z < 1 && scene.name.starts_with("probe/depth_arithmetic")) {
          z += codes / 16777215;
        }
      }
    };
    return learn(renderer).conventions;
  };
  EXPECT_EQ(learned(pipeline::make_pipeline()).depth_of, C::DepthOf::z);
  EXPECT_EQ(learned_of(1, 1).depth_of, C::DepthOf::inv_w);
  EXPECT_EQ(learned_of(1, 0).depth_of, C::DepthOf::inv_w) << "in double, kept in a float";
  // Beyond all roundings; and as a plane of values is in perspective.
  for (const C& none : {learned_of(1.0001, 1), learned(faulted("depth.in_perspective"))}) {
    EXPECT_EQ(none.depth_of, C::DepthOf::z);
    EXPECT_TRUE(
        std::ranges::any_of(none.unexplained, [](const std::string& line) { return line.starts_with("depth_of: "); }));
  }
}

// A clipper that drops what lies in the near half of the depths, as Direct3D's does by OpenGL's matrices.
TEST(LearnDepths, AreThoseOfWhatIsDrawn) {
  const auto learned_of = [](float most_lost) {
    OfAlteredScenes renderer;
    renderer.before = [=](Scene& scene) {
      if (!std::holds_alternative<Orthographic>(scene.projection) || scene.meshes.empty()) return;
      std::erase_if(scene.meshes[0].triangles, [&](const glm::uvec3& t) {
        const std::vector<glm::vec3>& p = scene.meshes[0].positions;
        return -std::min({p[t.x].z, p[t.y].z, p[t.z].z}) < most_lost;
      });
    };
    return learn(renderer);
  };
  const Learned found = learned_of(0.5f);
  EXPECT_EQ(found.conventions.depth_range, C::DepthRange::zero_to_one);
  EXPECT_TRUE(std::ranges::count(found.conventions.unexplained, "rectangles at depth 0.125, 0.25 are not drawn"))
      << fmt::format("{}", fmt::join(found.conventions.unexplained, "\n"));
  EXPECT_FALSE(std::ranges::count(found.conventions.open, "depth_format"));
  EXPECT_TRUE(std::ranges::count(found.conventions.open, "depth_rounding")) << "half of the depths tell it";
  const Learned two = learned_of(0.6f);
  EXPECT_TRUE(std::ranges::count(two.conventions.open, "depth_range")) << "two depths tell no range";
}

// (unsigned)(z * 16777215.0f + 0.5f): from 1/2 on the product is a whole number, and the sum the even one beside it.
TEST(LearnDepths, ARoundingThatFloatsHideAt24BitsIsThatOf16) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) { scene.frame.depth = DepthFormat::z32f; };
  renderer.after = [](const Scene& scene, Capture& c) {
    const float codes = scene.frame.depth == DepthFormat::z16 ? 65535.0f : 16777215.0f;
    for (double& z : c.planes.depth.values())
      z = std::floor(static_cast<float>(z) * codes + 0.5f) / static_cast<double>(codes);
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.depth_rounding, C::Rounding::nearest);
  EXPECT_EQ(found.depth_format, C::Depth::as_asked);
  EXPECT_FALSE(std::ranges::count(found.open, "depth_rounding"));
}

}  // namespace
}  // namespace plumbline::learn
