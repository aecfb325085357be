#include "reference/osmesa/readback/vertex_records.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "capture/renderer.h"
#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/light_state.h"
#include "reference/osmesa/scene/target.h"

namespace plumbline::osmesa {
namespace {

constexpr const char* kVertexSource =
    "#version 120\n"
    "varying vec4 p_eye;\n"
    "varying vec3 n_eye;\n"
    "uniform int normals;\n"
    "void main() {\n"
    "  gl_Position = ftransform();\n"
    "  p_eye = gl_ModelViewMatrix * gl_Vertex;\n"
    "  n_eye = gl_NormalMatrix * gl_Normal;\n"
    "  if (normals == 0) n_eye = normalize(n_eye);\n"
    "  if (normals == 1) n_eye *= gl_NormalScale;\n"
    "}\n";

constexpr std::array<const GLchar*, 3> kCaptured = {"gl_Position", "p_eye", "n_eye"};
struct Varyings {
  glm::vec4 p_clip, p_eye;
  glm::vec3 n_eye;
};

glm::dmat4 read_matrix(const Gl& gl, GLenum name) {
  glm::mat4 matrix;
  gl.GetFloatv(name, glm::value_ptr(matrix));
  return glm::dmat4(matrix);
}

// Scope of transform feedback: rasterization is off, the program is in use, and a query is at hand.
class Captured {
 public:
  Captured(const Gl& gl, GLuint program) : gl_(gl) {
    gl_.Enable(GL_RASTERIZER_DISCARD);
    gl_.UseProgram(program);
    gl_.GenQueries(1, &query_);
  }
  ~Captured() {
    gl_.DeleteQueries(1, &query_);
    gl_.UseProgram(0);
    gl_.Disable(GL_RASTERIZER_DISCARD);
  }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  GLuint query() const { return query_; }

 private:
  const Gl& gl_;
  GLuint query_ = 0;
};

// Loads a projection that puts every vertex (whose eye-space w is 1) in the middle of the view volume: none is clipped,
// and in a viewport of one pixel each is drawn at the pixel's centre.
void gather_vertices(const Gl& gl) {
  glm::mat4 middle(0);
  middle[3][3] = 1;
  gl.MatrixMode(GL_PROJECTION);
  gl.LoadMatrixf(glm::value_ptr(middle));
}

}  // namespace

std::vector<Matrices<double>> read_matrices(const Gl& gl, const SceneInGl& scene) {
  glm::vec4 viewport;
  gl.GetFloatv(GL_VIEWPORT, glm::value_ptr(viewport));
  const glm::dvec2 origin(viewport.x, viewport.y), half = glm::dvec2(viewport.z, viewport.w) / 2.0;

  std::vector<Matrices<double>> records;
  for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
    scene.set_matrices(i);
    glm::vec2 depth;
    gl.GetFloatv(GL_DEPTH_RANGE, glm::value_ptr(depth));
    const double near = static_cast<double>(depth.x), far = static_cast<double>(depth.y);
    Matrices<double>& m = records.emplace_back();
    m.model_view = read_matrix(gl, GL_MODELVIEW_MATRIX);
    m.projection = read_matrix(gl, GL_PROJECTION_MATRIX);
    m.normal = glm::transpose(glm::inverse(glm::dmat3(m.model_view)));
    m.win_scale = glm::dvec3(half, static_cast<float>((far - near) / 2));  // as Mesa takes them
    m.win_translate = glm::dvec3(origin + half, static_cast<float>((far + near) / 2));
  }
  check(gl, "reading the matrices back");
  return records;
}

VertexProgram::VertexProgram(const Gl& gl)
    : gl_(gl),
      program_(gl, kVertexSource, "", kCaptured),
      normals_(gl.GetUniformLocation(program_.name(), "normals")) {}

std::vector<Vertex<double>> VertexProgram::run(const SceneInGl& scene) const {
  std::vector<Vertex<double>> records;
  const Captured captured(gl_, program_.name());
  for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
    std::vector<Varyings> varyings(scene.ranges()[i].vertex_count);
    if (varyings.empty()) continue;
    const auto bytes = varyings.size() * sizeof(Varyings);
    const Buffer buffer(gl_, bytes, nullptr);
    scene.set_matrices(i);
    gl_.Uniform1i(normals_, static_cast<GLint>(scene.scene().draws[i].normals));
    gl_.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.name());
    gl_.BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, captured.query());
    gl_.BeginTransformFeedback(GL_POINTS);
    scene.draw_points(i);
    gl_.EndTransformFeedback();
    gl_.EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    GLuint written = 0;
    gl_.GetQueryObjectuiv(captured.query(), GL_QUERY_RESULT, &written);
    gl_.GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes), varyings.data());
    gl_.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    check(gl_, "transform feedback");
    if (written != varyings.size()) {
      throw RendererFailed(fmt::format("OpenGL: transform feedback of {} of {} vertices", written, varyings.size()));
    }
    for (const Varyings& v : varyings) records.push_back({v.p_eye, v.p_clip, v.n_eye});
  }
  return records;
}

VertexColors::VertexColors(const Gl& gl) : gl_(gl), primary_(gl, "", "void main() { gl_FragColor = gl_Color; }") {}

std::vector<Lit<double>> VertexColors::read(const SceneInGl& scene) const {
  constexpr std::uint32_t kWidth = 256, kHeight = 64;
  constexpr float kUndrawn = -1;  // no vertex has this colour: GL clamps vertex colours
  FrameFormat frame;
  frame.width = kWidth;
  frame.height = kHeight;
  const Target target(gl_, frame, ColorFormat::rgba32f);
  std::vector<Lit<double>> records;
  const PassState state(gl_);
  target.bind();
  set_lights(gl_, scene.scene());
  for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
    scene.set_matrices(i);
    gather_vertices(gl_);
    scene.set_vertex_light(i);
    // Fragments must have the primary colour only, and no texture.
    if (scene.has_vertex_program(i)) {
      gl_.Disable(GL_LIGHTING);  // with it, GL would add the secondary colour; the program lights either way
      gl_.Disable(GL_COLOR_SUM);
    } else {
      gl_.UseProgram(primary_.name());
    }
    const std::uint32_t vertices = scene.ranges()[i].vertex_count;
    for (std::uint32_t first = 0; first < vertices; first += kWidth * kHeight) {
      const std::uint32_t count = std::min(vertices - first, kWidth * kHeight);
      gl_.ClearColor(kUndrawn, kUndrawn, kUndrawn, kUndrawn);
      gl_.Clear(GL_COLOR_BUFFER_BIT);
      scene.draw_points(i, {first, count}, [&](std::uint32_t k) {
        gl_.Viewport(static_cast<GLint>(k % kWidth), static_cast<GLint>(k / kWidth), 1, 1);
      });
      const Plane<glm::vec4> colors = target.read_color({0, 0}, {kWidth, (count + kWidth - 1) / kWidth});
      for (const glm::vec4& color : std::span(colors.values()).first(count)) {
        if (color.r == kUndrawn) throw RendererFailed("OpenGL: a vertex is not drawn as a point");
        records.push_back({color});
      }
    }
  }
  check(gl_, "drawing the vertices as points");
  return records;
}

}  // namespace plumbline::osmesa
