// Random numbers that are the same everywhere, and scenes' names.
#include <stdexcept>

#include <gtest/gtest.h>

#include "campaign/scene_id.h"
#include "campaign/text/choices.h"

namespace plumbline::campaign {
namespace {

std::uint64_t hash_of(const std::string& text) {  // FNV-1a
  std::uint64_t out = 0xcbf29ce484222325;
  for (const char c : text) out = (out ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return out;
}
std::uint64_t hash_of_scenes(Generator generator) {
  std::string all;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) all += scene_text({generator, {seed}});
  return hash_of(all);
}

Choices choices(std::vector<std::uint64_t> seeds) { return Choices(seeds); }

// mt19937_64's numbers are the standard's, and the distributions are ours: the same text on any machine.
TEST(SceneText, IsTheSameForTheSameSeed) {
  EXPECT_EQ(hash_of_scenes(Generator::ordinary), 10614548038268845290u);
  EXPECT_EQ(hash_of_scenes(Generator::hard), 18330438398356533061u);
  EXPECT_EQ(hash_of_scenes(Generator::plain), 7565363859689327236u);
  EXPECT_EQ(hash_of_scenes(Generator::flat), 7286729620011264260u);
  EXPECT_EQ(hash_of_scenes(Generator::inside), 9902523354087685519u);
}

TEST(SceneText, OfTwoSeedsIsAFewChoicesFromTheFirst) {
  for (const Generator generator : kGenerators) {
    int same = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      std::string of_one = scene_text({generator, {seed}}), of_two = scene_text({generator, {seed, 7}});
      of_one.erase(0, of_one.find("\n", 3)), of_two.erase(0, of_two.find("\n", 3));  // without the description
      same += of_one == of_two ? 1 : 0;
      EXPECT_EQ(scene_text({generator, {seed, 7}}), scene_text({generator, {seed, 7}}));
    }
    EXPECT_LT(same, 50) << name_of(generator);
  }
}

TEST(Choices, AreInTheirRange) {
  Choices c = choices({1});
  bool low = false, high = false;
  for (int i = 0; i < 1000; ++i) {
    const int k = c.count(-3, 5);
    ASSERT_TRUE(k >= -3 && k <= 5);
    low |= k == -3, high |= k == 5;
    const double x = c.number(0.25, 0.75);
    ASSERT_TRUE(x >= 0.25 && x <= 0.75);
  }
  EXPECT_TRUE(low && high);
}

TEST(Choices, OfAFurtherSeedReplaceOneInTwentyFour) {
  Choices of_one = choices({1}), of_two = choices({1, 2});
  int replaced = 0;
  for (int i = 0; i < 24000; ++i) {
    replaced += of_one.whole(0, 0xffffffff) != of_two.whole(0, 0xffffffff) ? 1 : 0;
  }
  EXPECT_NEAR(replaced, 1000, 150);
}

TEST(SceneId, IsReadAsItIsWritten) {
  for (const char* text : {"ordinary/1", "hard/18446744073709551615", "hard/17.3", "ordinary/1.2.3"}) {
    EXPECT_EQ(to_string(scene_id_of(text)), text);
  }
  EXPECT_EQ(scene_id_of("hard/17.3"), (SceneId{Generator::hard, {17, 3}}));
}

TEST(SceneId, OfOtherTextIsRefused) {
  for (const char* text : {"", "hard", "hard/", "hard/x", "hard/1.", "hard/1/2", "hard/-1", "hard/01", "soft/1",
                           "hard/ 1", "hard/18446744073709551616", "ordinary1", "ordinary.1"}) {
    EXPECT_THROW(scene_id_of(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace plumbline::campaign
