// Runs in which nothing is judged do not hold.
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

TEST_F(Cli, AProgramsRunOfScenesThatHoldAnyFrameEnds2) {
  const std::string scene = kScenes + "clip/along_the_far_plane.json",
                    program = " --program '" PLUMBLINE_C_RENDERER " {serve}'";
  const Outcome run = plumb("check " + scene + program + " --json " + at("run.json"));
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_TRUE(run.says("nothing was judged: 1 scenes")) << run.text;
  EXPECT_TRUE(run.says("unable: a frame in which nothing is drawn holds, too 1")) << run.text;
  EXPECT_TRUE(run.says("--program: expected a scene that it draws and that can be judged, found none")) << run.text;
  EXPECT_EQ(plumb("check " + scene + " " + kSharedEdges + program).code, 0) << "one of two is judged";
  EXPECT_EQ(plumb("report " + at("run.json")).code, 2) << "as the run that it shows";
}

}  // namespace
}  // namespace plumbline
