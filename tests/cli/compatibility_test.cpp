// Files of earlier versions are read and mean the same, and files of other versions of a format are refused by name, as
// CHANGELOG.md promises.
#include <nlohmann/json.hpp>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

using Json = nlohmann::json;

const std::string kOld = PLUMBLINE_SOURCE_DIR "/tests/compatibility/0.1/";

class Compatibility : public Cli {
 protected:
  // The file, with one text in the place of another, which it holds once.
  std::string altered(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = test::text_of(file);
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << file << ": " << from;
    test::write_text(folder_ / "altered.json", text.replace(place, from.size(), to));
    return at("altered.json");
  }
};

// Keys of `old` that `now` lacks, or has with another type; of an array's objects the first.
void missing(const Json& old, const Json& now, const std::string& at, std::set<std::string>& out) {
  if (old.type() != now.type() && !(old.is_number() && now.is_number()) && !old.is_null() && !now.is_null()) {
    out.insert(at + ": another type");
  } else if (old.is_object()) {
    for (const auto& [key, value] : old.items()) {
      if (!now.contains(key)) {
        out.insert(at + "/" + key);
      } else {
        missing(value, now[key], at + "/" + key, out);
      }
    }
  } else if (old.is_array() && !old.empty() && !now.empty()) {
    missing(old[0], now[0], at + "/0", out);
  }
}

TEST_F(Compatibility, ASceneOf01DrawsTheSameBits) {
  EXPECT_EQ(plumb("capture " + kOld + "scene.json " + at("now")).code, 0);
  const Outcome compared = plumb("compare " + kOld + "capture " + at("now"));
  EXPECT_EQ(compared.code, 0) << compared.text;
}

TEST_F(Compatibility, ACaptureOf01IsJudged) {
  const Outcome judged = plumb("diagnose " + kOld + "scene.json --against exact --capture " + kOld + "capture");
  EXPECT_EQ(judged.code, 0) << judged.text;
  EXPECT_TRUE(judged.says("first different stage: none")) << judged.text;
}

TEST_F(Compatibility, ConventionsOf01AreTaken) {
  const Outcome judged = plumb("diagnose " + kOld + "scene.json --against exact --capture " + kOld +
                               "capture --conventions " + kOld + "conventions.json");
  EXPECT_EQ(judged.code, 0) << judged.text;
}

TEST_F(Compatibility, RunsOf01AreMergedAndCompared) {
  const Outcome merged = plumb("report merge " + kOld + "run.json -o " + at("merged.json"));
  EXPECT_EQ(merged.code, 0) << merged.text;
  const Outcome same = plumb("report diff " + kOld + "run.json " + at("merged.json"));
  EXPECT_EQ(same.code, 0) << same.text;
}

TEST_F(Compatibility, JsonHasEveryKeyOf01) {
  EXPECT_EQ(plumb("check " + kOld + "scene.json --no-cache --json " + at("run.json")).code, 0);
  EXPECT_EQ(plumb("diagnose " + kOld + "scene.json --fault merge.truncated --json " + at("diagnosis.json")).code, 1);
  for (const std::string name : {"run", "diagnosis"}) {
    std::set<std::string> gone;
    const Json now = Json::parse(test::text_of(at(name + ".json")));
    missing(Json::parse(test::text_of(kOld + name + ".json")), now, "", gone);
    for (const std::string& key : gone) {
      // Names of renderers, and of tolerances: values, not keys of the format.
      if (!key.starts_with("/versions/") && !key.starts_with("/tolerances/")) ADD_FAILURE() << name << ": " << key;
    }
    EXPECT_EQ(now["format"], "plumbline " + name);
    EXPECT_EQ(now["version"], 1);
  }
}

TEST_F(Compatibility, AnotherVersionIsRefused) {
  const std::string scene = kOld + "scene.json ";
  const std::string refused = "expected 1, found 2";
  const std::string of_scene = altered(scene.substr(0, scene.size() - 1), "{", R"({"version": 2,)");
  const Outcome by_scene = plumb("check " + of_scene);
  EXPECT_EQ(by_scene.code, 2);
  EXPECT_TRUE(by_scene.says("at \"/version\": " + refused)) << by_scene.text;

  const Outcome by_conventions = plumb("diagnose " + scene + "--capture " + kOld + "capture --conventions " +
                                       altered(kOld + "conventions.json", "\"version\": 1", "\"version\": 2"));
  EXPECT_EQ(by_conventions.code, 2);
  EXPECT_TRUE(by_conventions.says("at \"/version\": " + refused)) << by_conventions.text;

  const Outcome by_run =
      plumb("report merge " + altered(kOld + "run.json", "{", R"({"version": 2,)") + " -o " + at("m"));
  EXPECT_EQ(by_run.code, 2);
  EXPECT_TRUE(by_run.says("at \"/version\": " + refused)) << by_run.text;

  fs::copy(kOld + "capture", folder_ / "capture");
  fs::copy_file(altered(kOld + "capture/manifest.json", "\"version\": 1", "\"version\": 2"),
                folder_ / "capture/manifest.json", fs::copy_options::overwrite_existing);
  const Outcome by_capture = plumb("diagnose " + scene + "--capture " + at("capture"));
  EXPECT_EQ(by_capture.code, 2);
  EXPECT_TRUE(by_capture.says("at \"/version\": " + refused)) << by_capture.text;
}

TEST_F(Compatibility, AVersionOfThisFormatIsTaken) {
  const std::string scene = altered(kOld + "scene.json", "{", R"({"version": 1,)");
  EXPECT_EQ(plumb("render " + scene + " -o " + at("a.png")).code, 0);
}

}  // namespace
}  // namespace plumbline
