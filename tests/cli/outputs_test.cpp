// Outputs of plumb: proven writable before the work, whole or not at all, and never over others' files.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "capture/files/capture_folder.h"
#include "capture/files/image_file.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

using Outputs = Cli;
using Names = std::set<std::string>;

const std::string kBothWindings = kScenes + "cull/both_windings.json";
const std::string kCheck = "check " + kBothWindings + " --against exact";

// An output path that cannot be written, and the reason that must be told.
struct Bad {
  std::string path, reason;
};

TEST_F(Outputs, WithoutAValueAreRefusedBeforeAnythingIsWritten) {
  const std::string scene = kScenes + "cull/both_windings.json";
  for (const std::string& words :
       {"check " + scene + " --json= " + at("next"), "check " + scene + " --json --report",
        "golden update " + scene + " --golden= --check", "render " + scene + " -o --depth"}) {
    const Outcome run = plumb(words);
    EXPECT_EQ(run.code, 2) << words;
    EXPECT_TRUE(run.says("expected a value, found")) << words << ": " << run.text;
  }
  EXPECT_TRUE(fs::is_empty(at(""))) << "nothing is written";
  EXPECT_EQ(plumb("check " + scene + " --against exact --json=" + at("a=")).code, 0) << "a name that ends so";
}

TEST_F(Outputs, ThatCannotBeWrittenEndTheRunBeforeTheWork) {
  fs::create_directories(folder_ / "folder.exr/");
  fs::create_directories(folder_ / "folder.png/");
  test::write_text(folder_ / "file", "kept");
  fs::create_symlink("b.exr", folder_ / "a.exr");
  fs::create_symlink("a.exr", folder_ / "b.exr");
  const Names before = entries();
  const auto refused = [&](const std::string& arguments, const Bad& bad) {
    const Outcome run = plumb(arguments);
    EXPECT_EQ(run.code, 2) << arguments << "\n" << run.text;
    EXPECT_TRUE(run.says(bad.path)) << arguments << "\n" << run.text;
    EXPECT_TRUE(run.says(bad.reason)) << bad.reason << " in " << run.text;
    EXPECT_FALSE(run.says("filesystem error")) << run.text;
    EXPECT_FALSE(run.says("exact, ")) << "refused after the work";
    EXPECT_EQ(entries(), before) << arguments;
  };
  const std::string long_name(300, 'n');
  for (const Bad& bad :
       {Bad{at("no/such/out.exr"), "No such file or directory"}, Bad{at("file/out.exr"), "Not a directory"},
        Bad{at("folder.exr"), "Is a directory"}, Bad{at("folder.exr") + "/", "Is a directory"},
        Bad{"/proc/out.exr", "cannot be written"}, Bad{at("a.exr"), "Too many levels of symbolic links"},
        Bad{at(long_name + ".exr"), "File name too long"}}) {
    refused(kCheck + " --json " + bad.path, bad);
    if (bad.path.back() != '/') refused("render " + kBothWindings + " -o " + bad.path, bad);
  }
  const Bad bad{at("no/such/out.exr"), "No such file or directory"};
  refused(kCheck + " --ledger " + bad.path, bad);
  refused("render " + kBothWindings + " -o " + at("c.png") + " --depth " + bad.path, bad);
  refused(kCheck + " --json /dev/full", {"/dev/full", "no regular file"});
  refused(kCheck + " --report " + at("file"), {at("file"), "Not a directory"});
  refused(kCheck + " --report " + at("file/page"), {at("file/page"), "Not a directory"});
  refused(kCheck + " --report /proc/page", {"/proc/page", "cannot be written"});
  refused("capture " + kBothWindings + " " + at("file"), {at("file"), "Not a directory"});
  refused("capture " + kBothWindings + " /proc/capture", {"/proc/capture", "cannot be written"});
  EXPECT_EQ(test::text_of(at("file")), "kept");
}

TEST_F(Outputs, AreNotEmptyNames) {
  for (const char* option : {"--json", "--ledger", "--report", "--fault"}) {
    const Outcome run = plumb(kCheck + " " + option + " ''");
    EXPECT_EQ(run.code, 2) << option << "\n" << run.text;
    EXPECT_TRUE(run.says(option)) << run.text;
  }
  EXPECT_EQ(plumb(kCheck + " --json=''").code, 2);
  EXPECT_EQ(plumb("render " + kBothWindings + " -o ''").code, 2);
  EXPECT_EQ(plumb("render " + kBothWindings + " -o " + at("c.png") + " --depth ''").code, 2);
  EXPECT_EQ(plumb("render '' -o " + at("c.png")).code, 2);
  EXPECT_EQ(plumb("capture " + kBothWindings + " ''").code, 2);
  EXPECT_EQ(plumb("check ''").code, 2);
  EXPECT_TRUE(entries().empty());
}

TEST_F(Outputs, NeverOverwriteASceneThatIsReadByAnyNameOfIt) {
  fs::copy(kBothWindings, folder_ / "scene.json");
  fs::create_symlink("scene.json", folder_ / "link.json");
  fs::create_hard_link(folder_ / "scene.json", folder_ / "hard.txt");
  fs::copy(kBothWindings, folder_ / "scene.png");
  const std::string text = test::text_of(folder_ / "scene.json");
  const Names before = entries();
  for (const char* name : {"scene.json", "link.json", "hard.txt", "no/../scene.json"}) {
    const Outcome run = plumb("check " + at("scene.json") + " --against exact --ledger " + at(name));
    EXPECT_EQ(run.code, 2) << name << "\n" << run.text;
    EXPECT_TRUE(run.says("is read by this run") && run.says(name)) << run.text;
  }
  EXPECT_EQ(plumb("check " + folder_.string() + " --against exact --json " + at("scene.json")).code, 2) << "by folder";
  EXPECT_EQ(plumb("render " + at("scene.png") + " -o " + at("scene.png")).code, 2);
  EXPECT_EQ(test::text_of(folder_ / "scene.json"), text);
  EXPECT_EQ(test::text_of(folder_ / "scene.png"), text);
  EXPECT_EQ(entries(), before);
}

TEST_F(Outputs, NeverOverwriteWhatElseARunReads) {
  fs::copy(PLUMBLINE_SOURCE_DIR "/tests/scenes/blend/factors.json", folder_ / "factors.json");
  fs::copy(PLUMBLINE_SOURCE_DIR "/tests/scenes/blend/factors.part.json", folder_ / "factors.part.json");
  test::write_text(folder_ / "expect.json", "{\"expectations\": []}");
  const Names before = entries();
  const std::string goldens = PLUMBLINE_SOURCE_DIR "/golden";
  for (const std::string& name : {at("factors.part.json"), at("expect.json"), goldens + "/manifest.json"}) {
    const std::string expect = name == at("expect.json") ? " --expect " + name : "";
    const Outcome run =
        plumb("check " + at("factors.json") + " --against exact --golden " + goldens + expect + " --json " + name);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says("is read by this run")) << run.text;
  }
  EXPECT_EQ(entries(), before);
}

TEST_F(Outputs, NeverOverwriteEachOther) {
  fs::create_symlink("a.json", folder_ / "link.json");
  for (const char* other : {"a.json", "./a.json", "link.json"}) {
    const Outcome run = plumb(kCheck + " --json " + at("a.json") + " --ledger " + at(other));
    EXPECT_EQ(run.code, 2) << other;
    EXPECT_TRUE(run.says("--ledger") && run.says("--json")) << run.text;
  }
  EXPECT_EQ(plumb(kCheck + " --report " + at("page") + " --json " + at("page")).code, 2);
  fs::create_directories(folder_ / "page");
  EXPECT_EQ(plumb(kCheck + " --report " + at("page") + " --json " + at("page/out.json")).code, 2);
  EXPECT_EQ(plumb("render " + kBothWindings + " -o " + at("c.exr") + " --depth " + at("c.exr")).code, 2);
  EXPECT_EQ(entries(), (Names{"link.json", "page"}));
}

TEST_F(Outputs, ThroughALinkReplaceWhatItPointsTo) {
  fs::create_directories(folder_ / "far");
  test::write_text(folder_ / "far/old.json", "old");
  fs::create_symlink("far/old.json", folder_ / "old.json");
  fs::create_symlink("far/new.png", folder_ / "new.png");  // to nothing yet
  fs::create_directories(folder_ / "far/captures");
  fs::create_symlink("far/captures", folder_ / "captures");
  EXPECT_EQ(plumb(kCheck + " --json " + at("old.json")).code, 0);
  EXPECT_EQ(plumb("render " + kBothWindings + " -o " + at("new.png")).code, 0);
  EXPECT_EQ(plumb("capture " + kBothWindings + " " + at("captures")).code, 0);
  for (const char* link : {"old.json", "new.png", "captures"}) EXPECT_TRUE(fs::is_symlink(folder_ / link)) << link;
  EXPECT_TRUE(nlohmann::json::accept(test::text_of(folder_ / "far/old.json")));
  EXPECT_GT(read_image(folder_ / "far/new.png").size(), 0u);
  EXPECT_EQ(read_capture(folder_ / "far/captures").renderer, "ours");
}

TEST_F(Outputs, OfRenderAppearBothOrNotAtAll) {
  // A small picture, a large depth.
  const std::string both = "render " + kScenes + "depth/grazing.json -o " + at("c.png") + " --depth ";
  EXPECT_EQ(plumb(both + at("no/such/d.exr")).code, 2);
  fs::create_directories(folder_ / "d.exr");
  EXPECT_EQ(plumb(both + at("d.exr")).code, 2);
  fs::remove(folder_ / "d.exr");
  EXPECT_TRUE(entries().empty());
  // A full disk, found out by the second file: the first, small enough, must not appear.
  test::write_text(folder_ / "c.png", "old");
  const Outcome full = shell("trap '' XFSZ; ulimit -f 8; " PLUMBLINE_PLUMB " " + both + at("d.exr"));
  EXPECT_EQ(full.code, 2) << full.text;
  EXPECT_TRUE(full.says(at("d.exr") + ": cannot be written: File too large")) << full.text;
  EXPECT_EQ(entries(), Names{"c.png"});
  EXPECT_EQ(test::text_of(at("c.png")), "old");
  EXPECT_EQ(plumb(both + at("d.exr")).code, 0);
  EXPECT_EQ(entries(), (Names{"c.png", "d.exr"}));
}

TEST_F(Outputs, ThatFillTheDiskLeaveNothingBehind) {
  const std::string limited = "trap '' XFSZ; ulimit -f 1; " PLUMBLINE_PLUMB " ";
  for (const std::string& arguments : {kCheck + " --json " + at("o.json"), kCheck + " --report " + at("deep/page"),
                                       "capture " + kBothWindings + " " + at("capture"),
                                       "render " + kBothWindings + " --depth " + at("d.exr") + " -o " + at("c.exr")}) {
    const Outcome run = shell(limited + arguments);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says("File too large") && run.says(folder_.string())) << run.text;
    EXPECT_TRUE(entries().empty()) << arguments;
  }
  for (const char* command : {"list stages", "--version", "--help"}) {
    EXPECT_EQ(plumb(std::string(command) + " > /dev/full").code, 2)
        << command << ": standard output is an output as well";
  }
}

TEST_F(Outputs, CaptureAndReportReplaceAnEmptyFolderAndTheirOwn) {
  for (const std::string& command : {"capture " + kBothWindings + " " + at("it"), kCheck + " --report " + at("it")}) {
    fs::create_directories(folder_ / "it");
    EXPECT_EQ(plumb(command).code, 0);
    const Names made = entries();
    EXPECT_GT(made.size(), 3u);
    const Outcome again = plumb(command);
    EXPECT_EQ(again.code, 0) << again.text;
    EXPECT_EQ(entries(), made);
    test::write_text(folder_ / "it/thesis.txt", "mine");
    const Outcome mine = plumb(command);
    EXPECT_EQ(mine.code, 2) << "a folder of ours with a file of the user's";
    EXPECT_TRUE(mine.says("thesis.txt") && mine.says("left alone")) << mine.text;
    EXPECT_EQ(test::text_of(at("it/thesis.txt")), "mine");
    fs::remove_all(folder_ / "it");
  }
}

TEST_F(Outputs, CaptureAndReportLeaveOtherFoldersAlone) {
  const std::string capture = "capture " + kBothWindings + " " + at("it"), report = kCheck + " --report " + at("it");
  const auto refused = [&](const std::string& command, const std::string& why) {
    const Names before = entries();
    const Outcome run = plumb(command);
    EXPECT_EQ(run.code, 2) << why << "\n" << run.text;
    EXPECT_TRUE(run.says(at("it")) && run.says("left alone")) << run.text;
    EXPECT_FALSE(run.says("exact, ")) << "refused after the work";
    EXPECT_EQ(entries(), before) << why;
  };
  EXPECT_EQ(plumb(capture).code, 0);
  refused(report, "a capture is no report");
  const std::string manifest = test::text_of(at("it/manifest.json"));
  for (const char* text : {"{}", "", "{\"format\": \"web app\", \"name\": \"plumbline capture\"}", "[1, 2]"}) {
    test::write_text(folder_ / "it/manifest.json", text);
    refused(capture, "somebody else's manifest");
  }
  fs::remove_all(folder_ / "it");
  fs::create_directories(folder_ / "it/src");
  test::write_text(folder_ / "it/manifest.json", manifest);
  test::write_text(folder_ / "it/src/main.c", "mine");
  refused(capture, "a file in a folder beside a capture's manifest");
  fs::remove_all(folder_ / "it");
  EXPECT_EQ(plumb(report).code, 0);
  refused(capture, "a report is no capture");
  test::write_text(folder_ / "it/plumb-report.txt", "index.html\n");
  refused(report, "a list that does not say whose it is");
  fs::remove(folder_ / "it/plumb-report.txt");
  refused(report, "somebody's page");
}

TEST_F(Outputs, KeepScenesOfOneNameApartAndTakeAnyName) {
  const std::string odd = "a b#c?d%&\"<>'\xff\xfe\xc3\xa4";
  for (const char* top : {"x", "y"}) {
    fs::create_directories(folder_ / top / "cull");
    fs::copy(kBothWindings, folder_ / top / "cull/both_windings.json");
  }
  fs::create_directories(folder_ / "x" / odd);
  fs::copy(kBothWindings, folder_ / "x" / odd / (odd + ".json"));
  // A scene named "../scene", which must not leave the page's folder.
  const Outcome run =
      shell("cd '" + at("x/cull") + "' && cp both_windings.json ../z.json && " PLUMBLINE_PLUMB " check '" +
            at("x/cull") + "' '" + at("y") + "' '" + at("x") + "' ../z.json --against exact --json '" + at("out.json") +
            "' --report '" + at("page") + "'");
  EXPECT_EQ(run.code, 0) << run.text;
  std::set<std::string> shown;
  const std::string page = test::text_of(at("page/index.html"));
  EXPECT_FALSE(page.find("\xff") != page.npos || page.find("\"<>") != page.npos) << "not escaped";
  const std::string from = "id=\"report\">";
  const std::size_t begin = page.find(from) + from.size();
  const auto scenes = nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin))["scenes"];
  ASSERT_EQ(scenes.size(), 6u) << "x/cull, y/cull, x of three, ../z";
  const auto named = [](const std::string& name) {
    return [=](const nlohmann::json& scene) { return scene["name"].get<std::string>().ends_with(name); };
  };
  EXPECT_TRUE(std::ranges::any_of(scenes, named("a b#c?d%&\"<>'\xef\xbf\xbd\xef\xbf\xbd\xc3\xa4")));
  for (const auto& scene : scenes) {
    for (const char* kind : {"thumbnail", "file"}) {
      const std::string link = scene[kind];
      EXPECT_TRUE(fs::is_regular_file(folder_ / "page" / link)) << link;
      EXPECT_EQ(link.find_first_of("%#?& "), link.npos) << link;
      EXPECT_EQ(link.find(".."), link.npos) << link;
      EXPECT_TRUE(shown.insert(link).second) << link << " is shown for two scenes";
    }
  }
  const auto json = nlohmann::json::parse(test::text_of(at("out.json")));  // throws on what is no UTF-8
  EXPECT_EQ(json["scenes"].size(), 6u);
}

}  // namespace
}  // namespace plumbline
