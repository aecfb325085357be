#include "pipeline/frame.h"

#include "kernels/depth.h"
#include "kernels/merge.h"
#include "scene/antialias.h"

namespace plumbline::pipeline {

Frame::Frame(const FrameFormat& format) {
  const int w = format.width, h = format.height;
  switch (format.color) {
    case ColorFormat::rgba8: color_rgba8 = Plane<glm::u8vec4>(w, h); break;
    case ColorFormat::rgba12:
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

Formats formats_of(const FrameFormat& frame) {
  return {depth_scale(frame.depth), static_cast<float>(color_scale(frame.color)), sample_offset(frame)};
}

ClearPixel clear_pixel(const FrameFormat& frame) {
  const Formats formats = formats_of(frame);
  const double z = formats.depth_scale == 0.0 ? frame.clear_depth : depth_code(frame.clear_depth, formats.depth_scale);
  return {static_cast<float>(z), merge<float>(frame.clear_color, formats.color_scale)};
}

FrameBuffer::FrameBuffer(const FrameFormat& format) {
  const ClearPixel clear = clear_pixel(format);
  depth = Plane<float>(format.width, format.height, clear.depth);
  color = Plane<glm::vec4>(format.width, format.height, clear.color);
  if (format.stencil != StencilFormat::none) {
    stencil = Plane<std::uint8_t>(format.width, format.height, format.clear_stencil);
  }
}

FramePixel FrameBuffer::at(glm::ivec2 p) {
  return {&depth(p.x, p.y), &color(p.x, p.y), stencil.empty() ? nullptr : &stencil(p.x, p.y)};
}

Frame finished(const FrameFormat& format, const FrameBuffer& buffer) {
  Frame frame(format);
  const auto copy = [](const auto& from, auto& to) {
    using Value = std::remove_reference_t<decltype(to.values()[0])>;
    for (std::size_t i = 0; i < to.size(); ++i) to.values()[i] = Value(from.values()[i]);
  };
  copy(buffer.color, frame.color_rgba8);
  copy(buffer.color, frame.color_rgba16);
  copy(buffer.color, frame.color_rgba32f);
  copy(buffer.depth, frame.depth_code);
  copy(buffer.depth, frame.depth_z32f);
  copy(buffer.stencil, frame.stencil);
  return frame;
}

}  // namespace plumbline::pipeline
