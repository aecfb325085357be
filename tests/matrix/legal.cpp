#include "matrix/legal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "faults/pixel_barycentrics.h"
#include "faults/variants.h"
#include "pipeline/geometry.h"

namespace plumbline::faults {

namespace {

using MaybeScene = std::optional<Scene>;

// Each draw with a mesh of its own, changed.
template <class Change>
Scene with_own_meshes(Scene scene, Change change) {
  std::vector<Mesh> meshes;
  for (Draw& draw : scene.draws) {
    meshes.push_back(scene.meshes[draw.mesh]);
    change(draw, meshes.back());
    draw.mesh = static_cast<std::uint32_t>(meshes.size() - 1);
  }
  scene.meshes = std::move(meshes);
  return scene;
}

bool of_triangles_alone(const Scene& scene) {
  return std::all_of(scene.meshes.begin(), scene.meshes.end(),
                     [](const Mesh& m) { return m.topology == Topology::triangles; });
}

// Two-sided light takes the side from the winding: none there.
MaybeScene other_winding(const Scene& of) {
  if (of.light_model.sides == LightModel::Sides::two || !of_triangles_alone(of)) return {};
  Scene scene = of;
  for (Mesh& mesh : scene.meshes) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t[0], t[1]);  // the last one provokes
  }
  for (Draw& draw : scene.draws) {
    if (draw.cull != Cull::none) draw.cull = draw.cull == Cull::front ? Cull::back : Cull::front;
    std::swap(draw.front_mode, draw.back_mode);
    if (draw.stencil) std::swap(draw.stencil->front, draw.stencil->back);
  }
  return scene;
}

MaybeScene corners_rotated(const Scene& of) {
  if (!of_triangles_alone(of)) return {};
  return with_own_meshes(of, [](const Draw& draw, Mesh& mesh) {
    if (draw.shading == Shading::flat) return;
    for (glm::uvec3& t : mesh.triangles) t = {t[1], t[2], t[0]};
  });
}

MaybeScene triangles_backwards(const Scene& of) {
  Scene scene = of;
  for (Mesh& mesh : scene.meshes) std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  return scene;
}

template <class T>
std::vector<T> unshared(const Mesh& mesh, const std::vector<T>& values) {
  std::vector<T> out;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3 && !values.empty(); ++k) out.push_back(values[t[k]]);
  }
  return out;
}

MaybeScene vertices_unshared(const Scene& of) {
  Scene scene = of;
  for (Mesh& mesh : scene.meshes) {
    mesh = {unshared(mesh, mesh.positions),
            unshared(mesh, mesh.normals),
            unshared(mesh, mesh.colors),
            mesh.triangles,
            mesh.topology,
            unshared(mesh, mesh.texcoords)};
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      mesh.triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
    }
  }
  return scene;
}

MaybeScene draws_split(const Scene& of) {
  Scene scene = of;
  scene.draws.clear();
  scene.meshes.clear();
  for (const Draw& draw : of.draws) {
    const Mesh& mesh = of.meshes[draw.mesh];
    const auto middle = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(mesh.triangles.size() / 2);
    for (const auto& [from, to] :
         {std::pair(mesh.triangles.begin(), middle), std::pair(middle, mesh.triangles.end())}) {
      if (from == to) continue;
      Mesh half = mesh;
      half.triangles.assign(from, to);
      scene.draws.push_back(draw);
      scene.draws.back().mesh = static_cast<std::uint32_t>(scene.meshes.size());
      scene.meshes.push_back(std::move(half));
    }
  }
  return scene;
}

MaybeScene colors_at_vertices(const Scene& of) {
  const auto has_none = [&](const Draw& d) { return !d.lit && of.meshes[d.mesh].colors.empty(); };
  if (std::none_of(of.draws.begin(), of.draws.end(), has_none)) return {};
  return with_own_meshes(of, [](const Draw& draw, Mesh& mesh) {
    if (!draw.lit && mesh.colors.empty()) mesh.colors.assign(mesh.positions.size(), draw.material.diffuse);
  });
}

MaybeScene lights_backwards(const Scene& of) {
  if (of.lights.size() < 2) return {};
  Scene scene = of;
  std::reverse(scene.lights.begin(), scene.lights.end());
  return scene;
}

MaybeScene transforms_that_do_nothing(const Scene& of) {
  Scene scene = of;
  for (Draw& draw : scene.draws) {
    draw.transforms.insert(draw.transforms.begin(), Translate{{0, 0, 0}});
    draw.transforms.push_back(Scale{{1, 1, 1}});
  }
  return scene;
}

MaybeScene tests_that_pass(const Scene& of) {
  Scene scene = of;
  for (Draw& draw : scene.draws) {
    if (!draw.alpha_test) draw.alpha_test = AlphaTest{};
    if (!draw.scissor) draw.scissor = Scissor{0, 0, 16384, 16384};
    if (!draw.stencil && scene.frame.stencil != StencilFormat::none) draw.stencil = Stencil{};
  }
  return scene;
}

MaybeScene blending_that_replaces(const Scene& of) {
  Scene scene = of;
  for (Draw& draw : scene.draws) {
    if (!draw.merge.blend && !draw.merge.logic_op) draw.merge.blend = Blend{};
  }
  return scene;
}

MaybeScene draw_out_of_sight(const Scene& of) {
  Scene scene = of;
  if (scene.draws.empty()) return {};
  Draw unseen = scene.draws.back();
  unseen.scissor = Scissor{0, 0, 0, 0};
  scene.draws.push_back(unseen);
  return scene;
}

// Doubles all lengths. A view plane's eye and a pinhole's w have none.
MaybeScene world_doubled(const Scene& of) {
  Scene scene = of;
  if (auto* p = std::get_if<Perspective>(&scene.projection)) {
    *p = {p->fov_y_degrees, 2 * p->near, 2 * p->far};
  } else if (auto* o = std::get_if<Orthographic>(&scene.projection)) {
    *o = {2 * o->left, 2 * o->right, 2 * o->bottom, 2 * o->top, 2 * o->near, 2 * o->far};
  } else if (auto* f = std::get_if<Frustum>(&scene.projection)) {
    *f = {2 * f->left, 2 * f->right, 2 * f->bottom, 2 * f->top, 2 * f->near, 2 * f->far};
  } else {
    return {};
  }
  scene.camera.eye *= 2.0;
  scene.camera.center *= 2.0;
  for (Mesh& mesh : scene.meshes) {
    for (glm::vec3& p : mesh.positions) p *= 2.0f;
  }
  for (Light& light : scene.lights) {
    if (light.kind != Light::Kind::point) continue;
    light.vector *= 2.0;
    light.attenuation *= glm::vec3(1, 0.5f, 0.25f);
  }
  for (Draw& draw : scene.draws) {
    for (Transform& t : draw.transforms) {
      if (auto* translate = std::get_if<Translate>(&t)) translate->by *= 2.0;
    }
    if (draw.fog) {
      draw.fog->density *= 0.5f;
      draw.fog->start *= 2;
      draw.fog->end *= 2;
    }
  }
  return scene;
}

// Ways to draw.

void positions_in_two_steps(const Matrices<float>& m, Normals normals, const Mesh& mesh,
                            std::vector<Vertex<float>>& out) {
  const std::size_t first = out.size();
  pipeline::transform(m, normals, mesh, out);
  for (std::size_t i = first; i < out.size(); ++i) out[i].p_clip = m.projection * out[i].p_eye;
}

void near_plane_first(const pipeline::DrawInput& input, pipeline::Polygon& polygon) {
  const auto p = pipeline::view_volume();  // right, left, top, bottom, near, far
  const std::array<Vec4<float>, 6> near_first = {p[4], p[5], p[0], p[1], p[2], p[3]};
  pipeline::clip_at(std::span(near_first).subspan(input.depth_clamp ? 2 : 0), polygon);
}

void polygons_rotated(const pipeline::DrawInput& input, pipeline::Polygon& polygon) {
  pipeline::clip(input, polygon);
  auto& corners = polygon.corners;
  if (corners.size() > 3) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
}

PixelList larger_box(const Triangle& t, const PixelBounds& box) {
  if (t.corners != 3) return pipeline::covered_pixels(t, box);
  const PixelBounds b = pipeline::pixel_bounds(t);
  return pipeline::covered_pixels(pipeline::edges_of(t), {b.x0 - 1, b.y0 - 1, b.x1 + 1, b.y1 + 1}, box);
}

float depth_of_three_weights(const Setup& s, const Pixels<float>& p) {
  const Barycentric b = pipeline::barycentric(s.planes, p);
  const pipeline::DepthSetup& d = s.depth;
  return stored_depth(d, b.l0 * d.z0 + b.l1 * (d.z0 + d.dz1) + b.l2 * (d.z0 + d.dz2) + z_of_sample(s));
}

Color<float> attributes_in_double(const Setup& s, const pipeline::AttributeSetup& of, const Pixels<float>& p) {
  const Barycentric b = pipeline::barycentric(s.planes, p);
  const auto& inv_w = s.perspective.inv_w;
  const double q0 = b.l0 * static_cast<double>(inv_w[0]), q1 = b.l1 * static_cast<double>(inv_w[1]),
               q2 = b.l2 * static_cast<double>(inv_w[2]), sum = q0 + q1 + q2;
  if (!(std::abs(sum) > 1e-37)) return pipeline::mean<float>(of, weights_of(s, p));
  const auto channel = [&](int i) {
    const double of_0 = static_cast<double>(of.value0[i]), d1 = static_cast<double>(of.delta1[i]),
                 d2 = static_cast<double>(of.delta2[i]);
    return static_cast<float>(of_0 + (q1 * d1 + q2 * d2) / sum);
  };
  return {channel(0), channel(1), channel(2), channel(3)};
}

// OpenGL asks for the nearest code, and says nothing of halves.
Color<float> halves_up(const Color<float>& color, float scale) {
  if (scale == 0.0f) return color;
  const auto code = [&](float v) {
    return static_cast<float>(
        pipeline::floor_of(static_cast<double>(pipeline::clamp01(v)) * static_cast<double>(scale) + 0.5));
  };
  return {code(color.r), code(color.g), code(color.b), code(color.a)};
}

float mean_from_the_last(std::span<const float> values, std::span<const PixelSample> samples, float scale) {
  const std::vector<float> v(values.rbegin(), values.rend());
  const std::vector<PixelSample> s(samples.rbegin(), samples.rend());
  return pipeline::weighted_mean(v, s, scale);
}

constexpr Variant said(std::string_view name, std::string_view says, MaybeScene (*scene)(const Scene&),
                       bool same_bits = false) {
  return {name, says, scene, nullptr, same_bits};
}
constexpr Variant drawn(std::string_view name, std::string_view says, void (*apply)(Stages&), bool same_bits = false) {
  return {name, says, nullptr, apply, same_bits};
}

constexpr std::array kVariants = {
    said("other_winding", "triangles run the other way round, and front is back in all that asks", other_winding),
    said("corners_rotated", "triangles begin at another corner; flat ones, whose last one counts, do not",
         corners_rotated),
    said("triangles_backwards", "a mesh's triangles in the other order", triangles_backwards),
    said("vertices_unshared", "every triangle has vertices of its own", vertices_unshared, true),
    said("draws_split", "every draw is two, of half its triangles", draws_split, true),
    said("colors_at_vertices", "the material's colour stands at the vertices, in unlit draws", colors_at_vertices,
         true),
    said("lights_backwards", "the lights in the other order", lights_backwards),
    said("transforms_that_do_nothing", "a translation by 0, a scale by 1", transforms_that_do_nothing, true),
    said("tests_that_pass", "alpha, stencil and scissor tests that let everything pass", tests_that_pass, true),
    said("blending_that_replaces", "blending by one and zero", blending_that_replaces),
    said("draw_out_of_sight", "the last draw again, where no pixel is", draw_out_of_sight, true),
    said("world_doubled", "all lengths, and with them w, are twice as large", world_doubled, true),
    drawn("positions_in_two_steps", "P (M p) for (P M) p", put<&Stages::vertex, positions_in_two_steps>),
    drawn("near_plane_first", "the near plane cuts first, then the far one, and then the sides",
          put<&Stages::clip, near_plane_first>),
    drawn("polygons_rotated", "cut polygons begin, and are fanned, at another corner",
          put<&Stages::clip, polygons_rotated>),
    drawn("larger_box", "a bounding box with a pixel more on each side", put<&Stages::coverage, larger_box>, true),
    drawn("depth_of_three_weights", "depth by three weights, not by two differences",
          put<&Stages::depth, depth_of_three_weights>),
    drawn("attributes_in_double", "attributes are worked out in double",
          put<&Stages::attributes, attributes_in_double>),
    drawn("halves_up", "halves between two codes go up, not to the even one", put<&Stages::merge, halves_up>),
    drawn("mean_from_the_last", "samples are added up from the last",
          put<&pipeline::ResolveStage::weighted, mean_from_the_last>, true),
};

}  // namespace

std::span<const Variant> legal_variants() { return kVariants; }

}  // namespace plumbline::faults
