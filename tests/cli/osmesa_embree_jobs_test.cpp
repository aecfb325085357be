// Scenes judged at a time: what is left of them is the same.
#include <map>
#include <regex>
#include <vector>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

using Left = std::map<std::string, std::string>;  // names of files, and what they hold

std::vector<std::string> apart(const Left& a, const Left& b) {
  std::vector<std::string> out;
  for (const auto& [name, text] : a) {
    if (!b.contains(name) || b.at(name) != text) out.push_back(name);
  }
  for (const auto& [name, text] : b) {
    if (!a.contains(name)) out.push_back(name);
  }
  return out;
}

class Jobs : public Cli {
 protected:
  // Files and output that a run leaves, without times.
  Left left_by(const std::string& arguments, const std::string& jobs, int code) const {
    const fs::path to = folder_ / "run";  // the same for all: paths are printed
    fs::remove_all(to);
    fs::create_directories(to);
    std::string line = "check " + arguments + " --jobs " + jobs;
    for (const char* output : {"json", "ledger", "junit", "markdown", "rows", "failures", "report"}) {
      line += std::string(" --") + output + " " + (to / output).string();
    }
    const Outcome run = plumb(line);
    EXPECT_EQ(run.code, code) << run.text;
    test::write_text(to / "printed", run.text);
    Left out;
    static const std::regex seconds(R"re(( in |"seconds": ?|time=")[0-9][-+.e0-9]*)re");
    for (const auto& entry : fs::recursive_directory_iterator(to)) {
      if (entry.is_regular_file())
        out[entry.path().lexically_relative(to).string()] =
            std::regex_replace(test::text_of(entry.path()), seconds, "$1T");
    }
    return out;
  }
};

TEST_F(Jobs, LeaveTheSameHoweverMany) {
  const std::string scenes = kScenes + "cull " + kScenes + "merge " + kScenes + "scissor";
  const auto one = left_by(scenes, "1", 0), three = left_by(scenes, "3", 0);
  for (const char* name : {"json", "ledger", "junit", "markdown", "rows/cull/closed_mesh.txt", "report/index.html"}) {
    EXPECT_TRUE(one.contains(name)) << name;
  }
  EXPECT_EQ(apart(one, three), std::vector<std::string>{});
}

const std::string kFaulty = kScenes + "cull " + kScenes + "merge --fault matrices.viewport_one_short";

TEST_F(Jobs, LeaveTheSameFailures) {
  const auto one = left_by(kFaulty, "1", 1), three = left_by(kFaulty, "3", 1);
  EXPECT_TRUE(one.contains("failures/cull/both_windings/index.html"));
  EXPECT_EQ(apart(one, three), std::vector<std::string>{});
}

TEST_F(Jobs, EndWithTheFirstThingThatCannotBeWritten) {
  fs::create_directories(folder_ / "failures/cull/closed_mesh");
  test::write_text(at("failures/cull/closed_mesh/mine"), "");
  std::string first;
  for (const char* jobs : {"1", "3"}) {
    const Outcome run = plumb("check " + kFaulty + " --against exact --jobs " + jobs + " --failures " + at("failures") +
                              " --json " + at("c.json"));
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says("\ncull/both_windings ")) << "that is before it";
    EXPECT_TRUE(run.says("plumb: " + at("failures/cull/closed_mesh") + ": cannot be written")) << run.text;
    EXPECT_FALSE(fs::exists(at("c.json")));
    if (first.empty()) first = run.text;
    EXPECT_EQ(run.text, first);
  }
}

}  // namespace
}  // namespace plumbline
