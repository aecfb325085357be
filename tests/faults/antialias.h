// Bugs of antialiasing.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "faults/variants.h"

namespace plumbline::faults {

/// Samples mirrored in the pixel's middle row: y counted downwards.
inline pipeline::Places mirrored_samples(glm::ivec2 sample) { return {{sample.x, -sample.y}, sample, {0, 0}}; }

inline pipeline::Places depth_of_centre(glm::ivec2 sample) { return {sample, {0, 0}, {0, 0}}; }

inline pipeline::Places color_of_sample(glm::ivec2 sample) { return {sample, sample, sample}; }

inline float truncated_mean(std::span<const float> values, std::span<const PixelSample> samples, float scale) {
  if (scale == 0.0f) return pipeline::weighted_mean(values, samples, scale);
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += static_cast<double>(samples[i].weight) * static_cast<double>(values[i]);
    weights += samples[i].weight;
  }
  return static_cast<float>(std::floor(sum / weights));
}

/// The second's and the third's weights change places: neighbours in the table.
inline float mean_of_swapped(std::span<const float> values, std::span<const PixelSample> samples, float scale) {
  std::vector<PixelSample> wrong(samples.begin(), samples.end());
  if (wrong.size() > 2) std::swap(wrong[1].weight, wrong[2].weight);
  return pipeline::weighted_mean(values, wrong, scale);
}

}  // namespace plumbline::faults
