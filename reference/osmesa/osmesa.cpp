#include "reference/osmesa/osmesa.h"

#include "reference/osmesa/context.h"
#include "reference/osmesa/gl.h"
#include "reference/osmesa/planes.h"
#include "reference/osmesa/polygon_records.h"
#include "reference/osmesa/scene_in_gl.h"
#include "reference/osmesa/target.h"
#include "reference/osmesa/vertex_records.h"

namespace plumbline {
namespace osmesa {
namespace {

class Osmesa : public Renderer {
 public:
  explicit Osmesa(OsmesaDriver driver)
      : name_(driver == OsmesaDriver::llvmpipe ? "osmesa" : "softpipe"),
        context_(driver),
        vertex_program_(context_.gl()) {}

  RendererInfo info() const override {
    RendererInfo info;
    info.name = name_;
    info.version = context_.version();
    for (Ability& ability : info.stages) ability.shows = true;
    info[Stage::texture] = {false, false, "no scene has textures yet"};
    return info;
  }

  Capture capture(const Scene& scene, const Request& request) override {
    require_budget(scene, plane_bytes(scene), request.memory_budget);
    context_.make_current();
    Capture capture;
    capture.renderer = name_;
    capture.version = context_.version();
    capture.width = scene.frame.width;
    capture.height = scene.frame.height;
    const SceneInGl in_gl(context_.gl(), scene);
    capture.planes = draw_planes(context_.gl(), in_gl);
    read_records(in_gl, request, capture.records);
    return capture;
  }

 private:
  void read_records(const SceneInGl& scene, const Request& request, Records<double>& records) const {
    if (!request.records.any()) return;
    const Gl& gl = context_.gl();
    const Target target(gl, scene.scene().frame, ColorFormat::rgba8);
    const SavedState state(gl);
    target.bind();
    if (request.records.has(Stage::matrices)) records.matrices = read_matrices(gl, scene);
    if (request.records.has(Stage::vertex)) records.vertices = vertex_program_.run(scene);
    if (request.records.has(Stage::light)) records.lit = read_lit(gl, scene);
    read_polygons(gl, scene, request, records);
  }

  std::string name_;
  Context context_;
  VertexProgram vertex_program_;
};

}  // namespace
}  // namespace osmesa

std::unique_ptr<Renderer> make_osmesa(OsmesaDriver driver) { return std::make_unique<osmesa::Osmesa>(driver); }

}  // namespace plumbline
