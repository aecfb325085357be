// Known faults that may explain a frame: not those that the renderer's conventions contradict.
#include "cli/likely/known_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/suite.h"

namespace plumbline::cli {
namespace {

bool is_known(const std::string& fault, const Conventions& conventions) {
  GivenFrame given;
  given.conventions = conventions;
  const std::vector<KnownFault> known = known_faults(suite_scene("cull/both_windings"), given);
  return std::ranges::find(known, fault, &KnownFault::name) != known.end();
}

TEST(KnownFaults, AreNoneOfRowsAndDepthRangesThatConventionsTell) {
  Conventions learned, open;
  open.open = {"rows", "depth_range"};
  for (const char* fault : {"file.rows_reversed", "window.y_flipped", "file.depth_of_ndc", "file.depth_reversed"}) {
    EXPECT_FALSE(is_known(fault, learned)) << fault;
    EXPECT_TRUE(is_known(fault, open)) << fault;
    EXPECT_TRUE(is_known(fault, undeclared())) << fault;
  }
  EXPECT_TRUE(is_known("file.mirrored", learned));
  open.open = {"rows"};
  EXPECT_FALSE(is_known("file.depth_reversed", open));
}

}  // namespace
}  // namespace plumbline::cli
