// Comparison of frames, and formats, for the tests of programmable stages.
#pragma once

#include <cstring>

#include "pipeline/program.h"

namespace plumbline::testing_words {

/// The number of values whose bits differ; of planes of different sizes all of both.
template <class T>
std::size_t bits_apart(const Plane<T>& a, const Plane<T>& b) {
  if (a.width() != b.width() || a.height() != b.height()) return a.size() + b.size();
  std::size_t apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) apart += std::memcmp(&a.values()[i], &b.values()[i], sizeof(T)) != 0;
  return apart;
}
inline std::size_t bits_apart(const pipeline::Frame& a, const pipeline::Frame& b) {
  return bits_apart(a.color_rgba8, b.color_rgba8) + bits_apart(a.color_rgba16, b.color_rgba16) +
         bits_apart(a.color_rgba32f, b.color_rgba32f) + bits_apart(a.depth_code, b.depth_code) +
         bits_apart(a.depth_z32f, b.depth_z32f) + bits_apart(a.stencil, b.stencil);
}

inline FrameFormat floats(int width, int height, glm::vec4 clear = glm::vec4(0)) {
  return {width, height, ColorFormat::rgba32f, DepthFormat::z32f, clear, 1};
}

}  // namespace plumbline::testing_words
