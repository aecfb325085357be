// Legal variants raise nothing: scenes stated otherwise, and pipelines that work otherwise, against exact.
#include <gtest/gtest.h>

#include "capture/files/capture_folder.h"
#include "check/judge/judge.h"
#include "check/judge/judge_records.h"
#include "matrix/legal.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "tests/suite.h"

namespace plumbline {

namespace faults {
void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }
}  // namespace faults

namespace {

bool same_picture(const pipeline::Frame& a, const pipeline::Frame& b) {
  const auto same = [&](auto plane) { return (a.*plane).values() == (b.*plane).values(); };
  using F = pipeline::Frame;
  return same(&F::color_rgba8) && same(&F::color_rgba16) && same(&F::color_rgba32f) && same(&F::depth_code) &&
         same(&F::depth_z32f) && same(&F::stencil);
}

class LegalVariants : public testing::TestWithParam<faults::Variant> {};

// Each variant on two scenes that it applies to, not all on the same ones. (The fault matrix takes more.)
TEST_P(LegalVariants, RaisesNothing) {
  const faults::Variant& variant = GetParam();
  pipeline::Stages stages = pipeline::production_stages();
  if (variant.apply != nullptr) variant.apply(stages);
  const auto candidate = pipeline::make_pipeline(stages);
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  const std::vector<Scene>& scenes = suite_scenes();
  std::size_t next = 7 * variant.name.size();
  int judged = 0;
  for (std::size_t i = 0; i < scenes.size() && judged < 2; ++i) {
    const Scene& scene = scenes[(next += 1009) % scenes.size()];  // a prime: each comes once
    const std::optional<Scene> said = variant.scene != nullptr ? variant.scene(scene) : scene;
    if (!said) continue;
    ++judged;
    if (variant.same_bits) {
      EXPECT_TRUE(same_picture(pipeline::render(*said, stages), pipeline::render(scene))) << scene.name;
    }
    for (const check::Comparison& c : check::judge(*said, *candidate, references).comparisons) {
      EXPECT_FALSE(check::is_failure(c.outcome)) << scene.name << ": " << name_of(c.stage) << ", " << title_of(c.judge);
    }
  }
  EXPECT_GT(judged, 0);
}

INSTANTIATE_TEST_SUITE_P(all, LegalVariants,
                         testing::ValuesIn(faults::legal_variants().begin(), faults::legal_variants().end()),
                         [](const auto& variant) { return std::string(variant.param.name); });

TEST(LegalVariants, WhatAFolderHoldsIsJudgedAsWhatWasDrawn) {
  const Scene scene = suite_scene("clip/behind_eye");
  const auto ours = pipeline::make_pipeline();
  const auto exact = exact::make_exact();
  Request request;
  request.records = StageSet::all();
  const auto folder = std::filesystem::path(testing::TempDir()) / "legal_variants_capture";
  write_capture(ours->capture(scene, request), folder);
  const std::vector<check::Comparison> rows = check::judge_records(scene, read_capture(folder), *exact);
  std::filesystem::remove_all(folder);
  EXPECT_GT(rows.size(), 8u);
  for (const check::Comparison& c : rows) EXPECT_FALSE(check::is_failure(c.outcome)) << name_of(c.stage);
}

}  // namespace
}  // namespace plumbline
