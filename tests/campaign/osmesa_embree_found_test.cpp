// Findings of campaigns, shrunk and since fixed: nothing differs any more.
#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/campaign/scene_trial.h"
#include "tests/text_file.h"

namespace plumbline::test {
namespace {

std::vector<std::filesystem::path> found_scenes() {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::directory_iterator(PLUMBLINE_SOURCE_DIR "/tests/campaign/found"))
    out.push_back(entry.path());
  std::ranges::sort(out);
  return out;
}

TEST(Found, NothingDiffersAnyMore) {
  const auto files = found_scenes();
  EXPECT_GT(files.size(), 20u);
  for (const std::filesystem::path& file : files) {
    expect_holds(load_scene(file, with_suite_images()), "found/" + file.stem().string(), test::text_of(file));
  }
}

// A mistake of the one reference that is asked: arbiters settle it.
TEST(Found, ArbitersSettleWhatOneReferenceAloneCannot) {
  const auto ours = pipeline::make_pipeline();
  const auto opengl = make_opengl(), exact = exact::make_exact();
  const check::Reference asked[] = {{"opengl", opengl.get()}}, arbiters[] = {{"exact", exact.get()}};
  const Scene scene = load_scene(PLUMBLINE_SOURCE_DIR "/tests/campaign/found/wide_line.json", with_suite_images());
  EXPECT_NE(failures(check::judge(scene, *ours, asked)), "");
  check::BothCaptures drawn;
  const auto verdict = check::judge(scene, *ours, asked, &drawn, ~std::uint64_t{0}, arbiters);
  EXPECT_EQ(failures(verdict), "");
  for (const check::Comparison& row : verdict.comparisons) EXPECT_NE(row.judge.reference, "exact");
  EXPECT_EQ(drawn.references.size(), 1u);
}

}  // namespace
}  // namespace plumbline::test
