// The notes' mistakes as pictures: each is caught and its stage named, what it does to a picture is counted, and where
// it is none, under its own dialect's conventions, nothing is said.
#include <gtest/gtest.h>

#include <map>

#include "check/judge.h"
#include "faults/notes.h"
#include "pipeline/pipeline_renderer.h"
#include "reference/exact/exact.h"
#include "scene/scene_file.h"

namespace plumbline {

namespace faults {
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }
}  // namespace faults

namespace {

const std::filesystem::path kFolder = PLUMBLINE_SOURCE_DIR "/tests/scenes/notes";

/// By the file's name, without its ending.
const std::map<std::string, Scene>& scenes() {
  static const std::map<std::string, Scene> kScenes = [] {
    const std::filesystem::path folder[] = {kFolder};
    std::map<std::string, Scene> out;
    for (const auto& file : find_scenes(folder)) out.emplace(file.stem(), load_scene(file, {}));
    return out;
  }();
  return kScenes;
}

check::SceneVerdict judged(const Scene& scene, const pipeline::Stages& stages) {
  const auto candidate = pipeline::make_pipeline(stages);
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  return check::judge(scene, *candidate, references);
}

class NotesFaults : public testing::TestWithParam<faults::Fault> {};

TEST_P(NotesFaults, is_caught_and_its_stage_named) {
  const faults::Fault fault = GetParam();
  int caught = 0;
  for (const auto& [name, scene] : scenes()) {
    const check::SceneVerdict verdict = judged(scene, fault.stages());
    const check::Comparison* first = check::first_different(verdict);
    if (first == nullptr) continue;
    ++caught;
    EXPECT_EQ(name_of(first->stage), name_of(fault.stage)) << name << ", against " << first->reference;
    for (const check::Comparison& c : verdict.comparisons) {
      EXPECT_NE(c.outcome, check::Outcome::failed) << c.note;
      if (c.reference == "exact from its records" && c.outcome == check::Outcome::different) {
        EXPECT_EQ(name_of(c.stage), name_of(fault.stage)) << name << ": not wrong by itself";
      }
    }
  }
  EXPECT_GT(caught, 0);
}

INSTANTIATE_TEST_SUITE_P(all, NotesFaults, testing::ValuesIn(faults::of_notes().begin(), faults::of_notes().end()),
                         [](const auto& fault) {
                           std::string name(fault.param.name);
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace plumbline
