// Renderers that crash, hang, take all memory or throw: a row each, and everything else is judged.
#include <algorithm>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/run_plumb.h"
#include "tests/sanitizer.h"

namespace plumbline {
namespace {

const std::string kWindings = kScenes + "cull/both_windings.json";

class FailingRenderers : public Cli {};

// AddressSanitizer's new ends the process instead of throwing.
bool can_show(std::string_view ending) { return !kAddressSanitizer || ending != "memory"; }

// Limits of a run [s]: a hang is to end soon, all else may take its time on a busy machine.
const std::string kHangs = kAddressSanitizer ? "30" : "4";
std::string limits_of(const std::string& ending) {
  return " --time-limit " + (ending == "hang" ? kHangs : "60") + " --memory-limit 512";
}

TEST_F(FailingRenderers, AreRowsWithTheStageThatWasRunning) {
  const std::pair<const char*, std::string> kEndings[] = {
      {"throw", "vertex: a vertex too many"},
      {"memory", "light: took more memory than a worker may have"},
      {"crash", "clip: was killed by signal 11 (Segmentation fault)"},
      {"hang", "window: took longer than " + kHangs + "s and was killed"}};
  for (const auto& [fault, says] : kEndings) {
    if (!can_show(fault)) continue;
    const std::string limits = " --against exact" + limits_of(fault) + " ";
    const Outcome check = plumb("check " + kWindings + limits + "--fault endings." + fault + " --json " + at("c.json"));
    EXPECT_EQ(check.code, 1) << check.text;
    EXPECT_TRUE(check.says("failed cull/both_windings: ours, " + says)) << check.text;
    EXPECT_TRUE(check.says("repeat: ") && check.says(limits_of(fault))) << check.text;
    EXPECT_NE(test::text_of(at("c.json")).find("\"failed\""), std::string::npos) << "the run is written all the same";
    const Outcome diagnosis = plumb("diagnose " + kWindings + limits + "--fault endings." + fault);
    EXPECT_EQ(diagnosis.code, 1) << diagnosis.text;
    const std::string stage = says.substr(0, says.find(':'));
    EXPECT_TRUE(diagnosis.says("first different stage: " + stage + " (failed)")) << diagnosis.text;
    EXPECT_TRUE(diagnosis.says("wrong by itself: " + stage + "\n")) << diagnosis.text;
  }
}

// A reference that cannot be made is its own row; the others judge.
TEST_F(FailingRenderers, MayLackMemoryFromTheirStartOn) {
  const std::string two = kWindings + " " + kScenes + "scissor/windows.json";
  // AddressSanitizer holds freed memory back, which would count; libLLVM alone is larger than 64 MiB.
  const std::string environment = kAddressSanitizer ? "ASAN_OPTIONS=\"$ASAN_OPTIONS:quarantine_size_mb=0\" " : "";
  const Outcome run = shell(environment + PLUMBLINE_PLUMB " check " + two + " --memory-limit 64");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("failed cull/both_windings: " + kOpenGl + ", merge: ")) << run.text;
  EXPECT_TRUE(run.says("failed scissor/windows: " + kOpenGl + ", merge: ")) << run.text;
  EXPECT_TRUE(run.says(": while it was made")) << run.text;
  EXPECT_TRUE(run.says("exact, per stage         matrices   ") || run.says("exact, per stage         window     "))
      << run.text;
}

TEST_F(FailingRenderers, AreJudgedUpToTheStageThatFails) {
  const Outcome run = plumb("check " + kWindings + " --against exact --fault endings.crash");
  EXPECT_TRUE(run.says("exact, per stage         light      equal")) << run.text;
  EXPECT_TRUE(run.says("exact, per stage         8 stages   unsupported")) << run.text;
  EXPECT_TRUE(
      run.says("clip, window, coverage, depth, attributes, shade, visibility, merge (ours failed at stage clip)"))
      << run.text;
}

TEST_F(FailingRenderers, LeaveTheOtherScenesAlone) {
  const std::string two = kWindings + " " + kScenes + "scissor/windows.json";
  const Outcome run = plumb("check " + two + " --against exact --fault endings.crash --jobs 2");
  EXPECT_EQ(run.code, 1);
  EXPECT_TRUE(run.says("failed cull/both_windings: ours, clip: ")) << run.text;
  EXPECT_TRUE(run.says("failed scissor/windows: ours, clip: ")) << run.text;
  EXPECT_TRUE(run.says("FAILED: 2 scenes")) << run.text;
}

// One of 50 scenes fails, in one row; a reference that ends its worker takes no other scene with it.
TEST_F(FailingRenderers, FailOneSceneOfARun) {
  std::vector<fs::path> scenes;
  for (const char* group : {"coverage", "cull", "scissor", "depth", "masks", "stencil"}) {
    for (const auto& file : fs::directory_iterator(kScenes + group)) {
      const std::string name = file.path().filename();
      const bool takes_seconds = name == "large.json" || name == "soup.json" || name == "subpixel_grid.json";
      if (name.ends_with(".json") && !name.ends_with(".part.json") && !takes_seconds) scenes.push_back(file.path());
    }
  }
  std::ranges::sort(scenes);
  std::erase(scenes, fs::path(kWindings));
  ASSERT_GE(scenes.size(), 48u);
  scenes.resize(48);
  scenes.insert(scenes.begin() + 24, kWindings);
  scenes.push_back(kScenes + "blend/factors.json");
  std::string run = "check";
  for (const fs::path& scene : scenes) run += " " + scene.string();
  run += " --against exact,image_order --json " + at("run.json");
  const std::pair<const char*, std::string> kEndings[] = {{"throw", "a scene too many"},
                                                          {"memory", "took more memory than a worker may have"},
                                                          {"crash", "was killed by signal 11 (Segmentation fault)"},
                                                          {"exit", "ended its process with status 0"},
                                                          {"hang", "took longer than " + kHangs + "s and was killed"}};
  for (const auto& [how, says] : kEndings) {
    if (!can_show(how)) continue;
    const Outcome check = plumb(run + limits_of(how) + " --fault endings." + how + ":image_order:cull/both_windings");
    EXPECT_EQ(check.code, 1) << check.text;
    EXPECT_TRUE(check.says("FAILED: 50 scenes, ") && check.says(", 1 failed")) << check.text;
    EXPECT_TRUE(check.says("failed cull/both_windings: image_order, merge: ")) << check.text;
    EXPECT_TRUE(check.says(says)) << check.text;
    std::set<std::string> judged, failed;
    std::size_t failed_rows = 0;
    const auto json = nlohmann::json::parse(test::text_of(at("run.json")));
    for (const auto& row : json.at("comparisons")) {
      const bool fails = row.at("outcome") == "failed";
      failed_rows += fails ? 1 : 0;
      if (fails) failed.insert(row.at("scene"));
      if (row.at("outcome") == "equal" || row.at("outcome") == "within") judged.insert(row.at("scene"));
    }
    std::erase_if(judged, [&](const std::string& scene) { return failed.contains(scene); });
    EXPECT_EQ(judged.size(), 49u) << how;
    EXPECT_EQ(failed, std::set<std::string>{"cull/both_windings"}) << how;
    EXPECT_EQ(failed_rows, 1u) << how;
  }
}

}  // namespace
}  // namespace plumbline
