#include "reference/osmesa/scene/target.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "capture/renderer.h"

namespace plumbline::osmesa {
namespace {

struct DepthBits {
  GLenum format;
  GLint bits;
};

// Format of depth and stencil in one buffer, as frame buffer objects require it; there is none with 16 bits of depth.
GLenum with_stencil(DepthFormat format) {
  return format == DepthFormat::z32f ? GL_DEPTH32F_STENCIL8 : GL_DEPTH24_STENCIL8;
}

DepthBits depth_bits(DepthFormat format) {
  switch (format) {
    case DepthFormat::z16: return {GL_DEPTH_COMPONENT16, 16};
    case DepthFormat::z8:
    case DepthFormat::z24: return {GL_DEPTH_COMPONENT24, 24};
    case DepthFormat::z32f: break;
  }
  return {GL_DEPTH_COMPONENT32F, 32};
}

struct ColorBits {
  GLenum format;
  GLint bits;
};

ColorBits color_bits(ColorFormat format) {
  switch (format) {
    case ColorFormat::rgba8: return {GL_RGBA8, 8};
    case ColorFormat::rgba16: return {GL_RGBA16, 16};
    case ColorFormat::rgba12:
    case ColorFormat::rgba32f: break;
  }
  return {GL_RGBA32F, 32};
}

// Checks the bits of a channel: GL may give more than were asked for, and then codes would not be those of the frame.
void require_bits(const Gl& gl, GLenum name, GLint expected, std::string_view what) {
  GLint bits = 0;
  gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, name, &bits);
  check(gl, "the render buffer's format");
  if (bits != expected) throw RendererFailed(fmt::format("OpenGL: {} bits of {}, not {}", bits, what, expected));
}

void require_size(const Gl& gl, const FrameFormat& frame) {
  const int largest = limit(gl, GL_MAX_RENDERBUFFER_SIZE);
  GLint viewport[2] = {0, 0};
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  if (frame.width <= std::min(largest, viewport[0]) && frame.height <= std::min(largest, viewport[1])) return;
  throw RendererFailed(
      fmt::format("OpenGL: a frame of {} x {} pixels; its largest render buffer is {} x {}, viewport {} x {}",
                  frame.width, frame.height, largest, largest, viewport[0], viewport[1]));
}

// Window z of a sample's depth that GL returned as a float. GL converts a 24-bit code to float by a product with
// 1/(2^24 - 1) in float, which is not the nearest float: the code is the one whose product is z. (For fewer bits it is
// the nearest code.)
double window_z_of_sample(float z, DepthFormat format) {
  const double scale = depth_scale(format);
  if (scale == 0) return static_cast<double>(z);
  const double nearest = std::round(static_cast<double>(z) * scale);
  for (const double code : {nearest, nearest - 1, nearest + 1}) {
    if (code >= 0 && code <= scale && static_cast<float>(code) * (1.0f / static_cast<float>(scale)) == z)
      return code / scale;
  }
  return nearest / scale;
}

}  // namespace

Target::Target(const Gl& gl, const FrameFormat& frame, ColorFormat color) : gl_(gl), frame_(frame), color_(color) {
  if (frame.depth == DepthFormat::z8) frame_.depth = DepthFormat::z24;
  const bool stencil = frame.stencil != StencilFormat::none;
  if (stencil && frame.depth == DepthFormat::z16) frame_.depth = DepthFormat::z24;
  require_size(gl, frame);
  gl.GenFramebuffers(1, &frame_buffer_);
  gl.GenRenderbuffers(2, buffers_);
  try {
    const DepthBits depth = depth_bits(frame_.depth);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffers_[0]);
    const ColorBits bits = color_bits(color_);
    gl.RenderbufferStorage(GL_RENDERBUFFER, bits.format, frame.width, frame.height);
    check(gl, "the colour buffer's storage");
    require_bits(gl, GL_RENDERBUFFER_RED_SIZE, bits.bits, "red");
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffers_[1]);
    gl.RenderbufferStorage(GL_RENDERBUFFER, stencil ? with_stencil(frame_.depth) : depth.format, frame.width,
                           frame.height);
    check(gl, "the depth buffer's storage");
    require_bits(gl, GL_RENDERBUFFER_DEPTH_SIZE, depth.bits, "depth");
    if (stencil) require_bits(gl, GL_RENDERBUFFER_STENCIL_SIZE, 8, "stencil");

    gl.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers_[1]);
    if (stencil) gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, buffers_[1]);
    const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    check(gl, "the frame buffer's parts");
    if (status != GL_FRAMEBUFFER_COMPLETE) {
      throw RendererFailed(fmt::format("OpenGL: a frame buffer of {} x {} pixels is incomplete ({:#06x})", frame.width,
                                       frame.height, status));
    }
    if (frame.pass.sample || frame.antialias.kind == Antialias::Kind::multisample) {
      samples_ = std::make_unique<Multisamples>(gl, frame, bits.format, depth.format);
    }
  } catch (...) {
    release();
    throw;
  }
}

Target::~Target() { release(); }

void Target::release() {
  gl_.DeleteFramebuffers(1, &frame_buffer_);
  gl_.DeleteRenderbuffers(2, buffers_);
}

void Target::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, samples_ ? samples_->frame_buffer() : frame_buffer_);
  gl_.Viewport(0, 0, frame_.width, frame_.height);
}

void Target::take_samples() const {
  if (!samples_) return;
  if (frame_.pass.sample) {
    samples_->fetch_colors(*frame_.pass.sample, frame_buffer_);
  } else {
    samples_->resolve(frame_buffer_);
  }
}

Plane<std::uint32_t> Target::read_codes() const { return read_codes({0, 0}, {frame_.width, frame_.height}); }

Plane<std::uint32_t> Target::read_codes(glm::ivec2 origin, glm::ivec2 size) const {
  Plane<std::uint32_t> codes(size.x, size.y);
  read_codes(origin, codes);
  return codes;
}

void Target::read_codes(glm::ivec2 origin, Plane<std::uint32_t>& to) const {
  take_samples();
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
  gl_.ReadPixels(origin.x, origin.y, to.width(), to.height(), GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, to.values().data());
  check(gl_, "reading colour codes");
}

Plane<glm::vec4> Target::read_color() const { return read_color({0, 0}, {frame_.width, frame_.height}); }

Plane<glm::vec4> Target::read_color(glm::ivec2 origin, glm::ivec2 size) const {
  Plane<glm::vec4> color(size.x, size.y);
  if (color_ == ColorFormat::rgba32f) {
    take_samples();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
    gl_.ReadPixels(origin.x, origin.y, size.x, size.y, GL_RGBA, GL_FLOAT, color.values().data());
    check(gl_, "reading colours");
    return color;
  }
  if (color_ == ColorFormat::rgba16) {
    take_samples();
    Plane<glm::u16vec4> codes(size.x, size.y);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
    gl_.ReadPixels(origin.x, origin.y, size.x, size.y, GL_RGBA, GL_UNSIGNED_SHORT, codes.values().data());
    check(gl_, "reading colours");
    std::transform(codes.values().begin(), codes.values().end(), color.values().begin(),
                   [](const glm::u16vec4& code) { return glm::vec4(code) / 65535.0f; });
    return color;
  }
  const Plane<std::uint32_t> codes = read_codes(origin, size);
  const auto channel = [](std::uint32_t code, int shift) { return static_cast<float>(code >> shift & 0xffu) / 255.0f; };
  std::transform(codes.values().begin(), codes.values().end(), color.values().begin(), [&](std::uint32_t code) {
    return glm::vec4(channel(code, 0), channel(code, 8), channel(code, 16), channel(code, 24));
  });
  return color;
}

Plane<std::uint8_t> Target::read_stencil() const {
  if (frame_.stencil == StencilFormat::none) return {};
  Plane<std::uint8_t> stencil(frame_.width, frame_.height);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
  gl_.ReadPixels(0, 0, frame_.width, frame_.height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.values().data());
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  check(gl_, "reading stencil values");
  return stencil;
}

Plane<double> Target::read_sample_depth() const {
  FrameFormat floats = frame_;
  floats.pass = {};
  const Target to(gl_, floats, ColorFormat::rgba32f);
  samples_->fetch_depths(*frame_.pass.sample, to.frame_buffer_);
  const Plane<glm::vec4> fetched = to.read_color();
  Plane<double> depth(frame_.width, frame_.height);
  std::transform(fetched.values().begin(), fetched.values().end(), depth.values().begin(),
                 [&](const glm::vec4& z) { return window_z_of_sample(z.r, frame_.depth); });
  return depth;
}

Plane<double> Target::read_depth() const {
  if (samples_ && frame_.pass.sample) return read_sample_depth();
  take_samples();
  Plane<double> depth(frame_.width, frame_.height);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
  const auto read = [&](GLenum type, auto values, auto to_z) {
    values.resize(depth.size());
    gl_.ReadPixels(0, 0, frame_.width, frame_.height, GL_DEPTH_COMPONENT, type, values.data());
    check(gl_, "reading depth");
    std::transform(values.begin(), values.end(), depth.values().begin(), to_z);
  };
  if (frame_.depth == DepthFormat::z32f) {
    read(GL_FLOAT, std::vector<float>(), [](float z) { return static_cast<double>(z); });
  } else {
    // GL spreads an n-bit code over 32 bits; its high n bits are the code itself.
    const int spread = 32 - depth_bits(frame_.depth).bits;
    const double scale = depth_scale(frame_.depth);
    read(GL_UNSIGNED_INT, std::vector<GLuint>(), [=](GLuint z) { return static_cast<double>(z >> spread) / scale; });
  }
  return depth;
}

}  // namespace plumbline::osmesa
