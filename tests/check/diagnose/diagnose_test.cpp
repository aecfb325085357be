// diagnose(): every stage that is wrong is named, a second fault behind a first one too, and nothing where nothing is.
#include "check/diagnose/diagnose.h"
#include "tests/extent.h"

#include <algorithm>
#include <limits>

#include "faults/faults.h"
#include "pipeline/stages.h"
#include "scene/antialias.h"
#include "scene/file/scene_file.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/check/judge/spoiled_renderer.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

using Stages = std::vector<Stage>;

// The pipeline with several faults at once.
std::unique_ptr<Renderer> with(std::initializer_list<std::string_view> names) {
  pipeline::Stages stages = pipeline::production_stages();
  for (const std::string_view name : names) faults::named(name).apply(stages);
  return pipeline::make_pipeline(stages);
}

struct Diagnose : testing::Test {
  Diagnosis of(Renderer& candidate) {
    const Reference references[] = {{"exact", exact.get()}};
    return diagnose(scene, candidate, references);
  }
  Scene scene = two_draws();
  std::unique_ptr<Renderer> exact = exact::make_exact();
};

// Stages of two_draws().
constexpr Stage kOfScene[] = {Stage::matrices, Stage::vertex,     Stage::light, Stage::clip,
                              Stage::window,   Stage::coverage,   Stage::depth, Stage::attributes,
                              Stage::shade,    Stage::visibility, Stage::merge};

TEST_F(Diagnose, NothingIsWrongWithTheProductionPipeline) {
  const auto ours = pipeline::make_pipeline();
  const Diagnosis d = of(*ours);
  EXPECT_EQ(d.first, std::nullopt);
  EXPECT_TRUE(d.wrong.empty());
  EXPECT_TRUE(d.findings.empty());
  EXPECT_FALSE(d.verdict.comparisons.empty());
}

TEST_F(Diagnose, NamesEachStageAlone) {
  for (const Stage stage : kOfScene) {
    Spoiled candidate(pipeline::make_pipeline(), {stage});
    const Diagnosis d = of(candidate);
    EXPECT_EQ(d.wrong, Stages{stage}) << name_of(stage);
    ASSERT_EQ(d.findings.size(), 1u) << name_of(stage);
    EXPECT_EQ(d.findings[0].stage, stage);
    EXPECT_GT(d.findings[0].measurement.differing, 0u);
    EXPECT_FALSE(d.findings[0].numbers.empty());
  }
}

// A stranger whose captures leave the column texture.lod out.
class WithoutLevels : public Spoiled {
 public:
  using Spoiled::Spoiled;
  RendererInfo info() const override {
    RendererInfo out = Spoiled::info();
    out.profile = Profile::foreign;
    return out;
  }
  Capture capture(const Scene& scene, const Request& request) override {
    Capture out = Spoiled::capture(scene, request);
    for (Texel<double>& texel : out.records.texels) texel.lod = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
};

TEST_F(Diagnose, PrintsNoLevelOfDetailThatIsNotTold) {
  scene = suite_scene("texture/board_linear");
  for (const Stage stage : {Stage::texture, Stage::shade}) {
    WithoutLevels candidate(pipeline::make_pipeline(), {stage});
    const Diagnosis d = of(candidate);
    ASSERT_FALSE(d.findings.empty());
    EXPECT_EQ(d.findings[0].stage, stage);
    EXPECT_GT(d.findings[0].numbers.size(), 2u);
    for (const std::string& line : d.findings[0].numbers) EXPECT_EQ(line.find("nan"), std::string::npos) << line;
  }
}

TEST_F(Diagnose, NamesEachPairAndAllAtOnce) {
  for (const Stage a : kOfScene) {
    for (const Stage b : kOfScene) {
      if (a >= b) continue;
      Spoiled candidate(pipeline::make_pipeline(), {a, b});
      EXPECT_EQ(of(candidate).wrong, (Stages{a, b})) << name_of(a) << ", " << name_of(b);
    }
  }
  Spoiled all(pipeline::make_pipeline(), {std::begin(kOfScene), std::end(kOfScene)});
  EXPECT_EQ(of(all).wrong, Stages(std::begin(kOfScene), std::end(kOfScene)));
}

// A window stage that hands on nothing leaves the fault of attributes no pixel to show on.
TEST_F(Diagnose, NamesWhatAFaultBeforeItHides) {
  scene = suite_scene("interpolation/w_ratio");
  pipeline::Stages stages = pipeline::production_stages();
  faults::named("attributes.affine").apply(stages);
  stages.window = [](const pipeline::DrawInput&, const pipeline::Polygon&, std::vector<pipeline::ShadedTriangle>&) {};
  const auto candidate = pipeline::make_pipeline(stages);
  const Diagnosis d = of(*candidate);
  EXPECT_EQ(d.first, Stage::window);
  EXPECT_EQ(d.wrong, (Stages{Stage::window, Stage::attributes}));
  ASSERT_EQ(d.findings.size(), 2u);
  EXPECT_EQ(title_of(d.findings[0].judge), "exact, per stage");
  EXPECT_EQ(title_of(d.findings[1].judge), "exact, repaired");
  // Where the candidate's stages cannot be called, the first alone shows.
  Changed captured(pipeline::make_pipeline(stages));
  captured.on_info = [](RendererInfo& info) {
    for (Ability& a : info.stages) a.runs = false;
  };
  EXPECT_EQ(of(captured).wrong, Stages{Stage::window});
}

TEST_F(Diagnose, NamesStagesOfAnAntialiasedScenesPassesAndResolve) {
  scene = suite_scene("antialias/samples_wedges");
  const auto ours = pipeline::make_pipeline();
  EXPECT_TRUE(of(*ours).wrong.empty());
  const auto one = with({"coverage.samples_mirrored"});
  EXPECT_EQ(of(*one).wrong, Stages{Stage::coverage});
  const auto two = with({"coverage.samples_mirrored", "resolve.truncated"});
  EXPECT_EQ(of(*two).wrong, (Stages{Stage::coverage, Stage::resolve}));
  // Nothing reaches the frame: resolve shows on repaired samples alone.
  pipeline::Stages stages = pipeline::production_stages();
  faults::named("resolve.truncated").apply(stages);
  stages.coverage = [](const pipeline::WindowTriangle&, const pipeline::PixelBounds&) {
    return std::vector<glm::ivec2>();
  };
  const auto hidden = pipeline::make_pipeline(stages);
  EXPECT_EQ(of(*hidden).wrong, (Stages{Stage::coverage, Stage::resolve}));
}

TEST_F(Diagnose, WhatWasMadeOfWrongRecordsIsForgotten) {
  scene = suite_scene("alpha_test/bands");  // visibility looks at shaded fragments, of which there are fewer now
  EXPECT_EQ(of(*with({"matrices.fov_horizontal"})).wrong, Stages{Stage::matrices});
  EXPECT_EQ(of(*with({"window.snap_truncates"})).wrong, Stages{Stage::window});
}

TEST_F(Diagnose, WhatDoesNotFitTheBudgetIsLookedAtAboutTheWorstPixels) {
  scene = suite_scene("interpolation/w_ratio");
  pipeline::Stages stages = pipeline::production_stages();
  faults::named("attributes.affine").apply(stages);
  Changed candidate(pipeline::make_pipeline(stages));
  std::size_t pixels = 0;
  candidate.before_capture = [&](const Request& request) {
    if (request.records.has(Stage::coverage) && request.pixels.empty()) throw OverBudget("too many fragments");
    if (!request.pixels.empty()) pixels = request.pixels.size();
  };
  const Diagnosis d = of(candidate);
  EXPECT_EQ(d.wrong, Stages{Stage::attributes});
  EXPECT_GE(pixels, 9u);
  EXPECT_LE(pixels, 200u);
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(title_of(d.findings[0].judge), "exact, at the worst pixels");
  ASSERT_EQ(d.findings[0].causes.size(), 1u);
  EXPECT_TRUE(d.findings[0].causes[0].starts_with("error grows with the spread of 1/w"));
}

TEST_F(Diagnose, AVaryingIsToldByItsName) {
  scene = suite_scene("texture/globe");
  Changed candidate(pipeline::make_pipeline());
  candidate.on_capture = [](Capture& c) {
    if (!c.records.varyings[Varying::texture].fragments.empty())
      c.records.varyings[Varying::texture].fragments[0].s += 1;
  };
  const Diagnosis d = of(candidate);
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings[0].stage, Stage::attributes);
  EXPECT_STREQ(d.findings[0].measurement.worst.place.field, "texture");
}

TEST_F(Diagnose, OfTooManyFragmentsNoTriangleIsDrawnAsMissing) {
  const auto candidate = with({"coverage.at_corner"});
  const Reference references[] = {{"exact", exact.get()}};
  for (const std::uint64_t most : {std::uint64_t{0}, kMostFragments}) {
    const Diagnosis d = diagnose(scene, *candidate, references, most);
    EXPECT_EQ(d.wrong, Stages{Stage::coverage});
    ASSERT_EQ(d.findings.size(), 1u);
    EXPECT_EQ(d.findings[0].picture.empty(), most == 0);
  }
}

TEST_F(Diagnose, ARendererThatFailsAsAWholeIsWrongInNoStage) {
  Changed candidate(pipeline::make_pipeline());
  candidate.before_capture = [](const Request&) { throw RendererFailed("crashed"); };
  const Diagnosis d = of(candidate);
  EXPECT_TRUE(d.wrong.empty());
  EXPECT_FALSE(d.first);
  EXPECT_EQ(d.verdict.comparisons[0].outcome, Outcome::failed);
  EXPECT_EQ(d.verdict.comparisons[0].note, "crashed");
}

TEST_F(Diagnose, ARendererThatFailsInAStageIsWrongThere) {
  Changed candidate(pipeline::make_pipeline());
  candidate.before_capture = [](const Request&) { throw RendererFailed("crashed"); };
  candidate.before_run = [](Stage stage) {
    if (stage == Stage::window) throw RendererFailed("crashed in window");
  };
  const Diagnosis d = of(candidate);
  EXPECT_EQ(d.wrong, std::vector{Stage::window});
  EXPECT_EQ(d.first, Stage::window);
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].numbers, std::vector<std::string>{"crashed in window"});
  EXPECT_EQ(d.verdict.comparisons[0].stage, Stage::window);
}

TEST_F(Diagnose, WithoutExactTheFirstDifferentStageIsTheFinding) {
  Changed witness(pipeline::make_pipeline());
  witness.on_info = [](RendererInfo& info) {
    info.name = "witness";
    info.profile = Profile::opengl;
    for (Ability& a : info.stages) a.runs = false;
  };
  Spoiled candidate(pipeline::make_pipeline(), {Stage::window});
  const Reference references[] = {{"witness", &witness}};
  const Diagnosis d = diagnose(scene, candidate, references);
  EXPECT_EQ(d.first, Stage::window);
  EXPECT_TRUE(d.wrong.empty());
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].stage, Stage::window);
  const auto says = [&](const std::string& word) {
    return std::ranges::any_of(d.findings[0].numbers, [&](const auto& l) { return l.find(word) != std::string::npos; });
  };
  EXPECT_TRUE(says("p_win") && says("p_clip")) << "both sides' records are there";
}

TEST_F(Diagnose, WhatSteppingInFloatMakesIsFirstOnlyWhereNothingElseIsWrong) {
  // The first fragment's colour is `off` [u].
  const auto of_steps = [&](double off, bool wrong_frame) {
    OursAsAnothers stepped([=](Capture& c) {
      if (!c.records.attributes.empty()) c.records.attributes[0].color.r += off * kU;
      if (!c.records.shaded.empty()) c.records.shaded[0].color.r += off * kU;
      for (glm::vec4& color : c.planes.color.values()) color = wrong_frame ? glm::vec4(0, 0, 0, 1) : color;
    });
    return of(stepped);
  };
  const Diagnosis alone = of_steps(1000, false), hidden = of_steps(1000, true), too_far = of_steps(5000, true);
  EXPECT_EQ(alone.first, Stage::attributes);
  EXPECT_TRUE(differs_by_steps(alone.verdict, Stage::attributes));
  EXPECT_EQ(hidden.wrong.front(), Stage::attributes);
  EXPECT_EQ(hidden.first, Stage::merge);
  EXPECT_FALSE(differs_by_steps(too_far.verdict, Stage::attributes));
}

TEST_F(Diagnose, InBriefNamesTheSameStages) {
  Spoiled candidate(pipeline::make_pipeline(), {Stage::light, Stage::coverage, Stage::merge});
  const Reference references[] = {{"exact", exact.get()}};
  const Diagnosis brief = diagnose_in_brief(scene, candidate, references), full = of(candidate);
  EXPECT_EQ(brief.wrong, full.wrong);
  EXPECT_EQ(brief.first, full.first);
  ASSERT_EQ(brief.findings.size(), 3u);
  EXPECT_EQ(brief.findings[1].measurement.differing, full.findings[1].measurement.differing);
  EXPECT_TRUE(brief.findings[1].picture.empty());
  EXPECT_NE(full.findings[1].picture.find('?'), std::string::npos) << full.findings[1].picture;
}

// A compiler may drop a conversion to float and back, and the rounding with it (check/judge/stage_copy.cpp).
TEST(Repair, RoundsEveryNumber) {
  const auto rounded = [](auto v) { return decltype(v)(glm::vec<decltype(v)::length(), float>(v)) == v; };
  Capture c = exact_capture(two_draws());
  const Scene scene = two_draws();
  std::size_t unrounded = 0;
  for (const auto& v : c.records.vertices) unrounded += rounded(v.n_eye) ? 0 : 1;
  EXPECT_GT(unrounded, 0u);
  for (const Stage stage : kOfScene) round_to_formats(scene, stage, c);
  const Records<double>& r = c.records;
  for (const auto& m : r.matrices)
    EXPECT_TRUE(rounded(m.model_view[0]) && rounded(m.projection[1]) && rounded(m.normal[0]));
  for (const auto& v : r.vertices) EXPECT_TRUE(rounded(v.p_eye) && rounded(v.p_clip) && rounded(v.n_eye));
  for (const auto& l : r.lit) EXPECT_TRUE(rounded(l.color));
  for (const auto& v : r.polygons.vertices) EXPECT_TRUE(rounded(v.p_clip) && rounded(v.color));
  for (const auto& t : r.triangles) {
    for (const auto& v : t.v) EXPECT_TRUE(rounded(v.p_win) && rounded(glm::dvec1(v.inv_w)) && rounded(v.color));
  }
  const double scale = depth_scale(scene.frame.depth);
  for (const double z : r.depth) EXPECT_EQ(z, std::nearbyint(z * scale) / scale);
  for (const auto& a : r.attributes) EXPECT_TRUE(rounded(a.color));
  for (const auto& s : r.shaded) EXPECT_TRUE(rounded(s.color));
  EXPECT_FALSE(r.shaded.empty());
}

// Exact's records, rounded, in the place of every other stage's: what is right raises nothing on them.
TEST_F(Diagnose, RaisesNothingElseOnAnySceneWhereEveryOtherStageIsRepaired) {
  std::size_t files = 0, scenes = 0, findings = 0;
  for (const auto& file : suite_files()) {
    if (file.parent_path().stem() == "models") continue;
    const bool even = ++files % 2 == 0;
    if (files / 2 % one_of(16) != 0) continue;
    scene = load_scene(file, {});
    if (antialiased(scene)) scene = passes_of(scene)[0];
    std::set<Stage> wrong;
    for (std::size_t i = even ? 0 : 1; i <= static_cast<std::size_t>(Stage::merge); i += 2) {
      wrong.insert(static_cast<Stage>(i));
    }
    Spoiled candidate(pipeline::make_pipeline(), wrong);
    const Reference references[] = {{"exact", exact.get()}};
    const auto found = diagnose_in_brief(scene, candidate, references).findings;
    ++scenes, findings += found.size();
    for (const Finding& f : found) {
      EXPECT_TRUE(wrong.contains(f.stage))
          << scene.name << ": " << name_of(f.stage) << ", " << title_of(f.judge) << ": " << f.numbers[0];
    }
  }
  EXPECT_GT(scenes, 10u);
  EXPECT_GT(findings, 2 * scenes) << "of the stages that are not repaired";
}

}  // namespace
}  // namespace plumbline::check
