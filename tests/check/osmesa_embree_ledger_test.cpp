// The 4x rule: over the whole suite, each tolerance is used, holds, and is at most four times what was seen, or says
// why.
#include <gtest/gtest.h>

#include "check/judge.h"
#include "pipeline/pipeline_renderer.h"
#include "reference/embree/embree.h"
#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "scene/scene_file.h"

namespace plumbline {
namespace {

TEST(Ledger, every_row_is_used_and_holds_and_is_not_loose) {
  const auto ours = pipeline::make_pipeline();
  const auto osmesa = make_osmesa();
  const auto embree = embree::make_embree();
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"osmesa", osmesa.get()}, {"embree", embree.get()}, {"exact", exact.get()}};
  const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
  std::vector<check::SceneVerdict> verdicts;
  for (const auto& file : find_scenes(folder))
    verdicts.push_back(check::judge(load_scene(file, {}), *ours, references));
  for (const check::LedgerUse& use : check::ledger_use(verdicts)) {
    ASSERT_GE(use.largest_ratio, 0) << use.row->name << ": no comparison uses the row";
    EXPECT_LE(use.largest_ratio, 1) << use.row->name << ": " << use.where;
    if (use.row->loose_because.empty()) {
      EXPECT_GE(use.largest_ratio, 0.25) << use.row->name << ": looser than four times what was seen, " << use.where;
    } else {
      EXPECT_LT(use.largest_ratio, 0.5) << use.row->name << ": it is not loose, the excuse can go";
    }
  }
}

}  // namespace
}  // namespace plumbline
