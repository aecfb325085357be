// Grids and edges that plumb learn finds.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "capture/files/conventions_file.h"
#include "kernels/coverage.h"
#include "pipeline/stages.h"
#include "tests/learn/altered_renderers.h"

namespace plumbline::learn {
namespace {

// Colours between two codes tell the corners, however colours are rounded to codes: here those of a frame of floats.
TEST(LearnEdges, CornersOfAttributesAreFoundUnderEachRounding) {
  for (const C::Rounding rounding : {C::Rounding::nearest, C::Rounding::down, C::Rounding::up}) {
    OfAlteredScenes renderer;
    renderer.before = [](Scene& scene) { scene.frame.color = ColorFormat::rgba32f; };
    renderer.after = [=](const Scene&, Capture& c) {
      for (glm::vec4& color : c.planes.color.values()) {
        for (int k = 0; k < 4; ++k)
          color[k] =
              static_cast<float>(rounded(rounding, 255.0 * std::clamp(static_cast<double>(color[k]), 0.0, 1.0)) / 255);
      }
    };
    const C found = learn(renderer).conventions;
    EXPECT_EQ(found.color_rounding, rounding);
    EXPECT_EQ(found.attribute_corners, C::Corners::as_they_are);
    EXPECT_FALSE(std::ranges::count(found.open, "attribute_corners")) << conventions_text(found);
  }
}

// Model space is the window. Where y points down, positions are rounded one way in x and the other in y; no convention
// says that they are rounded to the nearest in one of the two alone.
TEST(LearnEdges, AGridOfWholePixelsIsFoundWithItsRounding) {
  const auto learned_of = [](auto x, auto y) {
    OfAlteredScenes renderer;
    renderer.before = [=](Scene& scene) {
      for (Mesh& mesh : scene.meshes) {
        for (glm::vec3& p : mesh.positions) p.x = x(p.x), p.y = y(p.y);
      }
    };
    return learn(renderer).conventions;
  };
  const auto down = [](float v) { return std::floor(v); };
  const auto up = [](float v) { return std::ceil(v); };
  const auto nearest = [](float v) { return std::nearbyint(v); };
  const C floored = learned_of(down, down), raised = learned_of(up, up), rounded = learned_of(nearest, nearest);
  for (const C& c : {floored, raised, rounded}) {
    EXPECT_EQ(c.subpixel_bits, 0);
    EXPECT_EQ(c.sample, glm::dvec2(0.5));
    EXPECT_EQ(c.attribute_corners, C::Corners::snapped) << "attributes go by the moved positions";
    EXPECT_EQ(c.depth_corners, C::DepthCorners::snapped) << "depths go by the moved positions";
    EXPECT_EQ(c.tie_rule, C::TieRule::left_bottom) << "diagonals pass through centres";
  }
  EXPECT_EQ(floored.subpixel_rounding, C::Rounding::down);
  EXPECT_EQ(raised.subpixel_rounding, C::Rounding::up);
  EXPECT_EQ(rounded.subpixel_rounding, C::Rounding::nearest);
  EXPECT_EQ(floored.window_y, C::WindowY::up);
  for (const C& c : {learned_of(down, up), learned_of(up, down)}) {
    EXPECT_EQ(c.subpixel_bits, 0);
    EXPECT_EQ(c.window_y, C::WindowY::down);
    EXPECT_EQ(c.tie_rule, C::TieRule::left_bottom);
  }
  EXPECT_EQ(learned_of(down, up).subpixel_rounding, C::Rounding::down);
  EXPECT_EQ(learned_of(up, down).subpixel_rounding, C::Rounding::up);
  const C mixed = learned_of(down, nearest);
  EXPECT_TRUE(std::ranges::any_of(mixed.unexplained,
                                  [](const std::string& says) { return says.find("one grid in x") != says.npos; }));
}

// Integers as corners and as samples, as scan converters of courses have them: y up, and y down with rows from the top,
// whose samples are their pixels' upper left corners.
TEST(LearnEdges, ASampleAtAWholePixelsBorderIsFound) {
  for (const bool is_down : {false, true}) {
    OfAlteredScenes renderer;
    renderer.before = [=](Scene& scene) {
      for (Mesh& mesh : scene.meshes) {
        for (glm::vec3& p : mesh.positions) {
          const float y = is_down ? static_cast<float>(scene.frame.height) - p.y : p.y;
          p.x = std::nearbyint(p.x), p.y = std::nearbyint(y);
        }
      }
      scene.frame.pass.shift += 0.5;
    };
    renderer.after = [=](const Scene&, Capture& c) {
      const Planes was = c.planes;
      for (int y = 0; is_down && y < c.height; ++y) {
        for (int x = 0; x < c.width; ++x) {
          c.planes.color(x, y) = was.color(x, c.height - 1 - y);
          c.planes.depth(x, y) = was.depth(x, c.height - 1 - y);
        }
      }
    };
    const C found = learn(renderer).conventions;
    EXPECT_EQ(found.subpixel_bits, 0);
    EXPECT_EQ(found.sample, glm::dvec2(0, is_down ? 1 : 0)) << conventions_text(found);
    EXPECT_EQ(found.tie_rule, is_down ? C::TieRule::left_top : C::TieRule::left_bottom);
  }
}

// A sample at a pixel's corner lies on the frame's sides, where probes begin and end: a tie rule may take it from them.
TEST(LearnEdges, ASampleAtACornerIsFoundWhateverTheTieRule) {
  OfAlteredScenes renderer(faulted("coverage.top_for_bottom"));
  renderer.before = [](Scene& scene) { scene.frame.pass.shift += 0.5; };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.sample, glm::dvec2(0));
  EXPECT_EQ(found.tie_rule, C::TieRule::left_top);
}

// Samples on the lower side of one strip of triangles are no samples of the strip below.
TEST(LearnEdges, AWholePixelsBorderIsFoundUnderEachTieRule) {
  for (const auto& [fault, rule] : {std::pair("coverage.inclusive_edges", C::TieRule::inclusive),
                                    std::pair("coverage.top_for_bottom", C::TieRule::left_top)}) {
    for (const double shift : {0.5, -0.5}) {
      OfAlteredScenes renderer(faulted(fault));
      renderer.before = [=](Scene& scene) {
        for (Mesh& mesh : scene.meshes) {
          for (glm::vec3& p : mesh.positions) p.x = std::nearbyint(p.x), p.y = std::nearbyint(p.y);
        }
        scene.frame.pass.shift += glm::dvec2(0.5, shift);
      };
      const C found = learn(renderer).conventions;
      EXPECT_EQ(found.subpixel_bits, 0) << fault;
      EXPECT_EQ(found.sample, glm::dvec2(0, shift > 0 ? 0 : 1)) << fault;
      EXPECT_EQ(found.tie_rule, rule) << fault;
    }
  }
}

// A tolerance of edge functions moves edges of one side as a sample off the centre would, and those of the other back.
TEST(LearnEdges, TrianglesThatReachBeyondTheirEdgesAreNoSampleOffTheCentre) {
  constexpr double kReach = 2.0 / 256;
  const auto plain = pipeline::make_pipeline();
  OfAlteredScenes renderer;
  renderer.after = [&](const Scene& scene, Capture& c) {
    if (scene.name != "probe/grid_x" && scene.name != "probe/grid_y") return;
    for (const glm::dvec2 by : {glm::dvec2(0, 1), {0, -1}, {1, 0}, {-1, 0}}) {
      Scene moved = scene;
      moved.frame.pass.shift += kReach * by;
      const Plane<glm::vec4> color = plain->capture(moved, {}).planes.color;
      for (std::size_t i = 0; i < color.size(); ++i)
        c.planes.color.values()[i] = glm::max(c.planes.color.values()[i], color.values()[i]);
    }
  };
  C expected = ours();
  expected.unexplained = {"triangles have too many samples, as if their edges lay 0.0078 pixel farther out"};
  EXPECT_EQ(conventions_text(learn(renderer).conventions), conventions_text(expected));
}

// Products in float: each corner lies up to 1/50 pixel off its place. The sample, and what follows from it, is known.
TEST(LearnEdges, ASampleIsFoundWhereEdgesScatter) {
  const auto learned_off_by = [](float most, double sample) {
    auto renderer = std::make_unique<OfAlteredScenes>();
    renderer->before = [=](Scene& scene) {
      scene.frame.pass.shift += 0.5 - sample;
      if (!scene.name.starts_with("probe/grid")) return;
      std::uint32_t state = 1;
      for (Mesh& mesh : scene.meshes) {
        for (glm::vec3& p : mesh.positions) {
          for (const int k : {0, 1}) {
            state = state * 1664525u + 1013904223u;
            p[k] += most * (static_cast<float>(state >> 8) * 0x1p-23f - 1);
          }
        }
      }
    };
    return learned(std::move(renderer));
  };
  const C found = learned_off_by(0.02f, 0.5), lost = learned_off_by(0.3f, 0.5);
  EXPECT_EQ(found.sample, glm::dvec2(0.5));
  const glm::dvec2 aside = learned_off_by(0.02f, 0.4375).sample;
  EXPECT_NEAR(aside.x, 0.4375, 0.01);
  EXPECT_NEAR(aside.y, 0.4375, 0.01);
  EXPECT_EQ(learned_off_by(0.008f, 0.004).sample, glm::dvec2(0)) << "within the scatter";
  EXPECT_EQ(found.tie_rule, C::TieRule::left_bottom);
  EXPECT_THAT(found.open, testing::IsSupersetOf({"subpixel_bits", "subpixel_rounding"}));
  EXPECT_THAT(found.open, testing::Not(testing::Contains("sample")));
  EXPECT_THAT(found.unexplained, testing::Contains(testing::HasSubstr("go by no grid: they scatter by 0.0")));
  EXPECT_THAT(lost.open, testing::Contains("sample"));
}

// A mistake at the frame's left side moves the edges of one strip in 16, in eight frames: the others are judged by.
TEST(LearnEdges, AMistakeAtTheFramesSideIsNamedBesideTheGrid) {
  Altered renderer(pipeline::make_pipeline(), [](Capture& c) {
    for (int y = 0; y < c.planes.color.height(); ++y) c.planes.color(0, y) = glm::vec4(0, 0, 0, 1);
  });
  const Learned found = learn(renderer);
  EXPECT_EQ(found.conventions.subpixel_bits, 8);
  EXPECT_EQ(found.conventions.sample, glm::dvec2(0.5));
  EXPECT_THAT(found.conventions.unexplained,
              testing::Contains(testing::HasSubstr("8 of 256 edges lie elsewhere: pixels are lost or added there")));
  OfAlteredScenes once;
  once.after = [is_first = true](const Scene& scene, Capture& c) mutable {
    if (scene.name != "probe/grid_x" || !std::exchange(is_first, false)) return;
    for (int y = 0; y < c.planes.color.height(); ++y) c.planes.color(0, y) = glm::vec4(0, 0, 0, 1);
  };
  EXPECT_THAT(learn(once).conventions.unexplained,
              testing::Contains(testing::StartsWith("1 of 256 edges lie elsewhere")));
}

TEST(LearnEdges, ASampleAtNoSixteenthOfAPixelIsInDoubt) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) { scene.frame.pass.shift += 0.5 - 225 / 256.0; };
  const Learned found = learn(renderer);
  const auto sample = std::ranges::find(found.rows, "sample", &LearnedRow::name);
  ASSERT_NE(sample, found.rows.end());
  EXPECT_EQ(sample->value, "0.8789, 0.8789");
  EXPECT_THAT(sample->evidence, testing::HasSubstr(", no multiple of 1/16 pixel: a mistake may move the edges"));
}

TEST(LearnEdges, RenderersThatDropBackFacesHaveAGrid) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    for (Draw& draw : scene.draws) draw.cull = Cull::back;
  };
  EXPECT_EQ(conventions_text(learn(renderer).conventions), conventions_text(ours()));
}

// Samples on the edge opposite a triangle's first corner are its, and those on its other edges are not.
std::vector<glm::ivec2> by_order_of_corners(const pipeline::WindowTriangle& triangle,
                                            const pipeline::PixelBounds& box) {
  pipeline::Edges edges = pipeline::edges_of(triangle);
  for (int i = 0; i < 3; ++i) {
    const bool owned = edges.step_x[i] > 0 || (edges.step_x[i] == 0 && edges.step_y[i] > 0);
    if (!owned) ++edges.at_origin[i];
    if (i != 0) --edges.at_origin[i];
  }
  return pipeline::covered_pixels(edges, pipeline::pixel_bounds(triangle), box);
}

TEST(LearnTies, OfCornersInTheirOrderAreNoRule) {
  pipeline::Stages stages = pipeline::production_stages();
  stages.coverage = by_order_of_corners;
  const C found = learned(pipeline::make_pipeline(stages));
  EXPECT_THAT(found.unexplained, testing::Contains(testing::HasSubstr("samples on a fan's edges")));
}

// Samples on an edge are its triangle's where the edge leads down or to the left. Of clockwise triangles, these are the
// other edges.
std::vector<glm::ivec2> by_direction_of_edges(const pipeline::WindowTriangle& triangle,
                                              const pipeline::PixelBounds& box) {
  pipeline::Edges edges = pipeline::edges_of(triangle);
  for (int i = 0; i < 3; ++i) {
    const bool owned = edges.step_x[i] > 0 || (edges.step_x[i] == 0 && edges.step_y[i] > 0);
    if (!triangle.front) edges.at_origin[i] += owned ? -1 : 1;
  }
  return pipeline::covered_pixels(edges, pipeline::pixel_bounds(triangle), box);
}

TEST(LearnTies, ByTheDirectionOfEdgesAreNoRule) {
  pipeline::Stages stages = pipeline::production_stages();
  stages.coverage = by_direction_of_edges;
  EXPECT_EQ(learned(pipeline::make_pipeline(stages)).tie_rule, C::TieRule::any);
}

// Pixel (37, 33) is one whose sample lies on a slanted edge, between two triangles of two frames.
TEST(LearnTies, ARuleHoldsOnSlantedEdgesTooOrNoneIsFound) {
  const auto learned_with = [](auto alter) {
    auto renderer = std::make_unique<OfAlteredScenes>();
    renderer->after = [alter](const Scene& scene, Capture& out) {
      if (scene.name.ends_with("fan")) alter(out.planes.color(37, 33));
    };
    return learned(std::move(renderer));
  };
  const glm::vec4 black(0, 0, 0, 1), white(1);
  EXPECT_EQ(learned_with([](glm::vec4&) {}).tie_rule, C::TieRule::left_bottom);
  const C other = learned_with([&](glm::vec4& color) { color = color.r > 0.5f ? black : white; });
  EXPECT_EQ(other.tie_rule, C::TieRule::any);
  EXPECT_TRUE(mistaken(other).empty());
  for (const glm::vec4& of_both : {black, white}) {
    const C wrong = learned_with([&](glm::vec4& color) { color = of_both; });
    EXPECT_FALSE(mistaken(wrong).empty()) << "a crack, or painted twice";
  }
}

}  // namespace
}  // namespace plumbline::learn
