#include "reference/osmesa/scene/multisamples.h"

#include <fmt/format.h>

#include "capture/renderer.h"
#include "capture/stages.h"
#include "reference/arithmetic/passes.h"
#include "reference/osmesa/scene/default_state.h"

namespace plumbline::osmesa {
namespace {

constexpr GLsizei kCount = static_cast<GLsizei>(math::kSamplePositions.size());

constexpr const char* kFetchSource =
    "#version 150 compatibility\n"
    "uniform sampler2DMS samples;\n"
    "uniform int number;\n"
    "void main() { gl_FragColor = texelFetch(samples, ivec2(gl_FragCoord.xy), number); }\n";

void require_places(const Gl& gl) {
  for (GLuint i = 0; i < math::kSamplePositions.size(); ++i) {
    GLfloat is[2] = {0, 0};
    gl.GetMultisamplefv(GL_SAMPLE_POSITION, i, is);
    const glm::dvec2 expected = math::kSamplePositions[i];
    if (glm::dvec2(is[0], is[1]) == expected) continue;
    throw Unsupported(
        fmt::format("OpenGL has its sample {} at ({}, {}), not at ({}, {})", i, is[0], is[1], expected.x, expected.y));
  }
}

GLuint make_program(const Gl& gl) {
  const GLuint shader = gl.CreateShader(GL_FRAGMENT_SHADER), program = gl.CreateProgram();
  gl.ShaderSource(shader, 1, &kFetchSource, nullptr);
  gl.CompileShader(shader);
  gl.AttachShader(program, shader);
  gl.DeleteShader(shader);
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  gl.DeleteProgram(program);
  throw Unsupported("OpenGL: a program that reads multisampled textures does not link");
}

}  // namespace

Multisamples::Multisamples(const Gl& gl, const FrameFormat& frame, GLenum color, GLenum depth)
    : gl_(gl), width_(frame.width), height_(frame.height) {
  if (const GLint most = limit(gl, GL_MAX_SAMPLES); most < kCount) {
    throw Unsupported(fmt::format("this OpenGL has {} samples a pixel, not {}", most, kCount));
  }
  gl.GenFramebuffers(1, &frame_buffer_);
  gl.GenTextures(2, textures_);
  try {
    gl.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer_);
    const auto attach = [&](GLuint texture, GLenum format, GLenum place) {
      gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
      gl.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, kCount, format, width_, height_, GL_TRUE);
      gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
      gl.FramebufferTexture2D(GL_FRAMEBUFFER, place, GL_TEXTURE_2D_MULTISAMPLE, texture, 0);
    };
    attach(textures_[0], color, GL_COLOR_ATTACHMENT0);
    attach(textures_[1], depth, GL_DEPTH_ATTACHMENT);
    check(gl, "the samples' buffers");
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw RendererFailed("OpenGL: a frame buffer of four samples a pixel is incomplete");
    }
    require_places(gl);
    program_ = make_program(gl);
  } catch (...) {
    release();
    throw;
  }
}

Multisamples::~Multisamples() { release(); }

void Multisamples::release() {
  gl_.DeleteFramebuffers(1, &frame_buffer_);
  gl_.DeleteTextures(2, textures_);
  gl_.DeleteProgram(program_);
}

void Multisamples::fetch_colors(int sample, GLuint to) const { fetch(textures_[0], sample, to); }
void Multisamples::fetch_depths(int sample, GLuint to) const { fetch(textures_[1], sample, to); }

void Multisamples::fetch(GLuint texture, int sample, GLuint to) const {
  const PassState state(gl_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, to);
  gl_.Viewport(0, 0, width_, height_);
  gl_.ClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FALSE);
  gl_.MatrixMode(GL_PROJECTION);
  gl_.LoadIdentity();
  gl_.MatrixMode(GL_MODELVIEW);
  gl_.LoadIdentity();
  gl_.UseProgram(program_);
  gl_.Uniform1i(gl_.GetUniformLocation(program_, "number"), sample);
  gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
  gl_.Rectf(-1, -1, 1, 1);
  gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
  gl_.UseProgram(0);
  check(gl_, "fetching a sample");
}

void Multisamples::resolve(GLuint to) const {
  const PassState state(gl_);  // without a scissor test, which would crop the copy
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, frame_buffer_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT,
                      GL_NEAREST);
  check(gl_, "resolving the samples");
}

}  // namespace plumbline::osmesa
