// The notes' lines: closest pixels, no gap, ties to E, in every octant and through any frame.
#include "notes/raster/line.h"
#include "tests/extent.h"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace {

using namespace plumbline::raster;
using Algorithm = std::function<std::vector<LinePixel>(const LinePixel&, const LinePixel&, glm::ivec2)>;

struct Named {
  const char* name;
  Algorithm draw;
};
const Named kAlgorithms[] = {
    {"brute force", brute_force_line}, {"incremental", incremental_line}, {"midpoint", midpoint_line}};

LinePixel end(int x, int y, float depth = 0, glm::vec4 color = glm::vec4(0)) { return {{x, y}, depth, color}; }
LinePixel end(glm::ivec2 p) { return end(p.x, p.y); }

bool operator==(const LinePixel& a, const LinePixel& b) {
  return a.pixel == b.pixel && a.depth == b.depth && a.color == b.color;
}
std::vector<glm::ivec2> pixels_of(const std::vector<LinePixel>& line) {
  std::vector<glm::ivec2> pixels;
  for (const LinePixel& p : line) pixels.push_back(p.pixel);
  return pixels;
}

/// The whole line between two pixels that may lie below 0: it is moved into a frame and back.
std::vector<glm::ivec2> whole(const Algorithm& draw, glm::ivec2 from, glm::ivec2 to) {
  const glm::ivec2 low = glm::min(from, to), frame = glm::max(from, to) - low + 1;
  std::vector<glm::ivec2> pixels = pixels_of(draw(end(from - low), end(to - low), frame));
  for (glm::ivec2& p : pixels) p += low;
  return pixels;
}

/// How a pixel lies beside the line from `a` to `b`, by integers alone, in any octant: distance along the minor axis,
/// times twice the length along the major one; and whether it is on a's side of the line: where E leads.
struct Beside {
  std::int64_t twice_distance, length;
  bool towards_e;
  bool closest() const { return twice_distance < length || (is_tie() && towards_e); }
  bool is_tie() const { return twice_distance == length; }
};
Beside beside(glm::i64vec2 a, glm::i64vec2 b, glm::i64vec2 p) {
  const glm::i64vec2 d = b - a, q = p - a;
  const std::int64_t cross = d.x * q.y - d.y * q.x;  // > 0: left of the line
  const bool x_major = std::abs(d.x) >= std::abs(d.y);
  const bool turns_left = (d.x > 0) == (d.y > 0);  // from the major axis' direction towards the line
  const bool right_of_line = cross < 0;
  return {2 * std::abs(cross), x_major ? std::abs(d.x) : std::abs(d.y),
          x_major ? turns_left == right_of_line : turns_left != right_of_line};
}

/// Brute force in integers: one pixel per major step from the first to the last, each the closest to the line, ties
/// towards E. This leaves no choice, so it is the line.
::testing::AssertionResult is_the_line(const std::vector<glm::ivec2>& pixels, glm::ivec2 a, glm::ivec2 b) {
  const glm::ivec2 d = b - a;
  const int axis = std::abs(d.x) >= std::abs(d.y) ? 0 : 1, step = d[axis] < 0 ? -1 : 1;
  if (pixels.size() != static_cast<std::size_t>(std::abs(d[axis])) + 1)
    return ::testing::AssertionFailure() << pixels.size() << " pixels for " << d.x << ", " << d.y;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i][axis] != a[axis] + step * static_cast<int>(i))
      return ::testing::AssertionFailure() << "pixel " << i << " of " << d.x << ", " << d.y << " is not on its step";
    if (pixels.size() > 1 && !beside(a, b, pixels[i]).closest())
      return ::testing::AssertionFailure() << "pixel " << i << " of " << d.x << ", " << d.y << " is not the closest";
  }
  return ::testing::AssertionSuccess();
}

std::string drawn(const Algorithm& draw, glm::ivec2 from, glm::ivec2 to, glm::ivec2 frame) {
  std::vector<std::string> rows(static_cast<std::size_t>(frame.y), std::string(static_cast<std::size_t>(frame.x), '.'));
  for (const LinePixel& p : draw(end(from), end(to), frame))
    rows[static_cast<std::size_t>(frame.y - 1 - p.pixel.y)][static_cast<std::size_t>(p.pixel.x)] = '#';
  std::string picture;
  for (const std::string& row : rows) picture += row + "\n";
  return picture;
}

TEST(RasterLine, DrawsWhatAPersonWould) {
  for (const auto& [name, draw] : kAlgorithms) {
    SCOPED_TRACE(name);
    EXPECT_EQ(drawn(draw, {0, 0}, {7, 3}, {8, 4}),
              "......##\n"
              "....##..\n"
              "..##....\n"
              "##......\n");
    EXPECT_EQ(drawn(draw, {2, 4}, {0, 0}, {3, 5}),  // steep, and from above: the ties at rows 3 and 1 towards (2, 4)
              "..#\n"
              "..#\n"
              ".#.\n"
              ".#.\n"
              "#..\n");
    EXPECT_EQ(drawn(draw, {2, 1}, {2, 1}, {4, 3}), "....\n..#.\n....\n");
    EXPECT_TRUE(draw(end(2, 1), end(2, 1), {2, 3}).empty());
  }
}

TEST(RasterLine, MidpointAndBruteForceAreTheClosestPixelsOnAllOfAGrid) {
  for (int i = 0; i < 1024; ++i)
    for (int j = 0; j < 1024; ++j) {
      const glm::ivec2 a(i % 32, i / 32), b(j % 32, j / 32);
      const std::vector<glm::ivec2> midpoint = pixels_of(midpoint_line(end(a), end(b), {32, 32}));
      ASSERT_TRUE(is_the_line(midpoint, a, b)) << fmt::format("{},{} to {},{}", a.x, a.y, b.x, b.y);
      ASSERT_EQ(pixels_of(brute_force_line(end(a), end(b), {32, 32})), midpoint);
    }
}

glm::ivec2 random_16_bit(std::mt19937& random) {
  std::uniform_int_distribution<int> coordinate(-32768, 32767);
  const int x = coordinate(random);
  return {x, coordinate(random)};
}

TEST(RasterLine, MidpointAndBruteForceAreTheClosestPixelsOfLongLines) {
  std::mt19937 random(1);
  for (std::size_t i = 0; i < 500; i += plumbline::one_of(10)) {
    const glm::ivec2 a = random_16_bit(random), b = random_16_bit(random);
    const std::vector<glm::ivec2> midpoint = whole(midpoint_line, a, b);
    ASSERT_TRUE(is_the_line(midpoint, a, b));
    ASSERT_EQ(whole(brute_force_line, a, b), midpoint);
  }
}

// A million lines (in a run, 100,000), each seen through a frame at a place on it.
TEST(RasterLine, MidpointAndBruteForceAreTheClosestPixelsOfAMillionLines) {
  std::mt19937 random(2);
  constexpr glm::ivec2 kFrame(33, 31);
  std::int64_t seen = 0;
  for (std::size_t i = 0; i < 1'000'000; i += plumbline::one_of(10)) {
    glm::ivec2 a = random_16_bit(random), b = random_16_bit(random);
    const double t = std::uniform_real_distribution<double>(0, 1)(random);
    const glm::ivec2 corner = glm::ivec2(glm::round(glm::mix(glm::dvec2(a), glm::dvec2(b), t))) - kFrame / 2;
    a -= corner, b -= corner;
    const std::vector<glm::ivec2> midpoint = pixels_of(midpoint_line(end(a), end(b), kFrame));
    ASSERT_FALSE(midpoint.empty());
    ASSERT_EQ(pixels_of(brute_force_line(end(a), end(b), kFrame)), midpoint);
    const int axis = std::abs(b.x - a.x) >= std::abs(b.y - a.y) ? 0 : 1;
    for (std::size_t k = 0; k < midpoint.size(); ++k) {
      ASSERT_TRUE(beside(a, b, midpoint[k]).closest());
      ASSERT_TRUE(k == 0 || std::abs(midpoint[k][axis] - midpoint[k - 1][axis]) == 1);
    }
    seen += static_cast<std::int64_t>(midpoint.size());
  }
  EXPECT_GT(seen, 10'000'000 / static_cast<std::int64_t>(plumbline::one_of(10)));
}

// The notes' ROUND(k x + d), half upwards, in double, as one would write it; x0 < x1, 0 <= k <= 1.
TEST(RasterLine, DiffersFromRoundAtExactTiesOnly) {
  std::int64_t differences = 0, ties = 0, ties_by_gcd = 0, pixels = 0;
  for (int n = 1; n < 256; ++n)
    for (int a = 0; a <= n; ++a) {
      const glm::ivec2 p(3, 5), q = p + glm::ivec2(n, a);
      const double k = static_cast<double>(a) / n, d = p.y - k * p.x;
      for (const LinePixel& e : midpoint_line(end(p), end(q), {512, 512})) {
        const int rounded = static_cast<int>(std::floor(k * e.pixel.x + d + 0.5));
        const bool tie = beside(p, q, e.pixel).is_tie();
        ++pixels;
        ties += tie;
        if (rounded == e.pixel.y) continue;
        ++differences;
        ASSERT_TRUE(tie) << n << ", " << a << " at " << e.pixel.x;
        ASSERT_EQ(rounded, e.pixel.y + 1);  // NE for E
      }
      // x a / n is half an odd number where n / g is even, at the middle of each of the g periods.
      const int g = std::gcd(n, a);
      if (n / g % 2 == 0) ties_by_gcd += g;
    }
  EXPECT_EQ(ties, ties_by_gcd);
  EXPECT_EQ(ties, 38'264);
  EXPECT_EQ(differences, 37'050);  // at the other 1,214 ties, k x + d was rounded to less than the half
  EXPECT_EQ(pixels, 5'625'215);
}

// y = y + k: the farthest that a pixel of it is from the line, on the slope that is worst at this length (found among
// all; the median slope's sum is off by a fifth of the worst's). The closest pixel is never farther than 1/2. In double
// the sum is off by 3e-8 over 32,767 steps.
TEST(RasterLine, IncrementalDrifts) {
  struct Row {
    int n, a;
    double worst;
  };
  for (const auto& [n, a, worst] : {Row{255, 37, 0.498039}, Row{511, 289, 0.500978}, Row{1023, 927, 0.510264},
                                    Row{2047, 1783, 0.547631}, Row{4095, 3093, 0.659341}, Row{8191, 8129, 1.469296},
                                    Row{16383, 16263, 4.432155}, Row{32767, 32607, 16.346690}}) {
    double farthest = 0;
    for (const LinePixel& p : incremental_line(end(0, 0), end(n, a), {n + 1, n + 1}))
      farthest = std::max(farthest, std::abs(p.pixel.y - static_cast<double>(a) * p.pixel.x / n));
    EXPECT_NEAR(farthest, worst, 1e-6) << n << ", " << a;
    EXPECT_EQ(is_the_line(whole(incremental_line, {0, 0}, {n, a}), {0, 0}, {n, a}), n < 511);
  }
}

TEST(RasterLine, OctantsAreMirrorImages) {
  using Mirror = glm::ivec2 (*)(glm::ivec2);
  const Mirror mirrors[] = {[](glm::ivec2 p) { return glm::ivec2(-p.x, p.y); },
                            [](glm::ivec2 p) { return glm::ivec2(p.x, -p.y); },
                            [](glm::ivec2 p) { return glm::ivec2(p.y, p.x); }};  // they generate all eight
  for (const auto& [name, draw] : kAlgorithms)
    for (int dx = -31; dx <= 31; ++dx)
      for (int dy = -31; dy <= 31; ++dy)
        for (const Mirror mirror : mirrors) {
          if (std::abs(dx) == std::abs(dy) && mirror({1, 2}) == glm::ivec2(2, 1)) continue;  // either axis may be major
          std::vector<glm::ivec2> mirrored = whole(draw, {0, 0}, {dx, dy});
          for (glm::ivec2& p : mirrored) p = mirror(p);
          ASSERT_EQ(whole(draw, {0, 0}, mirror({dx, dy})), mirrored) << name << " " << dx << ", " << dy;
        }
}

TEST(RasterLine, FromTheOtherEndDiffersAtTiesOnly) {
  int ties = 0;
  for (int dx = -31; dx <= 31; ++dx)
    for (int dy = -31; dy <= 31; ++dy) {
      const glm::ivec2 a(0), b(dx, dy);
      const std::vector<glm::ivec2> there = whole(midpoint_line, a, b), back = whole(midpoint_line, b, a);
      for (std::size_t i = 0; i < there.size(); ++i) {
        const bool tie = there.size() > 1 && beside(a, b, there[i]).is_tie();
        ASSERT_EQ(there[i] != back[back.size() - 1 - i], tie);
        ties += tie;
      }
    }
  EXPECT_EQ(ties, 2'848);
}

TEST(RasterLine, TheFrameChangesNoPixel) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> coordinate(-60, 100), size(1, 40);
  for (const auto& [name, draw] : kAlgorithms)
    for (int i = 0; i < 100'000; ++i) {
      const glm::ivec2 frame(size(random), size(random)), shift(60);
      const LinePixel from = end(coordinate(random), coordinate(random), 0.25f, {0, 1, 2, 3});
      const LinePixel to = end(coordinate(random), coordinate(random), 0.75f, {3, -1, 0, 3});
      LinePixel moved_from = from, moved_to = to;
      moved_from.pixel += shift, moved_to.pixel += shift;
      std::vector<LinePixel> expected;
      for (LinePixel p : draw(moved_from, moved_to, {161, 161})) {
        p.pixel -= shift;
        if (p.pixel.x >= 0 && p.pixel.y >= 0 && p.pixel.x < frame.x && p.pixel.y < frame.y) expected.push_back(p);
      }
      const std::vector<LinePixel> clipped = draw(from, to, frame);
      ASSERT_EQ(clipped.size(), expected.size()) << name;
      for (std::size_t k = 0; k < clipped.size(); ++k) ASSERT_TRUE(clipped[k] == expected[k]) << name;
    }
}

TEST(RasterLine, EndsAsFarAwayAsTheyMayBe) {
  constexpr int kFar = 1 << 29;
  for (const Algorithm& draw : {Algorithm(brute_force_line), Algorithm(midpoint_line)}) {
    EXPECT_EQ(draw(end(-kFar, -kFar), end(kFar, kFar), {64, 64}).size(), 64u);
    // y = x - 1/2 - x / 2^30: at x = 0 a tie, towards the start above; from there on the pixel below.
    const std::vector<LinePixel> half_way = draw(end(kFar, kFar - 1), end(-kFar, -kFar), {64, 64});
    ASSERT_EQ(half_way.size(), 64u);
    EXPECT_EQ(half_way[63].pixel, glm::ivec2(0, 0));
    for (int x = 1; x < 64; ++x) EXPECT_EQ(half_way[static_cast<std::size_t>(63 - x)].pixel, glm::ivec2(x, x - 1));
    EXPECT_TRUE(draw(end(-kFar, -kFar), end(kFar, -kFar), {64, 64}).empty());
  }
  for (const auto& [name, draw] : kAlgorithms) {
    EXPECT_THROW(draw(end(0, 0), end(kFar + 1, 0), {64, 64}), std::invalid_argument) << name;
    EXPECT_THROW(draw(end(0, -kFar - 1), end(0, 0), {64, 64}), std::invalid_argument) << name;
  }
}

TEST(RasterLine, DepthAndColorAreAffineInTheStep) {
  for (const auto& [name, draw] : kAlgorithms) {
    SCOPED_TRACE(name);
    const std::vector<LinePixel> line =
        draw(end(7, 2, 0.1f, {0, 0.3f, 1, 1}), end(3, 10, 0.9f, {1, 0.3f, 0.2f, 1}), {16, 16});
    ASSERT_EQ(line.size(), 9u);
    EXPECT_EQ(line.front().depth, 0.1f);
    EXPECT_EQ(line.back().depth, 0.9f);
    EXPECT_EQ(line.back().color, glm::vec4(1, 0.3f, 0.2f, 1));
    for (int i = 0; i <= 8; ++i) {  // eighths are exact: two products and a sum are rounded, each at most 2^-24
      const LinePixel& p = line[static_cast<std::size_t>(i)];
      EXPECT_NEAR(p.depth, 0.1 + 0.8 * i / 8, 0x3p-24);
      EXPECT_NEAR(p.color.x, i / 8.0, 0x3p-24);
      EXPECT_NEAR(p.color.z, 1 - 0.8 * i / 8, 0x3p-24);
    }
  }
}

// b / 2 as an integer, for an odd b: rounded to 0, f is 1/2 too large, and is never wrong, for it is then 1/2 beside an
// integer; rounded down, f = 1/2 becomes 0, and E is taken for NE. is_the_line sees it.
TEST(RasterLine, HalfAConstantIsNotAnInteger) {
  const auto wrong_lines = [](auto half) {
    int wrong = 0;
    for (int n = 1; n < 32; ++n)
      for (int a = 0; a <= n; ++a) {
        std::vector<glm::ivec2> pixels;
        int y = 0, f = a + half(-n);
        for (int x = 0; x <= n; ++x) {
          pixels.emplace_back(x, y);
          if (f > 0) ++y;
          f += f > 0 ? a - n : a;
        }
        wrong += !is_the_line(pixels, {0, 0}, {n, a});
      }
    return wrong;
  };
  EXPECT_EQ(wrong_lines([](int b) { return b / 2; }), 0);
  EXPECT_EQ(wrong_lines([](int b) { return b >> 1; }), 213);
}

}  // namespace
