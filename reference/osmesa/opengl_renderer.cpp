#include "reference/osmesa/opengl_renderer.h"

#include <utility>

#include <fmt/format.h>

#include "reference/arithmetic/resolve.h"
#include "reference/osmesa/gl/gl.h"
#include "reference/osmesa/readback/line_records.h"
#include "reference/osmesa/readback/pixel_fragments.h"
#include "reference/osmesa/readback/planes.h"
#include "reference/osmesa/readback/polygon_records.h"
#include "reference/osmesa/readback/vertex_records.h"
#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/scene_in_gl.h"
#include "reference/osmesa/scene/target.h"

namespace plumbline::osmesa {
namespace {

std::string text(const Gl& gl, GLenum name) {
  const GLubyte* value = gl.GetString(name);
  return value == nullptr ? "" : reinterpret_cast<const char*>(value);
}

Gl current_gl(Context& context) {
  context.make_current();
  return load(context);
}

class OpenGlRenderer final : public Renderer {
 public:
  OpenGlRenderer(std::string name, MesaDriver driver, std::unique_ptr<Context> context)
      : name_(std::move(name)),
        driver_(driver),
        context_(std::move(context)),
        gl_(current_gl(*context_)),
        vertex_program_(gl_),
        vertex_colors_(gl_) {
    const std::string renderer = text(gl_, GL_RENDERER);
    if (!renderer.starts_with(name_of(driver))) {
      throw RendererFailed(fmt::format("OpenGL: asked for {}, got the driver \"{}\"", name_of(driver), renderer));
    }
    gl_version_ = text(gl_, GL_VERSION);
    version_ = renderer + ", OpenGL " + gl_version_;
  }
  ~OpenGlRenderer() override {
    try {
      context_->make_current();  // names of programs are deleted in this context: another may use the same names
    } catch (const RendererFailed&) {
    }
  }

  RendererInfo info() const override {
    RendererInfo info;
    info.name = name_;
    info.version = version_;
    info.profile = Profile::opengl;
    for (Ability& ability : info.stages) ability.shows = true;
    if (const std::string why = why_unfused(driver_); !why.empty()) info[Stage::window] = {false, false, why};
    return info;
  }

  Capture capture(const Scene& scene, const Request& request) override {
    require_shown(scene);
    if (antialiased(scene)) return capture_resolved(scene, request);
    require_budget(scene, plane_bytes(scene), request.memory_budget);
    context_->make_current();
    Capture capture;
    capture.renderer = name_;
    capture.version = version_;
    capture.width = scene.frame.width;
    capture.height = scene.frame.height;
    const SceneInGl in_gl(gl_, scene);
    capture.planes = draw_planes(gl_, in_gl);
    read_records(in_gl, request, capture.records);
    return capture;
  }

 private:
  static void require_shown(const Scene& scene) {
    const FrameFormat& frame = scene.frame;
    const bool samples = frame.antialias.kind == Antialias::Kind::multisample || frame.pass.sample;
    if (samples && frame.stencil != StencilFormat::none) {
      throw Unsupported("OpenGL: multisampled stencil values are not read here");
    }
    for (const Draw& draw : scene.draws) require_outlines_shown(scene, draw);
  }

  // Throws Unsupported for unfilled faces that Mesa draws otherwise than OpenGL 2.1 specifies.
  static void require_outlines_shown(const Scene& scene, const Draw& draw) {
    const bool front = draw.front_mode == PolygonMode::fill, back = draw.back_mode == PolygonMode::fill;
    const bool moved = draw.polygon_offset != PolygonOffset{};
    if (front != back && moved) {
      throw Unsupported("where one face alone is filled, Mesa offsets the other's depths (OpenGL 2.1, section 3.5.5)");
    }
    if (!front && !back && moved && scene.depth_clamp) {
      throw Unsupported("of faces that are not filled, Mesa clamps the corners' offset depths (ARB_depth_clamp)");
    }
    if (!back && draw.stencil && draw.stencil->front != draw.stencil->back) {
      throw Unsupported(
          "where a back face is not filled, Mesa takes the front's stencil state (OpenGL 2.1, section 4.1.5)");
    }
  }

  // OpenGL resolves its own samples (multisampling); supersampled frames and taps are averaged by
  // math::capture_resolved.
  Capture capture_resolved(const Scene& scene, const Request& request) {
    Capture capture = math::capture_resolved(*this, scene, request);
    if (scene.frame.antialias.kind != Antialias::Kind::multisample) return capture;
    const Planes resolved = draw_picture(gl_, SceneInGl(gl_, scene));
    capture.planes.color = resolved.color;
    capture.planes.depth = resolved.depth;
    return capture;
  }

  void read_records(const SceneInGl& scene, const Request& request, Records<double>& records) const {
    if (!request.records.any()) return;
    if (!request.pixels.empty() && !request.records.has(Stage::window)) {
      return read_pixel_fragments(gl_, scene, request, records);
    }
    const bool polygons = request.records.has(Stage::clip) || request.records.has(Stage::window);
    if (polygons && crashes_in_feedback(scene.scene(), driver_, gl_version_)) {
      throw Unsupported(
          "Mesa 25.0 and later crash in feedback mode where a vertex program lights two sides: its records of clip and "
          "window cannot be read");
    }
    FrameFormat frame = scene.scene().frame;
    frame.pass.sample.reset();  // vertices have no samples
    const Target target(gl_, frame, ColorFormat::rgba8);
    const PassState state(gl_);
    target.bind();
    if (request.records.has(Stage::matrices)) records.matrices = read_matrices(gl_, scene);
    if (request.records.has(Stage::vertex)) records.vertices = vertex_program_.run(scene);
    std::vector<Lit<double>> lit;
    if (polygons || request.records.has(Stage::light)) lit = vertex_colors_.read(scene);
    target.bind();
    if (polygons) read_polygons(gl_, scene, lit, request, records);
    if (request.records.has(Stage::light)) records.lit = std::move(lit);
    if (request.records.has(Stage::coverage) && request.records.has(Stage::window)) {
      read_covered_lines(gl_, scene, records);
    }
  }

  std::string name_, version_, gl_version_;
  MesaDriver driver_;
  std::unique_ptr<Context> context_;
  Gl gl_;
  VertexProgram vertex_program_;
  VertexColors vertex_colors_;
};

}  // namespace

std::unique_ptr<Renderer> make_opengl_renderer(std::string name, MesaDriver driver, std::unique_ptr<Context> context) {
  return std::make_unique<OpenGlRenderer>(std::move(name), driver, std::move(context));
}

}  // namespace plumbline::osmesa
