// Every fault is caught, and its stage named, on the scenes of the suite: as the first stage that differs, and as the
// one stage that is wrong by itself.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "check/judge.h"
#include "faults/faults.h"
#include "pipeline/pipeline_renderer.h"
#include "reference/exact/exact.h"
#include "scene/scene_file.h"

namespace plumbline {

namespace faults {
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }
}  // namespace faults

namespace {

// All but the big models.
const std::vector<Scene>& scenes() {
  static const std::vector<Scene> kScenes = [] {
    const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
    std::vector<Scene> out;
    for (const auto& file : find_scenes(folder)) {
      if (file.parent_path().stem() != "models") out.push_back(load_scene(file, {}));
    }
    return out;
  }();
  return kScenes;
}

bool same_picture(const pipeline::Frame& a, const pipeline::Frame& b) {
  const auto same = [&](auto plane) { return (a.*plane).values() == (b.*plane).values(); };
  using F = pipeline::Frame;
  return same(&F::color_rgba8) && same(&F::color_rgba12) && same(&F::color_rgba16) && same(&F::color_rgba32f) &&
         same(&F::depth_code) && same(&F::depth_z32f) && same(&F::stencil);
}

class Faults : public testing::TestWithParam<faults::Fault> {};

TEST_P(Faults, is_caught_and_its_stage_named) {
  const faults::Fault fault = GetParam();
  const auto candidate = pipeline::make_pipeline(fault.stages());
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  const pipeline::Stages stages = fault.stages();
  // The gradients of stage 8 are taken where attributes are.
  const auto may_be_wrong_too = [&](Stage stage) {
    return stage == fault.stage || (fault.name == "attributes.of_sample" && stage == Stage::texture);
  };
  int caught = 0;
  for (const Scene& scene : scenes()) {
    if (same_picture(pipeline::render(scene, stages), pipeline::render(scene))) continue;
    const check::SceneVerdict verdict = check::judge(scene, *candidate, references);
    const check::Comparison* first = check::first_different(verdict);
    if (first == nullptr) continue;  // a scene that the fault does not affect
    ++caught;
    EXPECT_EQ(name_of(first->stage), name_of(fault.stage)) << scene.name << ", against " << first->reference;
    for (const check::Comparison& c : verdict.comparisons) {
      EXPECT_NE(c.outcome, check::Outcome::failed) << c.note;
      if (c.reference == "exact from its records" && c.outcome == check::Outcome::different) {
        EXPECT_TRUE(may_be_wrong_too(c.stage)) << scene.name << ": " << name_of(c.stage) << " is not wrong by itself";
      }
    }
  }
  EXPECT_GT(caught, 0);
}

INSTANTIATE_TEST_SUITE_P(all, Faults, testing::ValuesIn(faults::of_stages().begin(), faults::of_stages().end()),
                         [](const auto& fault) {
                           std::string name(fault.param.name);
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

TEST(Faults, there_are_five_in_each_stage_and_twenty_that_others_report) {
  std::map<Stage, int> count;
  std::set<std::string_view> names;
  int reported = 0;
  for (const faults::Fault& fault : faults::of_stages()) {
    ++count[fault.stage];
    names.insert(fault.name);
    reported += fault.report.empty() ? 0 : 1;
    EXPECT_TRUE(std::string(fault.name).starts_with(name_of(fault.stage))) << fault.name;
  }
  EXPECT_GE(names.size(), 80u);
  EXPECT_EQ(names.size(), faults::of_stages().size()) << "two of one name";
  EXPECT_GE(reported, 20);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) EXPECT_GE(count[static_cast<Stage>(i)], 5) << kStageNames[i];
}

TEST(Faults, production_is_not_caught) {
  const auto candidate = pipeline::make_pipeline();
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  for (const Scene& scene : scenes()) {
    EXPECT_EQ(check::first_different(check::judge(scene, *candidate, references)), nullptr) << scene.name;
  }
}

}  // namespace
}  // namespace plumbline
