// Knowledge about a frame that is to be explained: legal pixels, and stages that are right or wrong.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "cli/likely/lookalikes.h"

namespace plumbline::cli {
namespace {

check::Comparison row(const check::JudgeId& judge, Stage stage, std::vector<glm::ivec2> wrong,
                      std::uint64_t differing) {
  check::Measurement m;
  m.unit = "bound", m.items = 100, m.differing = differing, m.max_difference = m.max_ratio = differing > 0 ? 2 : 0;
  m.differing_at = std::move(wrong);
  return check::judged("scene", judge, stage, std::move(m));
}

TEST(FrameOf, RightStagesAreThoseThatRowsFindRight) {
  const check::JudgeId exact("exact", check::Kind::per_stage), embree("embree", check::Kind::legal);
  Capture left;
  left.planes.color = Plane<glm::vec4>(4, 2, glm::vec4(0));
  RendererInfo renderer;
  renderer[Stage::matrices].given = true;
  std::vector<check::Comparison> rows = {row(exact, Stage::window, {}, 0), row(exact, Stage::coverage, {}, 0),
                                         row(embree, Stage::coverage, {{1, 0}}, 1), row(exact, Stage::merge, {}, 0)};
  const auto right = [&] { return frame_of(left, renderer, {"scene", "scene.json", rows}).right; };
  EXPECT_EQ(right(), (StageSet{Stage::matrices, Stage::window}));
  rows.push_back(row(exact, Stage::depth, {{1, 0}}, 1));
  EXPECT_EQ(right(), (StageSet{Stage::matrices, Stage::window, Stage::coverage, Stage::merge}));
  EXPECT_EQ(frame_of(left, renderer, {"scene", "scene.json", rows}).wrong, StageSet{Stage::depth});
}

TEST(FrameOf, LegalPixelsAreThoseThatNoRowOfLegalAnswersFindsWrong) {
  Capture left;
  left.planes.color = Plane<glm::vec4>(4, 2, glm::vec4(0));
  left.planes.depth = Plane<double>(4, 2, 1.0);
  const check::JudgeId embree("embree", check::Kind::legal), osmesa("osmesa");
  const auto legal = [&](std::vector<check::Comparison> rows) {
    return frame_of(left, {}, {"scene", "scene.json", std::move(rows)}).is_legal;
  };
  const Plane<std::uint8_t> two = legal({row(embree, Stage::merge, {{1, 0}}, 1), row(embree, Stage::depth, {{2, 1}}, 1),
                                         row(osmesa, Stage::merge, {{3, 1}}, 1)});
  ASSERT_EQ(two.size(), 8u);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(two.values()[static_cast<std::size_t>(i)], i == 1 || i == 6 ? 0 : 1) << i;
  EXPECT_TRUE(legal({row(embree, Stage::merge, {{1, 0}}, 2)}).empty()) << "not all pixels are told";
  EXPECT_TRUE(legal({row(osmesa, Stage::merge, {{1, 0}}, 1)}).empty()) << "nobody knows what is legal";
  EXPECT_TRUE(legal({row(embree, Stage::depth, {{1, 0}}, 1)}).empty()) << "of colours nobody";
  EXPECT_TRUE(legal({row(embree, Stage::merge, {}, 0)}).empty()) << "nothing is wrong";
}

}  // namespace
}  // namespace plumbline::cli
