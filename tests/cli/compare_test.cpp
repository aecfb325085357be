// plumb compare as a user meets it; what it finds is tested in tests/check.
#include <nlohmann/json.hpp>

#include "base/atomic_path.h"
#include "capture/files/capture_folder.h"
#include "capture/files/image_file.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

class Compare : public Cli {
 protected:
  void write_images() const {
    Plane<glm::vec4> plane(5, 4, glm::vec4(0.4f, 0.2f, 0.6f, 1));
    write_image(at("a.png"), plane);
    write_image(at("same.png"), plane);
    plane(3, 1).g = 51.0f / 255 + 1.0f / 255;
    write_image(at("step.png"), plane);
    write_image(at("wide.png"), Plane<glm::vec4>(6, 4));
    write_file(at("z.exr"), encode_depth_exr("z.exr", Plane<double>(5, 4, 0.5)));
    write_file(at("z2.exr"), encode_depth_exr("z2.exr", Plane<double>(5, 4, 0.75)));
  }
  Outcome compare(const std::string& a, const std::string& b, const std::string& options = "") const {
    return plumb("compare " + at(a) + " " + at(b) + " " + options);
  }
};

TEST_F(Compare, Ends0WhereAllHoldsAnd1WhereSomethingDiffers) {
  write_images();
  const Outcome same = compare("a.png", "same.png");
  EXPECT_EQ(same.code, 0) << same.text;
  EXPECT_TRUE(same.says("5 of 5 hold, tolerance 0")) << same.text;
  const Outcome step = compare("a.png", "step.png");
  EXPECT_EQ(step.code, 1) << step.text;
  for (const char* part : {"pixel 3,1", "(1/255)", "0.2 against 0.203921569", "first: pixels"}) {
    EXPECT_TRUE(step.says(part)) << part << " in\n" << step.text;
  }
  const Outcome wide = compare("a.png", "wide.png");
  EXPECT_EQ(wide.code, 1);
  EXPECT_TRUE(wide.says("5 x 4 against 6 x 4")) << wide.text;
  const Outcome kinds = compare("a.png", "z.exr");
  EXPECT_EQ(kinds.code, 1);
  EXPECT_TRUE(kinds.says("R G B A against Z")) << kinds.text;
  EXPECT_EQ(compare("z.exr", "z2.exr", "--tolerance 0.25").code, 0);
}

// Captures load without OpenImageIO's quarter of a second.
TEST_F(Compare, TakesAToleranceAsANumberOrAFraction) {
  Capture capture;
  capture.renderer = "mine";
  capture.width = 5;
  capture.height = 4;
  capture.planes.color = Plane<glm::vec4>(5, 4, glm::vec4(0.4f, 0.2f, 0.6f, 1));
  write_capture(capture, at("a"));
  capture.planes.color(3, 1).g = 51.0f / 255 + 1.0f / 255;
  write_capture(capture, at("step"));
  const Outcome apart = compare("a", "step");
  EXPECT_EQ(apart.code, 1) << apart.text;
  for (const char* tolerance : {"1/255", "0.004", "1e-2", "257/65535"}) {
    EXPECT_EQ(compare("a", "step", std::string("--tolerance ") + tolerance).code, 0) << tolerance;
  }
  EXPECT_EQ(compare("a", "step", "--tolerance 0.0039").code, 1);
  EXPECT_EQ(compare("a", "step", "--tolerance 1/256").code, 1);
}

TEST_F(Compare, Ends2WhereItCannotCompare) {
  for (const char* name : {"a.png", "same.png"})
    fs::copy(PLUMBLINE_SOURCE_DIR "/tests/walkthrough/right.png", at(name));
  const std::string before = test::text_of(at("a.png"));
  test::write_text(at("text.png"), "text");
  fs::create_directories(folder_ / "empty");
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const Outcome run = plumb("compare " + arguments);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says(why)) << why << " in " << run.text;
  };
  const std::string a = at("a.png"), both = a + " " + at("same.png");
  refused(a, "B");
  refused(a + " " + at("none.png"), at("none.png"));
  refused(a + " " + at("text.png"), at("text.png"));
  refused(at("text.png") + " " + a, at("text.png"));
  refused(a + " " + at("empty"), "two images or two captures");
  refused(at("empty") + " " + at("empty"), "manifest.json");
  for (const char* bad : {"-1", "nan", "inf", "x", "1/0", "1/", "0/0", "1/2/3", "''", "1e999", "' 1'"}) {
    refused(both + " --tolerance=" + bad, "--tolerance");
  }
  for (const char* bad : {"0", "-1", "nan"}) refused(both + " --amplify=" + bad, "--amplify");
  refused(both + " -o " + at("d.jpg"), ".ppm or .exr");
  refused(both + " --json " + a, "is read by this run");
  refused(both + " -o " + a, "is read by this run");
  refused(both + " --json " + at("no/such.json"), "No such file");
  EXPECT_TRUE(test::text_of(a) == before) << "not overwritten";
}

TEST_F(Compare, WritesTheDifferenceAndJson) {
  write_images();
  const Outcome run = compare("a.png", "step.png", "-o " + at("d.png") + " --json " + at("d.json"));
  EXPECT_EQ(run.code, 1) << run.text;
  const Plane<glm::vec4> difference = read_image(at("d.png"));
  EXPECT_EQ(difference(3, 1), glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(difference(0, 0), glm::vec4(0, 0, 0, 1));
  const auto json = nlohmann::json::parse(test::text_of(at("d.json")));
  EXPECT_EQ(json["tolerance"], 0);
  EXPECT_EQ(json["a"], at("a.png"));
  ASSERT_EQ(json["comparisons"].size(), 5u);
  EXPECT_EQ(json["comparisons"][2]["what"], "G");
  EXPECT_EQ(json["comparisons"][2]["outcome"], "different");
  EXPECT_EQ(json["comparisons"][2]["differing"], 1);
  EXPECT_EQ(json["comparisons"][2]["codes"], 255);
  EXPECT_EQ(json["comparisons"][2]["worst"]["pixel"], nlohmann::json({3, 1}));
  EXPECT_EQ(json["comparisons"][1]["outcome"], "equal");
  EXPECT_TRUE(json["comparisons"][1]["worst"].is_null());
  EXPECT_EQ(compare("a.png", "step.png", "--amplify 51 -o " + at("d.exr")).code, 1);
  EXPECT_FLOAT_EQ(read_image(at("d.exr"))(3, 1).g, 0.2f);
  EXPECT_EQ(compare("a.png", "wide.png", "-o " + at("none.png")).code, 1);
  EXPECT_FALSE(fs::exists(at("none.png")));
}

TEST_F(Compare, TakesTwoCaptures) {
  const std::string scene = kScenes + "cull/both_windings.json ";
  EXPECT_EQ(plumb("capture " + scene + at("ours")).code, 0);
  EXPECT_EQ(plumb("capture " + scene + at("again")).code, 0);
  EXPECT_EQ(plumb("capture " + scene + at("fault") + " --fault window.snap_truncates").code, 0);
  EXPECT_EQ(compare("ours", "again").code, 0);
  const Outcome fault = compare("ours", "fault", "--json " + at("out.json"));
  EXPECT_EQ(fault.code, 1);
  EXPECT_TRUE(fault.says("first: window.snapped")) << fault.text;
  EXPECT_TRUE(nlohmann::json::accept(test::text_of(at("out.json"))));
  EXPECT_EQ(compare("ours", "again", "-o " + at("d.png")).code, 2);
  EXPECT_EQ(compare("ours", "again", "--json " + at("ours/manifest.json")).code, 2);
  // A capture without one stage: not equal, but where that is asked for.
  auto manifest = nlohmann::json::parse(test::text_of(at("again/manifest.json")));
  auto& arrays = manifest["arrays"];
  arrays.erase(std::find_if(arrays.begin(), arrays.end(), [](auto& a) { return a["name"] == "depth.value"; }));
  test::write_text(at("again/manifest.json"), manifest.dump());
  const Outcome part = compare("ours", "again");
  EXPECT_EQ(part.code, 1) << part.text;
  EXPECT_TRUE(part.says("A holds") && part.says("depth")) << part.text;
  EXPECT_EQ(compare("ours", "again", "--allow-missing").code, 0);
  EXPECT_EQ(compare("fault", "again", "--allow-missing").code, 1);
  manifest["arrays"] = nlohmann::json::array();
  test::write_text(at("again/manifest.json"), manifest.dump());
  const Outcome nothing = compare("again", "again", "--allow-missing");
  EXPECT_EQ(nothing.code, 1);
  EXPECT_TRUE(nothing.says("nothing was compared")) << nothing.text;
}

}  // namespace
}  // namespace plumbline
