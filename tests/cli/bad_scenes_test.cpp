// Bad input: refused where it is bad, in words that say what was expected, before anything is written.
#include "tests/cli/bad_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <map>

#include "scene/file/scene_file.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n";

/// Files that the table's scenes name; the scene's folder is "group".
const std::map<std::string, std::string> kFiles = {
    {"outside.obj", kTriangle + "f 1 2 3\n"},
    {"outside.part.json", "{}"},
    {"secret.mtl", "newmtl red\nKd 1 0 0\n"},
    {"group/range.obj", kTriangle + "f 1 2 9\n"},
    {"group/nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"group/far.obj", "v 0 0 0\nv 2e6 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"group/bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n"},
    {"group/crossing.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 2 0\nf 1 2 3 4\n"},
    {"group/empty.obj", ""},
    {"group/vertices.obj", kTriangle},
    {"group/points.obj", kTriangle + "p 1\n"},
    {"group/two.obj", kTriangle + "f 1 2\n"},
    {"group/zero_normal.obj", kTriangle + "vn 0 0 0\nf 1//1 2//1 3//1\n"},
    {"group/leak.obj", "mtllib ../secret.mtl\n" + kTriangle + "f 1 2 3\n"},
    {"group/truncated.ply", kPly},
    {"group/huge.ply",
     "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
     "end_header\n0 0 0\n"},
    {"group/index.ply", kPly + "0 1 0\n3 0 1 3\n"},
    {"group/broken.gltf", R"({"asset": {"version": "2.0"}, "meshes": 3})"},
    {"group/broken.glb", "glTF"},
    {"group/broken.3ds", "MM\xff\xff"},
    {"group/mesh.stl", "solid"},
    {"group/broken.png", "no png"},
    {"group/broken.jpg", ""},
    {"group/short.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\4\0\4\0\30\0\1\2\3", 21)},
    {"group/image.gif", "GIF89a"},
    {"group/folder.obj/x", ""},
    {"group/parts/x", ""},
    {"group/good.part.json",
     R"({"frame": {"width": 8}, "projection": {"perspective": {"fov_y": 30, "near": 1, "far": 9}}})"},
    {"group/bad.part.json", R"({"frame": {"widht": 3}})"},
    {"group/typo.part.json", R"({"frame": {"width": 3,}})"},
    {"group/list.part.json", "[]"},
    {"group/self.part.json", R"({"include": ["self.part.json"]})"},
    {"group/a.part.json", R"({"include": ["b.part.json"]})"},
    {"group/b.part.json", R"({"include": ["a.part.json"]})"},
    {"group/lost.part.json", R"({"include": ["none.part.json"]})"},
};

class BadScenes : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(testing::TempDir()) / fmt::format("plumbline_bad_scenes_{}_{}", info->name(), getpid());
    fs::remove_all(root_);
    fs::create_directories(root_ / "assets");
    for (const auto& [name, text] : kFiles) write(name, text);
    for (int i = 0; i < 10; ++i) {
      write("group/deep" + std::to_string(i) + ".part.json",
            R"({"include": ["deep)" + std::to_string(i + 1) + R"(.part.json"]})");
    }
    fs::create_symlink(root_ / "outside.obj", root_ / "group/link.obj");
    fs::create_symlink("nowhere.obj", root_ / "group/dangling.obj");
    fs::create_symlink(root_ / "outside.part.json", root_ / "group/link.part.json");
    for (const char* pipe : {"pipe.obj", "pipe.part.json", "pipe.json"}) {
      ASSERT_EQ(mkfifo((root_ / "group" / pipe).c_str(), 0600), 0);
    }
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    test::write_text(root_ / name, text);
    return root_ / name;
  }
  /// Message about the scene, "@" for the folder of all; "none" if it is read.
  std::string message(const fs::path& file) const {
    try {
      load_scene(file, {.asset_folders = {root_ / "assets"}});
    } catch (const SceneError& error) {
      return shortened(error.what());
    }
    return "none";
  }
  std::string shortened(std::string text) const {
    const std::string prefix = root_.string() + "/";
    for (std::size_t at = 0; (at = text.find(prefix, at)) != text.npos;) text.replace(at, prefix.size(), "@");
    return text;
  }
  std::string message_of(const std::string& text) const { return message(write("group/scene.json", text)); }

  fs::path root_;
};

/// The expected message; of an included file's it names that file.
void expect_message(const BadScene& bad, std::string message) {
  const std::string head = "@group/scene.json: ";
  if (!bad.message.starts_with("@")) {
    EXPECT_EQ(message.substr(0, head.size()), head) << bad.text;
    message.erase(0, head.size());
  }
  if (bad.message.ends_with("...")) {
    const std::string beginning = bad.message.substr(0, bad.message.size() - 3);
    EXPECT_EQ(message.substr(0, beginning.size()), beginning) << bad.text;
    EXPECT_GT(message.size(), beginning.size()) << bad.text;
  } else {
    EXPECT_EQ(message, bad.message) << bad.text;
  }
}

TEST_F(BadScenes, AreRefusedInTheseWords) {
  ASSERT_GE(kBadScenes.size(), 80u);
  for (const BadScene& bad : kBadScenes) expect_message(bad, message_of(bad.text));
}

TEST_F(BadScenes, OddBytesAreRefused) {
  const auto refused = [&](const std::string& text, const std::string& expected) {
    EXPECT_EQ(message_of(text).substr(0, expected.size()), expected);
  };
  const std::string at_top = "@group/scene.json: expected ";
  refused("\xef\xbb\xbf{}", at_top + "JSON in UTF-8 without a byte order mark, found the mark");
  refused(std::string("\xff\xfe{\0}\0", 6), at_top + "JSON, found");
  refused("\"\xff\"", at_top + "JSON, found");
  refused("{\"description\": \"\xc0\x80\"}", "@group/scene.json: at \"/description\": expected JSON, found");
  refused("{\"description\": \"\xed\xa0\x80\"}", "@group/scene.json: at \"/description\": expected JSON, found");
  refused(std::string("{\0}", 3), at_top + "JSON, found a NUL byte in line 1");
  refused(std::string("{\n}\0 {{{", 8), at_top + "JSON, found a NUL byte in line 2");
  refused(top("\"\\u001b[2J\": 1"), "@group/scene.json: at \"/\\u001b[2J\": expected a key among $schema");
  refused(top("\"\\u009b2J\": 1"), "@group/scene.json: at \"/\\u009b2J\": expected a key among $schema");
  write("group/steers.obj", kTriangle + "\x1b[2J 1 2 3\n");
  EXPECT_NE(message_of(mesh(R"({"file": "steers.obj"})")).find("found \"\\u001b[2J\" in line 4"), std::string::npos);
  refused(std::string(9u << 20, ' '), at_top + "JSON of at most 8388608 bytes, found more");
  std::string place;
  for (int i = 0; i < 64; ++i) place += "/0";
  refused(std::string(1'000'000, '['),
          "@group/scene.json: at \"" + place + "\": expected at most 64 levels of nesting");
  refused("{\"description\": " + std::string(1'000'000, '9'), "@group/scene.json: at \"/description\": expected a");
  refused(mesh(R"({"file": ")" + std::string(5000, 'x') + "\"}"),
          "@group/scene.json: at \"/draws/0/mesh/file\": expected");
}

TEST_F(BadScenes, WhatIsNoFileIsRefused) {
  const auto refused = [&](const fs::path& file, const std::string& found) {
    EXPECT_EQ(message(file), shortened(file.string()) + ": expected a JSON file, found " + found);
  };
  refused(root_ / "none.json", "nothing: there is no such file");
  refused(root_ / "group", "something that is not a file");
  refused(root_ / "group/pipe.json", "something that is not a file");
  refused("/dev/zero", "something that is not a file");
}

TEST_F(BadScenes, APartOfScenesIsNamedAsOne) {
  EXPECT_EQ(message(root_ / "group/good.part.json"),
            "@group/good.part.json: at \"/description\": expected a value, found nothing: the key is missing "
            "(*.part.json is a part that scenes include)");
}

TEST_F(BadScenes, IncludesOfTooManyFilesAreRefused) {
  std::string names;
  for (int i = 0; i < 64; ++i) names += (i > 0 ? ", " : "") + std::string("\"good.part.json\"");
  EXPECT_EQ(message_of(top("\"include\": [" + names + "]")),
            "@group/scene.json: at \"/include/63\": expected at most 64 files in all, found more");
}

TEST_F(BadScenes, EndTheProgramWith2AndNothingWritten) {
  const std::string out = (root_ / "out").string(), scene = (root_ / "group/scene.json").string();
  fs::create_directories(out);
  const std::array commands = {
      "render " + scene + " -o " + out + "/x.png --depth " + out + "/x.exr",
      "check " + scene + " --against exact --json " + out + "/x.json --report " + out + "/page",
      "capture " + scene + " " + out + "/capture"};
  const std::size_t every = kBadScenes.size() / 12;
  for (std::size_t i = 0; i < kBadScenes.size(); i += every) {
    write("group/scene.json", kBadScenes[i].text);
    const std::string command = commands[i / every % commands.size()];
    const Outcome run = plumb(command + " --assets " + (root_ / "assets").string());
    const std::string& said = run.text;
    EXPECT_EQ(run.code, 2) << command << "\n" << kBadScenes[i].text;
    EXPECT_NE(said.find(": expected "), said.npos) << said;
    EXPECT_TRUE(fs::is_empty(out)) << command << "\n" << kBadScenes[i].text;
  }
}

}  // namespace
}  // namespace plumbline
