// What class notes (004) 2.2 assume of f(x, y) = a x + b y + c, and what it needs.
#include <cstdint>

#include <gtest/gtest.h>
#include <glm/glm.hpp>

namespace plumbline {
namespace {

// a = y_1 - y_0, b = -(x_1 - x_0), c = x_1 y_0 - y_1 x_0.
int f(glm::ivec2 p, glm::ivec2 r, glm::ivec2 at) {
  return (r.y - p.y) * at.x - (r.x - p.x) * at.y + r.x * p.y - r.y * p.x;
}

/// 1: above the line, -1: below, 0: on it; by the line's y at that x, over dx.
int side(glm::ivec2 p, glm::ivec2 r, glm::ivec2 at) {
  const int dx = r.x - p.x, above = (at.y - p.y) * dx - (r.y - p.y) * (at.x - p.x);
  return above == 0 ? 0 : (above > 0) == (dx > 0) ? 1 : -1;
}

struct WrongSides {
  int points = 0, wrong = 0;  // of points beside the line; of them, those where f < 0 is not above, or f > 0 not below
};

// "We assume a > 0", and f < 0 is above, f > 0 below. What decides is x_1 > x_0, that is b < 0: for (2, 0) to (0, 2) a
// is 2, and f(0, 5) = 6 though the point is above. For lines that fall to the right a < 0, and nothing is amiss.
TEST(NotesLines, Note004SidesOfFNeedARunToTheRightNotAPositiveA) {
  EXPECT_EQ(f({2, 0}, {0, 2}, {0, 5}), 6);
  EXPECT_EQ(side({2, 0}, {0, 2}, {0, 5}), 1);
  constexpr int kSize = 7;
  const auto each = [](auto visit) {
    for (int i = 0; i < kSize * kSize; ++i) visit(glm::ivec2(i % kSize, i / kSize));
  };
  WrongSides rising_right, rising_left, falling_right;
  each([&](glm::ivec2 p) {
    each([&](glm::ivec2 r) {
      const glm::ivec2 d = r - p;
      if (d.x == 0 || (d.x < 0 && d.y <= 0)) return;
      WrongSides& count = d.x < 0 ? rising_left : d.y > 0 ? rising_right : falling_right;
      each([&](glm::ivec2 at) {
        const int s = side(p, r, at);
        if (s == 0) return;
        ++count.points;
        count.wrong += (f(p, r, at) < 0) != (s > 0);
      });
    });
  });
  EXPECT_GT(rising_right.points, 10000);
  EXPECT_EQ(rising_right.wrong, 0);
  EXPECT_EQ(falling_right.wrong, 0) << "a <= 0";
  EXPECT_EQ(rising_left.wrong, rising_left.points) << "a > 0, and all of them";
  EXPECT_EQ(rising_left.points, rising_right.points) << "mirror images";
}

}  // namespace
}  // namespace plumbline
