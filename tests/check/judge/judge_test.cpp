// judge(), with made-up renderers: what each of them may do wrong, and who is blamed.
#include "tests/check/judge/judge_fixtures.h"

namespace plumbline::check {
namespace {

TEST_F(Judge, WhereAllAgreeEveryStageIsJudgedAndNothingFails) {
  BothCaptures drawn;
  const Results results = run({{"witness", &witness}, {"oracle", &oracle}, {"exact", &referee}}, &drawn);
  for (const auto& [key, c] : results) EXPECT_FALSE(is_failure(c.outcome)) << key.first << " " << name_of(key.second);
  EXPECT_EQ(first_different(verdict), nullptr);
  EXPECT_EQ(verdict.scene, scene.name);
  using enum Stage;
  for (Stage stage : {matrices, vertex}) EXPECT_TRUE(results.contains({"exact, from scene", stage}));
  for (Stage stage : {vertex, light, clip, window, coverage, depth, attributes, shade, visibility, merge}) {
    ASSERT_TRUE(results.contains({"exact, per stage", stage})) << name_of(stage);
    const Comparison& c = results.at({"exact, per stage", stage});
    EXPECT_GT(c.measurement.items, 0u) << name_of(stage) << ": nothing was compared";
    EXPECT_NE(c.outcome, Outcome::unsupported) << name_of(stage) << ": " << c.note;
  }
  for (Stage stage : {coverage, depth, attributes, visibility, merge}) {
    ASSERT_TRUE(results.contains({"oracle", stage})) << name_of(stage);
    EXPECT_EQ(results.at({"oracle", stage}).measurement.items, 24u * 16u) << name_of(stage);
  }
  for (Stage stage : {matrices, vertex, light, clip, window, coverage, depth, attributes, visibility, merge}) {
    ASSERT_TRUE(results.contains({"witness", stage})) << name_of(stage);
    EXPECT_EQ(results.at({"witness", stage}).outcome, Outcome::equal) << name_of(stage);
    EXPECT_GT(results.at({"witness", stage}).measurement.items, 0u) << name_of(stage);
  }
  EXPECT_EQ(drawn.candidate.planes.color.width(), 24);
  ASSERT_EQ(drawn.references.size(), 3u);
  for (int i : {0, 1}) EXPECT_EQ(drawn.references[static_cast<std::size_t>(i)].planes.color.height(), 16);
}

TEST_F(Judge, ACandidateThatThrowsHasFailed) {
  candidate.before_capture = [](auto&) { throw RendererFailed("it fell over"); };
  BothCaptures drawn;
  const Results results = run({{"witness", &witness}}, &drawn);
  EXPECT_EQ(count(results, Outcome::failed), 1u);
  EXPECT_EQ(results.at({"ours", Stage::merge}).outcome, Outcome::failed);
  EXPECT_EQ(results.at({"ours", Stage::merge}).note, "it fell over");
  EXPECT_EQ(count(results, Outcome::unsupported), results.size() - 1) << "nothing is compared that it did not draw";
  EXPECT_TRUE(drawn.candidate.planes.color.empty());
  EXPECT_FALSE(drawn.references[0].planes.color.empty());
}

TEST_F(Judge, AReferenceThatIsAbsentIsMissing) {
  const Results results = run({{"embree", nullptr}, {"witness", &witness}});
  EXPECT_EQ(count(results, Outcome::missing), 1u);
  EXPECT_EQ(verdict.comparisons.front().judge.reference, "embree");
  EXPECT_EQ(verdict.comparisons.front().note, "not built in");
  EXPECT_TRUE(results.contains({"witness", Stage::merge})) << "the others go on";
}

TEST_F(Judge, AReferenceThatThrowsHasFailedAndTheOthersGoOn) {
  oracle.before_capture = [](auto&) { throw std::runtime_error("no device"); };
  const Results results = run();
  EXPECT_EQ(count(results, Outcome::failed), 1u);
  EXPECT_EQ(results.at({"oracle", Stage::merge}).note, "no device");
  EXPECT_TRUE(results.contains({"witness", Stage::merge}));
  EXPECT_TRUE(results.contains({"exact, per stage", Stage::merge}));
}

TEST_F(Judge, AReferenceThatCannotDrawTheSceneIsUnsupported) {
  witness.before_capture = [](auto&) { throw Unsupported("no scene file"); };
  const Results results = run({{"witness", &witness}});
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results.begin()->second.outcome, Outcome::unsupported) << "renderer.h says so";
  EXPECT_EQ(results.begin()->second.note, "no scene file");
}

TEST_F(Judge, WhatAReferenceDoesNotShowIsUnsupportedWithItsReason) {
  witness.on_info = [](RendererInfo& info) {
    info.name = "witness";
    info.legal = false;
    for (Ability& a : info.stages) a = {false, false, "it shows nothing"};
  };
  witness.on_capture = [](Capture& c) { c.records = {}, c.planes = {}; };
  const Results results = run({{"witness", &witness}});
  EXPECT_EQ(count(results, Outcome::unsupported), results.size());
  EXPECT_GE(results.size(), 10u);
  for (const auto& [key, c] : results) {
    if (c.stage == Stage::shade) continue;  // the plane of attributes
    EXPECT_EQ(c.note, "it shows nothing") << name_of(c.stage);
  }
}

TEST_F(Judge, WhatOpenGlHasNotIsUnsupportedAndOthersJudgeIt) {
  using enum Stage;
  scene.frame.color = ColorFormat::rgba12;
  scene.frame.depth = DepthFormat::z8;
  witness.on_capture = [](Capture& c) {
    for (double& z : c.planes.depth.values()) z -= 1.0 / 0xffffff;  // a code of 24 bits, next to one of 8
  };
  const Results results = run();
  for (Stage stage : {depth, visibility, merge}) {
    const Comparison& c = results.at({"witness", stage});
    EXPECT_EQ(c.outcome, Outcome::unsupported) << name_of(stage);
    EXPECT_NE(c.note.find(stage == merge ? "12 bits" : "8-bit depth"), std::string::npos) << c.note;
    for (const char* other : {"oracle", "exact, per stage"}) {
      EXPECT_NE(results.at({other, stage}).outcome, Outcome::unsupported) << other << " " << name_of(stage);
      EXPECT_FALSE(is_failure(results.at({other, stage}).outcome)) << other << " " << name_of(stage);
    }
  }
  EXPECT_EQ(results.at({"witness", attributes}).outcome, Outcome::equal);
  EXPECT_TRUE(unjudged_stages(verdict).empty());
}

TEST_F(Judge, OtherWinnersInADepthFormatThatOpenGlHasNotAreUnsupported) {
  witness.on_capture = [](Capture& c) {
    c.planes.depth.values().assign(c.planes.depth.size(), 1);  // a code of any format
    c.planes.id(3, 4) = c.planes.id(3, 4) == 0 ? 1 : 0;
  };
  const auto outcome = [&](DepthFormat format, StencilFormat stencil) {
    scene.frame.depth = format;
    scene.frame.stencil = stencil;
    return run().at({"witness", Stage::visibility}).outcome;
  };
  EXPECT_EQ(outcome(DepthFormat::z8, StencilFormat::none), Outcome::unsupported);
  EXPECT_EQ(outcome(DepthFormat::z16, StencilFormat::s8), Outcome::unsupported);
  EXPECT_NE(outcome(DepthFormat::z16, StencilFormat::none), Outcome::unsupported);
  EXPECT_NE(outcome(DepthFormat::z24, StencilFormat::s8), Outcome::unsupported);
}

TEST_F(Judge, WhatTheCandidateDoesNotShowIsUnsupportedAndNotEqual) {
  candidate.on_info = [](RendererInfo& info) {
    info.name = "theirs";
    for (Ability& a : info.stages) a = {false, false, "it shows nothing"};
  };
  candidate.on_capture = [](Capture& c) { c.records = {}, c.planes = {}; };
  for (const std::vector<Reference>& references :
       {std::vector<Reference>{{"witness", &witness}}, {{"oracle", &oracle}}, {{"exact", &referee}}}) {
    const Results results = run(references);
    EXPECT_GT(results.size(), 0u);
    for (const auto& [key, c] : results) {
      EXPECT_EQ(name_of(c.outcome), name_of(Outcome::unsupported)) << key.first << " " << name_of(key.second) << c.note;
    }
  }
}

TEST_F(Judge, ACandidateOfPlanesAloneIsJudgedByThem) {
  using enum Stage;
  const StageSet shown = {coverage, depth, attributes, visibility, merge};
  candidate.on_info = [&](RendererInfo& info) {
    for (std::size_t i = 0; i < info.stages.size(); ++i) {
      info.stages[i].planes_alone = true;
      if (!shown.has(static_cast<Stage>(i))) info.stages[i] = {false, false, "planes alone"};
    }
  };
  candidate.on_capture = [](Capture& c) { c.records = {}; };
  const Results results = run();
  for (Stage stage : {coverage, depth, attributes, visibility, merge}) {
    EXPECT_FALSE(is_failure(results.at({"oracle", stage}).outcome)) << name_of(stage);
    EXPECT_NE(results.at({"oracle", stage}).outcome, Outcome::unsupported) << name_of(stage);
  }
  for (Stage stage : {coverage, visibility}) {
    EXPECT_EQ(results.at({"witness", stage}).outcome, Outcome::equal) << name_of(stage);
  }
  for (Stage stage : {depth, attributes, merge}) {
    EXPECT_EQ(results.at({"witness", stage}).note, "matrices: planes alone") << "its tolerance is made of records";
  }
  for (Stage stage : {matrices, vertex, light, clip, window}) {
    EXPECT_EQ(name_of(results.at({"witness", stage}).outcome), "unsupported") << name_of(stage);
  }
  EXPECT_EQ(count(results, Outcome::different), 0u) << "what is not shown is not different";
}

TEST_F(Judge, ACandidateOfAnotherSizeIsDifferentAndDoesNotCrash) {
  candidate.on_capture = [](Capture& c) {
    const Scene turned = two_draws(16, 24);
    c = pipeline::make_pipeline()->capture(turned, {.records = StageSet::all()});
  };
  for (const Reference& reference : {Reference{"witness", &witness}, Reference{"oracle", &oracle}}) {
    const Results results = run({reference});
    EXPECT_EQ(results.at({reference.name, Stage::merge}).outcome, Outcome::different);
    EXPECT_EQ(results.at({reference.name, Stage::visibility}).outcome, Outcome::different);
  }
  EXPECT_GT(count(run({{"exact", &referee}}), Outcome::different), 0u);
}

TEST_F(Judge, FragmentsBeyondTheBudgetAreUnsupportedTheRestIsJudged) {
  int tries = 0;
  candidate.before_capture = [&](const Request& request) {
    ++tries;
    if (request.records.has(Stage::coverage)) throw OverBudget("too many fragments");
    EXPECT_TRUE(request.records.has(Stage::window));
  };
  const Results results = run();
  EXPECT_EQ(tries, 2);
  EXPECT_EQ(count(results, Outcome::different) + count(results, Outcome::failed), 0u);
  for (Stage stage : {Stage::depth, Stage::attributes, Stage::shade}) {
    const Comparison& c = results.at({"exact, per stage", stage});
    EXPECT_EQ(c.outcome, Outcome::unsupported) << name_of(stage);
    EXPECT_NE(c.note.find("more fragments"), std::string::npos) << c.note;
  }
  for (Stage stage : {Stage::vertex, Stage::light, Stage::clip, Stage::window, Stage::coverage}) {
    EXPECT_GT(results.at({"exact, per stage", stage}).measurement.items, 0u) << name_of(stage);
  }
  EXPECT_EQ(results.at({"witness", Stage::merge}).outcome, Outcome::equal);
}

TEST_F(Judge, OfMoreFragmentsThanGivenNothingIsRecordedOrAskedFor) {
  const auto judged_up_to = [&](std::uint64_t most) {
    std::size_t recorded = 0, legal = 0;
    candidate.before_capture = [&](const Request& r) { recorded += r.records.has(Stage::depth) ? 1 : 0; };
    oracle.before_capture = [&](const Request& r) { legal += r.legal ? 1 : 0; };
    const Reference references[] = {{"witness", &witness}, {"oracle", &oracle}, {"exact", &referee}};
    verdict = judge(scene, candidate, references, nullptr, most);
    EXPECT_EQ(first_different(verdict), nullptr);
    return std::pair(recorded, legal);
  };
  const Capture all = referee.capture(scene, Request{});
  std::uint64_t fragments = 0;
  for (const std::uint32_t n : all.planes.count.values()) fragments += n;
  EXPECT_EQ(judged_up_to(fragments), std::pair(std::size_t{1}, std::size_t{1}));
  EXPECT_EQ(judged_up_to(fragments - 1), std::pair(std::size_t{0}, std::size_t{0}));
}

TEST_F(Judge, ACandidateBeyondEveryBudgetEndsTheSceneBeforeAReferenceDraws) {
  bool asked = false;
  candidate.before_capture = [](auto&) { throw OverBudget("too large"); };
  witness.before_capture = [&](auto&) { asked = true; };
  EXPECT_THROW(run({{"witness", &witness}}), OverBudget);
  EXPECT_FALSE(asked);
}

TEST_F(Judge, FragmentsThatDoNotFitEachOtherAreDifferentNotOverBudget) {
  candidate.on_capture = [](Capture& c) { c.records.depth.pop_back(); };
  const Results results = run({{"exact", &referee}});
  EXPECT_EQ(name_of(results.at({"exact, per stage", Stage::depth}).outcome), "different");
}

TEST_F(Judge, ARefereeThatThrowsFailsAndWhatItSaidBeforeStays) {
  referee.before_run = [](Stage stage) {
    if (stage == Stage::window) throw std::runtime_error("out of range");
  };
  candidate.on_capture = [](Capture& c) { c.records.vertices[0].p_eye.x += 1; };
  const Results results = run({{"exact", &referee}, {"witness", &witness}});
  EXPECT_EQ(count(results, Outcome::failed), 1u);
  EXPECT_TRUE(results.contains({"witness", Stage::merge})) << "the others go on";
  ASSERT_TRUE(results.contains({"exact, per stage", Stage::vertex})) << "judged before it threw";
  EXPECT_EQ(results.at({"exact, per stage", Stage::vertex}).outcome, Outcome::different);
}

TEST_F(Judge, EveryStageOfTheCandidateIsHeldToItsOwnRecords) {
  using enum Stage;
  const std::vector<std::pair<Stage, std::function<void(Capture&)>>> faults = {
      {vertex, [](Capture& c) { c.records.vertices[3].n_eye.y += 1e-3; }},
      {light, [](Capture& c) { c.records.lit[3].color.g += 1e-3; }},
      {clip, [](Capture& c) { c.records.polygons.vertices[0].color.g += 1e-3; }},
      {window, [](Capture& c) { c.records.triangles[0].v[1].snapped.x += 1; }},
      {coverage, [](Capture& c) { c.planes.id_sum(5, 5) += 1; }},
      {coverage, [](Capture& c) { std::swap(c.records.covered[0].x, c.records.covered[0].y); }},
      {depth, [](Capture& c) { c.records.depth[7] += 1e-4; }},
      {attributes, [](Capture& c) { c.records.attributes[7].color.r += 1e-3; }},
      {shade, [](Capture& c) { c.records.shaded[7].color.r += 1e-3; }},
      {visibility, [](Capture& c) { c.planes.id(5, 5) += 1; }},
      {merge, [](Capture& c) { c.planes.color(5, 5).r += 1 / 255.0f; }},
      {merge, [](Capture& c) { c.planes.depth(5, 5) -= 1e-6; }}};
  for (const auto& [stage, fault] : faults) {
    candidate.on_capture = fault;
    const Results results = run({{"exact", &referee}});
    EXPECT_EQ(results.at({"exact, per stage", stage}).outcome, Outcome::different) << name_of(stage);
    ASSERT_NE(first_different(verdict), nullptr) << name_of(stage);
    EXPECT_EQ(first_different(verdict)->stage, stage);
  }
}

// Marked as drawn, a hidden fragment is what the frame holds, and the next of its depth an open test.
TEST_F(Judge, AFragmentDrawnWronglyLeavesNothingOpen) {
  scene.draws.push_back(scene.draws[1]);
  for (Draw& draw : scene.draws) draw.merge.blend = Blend{};
  const auto spoil = [](Capture& c, bool drawn_wrongly) {
    const Records<double>& r = c.records;
    const auto hidden = std::ranges::find_if(r.covered, [&](const Covered& f) {
      const std::uint32_t primitive = r.triangles[f.triangle].primitive;
      return c.planes.id(f.x, f.y) < 2 && (primitive == 2 || primitive == 3);
    });
    ASSERT_NE(hidden, r.covered.end());
    if (drawn_wrongly) c.records.drawn[static_cast<std::size_t>(hidden - r.covered.begin())].drawn = true;
    float& red = c.planes.color(hidden->x, hidden->y).r;
    red = red < 0.5f ? 1 : 0;
  };
  const auto run_it = [&] { return run({{"witness", &witness}, {"exact", &referee}}); };
  EXPECT_FALSE(is_failure(run_it().at({"witness", Stage::merge}).outcome));
  for (const bool drawn_wrongly : {false, true}) {
    candidate.on_capture = [&](Capture& c) { spoil(c, drawn_wrongly); };
    const Results results = run_it();
    EXPECT_EQ(results.at({"witness", Stage::merge}).outcome, Outcome::different) << drawn_wrongly;
    EXPECT_EQ(results.at({"exact, per stage", Stage::visibility}).outcome == Outcome::different, drawn_wrongly);
  }
}

TEST_F(Judge, AWinnerApartIsOnePixelApart) {
  candidate.on_capture = [](Capture& c) { c.planes.id(5, 5) = 1'000'000; };
  const Measurement m = run({{"exact", &referee}}).at({"exact, per stage", Stage::visibility}).measurement;
  EXPECT_EQ(m.unit, "pixels");
  EXPECT_EQ(m.max_difference, 1) << "the difference of two numbers of primitives means nothing";
}

TEST_F(Judge, WithoutReferencesThereIsNoVerdict) { EXPECT_TRUE(run(std::vector<Reference>{}).empty()); }

TEST_F(Judge, RecordsOfMoreFragmentsThanTheLimitAreNotJudgedOneByOne) {
  for (const Antialias::Kind kind : {Antialias::Kind::none, Antialias::Kind::supersample}) {
    scene.frame.antialias = {kind, 2};
    const Reference references[] = {{"exact", &referee}};
    for (const std::uint64_t most : {~std::uint64_t{0}, std::uint64_t{4}}) {
      int rows = 0;
      for (const Comparison& c : judge(scene, candidate, references, nullptr, most).comparisons) {
        if (c.stage != Stage::depth || c.judge.kind != Kind::per_stage) continue;
        ++rows;
        EXPECT_EQ(c.outcome == Outcome::unsupported, most == 4) << c.note;
      }
      EXPECT_EQ(rows, 1);
    }
  }
}

}  // namespace
}  // namespace plumbline::check
