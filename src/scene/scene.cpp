#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace plumbline {

bool may_draw(const Scene& scene, Topology topology) {
  constexpr PolygonMode kModes[] = {PolygonMode::fill, PolygonMode::line, PolygonMode::point};
  const PolygonMode mode = kModes[static_cast<std::size_t>(topology)];
  return std::any_of(scene.draws.begin(), scene.draws.end(), [&](const Draw& draw) {
    const Topology of_mesh = scene.meshes[draw.mesh].topology;
    return of_mesh == Topology::triangles ? draw.front_mode == mode || draw.back_mode == mode : of_mesh == topology;
  });
}

bool textured(const Scene& scene) {
  return std::any_of(scene.draws.begin(), scene.draws.end(), [](const Draw& d) { return d.texture.has_value(); });
}

bool antialiased(const Scene& scene) { return scene.frame.antialias.kind != Antialias::Kind::none; }

std::vector<DrawRange> draw_ranges(const Scene& scene) {
  std::vector<DrawRange> out;
  draw_ranges(scene, out);
  return out;
}

void draw_ranges(const Scene& scene, std::vector<DrawRange>& out) {
  out.clear();
  std::uint32_t vertex = 0, primitive = 0;
  for (const Draw& draw : scene.draws) {
    const Mesh& mesh = scene.meshes[draw.mesh];
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    const auto primitives = static_cast<std::uint32_t>(mesh.triangles.size());
    out.push_back({vertex, vertices, primitive, primitives});
    vertex += vertices;
    primitive += primitives;
  }
}

double depth_step(DepthFormat format, double z_win) {
  if (format != DepthFormat::z32f) return 1.0 / depth_scale(format);
  const auto z = static_cast<float>(std::abs(z_win));
  return std::max(static_cast<double>(std::nextafter(z, 2.0f)) - static_cast<double>(z), std::ldexp(1.0, -24));
}

double polygon_offset_unit(DepthFormat format, double z_max) {
  constexpr int kMantissa = 23, kLeastExponent = -126;
  if (format != DepthFormat::z32f) return 2 / depth_scale(format);
  return std::ldexp(1.0, std::max(z_max > 0 ? std::ilogb(z_max) : kLeastExponent, kLeastExponent) - kMantissa);
}

namespace {

void color(Material& m, ColorMaterial follows, const glm::vec4& color) {
  switch (follows) {
    case ColorMaterial::none: break;
    case ColorMaterial::ambient: m.ambient = color; break;
    case ColorMaterial::diffuse: m.diffuse = color; break;
    case ColorMaterial::ambient_and_diffuse: m.ambient = m.diffuse = color; break;
    case ColorMaterial::specular: m.specular = color; break;
    case ColorMaterial::emission: m.emission = color; break;
  }
}

}  // namespace

Material lit_material(const Scene& scene, const Draw& draw, LitPart part, const glm::vec4* vertex_color) {
  Material m = part.back && draw.back_material ? *draw.back_material : draw.material;
  if (vertex_color != nullptr) color(m, draw.color_material, *vertex_color);
  if (part.secondary)
    m.ambient = m.diffuse = m.emission = glm::vec4(0);
  else if (scene.light_model.separate_specular)
    m.specular = glm::vec4(0);
  return m;
}

}  // namespace plumbline
