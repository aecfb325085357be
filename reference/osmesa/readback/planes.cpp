#include "reference/osmesa/readback/planes.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include <fmt/format.h>

#include "capture/renderer.h"
#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/fragment_state.h"
#include "reference/osmesa/scene/light_state.h"
#include "reference/osmesa/scene/target.h"

namespace plumbline::osmesa {
namespace {

/// Scope in which GL counts fragments (GL_SAMPLES_PASSED). softpipe then computes the depth of each fragment; otherwise
/// it increments 16-bit depth along a row by steps that are rounded first (8 codes off in a frame of 97 pixels).
/// llvmpipe is not affected.
class CountedFragments {
 public:
  explicit CountedFragments(const Gl& gl) : gl_(gl) {
    gl_.GenQueries(1, &query_);
    gl_.BeginQuery(GL_SAMPLES_PASSED, query_);
  }
  ~CountedFragments() {
    gl_.EndQuery(GL_SAMPLES_PASSED);
    gl_.DeleteQueries(1, &query_);
  }
  CountedFragments(const CountedFragments&) = delete;
  CountedFragments& operator=(const CountedFragments&) = delete;

 private:
  const Gl& gl_;
  GLuint query_ = 0;
};

enum class Colors {
  of_winners,  ///< each drawn fragment replaces the stored colour
  merged,      ///< the scene's blending, logic ops and masks
  texels       ///< each fragment's texture source
};

void draw_scene(const Gl& gl, const SceneInGl& scene, const Target& target, Colors colors) {
  const PassState state(gl);
  const CountedFragments counted(gl);
  target.bind();
  scene.clear(colors == Colors::texels ? glm::vec4(0) : scene.scene().frame.clear_color);
  set_lights(gl, scene.scene());
  for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
    scene.set_matrices(i);
    scene.set_surface(i);
    scene.set_fragments(i);
    if (colors == Colors::merged) scene.set_merge(i);
    if (colors == Colors::texels) {
      scene.set_texture_source(i);
      scene.draw_without_colors(i);
    } else {
      scene.draw_primitives(i);
    }
  }
  check(gl, "drawing the scene");
}

// Whether any draw tests alpha: then a primitive's number must not be in its alpha.
bool tests_alpha(const Scene& scene) {
  return std::ranges::any_of(scene.draws, [](const Draw& draw) { return draw.alpha_test.has_value(); });
}

/// The number whose bytes are red (the lowest), green and blue.
std::int32_t number_of(const glm::vec4& color) {
  const auto byte = [](float v) { return static_cast<std::int32_t>(std::lround(255 * v)); };
  return byte(color.r) | byte(color.g) << 8 | byte(color.b) << 16;
}

/// draw_ids() for scenes with alpha tests, in a target of the frame's format, in which the test compares.
Plane<std::int32_t> draw_tested_ids(const Gl& gl, const SceneInGl& scene, const Target& target) {
  {
    const PassState state(gl);
    const CountedFragments counted(gl);
    const NumberedFragments numbered(gl);
    target.bind();
    scene.clear(glm::vec4(0));
    set_lights(gl, scene.scene());
    // A separate specular term would be added to the numbers, GL_COLOR_SUM or not (OpenGL 2.1, section 3.9).
    gl.LightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SINGLE_COLOR);
    for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
      scene.set_matrices(i);
      scene.set_fragments(i);
      const SavedState of_draw(gl);
      if (!scene.scene().draws[i].alpha_test) {
        gl.ShadeModel(GL_FLAT);
        scene.draw_ids(i);
        continue;
      }
      scene.set_surface(i);
      if (is_lit_per_fragment(scene.scene().draws[i])) {  // by a program, which has no texture environment
        gl.UseProgram(0);
        gl.Enable(GL_LIGHTING);  // at the vertices: the alpha is the material's either way
      }
      for (const GLenum after : std::initializer_list<GLenum>{GL_FOG, GL_COLOR_SUM})
        gl.Disable(after);  // they come after the texture environment
      numbered.enable();
      scene.draw_one_by_one(i, [&](std::uint32_t primitive) { numbered.set(primitive + 1); });
      gl.UseProgram(0);
    }
    check(gl, "drawing the primitives' numbers");
  }
  const Plane<glm::vec4> color = target.read_color();
  Plane<std::int32_t> ids(color.width(), color.height());
  std::ranges::transform(color.values(), ids.values().begin(), [](const glm::vec4& c) { return number_of(c) - 1; });
  return ids;
}

/// The winners: the scene is drawn with each primitive's number + 1 as its colour, over 0.
Plane<std::int32_t> draw_ids(const Gl& gl, const SceneInGl& scene, const Target& target) {
  {
    const PassState state(gl);
    const CountedFragments counted(gl);
    target.bind();
    scene.clear(glm::vec4(0));
    gl.ShadeModel(GL_FLAT);
    for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
      scene.set_matrices(i);
      scene.set_fragments(i);
      scene.draw_ids(i);
    }
    check(gl, "drawing the primitives' numbers");
  }
  const Plane<std::uint32_t> codes = target.read_codes();
  Plane<std::int32_t> ids(codes.width(), codes.height());
  std::transform(codes.values().begin(), codes.values().end(), ids.values().begin(),
                 [](std::uint32_t code) { return static_cast<std::int32_t>(code) - 1; });
  return ids;
}

/// The sum over all fragments of all primitives: r counts them, g, b and a sum the parts of their weights.
Plane<glm::vec4> draw_weights(const Gl& gl, const SceneInGl& scene, const Target& target) {
  {
    const PassState state(gl);
    target.bind();
    scene.clear(glm::vec4(0));
    gl.ShadeModel(GL_FLAT);
    gl.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_FALSE);
    gl.ClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FALSE);
    for (std::size_t i = 0; i < scene.ranges().size(); ++i) {
      scene.set_matrices(i);
      scene.set_fragments(i);
      disable_tests(gl);
      gl.Enable(GL_BLEND);
      gl.BlendFunc(GL_ONE, GL_ONE);
      scene.draw_weights(i);
    }
    check(gl, "drawing the overdraw");
  }
  return target.read_color();
}

void add_up_coverage(const Plane<glm::vec4>& sums, Planes& planes) {
  constexpr float kMost = 4096;  // fragments at a pixel: below it every sum is under 2^24, and exact in float
  planes.count = Plane<std::uint32_t>(sums.width(), sums.height());
  planes.id_sum = Plane<std::uint64_t>(sums.width(), sums.height());
  for (int y = 0; y < sums.height(); ++y) {
    for (int x = 0; x < sums.width(); ++x) {
      const glm::vec4& sum = sums(x, y);
      if (!(sum.r <= kMost)) {
        const std::string what =
            fmt::format("OpenGL: {} fragments at pixel ({}, {}): sums in float are exact up to {}", sum.r, x, y, kMost);
        if (std::isfinite(sum.r)) throw Unsupported(what);
        throw RendererFailed(what);
      }
      planes.count(x, y) = static_cast<std::uint32_t>(sum.r);
      planes.id_sum(x, y) = static_cast<std::uint64_t>(sum.g) + (static_cast<std::uint64_t>(sum.b) << 20) +
                            (static_cast<std::uint64_t>(sum.a) << 40);
    }
  }
}

}  // namespace

Planes draw_planes(const Gl& gl, const SceneInGl& scene) {
  const FrameFormat& frame = scene.scene().frame;
  const Target floats(gl, frame, ColorFormat::rgba32f);
  const Target bytes(gl, frame, ColorFormat::rgba8);
  std::optional<Target> shorts;
  if (frame.color == ColorFormat::rgba16) shorts.emplace(gl, frame, ColorFormat::rgba16);
  Planes planes;
  // An alpha test would compare the texels' alpha, not the fragments'.
  if (textured(scene.scene()) && !tests_alpha(scene.scene())) {
    draw_scene(gl, scene, floats, Colors::texels);
    planes.texel = floats.read_color();
  }
  draw_scene(gl, scene, floats, Colors::of_winners);
  planes.shaded = floats.read_color();
  // Asked for 12 bits a channel, OpenGL gives 16: the colour is left unrounded.
  const Target& target = frame.color == ColorFormat::rgba8 ? bytes : shorts ? *shorts : floats;
  if (&target != &floats || !colors_replace(scene.scene())) {
    draw_scene(gl, scene, target, Colors::merged);
    planes.color = target.read_color();
  } else {
    planes.color = planes.shaded;
  }
  planes.depth = target.read_depth();
  planes.stencil = target.read_stencil();
  planes.id = tests_alpha(scene.scene()) ? draw_tested_ids(gl, scene, target) : draw_ids(gl, scene, bytes);
  add_up_coverage(draw_weights(gl, scene, floats), planes);
  return planes;
}

Planes draw_picture(const Gl& gl, const SceneInGl& scene) {
  const FrameFormat& frame = scene.scene().frame;
  const Target target(gl, frame, frame.color == ColorFormat::rgba12 ? ColorFormat::rgba32f : frame.color);
  draw_scene(gl, scene, target, Colors::merged);
  Planes planes;
  planes.color = target.read_color();
  planes.depth = target.read_depth();
  return planes;
}

}  // namespace plumbline::osmesa
