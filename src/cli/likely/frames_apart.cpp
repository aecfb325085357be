#include "cli/likely/frames_apart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::cli {

namespace {

// Thresholds of a Look: colour [codes of 8 bits]; depth [steps of the depth format], but at least float_depth [window
// z], the error of depths in float; whether alpha counts; share of the distance from ours that is allowed.
struct Eye {
  float codes;
  double steps, float_depth;
  bool by_alpha = false;
  float share = 0;
};
constexpr float kUnseen = std::numeric_limits<float>::infinity();
constexpr std::array<Eye, kLooks> kEyes = {{{1.5f, 1.5, 0x1p-20, true},
                                            {1.5f, 1.5, 0x1p-20},
                                            {1.5f, kUnseen, 0},
                                            {1.5f, kUnseen, 0, false, 0.25f},
                                            {kUnseen, 1.5, 0x1p-20},
                                            {0.5f, kUnseen, 0},
                                            {kUnseen, 0.25, 0}}};

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// Largest difference of r, g and b, clamped to [0,1]; NaN where one is NaN.
float rgb_distance(const glm::vec4& a, const glm::vec4& b) {
  const glm::vec4 off = glm::abs(glm::clamp(a, 0.0f, 1.0f) - glm::clamp(b, 0.0f, 1.0f));
  return std::isnan(off.x + off.y + off.z) ? kNaN : std::max({off.x, off.y, off.z});
}

// Distances of a pixel in two frames; NaN where a number is NaN.
struct Distance {
  float rgb, alpha;        // of colours clamped to [0,1]: the largest of r, g and b
  double depth, step;      // window z; the depth format's step there
  bool has_depth = false;  // both frames have depths

  // `rgb_from_ours`: distance of the given frame from ours. Where that is beyond the threshold, too, a frame that
  // explains it is less than half as far.
  bool is_color_beyond(const Eye& eye, float rgb_from_ours = 0) const {
    const float codes = eye.codes / 255;
    const bool is_far = rgb_from_ours > codes;
    const float most = is_far ? std::min(std::max(codes, eye.share * rgb_from_ours), 0.49f * rgb_from_ours) : codes;
    return eye.codes < kUnseen && (!(rgb <= most) || (eye.by_alpha && !(alpha <= most)));
  }
  bool is_depth_beyond(const Eye& eye) const {
    return has_depth && eye.steps < kUnseen && !(depth <= std::max(eye.steps * step, eye.float_depth));
  }
};

Distance distance(DepthFormat format, const ColorAndDepth& given, const ColorAndDepth& other, std::size_t i) {
  const glm::vec4 a = given.color.values()[i], b = other.color.values()[i];
  Distance out{.rgb = rgb_distance(a, b),
               .alpha = std::abs(std::clamp(a.w, 0.0f, 1.0f) - std::clamp(b.w, 0.0f, 1.0f)),
               .depth = 0,
               .step = 0};
  if (given.depth.empty() || given.depth.size() != other.depth.size()) return out;
  const double z = other.depth.values()[i];
  out.has_depth = true;
  out.depth = std::abs(given.depth.values()[i] - z);
  out.step = depth_step(format, z);
  return out;
}

// Whether a pixel's numbers are equal, as most are; false for NaN.
bool is_same(const ColorAndDepth& given, const ColorAndDepth& other, std::size_t i) {
  const bool by_depth = !given.depth.empty() && given.depth.size() == other.depth.size();
  return given.color.values()[i] == other.color.values()[i] &&
         (!by_depth || given.depth.values()[i] == other.depth.values()[i]);
}

}  // namespace

bool colors_apart(const glm::vec4& a, const glm::vec4& b, float codes) { return !(rgb_distance(a, b) <= codes / 255); }

bool is_clear_depth(const FrameFormat& format, double z) { return std::abs(z - format.clear_depth) <= 1.0 / 65535; }

FramesApart::FramesApart(const FrameFormat& format, const GivenFrame& given, const ColorAndDepth& ours)
    : format_(format.depth), given_(given), ours_(ours), counted_(given.color.size()) {
  const auto holds = [&](const Plane<std::uint8_t>& legal, std::size_t i) {
    return legal.size() == given.color.size() && legal.values()[i] != 0;
  };
  const auto has_surface = [&](const ColorAndDepth& of, std::size_t i) {
    return !is_clear_depth(format, of.depth.values()[i]);
  };
  for (std::size_t i = 0; i < given.color.size(); ++i) {
    const Distance from_ours = distance(format_, given, ours, i);
    rgb_from_ours_.push_back(from_ours.rgb);
    for (std::size_t look = 0; look < kLooks; ++look) {
      const Eye& eye = kEyes[look];
      const Plane<std::uint8_t>& legal = is_of_color(static_cast<Look>(look)) ? given.is_legal_color : given.is_legal;
      const bool is_far = from_ours.is_depth_beyond(eye);
      if (holds(given.is_wrong_in_ours, i)) {
        counted_[i][look] = left_out;
      } else if (holds(legal, i)) {
        if (is_far || from_ours.is_color_beyond(eye)) counted_[i][look] = passed_over;
      } else if (is_far && holds(given.is_legal_depth, i) && has_surface(given, i) && has_surface(ours, i)) {
        counted_[i][look] = by_color;
      }
    }
  }
}

Apart FramesApart::from(const ColorAndDepth& frame) const {
  Apart out{};
  for (std::size_t i = 0; i < given_.color.size(); ++i) {
    if (is_same(given_, frame, i)) continue;
    const Distance there = distance(format_, given_, frame, i);
    for (std::size_t look = 0; look < kLooks; ++look) {
      const Eye& eye = kEyes[look];
      const Counted counted = counted_[i][look];
      // A legal depth is none of a fault that moves depths elsewhere.
      const bool is_depth_apart =
          there.is_depth_beyond(eye) &&
          (counted == whole || (counted == by_color && is_depth_beyond_ours(frame, i, static_cast<Look>(look))));
      const bool is_apart = is_depth_apart || there.is_color_beyond(eye, rgb_from_ours_[i]);
      if (counted < passed_over && is_apart) ++out[look];
    }
  }
  return out;
}

bool FramesApart::is_depth_beyond_ours(const ColorAndDepth& frame, std::size_t i, Look look) const {
  return distance(format_, ours_, frame, i).is_depth_beyond(kEyes[look]);
}

FramesApart::Legal FramesApart::legal(const ColorAndDepth& frame) const {
  Legal out;
  for (std::size_t i = 0; i < given_.color.size(); ++i) {
    if (std::ranges::find(counted_[i], passed_over) == counted_[i].end()) continue;
    const Distance from_given = distance(format_, given_, frame, i), from_ours = distance(format_, ours_, frame, i);
    for (std::size_t look = 0; look < kLooks; ++look) {
      if (counted_[i][look] != passed_over) continue;
      const Eye& eye = kEyes[look];
      if (!from_given.is_color_beyond(eye, rgb_from_ours_[i]) && !from_given.is_depth_beyond(eye)) {
        ++out.drawn[look];
      } else if (from_ours.is_color_beyond(eye) || from_ours.is_depth_beyond(eye)) {
        ++out.against[look];
      }
    }
  }
  return out;
}

}  // namespace plumbline::cli
