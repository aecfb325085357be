// Pixels, to be compared in any order.
#pragma once

#include <algorithm>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline::test {

using Pixels = std::vector<glm::ivec2>;

inline Pixels by_rows(Pixels pixels) {
  std::sort(pixels.begin(), pixels.end(),
            [](glm::ivec2 a, glm::ivec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  return pixels;
}

}  // namespace plumbline::test
