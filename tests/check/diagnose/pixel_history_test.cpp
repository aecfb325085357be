// A pixel's history: every fate, with hand-computed numbers; and a fault's fate beside exact's.
#include "check/diagnose/history.h"

#include "faults/faults.h"
#include "report/text/history_text.h"
#include "tests/check/judge/fates_scene.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/oracle/window_answers.h"

namespace plumbline::check {
namespace {

constexpr glm::ivec2 kPixel(1, 1);

struct HistoryTest : testing::Test {
  History ask(glm::ivec2 pixel = kPixel) {
    const Reference references[] = {{"exact", exact.get()}};
    return pixel_history(scene, candidate, references, pixel);
  }
  std::vector<PixelHistory> renderers(glm::ivec2 pixel = kPixel) { return ask(pixel).samples.at(0).renderers; }
  // Ours with the fault, then exact.
  std::vector<PixelHistory> with_fault(std::string_view name) {
    const std::unique_ptr<Renderer> faulty = pipeline::make_pipeline(faults::named(name).stages());
    const Reference references[] = {{"exact", exact.get()}};
    return pixel_history(scene, *faulty, references, kPixel).samples.at(0).renderers;
  }
  Scene scene = fates_scene();
  Changed candidate{pipeline::make_pipeline()};
  std::unique_ptr<Renderer> exact = exact::make_exact();
};

std::vector<Fate> fates(const PixelHistory& history) {
  std::vector<Fate> out;
  for (const PixelFragment& f : history.fragments) out.push_back(f.fate);
  return out;
}

TEST_F(HistoryTest, EveryFateHappensInOrderWithItsNumbers) {
  for (const PixelHistory& h : renderers()) {
    SCOPED_TRACE(h.renderer);
    EXPECT_EQ(h.absent, "");
    EXPECT_TRUE(h.lacks.empty());
    EXPECT_TRUE(h.notes.empty());
    ASSERT_EQ(fates(h), (std::vector<Fate>{Fate::overwritten, Fate::alpha, Fate::stencil, Fate::depth, Fate::scissor,
                                           Fate::culled, Fate::winner}));
    const auto& f = h.fragments;
    EXPECT_EQ(f[0].why, "depth 12582911 < 16777215; primitive 6 replaces it");
    EXPECT_EQ(f[1].why, "not alpha 64 > 128");  // 63.75 and 127.5, the half to even
    EXPECT_EQ(f[2].why, "not stencil 1 == 0 (then 0 becomes 1)");
    EXPECT_EQ(f[3].why, "not depth 15728639 < 12582911, stencil always (7, 1) (then 1 becomes 7)");
    EXPECT_EQ(f[4].why, "not in the box from 4,4 to below 8,8");
    EXPECT_EQ(f[5].why, "it faces the front, front faces are culled");
    EXPECT_EQ(f[6].why, "depth 4194304 < 12582911");
    for (std::size_t i = 0; i < f.size(); ++i) {
      EXPECT_EQ(f[i].primitive, i);
      EXPECT_EQ(f[i].draw, i);
      EXPECT_TRUE(f[i].front);
      EXPECT_EQ(f[i].drawn, i == 0 || i == 6);
      EXPECT_EQ(f[i].held_depth.has_value(), i < 4 || i == 6);
      EXPECT_EQ(glm::vec4(*f[i].color), scene.draws[i].material.diffuse);
      EXPECT_EQ(glm::vec4(*f[i].shaded), scene.draws[i].material.diffuse);
      EXPECT_FALSE(f[i].texel || f[i].lod);
    }
    EXPECT_EQ(std::round(*f[0].depth * 16777215), kFar);
    EXPECT_EQ(std::round(*f[3].depth * 16777215), kFarther);
    EXPECT_EQ(std::round(*f[6].depth * 16777215), kNear);
    EXPECT_EQ(*f[0].held_depth, 1);
    EXPECT_EQ(*f[3].held_depth, kFar / 16777215.0);
    EXPECT_EQ(*f[2].held_stencil, 0);
    EXPECT_EQ(*f[3].held_stencil, 1);
    EXPECT_EQ(*f[6].held_stencil, 7);
    EXPECT_EQ(*h.color, glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(*h.depth, kNear / 16777215.0);
    EXPECT_EQ(*h.stencil, 7);
  }
}

// visibility.drawn is optional: without it the tests say what is drawn, and nothing is said against the frame.
TEST_F(HistoryTest, WhereItIsNotToldWhatIsDrawnTheTestsSay) {
  candidate.on_capture = [](Capture& c) { c.records.drawn.clear(); };
  const std::vector<PixelHistory> both = renderers();
  EXPECT_EQ(fates(both[0]), fates(both[1]));
  EXPECT_TRUE(both[0].lacks.contains("drawn"));
  EXPECT_TRUE(both[0].notes.empty());
  EXPECT_EQ(both[0].fragments[0].drawn, std::nullopt);
  EXPECT_EQ(both[0].fragments[0].why, both[1].fragments[0].why);
}

TEST_F(HistoryTest, APixelThatNothingReachesHasTheClearValues) {
  for (const PixelHistory& h : renderers({7, 7})) {
    EXPECT_TRUE(h.fragments.empty() && h.lacks.empty() && h.notes.empty()) << h.renderer;
    EXPECT_EQ(*h.depth, 1);
    EXPECT_EQ(*h.stencil, 0);
  }
}

TEST_F(HistoryTest, BlendingGoesOverWhatIsThere) {
  scene.draws[6].merge.blend.emplace();
  for (const PixelHistory& h : renderers()) {
    EXPECT_EQ(h.fragments[0].why, "depth 12582911 < 16777215; primitive 6 is blended with it") << h.renderer;
  }
}

// 16 texels over 8 pixels: two a pixel, the level is log2(2).
TEST_F(HistoryTest, TextureAndVaryingsAreToldWhereTheDrawHasThem) {
  Texture& texture = scene.textures.emplace_back();
  texture.format = TextureFormat::rgba;
  set_levels(texture, {16, 16, std::vector<glm::vec4>(256, glm::vec4(1, 0, 0, 1))});
  scene.draws[6].texture = DrawTexture{0, TextureEnvironment::replace, {}};
  scene.meshes[6].texcoords = {{0, 0}, {1, 0}, {0, 1}};
  scene.draws[0].lit = true;
  scene.draws[0].shading = Shading::phong;
  for (const PixelHistory& h : renderers()) {
    SCOPED_TRACE(h.renderer);
    const PixelFragment &lit = h.fragments[0], &textured = h.fragments[6];
    ASSERT_EQ(lit.varyings.size(), 2u);
    EXPECT_EQ(lit.varyings[0].first, Varying::normal);
    EXPECT_EQ(lit.varyings[1].first, Varying::position);
    EXPECT_EQ(lit.varyings[1].second.z, -4);  // window depth 3/4 of 1 to 5
    EXPECT_FALSE(lit.texel || lit.lod);
    ASSERT_EQ(textured.varyings.size(), 1u);
    EXPECT_EQ(textured.varyings[0].second, glm::dvec4(0.1875, 0.1875, 0, 1));  // 1.5 pixels of 8
    EXPECT_EQ(*textured.texel, glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(*textured.lod, 1);
    EXPECT_EQ(*textured.shaded, glm::dvec4(1, 0, 0, 1));
    EXPECT_TRUE(h.lacks.empty());
  }
}

// The fault's fragment is drawn where exact's dies, and its own numbers say that it should not be.
TEST_F(HistoryTest, AFaultShowsAnotherFateThanExact) {
  struct Case {
    const char* fault;
    std::size_t primitive;
    Fate exact;
    const char* why;
  };
  scene.draws[1].material.diffuse.a = 0.5f;
  scene.draws[3].stencil.reset();
  scene.meshes[3] = scene.meshes[0];  // as deep as the first
  scene.draws[4].scissor = Scissor{0, 0, 1, 1};
  for (const Case& c :
       {Case{"visibility.alpha_at_reference", 1, Fate::alpha, "though not alpha 128 > 128"},
        Case{"visibility.less_equal", 3, Fate::depth, "though not depth 12582911 < 12582911"},
        Case{"coverage.scissor_inclusive", 4, Fate::scissor, "though not in the box from 0,0 to below 1,1"}}) {
    SCOPED_TRACE(c.fault);
    const std::vector<PixelHistory> both = with_fault(c.fault);
    const PixelFragment &mine = both[0].fragments.at(c.primitive), &theirs = both[1].fragments.at(c.primitive);
    EXPECT_EQ(theirs.fate, c.exact);
    EXPECT_EQ(theirs.drawn, false);
    EXPECT_EQ(mine.fate, Fate::overwritten);
    EXPECT_EQ(mine.drawn, true);
    EXPECT_NE(mine.why.find(c.why), std::string::npos) << mine.why;
  }
}

TEST_F(HistoryTest, WhatTheFrameHoldsBesideWhatTheFragmentsLeave) {
  const std::vector<PixelHistory> both =
      with_fault("visibility.stencil_ops_swapped");  // depth's failure keeps the value
  ASSERT_EQ(both[0].notes.size(), 1u);
  EXPECT_EQ(both[0].notes[0], "by its fragments the stencil value is 7, by its frame 1");
  EXPECT_TRUE(both[1].notes.empty());
}

TEST_F(HistoryTest, AFragmentThatPassesAndIsNotDrawnIsDiscarded) {
  candidate.on_capture = [](Capture& c) {
    if (!c.records.drawn.empty()) c.records.drawn.back().drawn = false;
  };
  const std::vector<PixelHistory> both = renderers();
  EXPECT_EQ(both[0].fragments[6].fate, Fate::discarded);
  EXPECT_EQ(both[0].fragments[6].why, "passes, and is not drawn: depth 4194304 < 12582911");
  EXPECT_EQ(both[0].fragments[0].fate, Fate::winner);
  ASSERT_EQ(both[0].notes.size(), 2u);  // the frame has the other
  EXPECT_EQ(both[0].notes[0], "by its fragments the winner is 0, by its frame 6");
}

// A ramp over x, sampled at pixels' lower left corners: fragments and legal answers are those of one place.
TEST_F(HistoryTest, ASampleThatIsDeclaredMovesAllOnce) {
  scene = math::window_scene({{{{0, 0, 0.5f}, {64, 0, 0.5f}, {0, 64, 0.5f}}}}, 64);
  candidate.on_info = [](RendererInfo& info) {
    info.profile = Profile::foreign;
    info.conventions.sample = glm::dvec2(0);
  };
  const PixelHistory of_exact = renderers({16, 8}).at(1);
  ASSERT_EQ(of_exact.fragments.size(), 1u);
  ASSERT_FALSE(of_exact.legal.empty());
  EXPECT_FLOAT_EQ(of_exact.legal[0].color.r, 16 / 64.0f);
  EXPECT_NEAR(of_exact.fragments[0].shaded->r, 16 / 64.0, 1e-6);
}

TEST_F(HistoryTest, WhatIsNotToldIsSaidWithItsReason) {
  candidate.on_info = [](RendererInfo& info) { info[Stage::coverage] = {false, false, "made of fog"}; };
  candidate.on_capture = [](Capture& c) {
    c.records = {};
    c.planes.depth = {};
  };
  const Reference references[] = {{"exact", exact.get()}, {"gone", nullptr}};
  const History history = pixel_history(scene, candidate, references, kPixel);
  const auto& all = history.samples[0].renderers;
  EXPECT_EQ(all[0].lacks.at("fragments"), "made of fog");
  EXPECT_EQ(all[2].absent, "missing: not built in");
  const std::string text = report::history_text(scene, history);
  EXPECT_NE(text.find("] ours: made of fog\n"), std::string::npos) << text;
  EXPECT_NE(text.find("] ours: it shows no depth of the frame\n"), std::string::npos) << text;
  EXPECT_NE(text.find("] gone: missing: not built in\n"), std::string::npos) << text;
  candidate.before_capture = [](const Request&) { throw Unsupported("no rays today"); };
  EXPECT_EQ(renderers()[0].absent, "unsupported: no rays today");
  candidate.before_capture = [](const Request&) { throw std::runtime_error("boom"); };
  EXPECT_EQ(renderers()[0].absent, "failed: boom");
  EXPECT_EQ(renderers()[1].absent, "");
}

TEST_F(HistoryTest, PixelsBeyondTheFrameAreRefusedWithItsSize) {
  for (const glm::ivec2 p : {glm::ivec2(8, 0), glm::ivec2(0, 8), glm::ivec2(-1, 0), glm::ivec2(0, -1)}) {
    try {
      ask(p);
      ADD_FAILURE() << p.x << "," << p.y;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find("8 x 8, from 0,0 to 7,7"), std::string::npos) << e.what();
    }
  }
}

// Four samples are four passes; 3 x 3 are nine pixels of one.
TEST_F(HistoryTest, AnAntialiasedPixelHasAHistoryForEachSample) {
  scene.frame.antialias.kind = Antialias::Kind::multisample;
  History history = ask();
  ASSERT_EQ(history.samples.size(), 4u);
  ASSERT_EQ(history.resolved.size(), 2u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(history.samples[i].pass, i);
    EXPECT_EQ(history.samples[i].pixel, kPixel);
    for (const PixelHistory& h : history.samples[i].renderers) EXPECT_EQ(h.fragments.size(), 7u);
  }
  scene.frame.antialias = {Antialias::Kind::supersample, 3};
  history = ask();
  ASSERT_EQ(history.samples.size(), 9u);
  EXPECT_EQ(history.samples[5].pixel, glm::ivec2(5, 4));
  for (const check::SampleHistory& s : history.samples) {
    for (const PixelHistory& h : s.renderers) {
      EXPECT_EQ(h.fragments.size(), 7u);
      EXPECT_TRUE(h.notes.empty());
    }
  }
  EXPECT_EQ(*history.resolved[0].color, glm::vec4(0, 0, 1, 1));
}

TEST_F(HistoryTest, TextAndJsonCarryIt) {
  const History history = ask();
  const std::string text = report::history_text(scene, history), json = report::history_json(scene, history);
  EXPECT_TRUE(text.starts_with("pixel 1,1 of 8 x 8, rows from the bottom\n")) << text;
  for (const char* part : {"primitive 3: number 0 of mesh 3, draw 3\n", "0.25 = code 4194303.75",
                           "winner: depth 4194304 <", "= codes 0 0 255 255"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  for (const char* part : {R"("scene": "test/fates")", R"("fate": "stencil")", R"("why": "not alpha 64 > 128")",
                           R"("held_stencil": 7)", R"("texel": null)"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
  }
}

}  // namespace
}  // namespace plumbline::check
