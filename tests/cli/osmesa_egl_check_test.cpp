// Both of Mesa's libraries in one run of the program: the one that is not the default is in a process of its own.
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

TEST_F(Cli, OsmesaAndEglAndSoftpipeVoteInOneRun) {
  const std::string scene = kScenes + "clip/each_plane.json";
  const Outcome run = plumb("check " + scene + " --against exact,softpipe,egl,osmesa");
  EXPECT_EQ(run.code, 0) << run.text;
  const std::size_t osmesa = run.text.find(" osmesa "), egl = run.text.find(" egl "),
                    softpipe = run.text.find(" softpipe ");
  EXPECT_LT(osmesa, egl) << run.text;
  EXPECT_LT(egl, softpipe) << run.text;
  EXPECT_LT(softpipe, run.text.find(" exact, from scene ")) << run.text;
}

// The child process hands on the reason.
TEST_F(Cli, EglAndSoftpipeSayWhyASceneIsUnsupported) {
  const Outcome run = plumb("check " + kScenes + "polygon_mode/clipped.json --against egl,softpipe,exact");
  EXPECT_EQ(run.code, 0) << run.text;
  for (const char* name : {" egl  ", " softpipe  "}) {
    const std::size_t row = run.text.find(name);
    ASSERT_NE(row, std::string::npos) << run.text;
    const std::string line = run.text.substr(row, run.text.find('\n', row) - row);
    EXPECT_NE(line.find("unsupported"), std::string::npos) << line;
    EXPECT_NE(line.find("Mesa draws no edges where the view volume cuts"), std::string::npos) << line;
  }
}

// Unlike softpipe, it shows every stage that osmesa does.
TEST_F(Cli, EglIsListedWithItsStages) {
  const std::string text = plumb("list renderers").text;
  const auto stages = [&](const std::string& name) {
    const std::size_t from = text.find('\n', text.find("\n" + name + " (") + 1) + 1;
    return text.substr(from, text.find("\n", text.find("merge", from)) - from);
  };
  EXPECT_EQ(stages("egl"), stages("osmesa")) << text;
  EXPECT_NE(stages("egl"), stages("softpipe")) << text;
}

// libglvnd looks for EGL's libraries in the folder that the variable names.
TEST_F(Cli, EglIsListedAsNotUsableWhereItsProcessFails) {
  ::setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
  const Outcome run = plumb("list renderers");
  ::unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_NE(run.text.find("\negl: built in, and not usable here, install libgl1-mesa-dri: "), std::string::npos)
      << run.text;
  EXPECT_EQ(run.text.find("\negl ("), std::string::npos) << run.text;
  EXPECT_NE(run.text.find("\nosmesa ("), std::string::npos) << run.text;
}

TEST_F(Cli, EglIsListedAsNotUsableWithoutATemporaryFolder) {
  ::setenv("TMPDIR", "/proc", 1);  // where root makes no folder either
  const Outcome run = plumb("list renderers");
  ::unsetenv("TMPDIR");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_NE(run.text.find("\negl: built in, and not usable here: /proc: expected a folder"), std::string::npos)
      << run.text;
  EXPECT_NE(run.text.find("\nosmesa ("), std::string::npos) << run.text;
}

TEST_F(Cli, AReferenceWithoutATemporaryFolderIsBadInput) {
  ::setenv("TMPDIR", "/proc", 1);  // where root makes no folder either
  for (const std::string& line : {kScenes + "frame/one_pixel.json --against egl,softpipe",
                                  kScenes + "frame/one_pixel.json --program 'true {scene} {output}'"}) {
    for (const char* command : {"check ", "diagnose "}) {
      const Outcome run = plumb(command + line);
      EXPECT_EQ(run.code, 2) << run.text;
      EXPECT_NE(run.text.find("/proc: expected a folder for temporary files, in which"), std::string::npos) << run.text;
    }
  }
  ::unsetenv("TMPDIR");
}

}  // namespace
}  // namespace plumbline
