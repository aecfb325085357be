#include "cli/likely/frames_apart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::cli {

namespace {

// Thresholds of a Look: colour [codes of 8 bits]; depth [steps of the depth format], but at least float_depth [window
// z], the error of depths in float; whether alpha counts.
struct Eye {
  float codes;
  double steps, float_depth;
  bool by_alpha = false;
};
constexpr float kUnseen = std::numeric_limits<float>::infinity();
constexpr std::array<Eye, kLooks> kEyes = {
    {{1.5f, 1.5, 0x1p-20, true}, {1.5f, 1.5, 0x1p-20}, {0.5f, kUnseen, 0}, {kUnseen, 0.25, 0}}};

// By pixel, 1 where the frames differ.
std::vector<std::uint8_t> apart_at(DepthFormat format, const ColorAndDepth& given, const ColorAndDepth& other,
                                   const Eye& eye) {
  const bool by_depth = !given.depth.empty() && given.depth.size() == other.depth.size();
  std::vector<std::uint8_t> out(given.color.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    bool apart = colors_apart(other.color.values()[i], given.color.values()[i], eye.codes, eye.by_alpha);
    if (by_depth && !apart) {
      const double z = other.depth.values()[i];
      const double most = std::max(eye.steps * depth_step(format, z), eye.float_depth);
      apart = !(std::abs(given.depth.values()[i] - z) <= most);
    }
    out[i] = apart ? 1 : 0;
  }
  return out;
}

}  // namespace

bool colors_apart(const glm::vec4& a, const glm::vec4& b, float codes, bool by_alpha) {
  const glm::vec4 off = glm::abs(glm::clamp(a, 0.0f, 1.0f) - glm::clamp(b, 0.0f, 1.0f));
  const float most = codes / 255;
  const bool near = off.x <= most && off.y <= most && off.z <= most && !std::isnan(b.x + b.y + b.z);
  return !near || (by_alpha && (!(off.w <= most) || std::isnan(b.w)));
}

FramesApart::FramesApart(DepthFormat format, const GivenFrame& given, const ColorAndDepth& ours)
    : format_(format), given_(given) {
  for (std::size_t look = 0; look < kLooks; ++look) {
    std::vector<std::uint8_t>& passed_over = passed_over_[look];
    passed_over.resize(given.color.size());
    if (given.is_legal.size() != given.color.size()) continue;
    passed_over = apart_at(format, given, ours, kEyes[look]);
    for (std::size_t i = 0; i < passed_over.size(); ++i) passed_over[i] &= given.is_legal.values()[i];
  }
}

Apart FramesApart::from(const ColorAndDepth& frame) const {
  Apart out{};
  for (std::size_t look = 0; look < kLooks; ++look) {
    const std::vector<std::uint8_t> differ = apart_at(format_, given_, frame, kEyes[look]);
    for (std::size_t i = 0; i < differ.size(); ++i) out[look] += differ[i] > passed_over_[look][i];
  }
  return out;
}

}  // namespace plumbline::cli
