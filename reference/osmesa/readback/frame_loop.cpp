#include "reference/osmesa/readback/frame_loop.h"

#include "reference/osmesa/gl/context.h"
#include "reference/osmesa/gl/gl.h"
#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/light_state.h"
#include "reference/osmesa/scene/scene_in_gl.h"
#include "reference/osmesa/scene/target.h"

namespace plumbline {

struct OsmesaFrames::Frames {
  Frames(const Scene& scene, Filters filters)
      : context(osmesa::make_opengl_context(MesaDriver::llvmpipe, filters == Filters::exact
                                                                      ? osmesa::ShaderCode::quick_to_run
                                                                      : osmesa::ShaderCode::approximate)),
        gl(current(*context)),
        in_gl(gl, scene),
        target(gl, scene.frame, scene.frame.color) {}

  static osmesa::Gl current(osmesa::Context& context) {
    context.make_current();
    return osmesa::load(context);
  }

  std::unique_ptr<osmesa::Context> context;
  osmesa::Gl gl;
  osmesa::SceneInGl in_gl;
  osmesa::Target target;
};

OsmesaFrames::OsmesaFrames(const Scene& scene, Filters filters) : frames_(std::make_unique<Frames>(scene, filters)) {}
OsmesaFrames::~OsmesaFrames() = default;

void OsmesaFrames::draw() {
  frames_->context->make_current();
  const osmesa::Gl& gl = frames_->gl;
  const osmesa::SceneInGl& scene = frames_->in_gl;
  const osmesa::PassState state(gl);
  frames_->target.bind();
  scene.clear(scene.scene().frame.clear_color);
  osmesa::set_lights(gl, scene.scene());
  for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
    scene.set_matrices(i);
    scene.set_surface(i);
    scene.set_fragments(i);
    scene.set_merge(i);
    scene.draw_primitives(i);
  }
  gl.Finish();
}

Planes OsmesaFrames::read() const {
  frames_->context->make_current();
  Planes planes;
  planes.color = frames_->target.read_color();
  planes.depth = frames_->target.read_depth();
  return planes;
}

void OsmesaFrames::read_codes(Plane<std::uint32_t>& to) const {
  frames_->context->make_current();
  frames_->target.read_codes({0, 0}, to);
}

}  // namespace plumbline
