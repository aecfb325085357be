#include "capture/by_conventions.h"

#include <algorithm>

namespace plumbline {

namespace {

using C = Conventions;

void rotate_corners(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    if (mesh.topology != Topology::triangles) continue;
    for (glm::uvec3& t : mesh.triangles) t = {t.y, t.z, t.x};
  }
}

template <class T>
void turn_over(Plane<T>& plane) {
  for (int y = 0; y < plane.height() / 2; ++y) {
    for (int x = 0; x < plane.width(); ++x) std::swap(plane(x, y), plane(x, plane.height() - 1 - y));
  }
}

double to_window(C::DepthRange range, double z) {
  return range == C::DepthRange::minus_one_to_one ? z / 2 + 0.5 : range == C::DepthRange::one_to_zero ? 1 - z : z;
}

}  // namespace

double rounded_in_range(C::DepthRange range, double z) {
  const double kept = range == C::DepthRange::minus_one_to_one ? 2 * z - 1
                      : range == C::DepthRange::one_to_zero    ? 1 - z
                                                               : z;
  return to_window(range, static_cast<float>(kept));
}

bool is_opaque(const Scene& scene) {
  const auto is_one = [](const glm::vec4& color) { return color.a == 1; };
  const auto has_opaque_colors = [&](const Mesh& mesh) { return std::ranges::all_of(mesh.colors, is_one); };
  const auto has_opaque_texels = [&](const Texture& texture) {
    const Sampler& s = texture.sampler;
    const bool has_border = s.wrap_s == Wrap::clamp_to_border || s.wrap_t == Wrap::clamp_to_border;
    if (has_border && !is_one(source_components(texture.format, s.border))) return false;
    return std::ranges::all_of(texture.levels,
                               [&](const TextureLevel& level) { return std::ranges::all_of(level.texels, is_one); });
  };
  const auto keeps_alpha = [&](const DrawTexture& t) {
    return t.environment != TextureEnvironment::blend || is_one(t.color);
  };
  const auto stays_opaque = [&](const Draw& draw) {
    return (!draw.texture || keeps_alpha(*draw.texture)) && is_one(draw.material.diffuse) &&
           (!draw.back_material || is_one(draw.back_material->diffuse)) && !draw.merge.blend && !draw.merge.logic_op;
  };
  return is_one(scene.frame.clear_color) && std::ranges::all_of(scene.meshes, has_opaque_colors) &&
         std::ranges::all_of(scene.textures, has_opaque_texels) && std::ranges::all_of(scene.draws, stays_opaque);
}

SceneByConventions::SceneByConventions(const Scene& scene, const Conventions& c) : scene_(scene) {
  const bool centred = c.sample == glm::dvec2(0.5), masks_alpha = c.alpha == C::Alpha::none && !is_opaque(scene);
  if (centred && !masks_alpha && c.depth_planes == C::DepthPlanes::cut && c.provoking_vertex == C::Provoking::last &&
      c.depth_format == C::Depth::as_asked) {
    return;
  }
  Scene& out = altered_.emplace(scene);
  out.frame.pass.shift += 0.5 - c.sample;
  if (c.depth_planes == C::DepthPlanes::clamped) out.depth_clamp = true;
  if (c.provoking_vertex == C::Provoking::first) rotate_corners(out);
  out.frame.depth = depth_format_of(scene.frame, c);
  if (!masks_alpha) return;
  out.frame.clear_color.a = 1;
  for (Draw& draw : out.draws) draw.merge.color_mask.a = false;
}

DepthFormat depth_format_of(const FrameFormat& frame, const Conventions& c) {
  switch (c.depth_format) {
    case C::Depth::as_asked: break;
    case C::Depth::z16: return DepthFormat::z16;
    case C::Depth::z24: return DepthFormat::z24;
    case C::Depth::z32f: return DepthFormat::z32f;
  }
  return frame.depth;
}

namespace {

// Moves window positions so that pixels are sampled at their centres.
void move_to_centres(const glm::dvec2& sample, std::vector<WindowTriangle<double>>& triangles) {
  const glm::dvec2 by = 0.5 - sample;
  for (WindowTriangle<double>& triangle : triangles) {
    for (WindowVertex<double>& v : triangle.v) {
      v.p_win.x += by.x, v.p_win.y += by.y;
      const glm::dvec2 moved = glm::dvec2(v.snapped) + glm::round(by * static_cast<double>(kSubpixel));
      v.snapped = glm::clamp(moved, -0x1p31, 0x1p31 - 1);
    }
  }
}

}  // namespace

void to_dialect(const Conventions& c, Capture& capture) {
  move_to_centres(c.sample, capture.records.triangles);
  for (double& z : capture.planes.depth.values()) z = to_window(c.depth_range, z);
  for (double& z : capture.records.depth) z = to_window(c.depth_range, z);
  if (c.alpha == C::Alpha::none) {
    for (glm::vec4& color : capture.planes.color.values()) color.a = 1;
  }
  if (c.rows == C::Rows::from_bottom) return;
  Planes& p = capture.planes;
  turn_over(p.count), turn_over(p.id_sum), turn_over(p.id), turn_over(p.texel), turn_over(p.shaded);
  turn_over(p.color), turn_over(p.stencil), turn_over(p.depth);
  for (Covered& covered : capture.records.covered) {
    covered.y = static_cast<std::uint16_t>(capture.height - 1 - covered.y);
  }
}

}  // namespace plumbline
