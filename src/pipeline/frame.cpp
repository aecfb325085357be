#include "pipeline/frame.h"

namespace plumbline::pipeline {

Frame::Frame(const FrameFormat& format) {
  const int w = format.width, h = format.height;
  switch (format.color) {
    case ColorFormat::rgba8: color_rgba8 = Plane<glm::u8vec4>(w, h); break;
    case ColorFormat::rgba12: color_rgba12 = Plane<glm::u16vec4>(w, h); break;
    case ColorFormat::rgba16: color_rgba16 = Plane<glm::u16vec4>(w, h); break;
    case ColorFormat::rgba32f: color_rgba32f = Plane<glm::vec4>(w, h); break;
  }
  if (format.depth == DepthFormat::z32f) {
    depth_z32f = Plane<float>(w, h);
  } else {
    depth_code = Plane<std::uint32_t>(w, h);
  }
  if (format.stencil != StencilFormat::none) stencil = Plane<std::uint8_t>(w, h);
}

}  // namespace plumbline::pipeline
