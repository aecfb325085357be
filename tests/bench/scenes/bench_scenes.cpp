#include "bench/scenes/bench_scenes.h"

#include <algorithm>
#include <cmath>

#include "scene/json/asset_folders.h"
#include "scene/mesh/mesh_file.h"
#include "scene/mesh/mesh_shapes.h"

namespace plumbline::bench {

namespace {

Scene scene_of(Mesh mesh, int size) {
  Scene scene;
  scene.frame.width = scene.frame.height = size;
  scene.frame.clear_color = {0.1f, 0.2f, 0.3f, 1};
  scene.camera.eye = {0, 0, 3};
  scene.meshes.push_back(std::move(mesh));
  Draw draw;
  draw.cull = Cull::back;
  draw.transforms = {Rotate{20, {1, 0.3, 0}}};
  scene.draws.push_back(draw);
  Light light;
  light.vector = {0.3, 0.5, 1};
  scene.lights.push_back(light);
  return scene;
}

// 2 slices (stacks - 1) triangles, slices = 2 stacks.
Mesh sphere(int triangles) {
  const int stacks = static_cast<int>(std::lround(0.5 + std::sqrt(0.25 + triangles / 4.0)));
  return make_uv_sphere(2 * stacks, stacks);
}

// The whole frame, at window depth 1/2.
Scene full_screen(int size) {
  Scene scene = scene_of(make_grid(1, 1), size);
  scene.projection = Orthographic{-1, 1, -1, 1, 1, 5};
  scene.draws[0].transforms.clear();
  scene.draws[0].lit = false;
  scene.draws[0].material.diffuse = {0.9f, 0.6f, 0.3f, 1};
  return scene;
}

// 100 full screens, nearer or farther one by one.
Scene layers(int size, bool back_to_front) {
  constexpr int kLayers = 100;
  Scene scene = full_screen(size);
  const Draw draw = scene.draws[0];
  scene.draws.assign(kLayers, draw);
  for (int i = 0; i < kLayers; ++i) {
    const double z = 0.01 * (back_to_front ? i : kLayers - 1 - i);
    scene.draws[static_cast<std::size_t>(i)].transforms = {Translate{{0, 0, z}}};
    scene.draws[static_cast<std::size_t>(i)].material.diffuse.r = 0.01f * static_cast<float>(i);
  }
  return scene;
}

Scene blended(int size) {
  Scene scene = layers(size, true);
  scene.draws.resize(10);
  const BlendTerm over{BlendFactor::source_alpha, BlendFactor::one_minus_source_alpha, BlendEquation::add};
  for (Draw& draw : scene.draws) {
    draw.material.diffuse.a = 0.4f;
    draw.merge.blend = Blend{over, over, glm::vec4(0)};
  }
  return scene;
}

Scene textured_sphere(int size) {
  Scene scene = scene_of(make_globe(142, 71), size);
  Texture texture;
  texture.name = "noise";
  texture.sampler.min = MinFilter::linear_mipmap_linear;
  TextureLevel image{256, 256, {}};
  for (unsigned i = 0; i < 256 * 256; ++i) {
    const unsigned noise = (i * 2654435761u) >> 8;
    image.texels.emplace_back(glm::vec4(noise & 255u, noise >> 8 & 255u, noise >> 16 & 255u, 255u) / 255.0f);
  }
  set_levels(texture, std::move(image));
  scene.textures.push_back(std::move(texture));
  scene.draws[0].texture = DrawTexture{};
  return scene;
}

Scene phong_sphere(int size) {
  Scene scene = sphere_scene(20'000, size);
  scene.draws[0].shading = Shading::phong;
  scene.draws[0].material.specular = {1, 1, 1, 1};
  scene.draws[0].material.shininess = 40;
  return scene;
}

Scene multisampled(int size) {
  Scene scene = sphere_scene(20'000, size);
  scene.frame.antialias = {Antialias::Kind::multisample, 1};
  return scene;
}

// A sphere's edges.
Scene wires(int size) {
  Scene scene = sphere_scene(20'000, size);
  scene.draws[0].front_mode = PolygonMode::line;
  return scene;
}

Scene depth_only(int size) {
  Scene scene = sphere_scene(20'000, size);
  scene.draws[0].lit = false;
  scene.draws[0].merge.color_mask = glm::bvec4(false);
  return scene;
}

Scene bunny(int size) {
  const AssetFolders folders({PLUMBLINE_ASSETS});
  std::vector<MeshPart> parts = load_mesh(PLUMBLINE_ASSETS "/bunny.obj", folders, 1'000'000);
  Mesh mesh = std::move(parts.at(0).mesh);
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::vec3 size_of = high - low;
  const double scale = 1.9 / static_cast<double>(std::max({size_of.x, size_of.y, size_of.z}));
  Scene scene = scene_of(std::move(mesh), size);
  const glm::dvec3 middle = glm::dvec3(low + high) * 0.5;
  scene.draws[0].transforms = {Scale{glm::dvec3(scale)}, Translate{-middle}};
  return scene;
}

}  // namespace

Scene sphere_scene(int triangles, int size) { return scene_of(sphere(triangles), size); }

std::vector<BenchScene> bench_scenes() {
  const auto of = [](int triangles) { return [=](int size) { return sphere_scene(triangles, size); }; };
  return {{"sphere_1k", of(1'000)},
          {"sphere_20k", of(20'000)},
          {"sphere_300k", of(300'000)},
          {"bunny", bunny},
          {"full_screen_quad", full_screen},
          {"layers_front_to_back", [](int size) { return layers(size, false); }, 0, false, true},
          {"layers_back_to_front", [](int size) { return layers(size, true); }, 0, false, true},
          {"textured_trilinear", textured_sphere},
          {"textured_trilinear_256", textured_sphere, 256},
          {"textured_trilinear_64", textured_sphere, 64},
          {"sphere_20k_read", of(20'000), 0, true},
          {"phong_per_fragment", phong_sphere},
          {"blended", blended},
          {"multisampled_4x", multisampled},
          {"million_triangles", of(1'000'000)},
          {"lines", wires},
          {"depth_only", depth_only}};
}

}  // namespace plumbline::bench
