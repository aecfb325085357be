// Journals as one.
#include <algorithm>

#include <gtest/gtest.h>

#include "campaign/results.h"

namespace plumbline::campaign {
namespace {

const Signature kShade{"shade", "different color", "exact, per stage"}, kClip{"clip", "different p_clip", "osmesa"};

Entry entry(Generator generator, std::uint64_t seed, std::vector<Signature> found = {}) {
  return {{generator, {seed}}, std::move(found), {}, "", "", static_cast<double>(seed)};
}
std::vector<Entry> some() {
  std::vector<Entry> out;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    out.push_back(entry(Generator::hard, seed, seed % 2 == 0 ? std::vector{kShade} : std::vector<Signature>{}));
  }
  out.push_back(entry(Generator::ordinary, 4, {kClip}));
  out.push_back(entry(Generator::ordinary, 5));
  out.back().disputes = {{"merge", "Mesa's fog", "osmesa"}};
  out.push_back(entry(Generator::ordinary, 6));
  out.back().unable = "fog";
  return out;
}

TEST(CampaignResults, AreCountedBySignature) {
  const Results r = merged({some()});
  EXPECT_EQ(r.scenes(), 12u);
  EXPECT_EQ(r.judged.at(Generator::hard), 9u);
  EXPECT_EQ(r.held, 6u);
  EXPECT_EQ(r.unable, (std::map<std::string, std::uint64_t>{{"fog", 1}}));
  ASSERT_EQ(r.found.size(), 2u);
  EXPECT_EQ(r.found[0].signature, kClip);
  EXPECT_EQ(r.found[1].signature, kShade);
  EXPECT_EQ(r.found[1].scenes, 4u);
  EXPECT_EQ(r.found[1].first,
            (std::vector<SceneId>{{Generator::hard, {2}}, {Generator::hard, {4}}, {Generator::hard, {6}}}));
  ASSERT_EQ(r.disputes.size(), 1u);
  EXPECT_TRUE(r.conflicts.empty());
}

TEST(CampaignResults, AreTheSameInAnyOrderAndAnyParts) {
  const std::string whole = json_of(merged({some()}), "terms");
  std::vector<Entry> all = some();
  std::ranges::reverse(all);
  for (Entry& e : all) e.milliseconds *= 3;
  EXPECT_EQ(json_of(merged({all}), "terms"), whole);
  const std::vector<Entry> first(all.begin(), all.begin() + 7), last(all.begin() + 4, all.end());  // three twice
  EXPECT_EQ(json_of(merged({first, last}), "terms"), whole);
  EXPECT_EQ(json_of(merged({last, first, {}}), "terms"), whole);
  EXPECT_NE(json_of(merged({first}), "terms"), whole);
  EXPECT_NE(json_of(merged({some()}), "others"), whole);
}

TEST(CampaignResults, TwoVerdictsOfOneSceneAreAConflict) {
  std::vector<Entry> other = some();
  other[1].found = {kClip};
  other[2].unable = "fog";
  other[1].states = "\x07";
  EXPECT_EQ(json_of(merged({some(), other}), ""), json_of(merged({other, some()}), ""));
  for (const Results& r : {merged({some(), other}), merged({other, some()})}) {
    EXPECT_EQ(r.conflicts, (std::vector<SceneId>{{Generator::hard, {2}}, {Generator::hard, {3}}}));
    EXPECT_EQ(r.scenes(), 10u);
    EXPECT_NE(text_of(r).find("judged differently by two journals: hard/2, hard/3"), std::string::npos) << text_of(r);
  }
}

TEST(CampaignResults, SayWhyNothingCouldBeJudged) {
  std::vector<Entry> all;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    all.push_back(entry(Generator::hard, seed));
    all.back().unable = seed == 1 ? "" : seed == 2 ? "fog" : "textures";
  }
  all.push_back(entry(Generator::hard, 7, {kClip}));
  all.back().unable = "a crash";  // which is a finding
  const Results r = merged({all});
  EXPECT_EQ(r.held, 1u);
  EXPECT_NE(text_of(r).find("nothing could be judged: 5\n      4  textures\n      1  fog\n"), std::string::npos)
      << text_of(r);
  const std::string json = json_of(r, "");
  EXPECT_NE(json.find("\"unable\": 5"), std::string::npos) << json;
  EXPECT_NE(json.find("\"textures\": 4"), std::string::npos) << json;
}

TEST(CampaignResults, AreToldTheMostFrequentFirst) {
  const std::string text = text_of(merged({some()}));
  EXPECT_LT(text.find("4  shade, different color (against exact, per stage): hard/2, hard/4, hard/6"),
            text.find("1  clip, different p_clip (against osmesa): ordinary/4"))
      << text;
  EXPECT_NE(text.find("nothing could be judged: 1"), std::string::npos) << text;
}

}  // namespace
}  // namespace plumbline::campaign
