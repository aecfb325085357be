#include "reference/osmesa/readback/pixel_fragments.h"

#include <cmath>
#include <limits>

#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/fragment_state.h"
#include "reference/osmesa/scene/light_state.h"
#include "reference/osmesa/scene/target.h"

namespace plumbline::osmesa {
namespace {

struct Found {
  std::size_t draw;
  std::uint32_t primitive;
  bool front;
};

class OnePixel {
 public:
  OnePixel(const Gl& gl, const SceneInGl& scene, const Target& floats, const Target& frame, glm::ivec2 pixel)
      : gl_(gl), scene_(scene), floats_(floats), frame_(frame), pixel_(pixel) {}

  /// The primitives that reach the pixel, by bisection: half of them are drawn, and halves of a half that reaches it.
  std::vector<Found> find() const {
    std::vector<Found> found;
    for (std::size_t draw = 0; draw < scene_.ranges().size(); ++draw) {
      find(draw, {scene_.ranges()[draw].first_primitive, scene_.ranges()[draw].primitive_count}, found);
    }
    return found;
  }

  struct Values {
    glm::vec4 shaded;
    double depth;
  };
  /// Colour and depth of the primitive drawn alone, without tests.
  Values values(const Found& f) const {
    {
      const PassState state(gl_);
      floats_.bind();
      scene_.clear(glm::vec4(0));
      set_state(f.draw);
      disable_tests(gl_);
      gl_.Enable(GL_DEPTH_TEST);  // without it no depth is written
      gl_.DepthFunc(GL_ALWAYS);
      gl_.DepthMask(GL_TRUE);
      scene_.draw_primitives(f.draw, {f.primitive, 1});
    }
    return {color(floats_), floats_.read_depth()(pixel_.x, pixel_.y)};
  }

  glm::vec4 texel(const Found& f) const {
    {
      const PassState state(gl_);
      floats_.bind();
      scene_.clear(glm::vec4(0));
      set_state(f.draw);
      disable_tests(gl_);
      scene_.set_texture_source(f.draw);
      scene_.draw_without_colors(f.draw, {f.primitive, 1});
    }
    return color(floats_);
  }

  void clear_frame() const {
    const PassState state(gl_);
    frame_.bind();
    scene_.clear(glm::vec4(0));
  }
  /// Whether the primitive's fragment passes the tests, over the depth and stencil of the primitives before it. Cleared
  /// to a red far from the fragment's, the pixel shows whether it was drawn.
  bool draws(const Found& f, const glm::vec4& shaded) const {
    const float before = shaded.r < 0.5f ? 1 : 0;
    {
      const PassState state(gl_);
      frame_.bind();
      gl_.ClearColor(before, 0, 0, 0);
      gl_.Clear(GL_COLOR_BUFFER_BIT);
      set_state(f.draw);
      scene_.draw_primitives(f.draw, {f.primitive, 1});
    }
    return !(std::abs(color(frame_).r - before) <= 0.25f);
  }

 private:
  glm::vec4 color(const Target& target) const { return target.read_color(pixel_, {1, 1})(0, 0); }

  void set_state(std::size_t draw) const {
    set_lights(gl_, scene_.scene());
    scene_.set_matrices(draw);
    scene_.set_surface(draw);
    scene_.set_fragments(draw);
  }

  bool reached_by(std::size_t draw, Primitives these, bool but_back = false) const {
    {
      const PassState state(gl_);
      floats_.bind();
      scene_.clear(glm::vec4(0));
      gl_.ShadeModel(GL_FLAT);
      gl_.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_FALSE);
      gl_.ClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FALSE);
      scene_.set_matrices(draw);
      scene_.set_fragments(draw);
      disable_tests(gl_);
      if (but_back) {
        gl_.Enable(GL_CULL_FACE);
        gl_.CullFace(GL_BACK);
      }
      scene_.draw_weights(draw, these);
    }
    return color(floats_).r != 0;
  }

  void find(std::size_t draw, Primitives among, std::vector<Found>& found) const {
    if (among.count == 0 || !reached_by(draw, among)) return;
    if (among.count == 1) {
      found.push_back({draw, among.first, reached_by(draw, among, true)});
      return;
    }
    const std::uint32_t half = among.count / 2;
    find(draw, {among.first, half}, found);
    find(draw, {among.first + half, among.count - half}, found);
  }

  const Gl& gl_;
  const SceneInGl& scene_;
  const Target &floats_, &frame_;
  glm::ivec2 pixel_;
};

}  // namespace

void read_pixel_fragments(const Gl& gl, const SceneInGl& scene, const Request& request, Records<double>& records) {
  const FrameFormat& frame = scene.scene().frame;
  const StageSet wanted = request.records;
  const Target floats(gl, frame, ColorFormat::rgba32f);
  // The alpha test compares in the target's format; for 12 bits OpenGL has none (planes.cpp).
  const Target in_format(gl, frame, frame.color == ColorFormat::rgba12 ? ColorFormat::rgba32f : frame.color);
  for (const glm::ivec2 pixel : request.pixels) {
    const OnePixel at(gl, scene, floats, in_format, pixel);
    const std::vector<Found> found = at.find();
    at.clear_frame();
    for (const Found& f : found) {
      WindowTriangle<double> triangle{};
      triangle.primitive = f.primitive;
      triangle.front = f.front;
      triangle.corners = 0;
      records.covered.push_back({static_cast<std::uint32_t>(records.triangles.size()),
                                 static_cast<std::uint16_t>(pixel.x), static_cast<std::uint16_t>(pixel.y)});
      records.triangles.push_back(triangle);
      const OnePixel::Values values = at.values(f);
      if (wanted.has(Stage::depth)) records.depth.push_back(values.depth);
      if (wanted.has(Stage::shade)) records.shaded.push_back({values.shaded});
      if (wanted.has(Stage::visibility)) records.drawn.push_back({at.draws(f, values.shaded)});
      if (!wanted.has(Stage::texture) || !textured(scene.scene())) continue;
      Texel<double> texel;
      texel.lod = std::numeric_limits<double>::quiet_NaN();
      if (scene.scene().draws[f.draw].texture) texel.color = at.texel(f);
      records.texels.push_back(texel);
    }
  }
  check(gl, "drawing primitives one by one at a pixel");
}

}  // namespace plumbline::osmesa
