// A run in which no reference judges anything does not hold.
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

const std::string kLines = kScenes + "lines/beneath_points.json";  // no ray meets a line or a point

TEST_F(Cli, ARunThatJudgesNothingEnds2) {
  for (const std::string& by : {std::string(), std::string(" --fault merge.blue_first")}) {
    const Outcome run = plumb("check " + kLines + " --against embree" + by);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says("nothing was judged: 1 scenes")) << run.text;
    EXPECT_TRUE(run.says("expected a scene that a reference can judge, found none")) << run.text;
  }
  EXPECT_EQ(plumb("check " + kLines + " " + kSharedEdges + " --against embree").code, 0) << "one of two is judged";

  const Outcome diagnosis = plumb("diagnose " + kLines + " --against embree");
  EXPECT_EQ(diagnosis.code, 2) << diagnosis.text;
  EXPECT_TRUE(diagnosis.says(kLines + ": expected a stage that can be judged, found 0 of 13 stages judged"))
      << diagnosis.text;
}

}  // namespace
}  // namespace plumbline
