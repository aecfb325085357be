// Row `picture`: the frame as it ships against the one that was watched.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "check/compare/compare_bits.h"
#include "check/verdict/votes.h"
#include "tests/check/judge/judge_fixtures.h"

namespace plumbline::check {
namespace {

constexpr FrameFormat kFormat = [] {
  FrameFormat out;
  out.width = 3, out.height = 2;
  out.color = ColorFormat::rgba8;
  out.depth = DepthFormat::z16;
  out.stencil = StencilFormat::s8;
  return out;
}();

Planes planes() {
  Planes out;
  out.color = Plane<glm::vec4>(3, 2, glm::vec4(0.0f, 51.0f / 255, 1, 1));
  out.depth = Plane<double>(3, 2, 1.0);
  out.stencil = Plane<std::uint8_t>(3, 2, 7);
  return out;
}

Measurement changed(const std::function<void(Planes&)>& change) {
  Planes other = planes();
  change(other);
  return compare_picture(kFormat, other, planes());
}

TEST(ComparePicture, EqualPlanesAreEqual) {
  const Measurement m = changed([](Planes&) {});
  EXPECT_EQ(m.differing, 0u);
  EXPECT_EQ(m.items, 6u);
  EXPECT_EQ(m.max_difference, 0);
}

TEST(ComparePicture, OneBitOfAnyPlaneDiffers) {
  EXPECT_EQ(changed([](Planes& p) { p.color(1, 1).g += 1.0f / 255; }).differing, 1u);
  EXPECT_EQ(changed([](Planes& p) { p.color(2, 0).a = std::nextafter(1.0f, 0.0f); }).differing, 1u);
  EXPECT_EQ(changed([](Planes& p) { p.color(2, 0).r = -0.0f; }).differing, 1u);
  EXPECT_EQ(changed([](Planes& p) { p.depth(0, 1) = std::nextafter(1.0, 0.0); }).differing, 1u);
  EXPECT_EQ(changed([](Planes& p) { p.stencil(0, 0) = 6; }).differing, 1u);
}

TEST(ComparePicture, NoNumberAndAnotherSizeDiffer) {
  EXPECT_EQ(changed([](Planes& p) { p.color(0, 0).r = std::numeric_limits<float>::quiet_NaN(); }).differing, 1u);
  EXPECT_EQ(changed([](Planes& p) { p.depth(0, 0) = std::numeric_limits<double>::infinity(); }).differing, 1u);
  EXPECT_EQ(changed([](Planes& p) { p.depth = Plane<double>(2, 3, 1.0); }).differing, 6u);
  EXPECT_EQ(changed([](Planes& p) { p.stencil = {}; }).differing, 1u) << "a plane that is not handed out";
}

// NaNs whose bits differ in the quiet bit, which conversion to double sets, or in the payload's last bit.
TEST(ComparePicture, NaNsOfOtherBitsDiffer) {
  const auto apart = [](std::uint32_t bits, std::uint32_t other) {
    Planes a = planes(), b = planes();
    std::memcpy(&a.color(0, 0).r, &bits, sizeof bits);
    std::memcpy(&b.color(0, 0).r, &other, sizeof other);
    return compare_picture(kFormat, a, b).differing;
  };
  EXPECT_EQ(apart(0x7fa00000, 0x7fa00000), 0u);
  EXPECT_EQ(apart(0x7fa00000, 0x7fe00000), 1u);
  EXPECT_EQ(apart(0x7fc00000, 0x7fc00001), 1u);
}

struct JudgePicture : Judge {
  JudgePicture() {
    candidate.on_info = [](RendererInfo&) {};
  }
};

TEST_F(JudgePicture, TheShippedFrameIsHeldToTheWatchedOne) {
  EXPECT_EQ(run().at({"picture", Stage::merge}).outcome, Outcome::equal);
  candidate.on_picture = [](Capture& c) { c.planes.depth(3, 4) += 0x1p-20; };
  const Results results = run();
  const Comparison& row = results.at({"picture", Stage::merge});
  EXPECT_EQ(row.outcome, Outcome::different);
  EXPECT_EQ(row.measurement.differing, 1u);
  EXPECT_EQ(count(results, Outcome::different), 1u) << "nothing else";
  EXPECT_EQ(first_different(verdict)->judge.reference, "picture");
}

TEST_F(JudgePicture, EveryPainterIsHeldAndTheFirstThatDiffersIsNamed) {
  candidate.on_info = [](RendererInfo& info) { info.painters = {"float", info.painters.back()}; };
  std::vector<std::string> asked;
  candidate.before_capture = [&](const Request& r) {
    if (r.planes == WantedPlanes::picture) asked.push_back(r.painter);
  };
  EXPECT_EQ(run().at({"picture", Stage::merge}).outcome, Outcome::equal);
  EXPECT_EQ(asked, candidate.info().painters);
  for (const std::string& wrong : candidate.info().painters) {
    candidate.on_picture = [&](Capture& c) { c.planes.depth(3, 4) += asked.back() == wrong ? 0x1p-20 : 0; };
    const Comparison row = run().at({"picture", Stage::merge});
    EXPECT_EQ(row.outcome, Outcome::different);
    EXPECT_EQ(row.note, "painter " + wrong);
  }
}

TEST_F(JudgePicture, AFrameOfSamplesIsHeldToo) {
  for (const auto kind : {Antialias::Kind::multisample, Antialias::Kind::supersample, Antialias::Kind::taps}) {
    scene.frame.antialias = {kind, kind == Antialias::Kind::supersample ? 2 : 1};
    candidate.on_picture = [](Capture&) {};
    EXPECT_EQ(run().at({"picture", Stage::resolve}).outcome, Outcome::equal);
    candidate.on_picture = [](Capture& c) { c.planes.color(0, 0).g += 1; };
    EXPECT_EQ(run().at({"picture", Stage::resolve}).outcome, Outcome::different);
  }
}

TEST_F(JudgePicture, APainterThatFailsIsARowAndTheOthersAreJudged) {
  candidate.before_capture = [](const Request& r) {
    if (r.planes == WantedPlanes::picture) throw RendererFailed("out of tiles");
  };
  const Results results = run();
  EXPECT_EQ(results.at({"picture", Stage::merge}).outcome, Outcome::failed);
  EXPECT_EQ(results.at({"picture", Stage::merge}).note, "out of tiles");
  EXPECT_EQ(count(results, Outcome::failed), 1u);
}

TEST_F(JudgePicture, ARendererWithoutAPainterHasNoSuchRow) {
  candidate.on_info = [](RendererInfo& info) { info.painters.clear(); };
  EXPECT_FALSE(run().contains({"picture", Stage::merge}));
}

TEST(Picture, HasNoVote) {
  const JudgeId kShips("picture", Kind::picture);
  const auto row = [](const JudgeId& judge, Outcome outcome) {
    Comparison c{"s", judge, Stage::merge, outcome, {}, "", ""};
    c.measurement.differing = outcome == Outcome::different ? 1 : 0;
    c.measurement.max_ratio = outcome == Outcome::different ? HUGE_VAL : 0;
    return c;
  };
  std::vector<Comparison> rows = {row("osmesa", Outcome::different), row({"exact", Kind::per_stage}, Outcome::equal),
                                  row(kShips, Outcome::equal)};
  settle_votes(rows);
  EXPECT_EQ(rows[0].outcome, Outcome::different) << "exact alone is no majority";
  rows = {row(kShips, Outcome::different), row({"exact", Kind::per_stage}, Outcome::equal),
          row("embree", Outcome::equal)};
  settle_votes(rows);
  EXPECT_EQ(rows[0].outcome, Outcome::different) << "nobody outvotes it";
  EXPECT_EQ(std::ranges::count(unjudged_stages({"s", "", {row(kShips, Outcome::equal)}, 0}), Stage::merge), 1);
}

}  // namespace
}  // namespace plumbline::check
