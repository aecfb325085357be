// The page of plumb check: what its script is given.
#include <bit>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_path.h"
#include "capture/files/image_file.h"
#include "report/page/html_report.h"
#include "tests/check/verdict/verdicts.h"
#include "tests/report/page_numbers.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::report {
namespace {

namespace fs = std::filesystem;
using check::Comparison;
using check::Outcome;
using check::SceneVerdict;

struct Pages : TestFolder {
  static std::size_t entries(const fs::path& of) {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(of), {}));
  }
  const fs::path& folder = root_;
};

Scene described(const std::string& description) {
  Scene scene;
  scene.description = description;
  return scene;
}

// What a page's script is given, of the overview and of a scene; both are JSON in a script's text.
nlohmann::json overview(const fs::path& page) {
  const std::string text = test::text_of(page / "index.html"), from = "id=\"report\">";
  const std::size_t begin = text.find(from) + from.size();
  return nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
}
struct Shown {
  nlohmann::json about, view;
};
Shown shown(const fs::path& file) {
  const std::string text = test::text_of(file), head = "sceneArrived({...", middle = ", view: ", tail = "});\n";
  EXPECT_TRUE(text.starts_with(head) && text.ends_with(tail)) << text;
  const std::size_t view = text.find("}" + middle) + 1;
  return {nlohmann::json::parse(text.substr(head.size(), view - head.size())),
          nlohmann::json::parse(text.substr(view + middle.size(), text.size() - view - middle.size() - tail.size()))};
}
nlohmann::json rows_of(const nlohmann::json& view) {
  return nlohmann::json::parse(inflated(view["comparisons"].get<std::string>()));
}

Shown scene_of(HtmlReport& page, const fs::path& folder) {
  page.write("");
  return shown(folder / "group/scene.js");
}

TEST_F(Pages, PagesAreNoScriptOfAHostileText) {
  const std::string odd = "</script><script>\"a\" & 'b'</script><!--";
  Comparison c = not_compared(Outcome::failed, odd);
  c.judge.reference = odd;
  SceneVerdict verdict = verdict_of({c, compared(Outcome::within, 2, 8)});
  verdict.scene = "group/<a & \"b\">";
  HtmlReport page(folder / "page", 1);
  page.add(verdict, {}, {}, described(odd), odd, odd);
  page.write(odd);
  const std::string text = test::text_of(folder / "page/index.html");
  EXPECT_FALSE(contains(text, "<script>\"a"));
  EXPECT_FALSE(contains(text, "<!--"));
  EXPECT_FALSE(contains(text, "<a &"));
  EXPECT_TRUE(contains(text, "&lt;/script&gt;&lt;script&gt;&quot;a&quot; &amp; ")) << "the summary";
  const nlohmann::json card = overview(folder / "page")["scenes"][0];
  EXPECT_EQ(card["name"], verdict.scene);
  EXPECT_EQ(card["description"], odd);
  EXPECT_EQ(card["file"], "group/~3ca~20~26~20~22b~22~3e.js");
  EXPECT_EQ(card["outcome"], "failed");
  const std::string script = test::text_of(folder / "page/group/~3ca~20~26~20~22b~22~3e.js");
  EXPECT_FALSE(contains(script, "<")) << "though no page holds it";
  const Shown scene = shown(folder / "page/group/~3ca~20~26~20~22b~22~3e.js");
  for (const char* key : {"description", "failure", "repeat"}) EXPECT_EQ(scene.about[key], odd) << key;
  EXPECT_EQ(rows_of(scene.view)[0]["reference"], odd);
  EXPECT_EQ(rows_of(scene.view)[0]["note"], odd);
  EXPECT_EQ(rows_of(scene.view)[1]["worst"]["place"], "pixel 12,34 record 56 p_clip");
}

TEST_F(Pages, AScenesOutcomeIsTheWorstOfItsRows) {
  HtmlReport page(folder, 100);
  const auto add = [&](std::vector<Comparison> c, const char* failure = "") {
    page.add(verdict_of(std::move(c)), {}, {}, {}, failure);
  };
  add({compared(Outcome::equal), not_compared(Outcome::unsupported, "")});
  add({compared(Outcome::different, 1), compared(Outcome::dispute), compared(Outcome::equal)}, "why");
  add({compared(Outcome::within, 1, 2), compared(Outcome::dispute)});
  add({compared(Outcome::equal)}, "no reference judged light");
  add({compared(Outcome::expected, 1), compared(Outcome::dispute)});
  add({not_compared(Outcome::unsupported, "")});
  page.write("");
  const nlohmann::json scenes = overview(folder)["scenes"];
  const char* expected[] = {"equal", "different", "dispute", "fails", "expected", "unsupported"};
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(scenes[i]["outcome"], expected[i]) << i;
    EXPECT_EQ(scenes[i]["fails"], i == 1 || i == 3) << i;
    EXPECT_EQ(scenes[i]["first"], i == 1 ? nlohmann::json("clip") : nlohmann::json(nullptr)) << i;
  }
  EXPECT_EQ(shown(folder / "group/scene-2.js").about["first"], 0);
}

// A reference of each kind: one that draws, one that does not, one of another size.
struct TwoPixels {
  check::BothCaptures drawn;
  check::Reference references[3] = {{"osmesa", nullptr}, {"embree", nullptr}, {"exact", nullptr}};

  TwoPixels() {
    drawn.candidate.planes.color = Plane<glm::vec4>(3, 2, glm::vec4(1, 0.2, 0, 1));
    drawn.candidate.planes.id = Plane<std::int32_t>(3, 2, kBackground);
    drawn.references.resize(3);
    Plane<glm::vec4>& theirs = drawn.references[0].planes.color = drawn.candidate.planes.color;
    theirs(2, 0).g += 3.4f / 255;
    drawn.references[0].planes.id = drawn.candidate.planes.id;
    drawn.references[2].planes.color = Plane<glm::vec4>(2, 3);  // as many pixels, of another shape
  }
};

TEST_F(Pages, AScenesNumbersAreThoseOfBothSides) {
  TwoPixels two;
  HtmlReport page(folder, 100);
  page.add(verdict_of({}), two.references, two.drawn, {});
  const nlohmann::json view = scene_of(page, folder).view;
  EXPECT_EQ(view["sides"], (nlohmann::json{"ours", "osmesa", "exact"})) << "embree drew nothing";
  const nlohmann::json& color = view["layers"][0];
  EXPECT_EQ(color["name"], "colour");
  EXPECT_EQ(color["sides"][0]["scale"], 255);
  const std::vector<std::uint32_t> ours = unpacked(color["sides"][0]), theirs = unpacked(color["sides"][1], ours);
  EXPECT_EQ(ours, (std::vector<std::uint32_t>{255, 51, 0, 255, 255, 51, 0, 255, 255, 51, 0, 255,
                                              255, 51, 0, 255, 255, 51, 0, 255, 255, 51, 0, 255}));
  std::vector<std::uint32_t> expected = ours;
  expected[4 * 2 + 1] = 54;  // rounded: only ours must be of codes
  EXPECT_EQ(theirs, expected);
  EXPECT_TRUE(color["sides"][2].is_null()) << "of another size";
  EXPECT_EQ(view["layers"][1]["name"], "primitives");
  EXPECT_EQ(unpacked(view["layers"][1]["sides"][0]), std::vector<std::uint32_t>(6, 0xffffffff));
  EXPECT_EQ(view["layers"][1]["sides"][1]["base"], 0);
  EXPECT_FALSE(view["layers"][1]["sides"][1].contains("data")) << "not a number is different";
  const Plane<glm::vec4> small = read_image(folder / "group/scene.png");
  EXPECT_EQ(small.width(), 3);
  EXPECT_EQ(small(0, 0), glm::vec4(1, 51 / 255.0f, 0, 1));
}

TEST_F(Pages, OursThatIsNoCodeAndWhatIsNoNumberAreShownAsTheyAre) {
  TwoPixels two;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  two.drawn.candidate.planes.color(1, 1) = glm::vec4(0.5f, nan, -HUGE_VALF, 1);
  HtmlReport page(folder, 100);
  page.add(verdict_of({}), two.references, two.drawn, {});
  const nlohmann::json color = scene_of(page, folder).view["layers"][0];
  EXPECT_EQ(color["sides"][0]["scale"], 0) << "floats";
  const std::vector<std::uint32_t> ours = unpacked(color["sides"][0]);
  EXPECT_EQ(std::bit_cast<float>(ours[16]), 0.5f);
  EXPECT_TRUE(std::isnan(std::bit_cast<float>(ours[17])));
  EXPECT_EQ(std::bit_cast<float>(ours[18]), -HUGE_VALF);
  EXPECT_TRUE(color["sides"][1]["base"].is_null()) << "codes are no floats";
  EXPECT_EQ(unpacked(color["sides"][1])[16], 255u);
}

TEST_F(Pages, ARowMarksItsPixels) {
  TwoPixels two;
  Comparison differs = compared(Outcome::different, 1), outvoted = compared(Outcome::dispute, 1);
  differs.measurement.differing_at = {{2, 0}};
  differs.measurement.disputed_at = {{0, 1}};
  outvoted.measurement.differing_at = {{1, 1}, {7, 7}};  // a place that the frame has not
  HtmlReport page(folder, 100);
  page.add(verdict_of({differs, compared(Outcome::equal), outvoted, differs}), two.references, two.drawn, {});
  const nlohmann::json view = scene_of(page, folder).view;
  const nlohmann::json all = rows_of(view);
  ASSERT_EQ(view["marks"].size(), 2u) << "one for two rows";
  EXPECT_EQ(all[0]["mark"], all[3]["mark"]);
  EXPECT_FALSE(all[1].contains("mark"));
  const auto marks = [&](std::size_t row) {
    return unpacked({{"data", view["marks"][all[row]["mark"].get<std::size_t>()]}, {"bytes", 1}, {"channels", 1}});
  };
  EXPECT_EQ(marks(0), (std::vector<std::uint32_t>{0, 0, 1, 2, 0, 0}));
  EXPECT_EQ(marks(2), (std::vector<std::uint32_t>{0, 0, 0, 0, 2, 0}));
}

TEST_F(Pages, WhereReferencesAgreeTheSecondTakesNoPlace) {
  TwoPixels two;
  two.drawn.references[1].planes.color = two.drawn.references[0].planes.color;
  HtmlReport page(folder, 100);
  page.add(verdict_of({}), two.references, two.drawn, {}, "why");
  const nlohmann::json color = scene_of(page, folder).view["layers"][0];
  EXPECT_EQ(color["sides"][1]["base"], 0);
  EXPECT_EQ(color["sides"][2]["base"], 1);
  EXPECT_FALSE(color["sides"][2].contains("data"));
}

check::BothCaptures noise(int width, int height) {
  std::mt19937 random(1);
  check::BothCaptures out;
  out.references.resize(1);
  for (Plane<glm::vec4>* plane : {&out.candidate.planes.color, &out.references[0].planes.color}) {
    *plane = Plane<glm::vec4>(width, height);
    for (glm::vec4& v : plane->values())
      for (int c = 0; c < 4; ++c) v[c] = static_cast<float>(random() % 256) / 255;
  }
  return out;
}

TEST_F(Pages, OfManyScenesThatHoldSomeShowTheirColourAlone) {
  const check::Reference references[] = {{"osmesa", nullptr}};
  check::BothCaptures drawn = noise(60, 60);
  drawn.candidate.planes.depth = Plane<double>(60, 60, 0.5);
  HtmlReport page(folder, 100);
  for (int i = 0; i < 200; ++i) page.add(verdict_of({compared(Outcome::equal)}), references, drawn, {});
  page.add(verdict_of({compared(Outcome::different, 1)}), references, drawn, {}, "why");
  page.write("");
  std::size_t size = 0, whole = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    size += entry.is_regular_file() ? entry.file_size() : 0;
  for (int i = 2; i <= 200; ++i)
    whole += shown(folder / fmt::format("group/scene-{}.js", i)).view["layers"].size() == 2 ? 1 : 0;
  EXPECT_LT(size, 5'000'000u);
  EXPECT_GT(size, 4'800'000u);
  EXPECT_GT(whole, 20u);
  EXPECT_LT(whole, 180u);
  EXPECT_EQ(shown(folder / "group/scene-201.js").view["layers"].size(), 2u) << "the one that fails, and comes last";
  EXPECT_EQ(shown(folder / "group/scene-2.js").about["color_alone"], false);
  EXPECT_EQ(shown(folder / "group/scene-200.js").about["color_alone"], true) << "and says so";
}

TEST_F(Pages, AHundredScenesOfNoiseStayBelowFiveMegabytes) {
  const check::BothCaptures drawn = noise(256, 256);
  std::vector<Comparison> all(40, compared(Outcome::different, 1));
  for (Comparison& c : all) c.measurement.worst.place = {200, 30, -1, ""};
  const check::Reference references[] = {{"osmesa", nullptr}};
  HtmlReport page(folder, 100);
  page.add(verdict_of(all), references, drawn, described(std::string(300, 'd')), "why");
  const nlohmann::json view = scene_of(page, folder).view;
  std::size_t size = overview(folder)["scenes"][0].dump().size();
  for (const char* name : {"group/scene.js", "group/scene.png"}) size += fs::file_size(folder / name);
  const std::size_t shared = fs::file_size(folder / "index.html");
  EXPECT_LT(100 * size + shared, 5'000'000u);
  EXPECT_GT(size, 30'000u) << "the place that there is, is used";
  const int x = view["x"], y = view["y"], columns = view["columns"], rows_shown = view["rows"];
  EXPECT_TRUE(x <= 200 && 200 < x + columns && y <= 30 && 30 < y + rows_shown) << "the worst pixel is shown";
  const std::vector<std::uint32_t> ours = unpacked(view["layers"][0]["sides"][0]);
  ASSERT_EQ(ours.size(), static_cast<std::size_t>(4 * columns * rows_shown));
  EXPECT_EQ(static_cast<float>(ours[0]) / 255, drawn.candidate.planes.color(x, y).r);
}

TEST_F(Pages, OfFewScenesEachMayTakeMore) {
  const check::BothCaptures drawn = noise(256, 256);
  const check::Reference references[] = {{"osmesa", nullptr}};
  HtmlReport page(folder, 3);
  page.add(verdict_of({compared(Outcome::different, 1)}), references, drawn, {}, "why");
  EXPECT_EQ(scene_of(page, folder).view["columns"], 256);
}

TEST_F(Pages, PagesReplaceWhatIsNoUtf8AndNothingElse) {
  // Overlong, surrogate, beyond U+10FFFF, a lone continuation, cut short; the others are characters.
  const std::string odd = "\xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \x80 \xe2\x82";
  const std::string fine = "\xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80 \xed\x9f\xbf \xf4\x8f\xbf\xbf";
  HtmlReport page(folder, 100);
  page.add(verdict_of({}), {}, {}, described(odd + "|" + fine));
  page.write(odd + "|" + fine);
  const std::string r = "\xef\xbf\xbd";
  const std::string text = test::text_of(folder / "index.html");
  EXPECT_TRUE(contains(text, r + r + " " + r + r + r + " " + r + r + r + r + " " + r + " " + r + r + "|" + fine))
      << text;
  const std::string description = overview(folder)["scenes"][0]["description"];
  EXPECT_TRUE(description.starts_with(r) && description.ends_with("|" + fine)) << description;
}

TEST_F(Pages, ScenesOfOneNameHaveFilesOfTheirOwn) {
  check::BothCaptures drawn;
  HtmlReport page(folder, 100);
  std::size_t i = 0;
  for (const char* name : {"g/s", "g/s", "g/s-2", "../../s", "g/.s", "g/s"}) {
    drawn.candidate.planes.color = Plane<glm::vec4>(static_cast<int>(++i), 1, glm::vec4(1));
    SceneVerdict verdict = verdict_of({});
    verdict.scene = name;
    page.add(verdict, {}, drawn, {});
  }
  page.write("");
  const nlohmann::json scenes = overview(folder)["scenes"];
  i = 0;
  for (const std::string name : {"g/s", "g/s-2", "g/s-2-2", "~2e./~2e./s", "g/~2es", "g/s-3"}) {
    EXPECT_EQ(scenes[i]["thumbnail"], name + ".png");
    EXPECT_EQ(scenes[i]["file"], name + ".js");
    EXPECT_EQ(read_image(folder / (name + ".png")).width(), static_cast<int>(++i)) << name;
    EXPECT_EQ(shown(folder / (name + ".js")).view["width"], i) << name;
  }
}

TEST_F(Pages, APageAppearsWholeOrNotAtAll) {
  {
    HtmlReport page(folder / "a/b", 1);
    page.add(verdict_of({}), {}, {}, {});
    EXPECT_FALSE(fs::exists(folder / "a/b"));
  }
  EXPECT_EQ(entries(folder), 0u) << "not written, so nothing is left";
  HtmlReport page(folder / "a/b", 1);
  page.write("");
  EXPECT_TRUE(fs::exists(folder / "a/b/index.html"));
  HtmlReport late(folder / "a/b", 1);
  write_file(folder / "a/b/notes.txt", "made while it ran");
  EXPECT_THROW(late.write(""), OutputError);
  EXPECT_EQ(test::text_of(folder / "a/b/notes.txt"), "made while it ran");
}

}  // namespace
}  // namespace plumbline::report
