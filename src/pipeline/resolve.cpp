#include "pipeline/resolve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace plumbline::pipeline {

namespace {

// `plane`: a colour plane of Frame, such as &Frame::color_rgba8; nothing happens where the format has none.
void resolve_colors(Resolve channel, const FrameFormat& format, std::span<const Frame> passes, auto plane,
                    Frame& frame) {
  auto& to = frame.*plane;
  if (to.empty()) return;
  const PixelSamples samples = samples_of(format.antialias);
  const auto scale = static_cast<float>(color_scale(format.color));
  std::array<float, PixelSamples::kMost> room;
  const std::span<float> values = std::span(room).first(samples.size());
  for (int y = 0; y < to.height(); ++y) {
    for (int x = 0; x < to.width(); ++x) {
      for (int c = 0; c < 4; ++c) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
          const glm::ivec2 at = glm::ivec2(x, y) * format.antialias.factor + samples[i].offset;
          values[i] = static_cast<float>((passes[samples[i].pass].*plane)(at.x, at.y)[c]);
        }
        auto& value = to(x, y)[c];
        value = static_cast<std::remove_reference_t<decltype(value)>>(channel(values, samples, scale));
      }
    }
  }
}

void take_first_depths(int factor, const Frame& first, auto plane, Frame& frame) {
  auto& to = frame.*plane;
  for (int y = 0; y < to.height(); ++y) {
    for (int x = 0; x < to.width(); ++x) to(x, y) = (first.*plane)(x * factor, y * factor);
  }
}

}  // namespace

float mean_of_four(std::span<const float> values, std::span<const PixelSample>, float scale) {
  const float code = scale == 0.0f ? 1.0f : 1.0f / scale;
  float sum = values[0] * code;
  for (const float value : values.subspan(1)) sum = sum + value * code;
  const float mean = sum * 0.25f;
  return scale == 0.0f ? mean : std::nearbyint(mean * scale);
}

float weighted_mean(std::span<const float> values, std::span<const PixelSample> samples, float scale) {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += static_cast<double>(samples[i].weight) * static_cast<double>(values[i]);
    weights += samples[i].weight;
  }
  const double mean = sum / weights;
  return static_cast<float>(scale == 0.0f ? mean : std::floor(mean + 0.5));
}

Frame resolve(const ResolveStage& stage, const FrameFormat& format, std::span<const Frame> passes) {
  Frame frame(format);
  resolve(stage, format, passes, frame);
  return frame;
}

void resolve(const ResolveStage& stage, const FrameFormat& format, std::span<const Frame> passes, Frame& frame) {
  const Resolve channel = format.antialias.kind == Antialias::Kind::multisample ? stage.multisample : stage.weighted;
  resolve_colors(channel, format, passes, &Frame::color_rgba8, frame);
  resolve_colors(channel, format, passes, &Frame::color_rgba16, frame);
  resolve_colors(channel, format, passes, &Frame::color_rgba32f, frame);
  take_first_depths(format.antialias.factor, passes[0], &Frame::depth_code, frame);
  take_first_depths(format.antialias.factor, passes[0], &Frame::depth_z32f, frame);
  std::ranges::fill(frame.stencil.values(), std::uint8_t{0});
}

}  // namespace plumbline::pipeline
