// The finished frame in its own formats, as a display or a file would take it.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture/plane.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Row 0 at the bottom. Of the colour planes, and of the depth planes, that of the format is filled.
struct Frame {
  explicit Frame(const FrameFormat& format);
  bool empty() const { return depth_code.empty() && depth_z32f.empty(); }

  Plane<glm::u8vec4> color_rgba8;
  Plane<glm::u16vec4> color_rgba12;  ///< 0 to 4095
  Plane<glm::u16vec4> color_rgba16;
  Plane<glm::vec4> color_rgba32f;
  Plane<std::uint32_t> depth_code;  ///< z8, z16, z24
  Plane<float> depth_z32f;
  Plane<std::uint8_t> stencil;  ///< empty where the format has none
};

}  // namespace plumbline::pipeline
