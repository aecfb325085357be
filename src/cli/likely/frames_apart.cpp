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
constexpr std::array<Eye, kLooks> kEyes = {{{1.5f, 1.5, 0x1p-20, true},
                                            {1.5f, 1.5, 0x1p-20},
                                            {1.5f, kUnseen, 0},
                                            {kUnseen, 1.5, 0x1p-20},
                                            {0.5f, kUnseen, 0},
                                            {kUnseen, 0.25, 0}}};

bool are_colors_apart(const ColorAndDepth& given, const ColorAndDepth& other, std::size_t i, const Eye& eye) {
  return colors_apart(other.color.values()[i], given.color.values()[i], eye.codes, eye.by_alpha);
}

bool are_depths_apart(DepthFormat format, const ColorAndDepth& given, const ColorAndDepth& other, std::size_t i,
                      const Eye& eye) {
  if (given.depth.empty() || given.depth.size() != other.depth.size()) return false;
  const double z = other.depth.values()[i];
  const double most = std::max(eye.steps * depth_step(format, z), eye.float_depth);
  return !(std::abs(given.depth.values()[i] - z) <= most);
}

// Whether a pixel is the same number by number, which most are. NaN is not.
bool is_same(const ColorAndDepth& given, const ColorAndDepth& other, std::size_t i) {
  const bool by_depth = !given.depth.empty() && given.depth.size() == other.depth.size();
  return given.color.values()[i] == other.color.values()[i] &&
         (!by_depth || given.depth.values()[i] == other.depth.values()[i]);
}

}  // namespace

bool colors_apart(const glm::vec4& a, const glm::vec4& b, float codes, bool by_alpha) {
  const glm::vec4 off = glm::abs(glm::clamp(a, 0.0f, 1.0f) - glm::clamp(b, 0.0f, 1.0f));
  const float most = codes / 255;
  const bool near = off.x <= most && off.y <= most && off.z <= most && !std::isnan(b.x + b.y + b.z);
  return !near || (by_alpha && (!(off.w <= most) || std::isnan(b.w)));
}

bool is_clear_depth(const FrameFormat& format, double z) { return std::abs(z - format.clear_depth) <= 1.0 / 65535; }

FramesApart::FramesApart(DepthFormat format, const GivenFrame& given, const ColorAndDepth& ours)
    : format_(format), given_(given), ours_(ours) {
  const auto holds = [&](const Plane<std::uint8_t>& legal, std::size_t i) {
    return legal.size() == given.color.size() && legal.values()[i] != 0;
  };
  for (std::size_t look = 0; look < kLooks; ++look) {
    const Eye& eye = kEyes[look];
    const Plane<std::uint8_t>& legal = is_of_color(static_cast<Look>(look)) ? given.is_legal_color : given.is_legal;
    counted_[look].resize(given.color.size(), whole);
    for (std::size_t i = 0; i < given.color.size(); ++i) {
      const bool is_far = are_depths_apart(format, given, ours, i, eye);
      if (holds(legal, i)) {
        if (is_far || are_colors_apart(given, ours, i, eye)) counted_[look][i] = passed_over;
      } else if (is_far && holds(given.is_legal_depth, i)) {
        counted_[look][i] = by_color;
      }
    }
  }
}

Apart FramesApart::from(const ColorAndDepth& frame) const {
  Apart out{};
  for (std::size_t i = 0; i < given_.color.size(); ++i) {
    if (is_same(given_, frame, i)) continue;
    for (std::size_t look = 0; look < kLooks; ++look) {
      const Eye& eye = kEyes[look];
      const Counted counted = counted_[look][i];
      const bool is_apart = are_colors_apart(given_, frame, i, eye) ||
                            (counted == whole && are_depths_apart(format_, given_, frame, i, eye));
      if (counted != passed_over && is_apart) ++out[look];
    }
  }
  return out;
}

Apart FramesApart::against(const ColorAndDepth& frame) const {
  Apart out{};
  for (std::size_t look = 0; look < kLooks; ++look) {
    const Eye& eye = kEyes[look];
    const auto are_apart = [&](const ColorAndDepth& a, const ColorAndDepth& b, std::size_t i) {
      return are_colors_apart(a, b, i, eye) || are_depths_apart(format_, a, b, i, eye);
    };
    for (std::size_t i = 0; i < given_.color.size(); ++i) {
      if (counted_[look][i] == passed_over && are_apart(given_, frame, i) && are_apart(ours_, frame, i)) ++out[look];
    }
  }
  return out;
}

}  // namespace plumbline::cli
