#include "capture/renderers/probes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "scene/draw_index.h"

namespace plumbline {

namespace {

constexpr glm::vec4 kBlack(0, 0, 0, 1);

// The draw's geometry, culling, depth and stencil state; its own colours, and no test or blending of colours.
Draw plain(const Draw& of) {
  Draw draw = of;
  draw.material = Material{};
  draw.material.diffuse = glm::vec4(1);
  draw.back_material.reset();
  draw.lit = false;
  draw.color_material = ColorMaterial::none;
  draw.shading = Shading::gouraud;
  draw.alpha_test.reset();
  draw.fog.reset();
  draw.texture.reset();
  draw.merge = Merge{};
  return draw;
}

// The scene's frame and camera, without its draws.
Scene stage_of(const Scene& scene) {
  Scene out = scene;
  out.path.clear();
  out.frame.color = ColorFormat::rgba8;
  out.frame.clear_color = kBlack;
  out.light_model = LightModel{};
  out.lights.clear();
  out.textures.clear();
  out.meshes.clear();
  out.draws.clear();
  return out;
}

// One primitive of a mesh with vertices of its own, all of one colour.
void add_primitive(const Mesh& from, const glm::uvec3& corners, const glm::vec4& color, Mesh& to) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  const std::uint32_t count = corner_count(from.topology);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t vertex = corners[static_cast<int>(k)];
    to.positions.push_back(from.positions[vertex]);
    to.normals.push_back(from.normals[vertex]);
    to.colors.push_back(color);
  }
  to.triangles.push_back({first, first + std::min(1u, count - 1), first + count - 1});
}

// Red, green and blue are digits of a primitive's number to the base 255, as 8-bit codes of 0 to 254: a code of 255 has
// no room above it, and three equal corners may interpolate to a little less.
constexpr std::uint32_t kBase = 255;

// Colour of a primitive's number plus 1; 0 is the cleared frame. A quarter code is added, so that rounding to nearest
// and rounding down give the code back; where the renderer rounds up, a quarter code is subtracted.
glm::vec4 color_of(std::uint32_t primitive, Conventions::Rounding rounding) {
  const std::uint32_t number = primitive + 1;
  const glm::vec3 codes(number % kBase, number / kBase % kBase, number / (kBase * kBase) % kBase);
  return {glm::clamp((codes + (rounding == Conventions::Rounding::up ? -0.25f : 0.25f)) / 255.0f, 0.0f, 1.0f), 1};
}

Plane<glm::vec4> picture_of(const Scene& scene, Renderer& renderer) {
  Plane<glm::vec4> color = renderer.capture(scene, Request{}).planes.color;
  if (color.empty()) throw Unsupported(fmt::format("{}: leaves no planes.color to be probed", scene.name));
  return color;
}

// Depth functions that a cleared depth of 1 passes: all depths the first two, all but 1 the last. Without a far plane
// that cuts, and in formats of few codes, whole areas have depth 1.
std::vector<DepthFunc> functions_of_probes(const Scene& scene, const Conventions& conventions) {
  std::vector<DepthFunc> out = {DepthFunc::always, DepthFunc::less_equal};
  const DepthFormat format = depth_format_of(scene.frame, conventions);
  const bool cuts = !scene.depth_clamp && conventions.depth_planes == Conventions::DepthPlanes::cut;
  if (cuts && format != DepthFormat::z8 && format != DepthFormat::z16) out.push_back(DepthFunc::less);
  return out;
}

// Pictures of primitives alone, drawn by the first of functions_of_probes() that the renderer supports.
class PicturesAlone {
 public:
  PicturesAlone(const Scene& scene, Renderer& renderer)
      : scene_(scene), renderer_(renderer), funcs_(functions_of_probes(scene, renderer.info().conventions)) {}
  Plane<glm::vec4> of(std::uint32_t primitive) {
    while (true) {
      try {
        return picture_of(primitive_alone(scene_, primitive, funcs_.front()), renderer_);
      } catch (const Unsupported&) {
        if (funcs_.size() == 1 || primitive > 0) throw;
        funcs_.erase(funcs_.begin());
      }
    }
  }

 private:
  const Scene& scene_;
  Renderer& renderer_;
  std::vector<DepthFunc> funcs_;  // functions left to try; pictures are drawn by the first
};

}  // namespace

Scene primitive_alone(const Scene& scene, std::uint32_t primitive, DepthFunc func) {
  const DrawIndex draws(scene);
  const std::size_t number = draws.of_primitive(primitive).value();
  const Mesh& mesh = scene.meshes[scene.draws[number].mesh];
  Scene out = stage_of(scene);
  out.frame.stencil = StencilFormat::none;
  out.frame.clear_depth = 1;
  Draw& draw = out.draws.emplace_back(plain(scene.draws[number]));
  draw.mesh = 0;
  draw.stencil.reset();
  draw.depth_func = func;
  draw.depth_range = {};  // another, and an offset, may leave the cleared depth
  draw.polygon_offset = {};
  Mesh& alone = out.meshes.emplace_back();
  alone.topology = mesh.topology;
  add_primitive(mesh, mesh.triangles[primitive - draws.ranges()[number].first_primitive], glm::vec4(1), alone);
  return out;
}

Scene primitives_by_color(const Scene& scene, Conventions::Rounding rounding) {
  Scene out = stage_of(scene);
  std::uint32_t primitive = 0;
  for (const Draw& of : scene.draws) {
    Draw& draw = out.draws.emplace_back(plain(of));
    draw.merge.depth_mask = of.merge.depth_mask;
    draw.mesh = static_cast<std::uint32_t>(out.meshes.size());
    const Mesh& from = scene.meshes[of.mesh];
    Mesh& to = out.meshes.emplace_back();
    to.topology = from.topology;
    for (const glm::uvec3& corners : from.triangles) add_primitive(from, corners, color_of(primitive++, rounding), to);
  }
  return out;
}

std::int32_t winner_of(const glm::vec4& color) {
  const auto code = [&](int channel) {
    const float v = color[channel];  // of a program: any number, or none
    return v > 0 ? static_cast<std::int32_t>(std::lround(std::min(v, 1.0f) * 255.0f)) : 0;
  };
  constexpr auto kOne = static_cast<std::int32_t>(kBase);
  if (std::max({code(0), code(1), code(2)}) >= kOne) return kOne * kOne * kOne;
  return code(0) + kOne * code(1) + kOne * kOne * code(2) - 1;
}

void add_probed_planes(const Scene& scene, Renderer& renderer, Capture& capture) {
  Planes& planes = capture.planes;
  std::size_t primitives = 0;
  for (const DrawRange& range : draw_ranges(scene)) primitives += range.primitive_count;
  if (primitives > kMostProbes) {
    throw Unsupported(
        fmt::format("{} primitives: a picture of each, {} at most, would be needed", primitives, kMostProbes));
  }
  if (planes.count.empty() && planes.id_sum.empty()) {
    Plane<std::uint32_t> count(capture.width, capture.height);  // shown only if every picture is
    Plane<std::uint64_t> id_sum(capture.width, capture.height);
    PicturesAlone pictures(scene, renderer);
    for (std::uint32_t primitive = 0; primitive < primitives; ++primitive) {
      const Plane<glm::vec4> picture = pictures.of(primitive);
      for (std::size_t i = 0; i < picture.size(); ++i) {
        if (glm::vec3(picture.values()[i]) == glm::vec3(kBlack)) continue;
        ++count.values()[i];
        id_sum.values()[i] += id_weight(primitive);
      }
    }
    planes.count = std::move(count);
    planes.id_sum = std::move(id_sum);
  }
  const bool by_alpha = std::ranges::any_of(scene.draws, [](const Draw& d) { return d.alpha_test.has_value(); });
  if (!planes.id.empty() || by_alpha || scene.frame.stencil != StencilFormat::none) return;
  const Conventions conventions = renderer.info().conventions;
  if (conventions.color_encoding != Conventions::Encoding::linear)
    throw Unsupported("colours are encoded: those of primitives tell no winner");
  const Plane<glm::vec4> picture = picture_of(primitives_by_color(scene, conventions.color_rounding), renderer);
  Plane<std::int32_t> id(capture.width, capture.height);
  std::ranges::transform(picture.values(), id.values().begin(), winner_of);
  const auto is_none = [&](std::int32_t winner) { return winner >= static_cast<std::int32_t>(primitives); };
  if (std::ranges::any_of(id.values(), is_none)) {
    throw Unsupported("primitives in colours of their own are drawn in others: pixels tell no winner");
  }
  planes.id = std::move(id);
}

}  // namespace plumbline
