// OpenGL's entry points, loaded from the context at run time: libOSMesa and libOpenGL both export gl* functions, and
// only the context's own are the right ones. To be included within reference/osmesa only.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>

#include <string_view>

namespace plumbline::osmesa {

// clang-format off
#define PLUMBLINE_GL_FUNCTIONS(F) \
  F(ActiveTexture) F(AlphaFunc) F(AttachShader) F(BeginQuery) F(BeginTransformFeedback) F(BindBuffer) \
  F(BindBufferBase) F(BindFramebuffer) F(BindRenderbuffer) F(BindTexture) F(BlendColor) F(BlendEquationSeparate) \
  F(BlendFunc) F(BlendFuncSeparate) F(BlitFramebuffer) F(BufferData) F(CheckFramebufferStatus) F(ClampColor) \
  F(Clear) F(ClearColor) F(ClearDepth) F(ClearStencil) F(Color4f) F(Color4fv) F(ColorMask) F(ColorMaterial) \
  F(ColorPointer) F(CompileShader) F(CreateProgram) F(CreateShader) F(CullFace) F(DeleteBuffers) \
  F(DeleteFramebuffers) F(DeleteProgram) F(DeleteQueries) F(DeleteRenderbuffers) F(DeleteShader) \
  F(DeleteTextures) F(DepthFunc) F(DepthMask) F(DepthRange) F(Disable) F(DisableClientState) F(DrawArrays) \
  F(DrawElements) F(EdgeFlagPointer) F(Enable) F(EnableClientState) F(EndQuery) F(EndTransformFeedback) \
  F(FeedbackBuffer) F(Finish) F(Fogf) F(Fogfv) F(Fogi) F(FramebufferRenderbuffer) F(FramebufferTexture2D) \
  F(Frustum) F(GenBuffers) F(GenFramebuffers) F(GenQueries) F(GenRenderbuffers) F(GenTextures) \
  F(GetBufferSubData) F(GetError) F(GetFloatv) F(GetIntegerv) F(GetMultisamplefv) F(GetProgramInfoLog) \
  F(GetProgramiv) F(GetQueryObjectuiv) F(GetRenderbufferParameteriv) F(GetString) F(GetUniformLocation) \
  F(LightModelfv) F(LightModeli) F(Lightf) F(Lightfv) F(LineWidth) F(LinkProgram) F(LoadIdentity) F(LoadMatrixf) \
  F(LogicOp) F(Materialf) F(Materialfv) F(MatrixMode) F(NormalPointer) F(Ortho) F(PixelStorei) F(PointSize) \
  F(PolygonMode) F(PolygonOffset) F(PopAttrib) F(PopClientAttrib) F(PushAttrib) F(PushClientAttrib) F(ReadPixels) \
  F(Rectf) F(RenderMode) F(RenderbufferStorage) F(Rotated) F(Scaled) F(Scissor) F(ShadeModel) F(ShaderSource) \
  F(StencilFuncSeparate) F(StencilMaskSeparate) F(StencilOpSeparate) F(TexCoordPointer) F(TexEnvfv) F(TexEnvi) \
  F(TexImage2D) F(TexImage2DMultisample) F(TexParameterf) F(TexParameterfv) F(TexParameteri) \
  F(TransformFeedbackVaryings) F(Translated) F(Uniform1i) F(UseProgram) F(VertexPointer) F(Viewport)
// clang-format on

/// Pointers to the functions of PLUMBLINE_GL_FUNCTIONS, which are named without their prefix "gl".
struct Gl {
#define PLUMBLINE_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
  PLUMBLINE_GL_FUNCTIONS(PLUMBLINE_GL_MEMBER)
#undef PLUMBLINE_GL_MEMBER
};

/// Throws RendererFailed, with GL's name of the error and `where`, if GL has recorded an error; clears GL's errors.
void check(const Gl& gl, std::string_view where);

/// An integer limit of GL, such as GL_MAX_LIGHTS.
GLint limit(const Gl& gl, GLenum name);

/// Saves GL state and restores it on destruction: all but the matrices, and state that Mesa's pop leaves out
/// (default_state.h).
class SavedState {
 public:
  explicit SavedState(const Gl& gl) : gl_(gl) {
    gl_.PushAttrib(GL_ALL_ATTRIB_BITS);
    gl_.GetIntegerv(GL_CURRENT_PROGRAM, &program_);
    gl_.GetIntegerv(GL_FRAMEBUFFER_BINDING, &frame_buffer_);
  }
  ~SavedState() {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(frame_buffer_));  // whose draw buffers were saved
    gl_.PopAttrib();
    gl_.UseProgram(static_cast<GLuint>(program_));
  }
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;

 private:
  const Gl& gl_;
  GLint program_ = 0, frame_buffer_ = 0;
};

/// Saves vertex arrays and their buffers and restores them on destruction.
class SavedArrays {
 public:
  explicit SavedArrays(const Gl& gl) : gl_(gl) { gl_.PushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT); }
  ~SavedArrays() { gl_.PopClientAttrib(); }
  SavedArrays(const SavedArrays&) = delete;
  SavedArrays& operator=(const SavedArrays&) = delete;

 private:
  const Gl& gl_;
};

}  // namespace plumbline::osmesa
