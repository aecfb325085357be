// The painter draws what the stages' functions draw, bit for bit: by every SIMD target, on any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "painter/painter.h"
#include "pipeline/render.h"
#include "scene/antialias.h"
#include "scene/file/scene_file.h"
#include "scene/mesh/mesh_shapes.h"
#include "scene/texture/texture_images.h"
#include "tests/extent.h"
#include "tests/painter/painter_frames.h"
#include "tests/suite.h"

namespace plumbline::pipeline {
namespace {

// A painter per SIMD target, and the widest on 2, 3, 5 and 8 threads.
std::map<std::string, std::unique_ptr<Painter>> painters() {
  std::map<std::string, std::unique_ptr<Painter>> out;
  for (const SimdTarget& target : simd_targets()) {
    out[std::string(target.name)] = std::make_unique<Painter>(1, target);
  }
  for (const int threads : {2, 3, 5, 8}) {
    out[std::to_string(threads) + " threads"] = std::make_unique<Painter>(threads);
  }
  return out;
}

// Every scene (in a run one of 6) and pass; painters keep their memory between scenes of any size.
TEST(Painter, DrawsEverySceneAsItsDefinitionDoes) {
  const std::vector<std::filesystem::path> files = suite_files();
  const Stages stages = production_stages();
  const auto all = painters();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < files.size(); i += one_of(6)) {
    const Scene scene = load_scene(files[i], {});
    std::vector<Scene> scenes = passes_of(scene);
    if (antialiased(scene)) scenes.push_back(scene);
    for (const Scene& s : scenes) {
      const Frame definition = render(s, stages);
      for (const auto& [name, painter] : all) {
        EXPECT_TRUE(same_bits(painter->draw(s), definition)) << name << ", " << files[i];
        ++compared;
      }
    }
  }
  std::printf("%zu frames compared, by %zu painters\n", compared, all.size());
}

// Triangles from large to smaller than pixels; nearer ones first and last.
TEST(Painter, DrawsTrianglesOfAllSizesAsItsDefinitionDoes) {
  const Stages stages = production_stages();
  const auto all = painters();
  for (const int slices : {6, 30, 120}) {
    for (const bool nearest_first : {false, true}) {
      for (const Cull cull : {Cull::none, Cull::back}) {
        Scene scene = spheres(slices, cull);
        if (nearest_first) std::reverse(scene.draws.begin(), scene.draws.end());
        for (const auto& [clear, antialias] :
             {std::pair(1.0, Antialias::Kind::none), std::pair(0.97, Antialias::Kind::none),
              std::pair(1.0, Antialias::Kind::multisample), std::pair(0.97, Antialias::Kind::multisample)}) {
          scene.frame.clear_depth = clear;
          scene.frame.antialias = {antialias, 1};
          const Frame definition = render(scene, stages);
          for (const auto& [name, painter] : all) {
            EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name << ", " << slices << " slices";
          }
        }
      }
    }
  }
}

// Surfaces on triangles of few pixels or none, a pixel of each at a time: textured, lit per fragment from one side and
// from two, foggy, with flat and with smooth colours; of one face, and of both side by side; nearer ones first and
// last.
TEST(Painter, ShadesSmallTrianglesAsItsDefinitionDoes) {
  const Stages stages = production_stages();
  const auto all = painters();
  for (unsigned round = 0; round < 48; ++round) {
    std::mt19937 random(round);
    const auto one_in = [&](unsigned n) { return random() % n == 0; };
    Scene scene = spheres(4, one_in(3) ? Cull::none : Cull::back);
    scene.frame.width = one_in(4) ? 200 : 72;
    scene.frame.height = one_in(4) ? 136 : 56;
    scene.meshes = {make_globe(one_in(5) ? 160 : 40, one_in(7) ? 80 : 20)};
    std::vector<glm::uvec3>& triangles = scene.meshes[0].triangles;
    const std::size_t turned = one_in(3) ? triangles.size() : 0;
    for (std::size_t i = 0; i < turned; i += 2) std::swap(triangles[i].x, triangles[i].y);
    scene.frame.clear_depth = one_in(6) ? 0.97 : 1.0;
    scene.light_model.sides = one_in(2) ? LightModel::Sides::two : LightModel::Sides::one;
    scene.light_model.separate_specular = one_in(5);
    Texture texture;
    texture.sampler.min = one_in(4) ? MinFilter::nearest : MinFilter::linear_mipmap_linear;
    texture.sampler.wrap_s = one_in(3) ? Wrap::clamp_to_border : Wrap::mirrored_repeat;
    set_levels(texture, make_noise(one_in(5) ? 30 : 64, 16, 1));
    scene.textures.push_back(texture);
    if (one_in(9)) std::reverse(scene.draws.begin(), scene.draws.end());
    for (Draw& draw : scene.draws) {
      draw.shading = one_in(3) ? Shading::phong : one_in(2) ? Shading::flat : Shading::gouraud;
      draw.material.specular = {1, 0.5, 1, 1};
      draw.material.shininess = 20;
      if (!one_in(6)) draw.texture = DrawTexture{};
      if (one_in(4)) draw.fog = Fog{};
    }
    const Frame definition = render(scene, stages);
    for (const auto& [name, painter] : all) {
      EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name << ", round " << round;
    }
  }
}

// Two meshes before an orthographic camera: x and y are the window's, z its distance; the second is red.
Scene wall_and_others(int size, Mesh wall, Mesh others) {
  Scene scene;
  scene.frame.width = scene.frame.height = size;
  scene.frame.antialias = {Antialias::Kind::multisample, 1};
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, static_cast<double>(size), 0, static_cast<double>(size), 0, 100};
  scene.meshes = {std::move(wall), std::move(others)};
  Draw draw;
  draw.lit = false;
  draw.transforms = {Scale{{1, 1, -1}}};
  scene.draws = {draw, draw};
  scene.draws[1].mesh = 1;
  scene.draws[1].material.diffuse = {1, 0, 0, 1};
  return scene;
}

void expect_parts_of_pixels(const Scene& scene, int at_least) {
  const Frame definition = render(scene, production_stages());
  const auto red = [](const glm::u8vec4& c) { return c.r > c.g && c.g > 0; };
  EXPECT_GT(std::ranges::count_if(definition.color_rgba8.values(), red), at_least);
  for (const auto& [name, painter] : painters()) {
    EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name;
  }
}

// Steep triangles behind a wall, but for some of a pixel's four samples, in tiles that the wall covers wholly.
TEST(Painter, HidesNoSampleThatIsNearer) {
  constexpr int kSize = 256;
  std::mt19937 random(6);
  const auto up_to = [&](double most) { return most * 0x1p-32 * static_cast<double>(random()); };
  std::vector<glm::vec3> corners;
  std::vector<glm::uvec3> triangles;
  for (unsigned i = 0; i < 4000; ++i) {
    const double angle = i % 2 == 0 ? 1.5708 * (i / 2 % 4) : up_to(6.28);
    const double slope = 0.01 + up_to(0.5), in_front = up_to(0.6);  // pixels
    const glm::dvec2 low(up_to(kSize), up_to(kSize)), toward(std::cos(angle), std::sin(angle));
    glm::dvec2 p[3];
    for (glm::dvec2& corner : p) corner = low + glm::dvec2(up_to(12), up_to(12));
    const double nearest = std::min({glm::dot(p[0], toward), glm::dot(p[1], toward), glm::dot(p[2], toward)});
    for (const glm::dvec2& corner : p) {
      corners.emplace_back(corner, 50 + slope * (glm::dot(corner, toward) - nearest - in_front));
    }
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const Mesh wall = make_triangles({{0, 0, 50}, {2 * kSize, 0, 50}, {0, 2 * kSize, 50}}, {{0, 1, 2}}, {});
  expect_parts_of_pixels(wall_and_others(kSize, wall, make_triangles(corners, triangles, {})), 100);
}

// A wall that is farther to the right, so that of a tile's right column some samples are farther than others are:
// there, triangles stand between these. That the wall hides all of a tile is known since a second wall was behind it.
TEST(Painter, HidesNoSampleThatIsNearerThanATilesFarthest) {
  constexpr int kSize = 256;
  const auto corner = [](double x, double y, double behind) { return glm::vec3(x, y, 50 + 0.02 * x + behind); };
  const std::vector<glm::vec3> walls = {corner(0, 0, 0), corner(2 * kSize, 0, 0), corner(0, 2 * kSize, 0),
                                        corner(0, 0, 3), corner(2 * kSize, 0, 3), corner(0, 2 * kSize, 3)};
  std::vector<glm::vec3> corners;
  std::vector<glm::uvec3> triangles;
  for (unsigned i = 0; i < 16; ++i) {
    const double x = 63 + 64 * (i % 4), y = 4 + 64 * (i / 4);
    const double z = 50 + 0.02 * (x + 0.75);  // samples are at x + .125, .375, .625, .875
    corners.insert(corners.end(), {glm::vec3(x + 0.1, y, z), glm::vec3(x + 1, y, z), glm::vec3(x + 1, y + 50, z)});
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  expect_parts_of_pixels(
      wall_and_others(kSize, make_triangles(walls, {{0, 1, 2}, {3, 4, 5}}, {}), make_triangles(corners, triangles, {})),
      100);
}

// Draws of all kinds over each other, some alike and some not, and walls that hide whole tiles.
TEST(Painter, DrawsAllKindsInTheirOrder) {
  const Stages stages = production_stages();
  const auto all = painters();
  std::mt19937 random(4);
  const auto one_in = [&](int n) { return static_cast<int>(random() % 1000) % n == 0; };
  for (int round = 0; round < 40; ++round) {
    Scene scene = spheres(round % 2 == 0 ? 16 : 60, Cull::none);
    scene.meshes.push_back(make_globe(round % 2 == 0 ? 12 : 50, 20));
    scene.meshes.push_back(make_grid(1, 1));
    Texture texture;
    texture.sampler.min = round % 3 == 0 ? MinFilter::linear : MinFilter::linear_mipmap_linear;
    texture.sampler.wrap_s = round % 4 == 0 ? Wrap::clamp_to_border : Wrap::repeat;
    texture.sampler.mag = one_in(3) ? MagFilter::nearest : MagFilter::linear;
    set_levels(texture, make_noise(round % 5 == 0 ? 30 : 64, 16, 1));
    scene.textures.push_back(texture);
    scene.frame.clear_depth = one_in(4) ? 0.96 : 1.0;
    std::vector<Draw> draws;
    for (int i = 0; i < 12; ++i) {
      Draw draw = scene.draws[random() % 4];
      if (one_in(4)) {  // a wall
        draw.mesh = 2;
        draw.transforms = {Translate{{0, 0, -1.0 + 0.001 * static_cast<double>(random() % 1000)}}, Scale{{4, 4, 1}}};
      }
      draw.lit = !one_in(4);
      draw.shading = one_in(2) ? Shading::flat : Shading::gouraud;
      draw.material.diffuse = {0.1 * static_cast<double>(random() % 10), 0.5, 0.9, one_in(2) ? 1.0 : 0.4};
      if (one_in(6)) draw.merge.blend = Blend{kOverTerm, kOverTerm, glm::vec4(0)};
      if (one_in(12)) draw.merge.color_mask = glm::bvec4(false);
      if (one_in(16)) draw.depth_func = DepthFunc::greater;
      if (one_in(16)) draw.depth_func = DepthFunc::less_equal;
      if (one_in(6)) draw.shading = Shading::phong, draw.lit = true;
      if (one_in(6)) {
        draw.mesh = 1;
        draw.texture = DrawTexture{};
      } else if (one_in(5)) {
        draw.front_mode = one_in(6) ? PolygonMode::point : PolygonMode::line;
        draw.back_mode = one_in(6) ? PolygonMode::fill : PolygonMode::line;
        draw.line_width = one_in(4) ? 2 : 1;
        draw.cull = one_in(3) ? Cull::back : one_in(3) ? Cull::front : Cull::none;
      }
      if (one_in(16)) draw.merge.logic_op = LogicOp::xor_;
      draws.push_back(draw);
    }
    scene.draws = draws;
    if (one_in(4)) scene.frame.antialias = {Antialias::Kind::multisample, 1};
    const Frame definition = render(scene, stages);
    for (const auto& [name, painter] : all) {
      EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name << ", round " << round;
    }
  }
}

// 1/w is 0 at the centres of pixels that are covered beside them: no level is then found, which is the least that the
// sampler lets be, and not magnified.
TEST(Painter, TakesTheLeastLevelAtTheHorizon) {
  Scene scene;
  scene.frame.width = scene.frame.height = 64;
  scene.frame.antialias = {Antialias::Kind::multisample, 1};
  scene.projection = Frustum{-1, 1, -1, 1, 1, 100};
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  const auto at = [](float x, float y, float w) { return glm::vec3((x / 32 - 1) * w, (y / 32 - 1) * w, -w); };
  scene.meshes = {make_triangles({at(.75f, 0, 64), at(16.5f, 2, 1), at(.75f, 4, 64)}, {{0, 1, 2}}, {})};
  scene.meshes[0].texcoords.assign(3, {0, 0});
  Texture texture;
  texture.sampler.min = MinFilter::nearest_mipmap_nearest;
  texture.sampler.mag = MagFilter::nearest;
  texture.sampler.min_lod = 1000;
  set_levels(texture, make_noise(4, 4, 1));
  scene.textures.push_back(texture);
  Draw draw;
  draw.lit = false;
  draw.texture = DrawTexture{0, TextureEnvironment::replace};
  scene.draws.push_back(draw);
  const std::uint8_t last = static_cast<std::uint8_t>(std::nearbyint(texture.levels.back().texels[0].r * 255.0f));
  const Frame definition = render(scene, production_stages());
  EXPECT_EQ(definition.color_rgba8(4, 1).r, last);
  EXPECT_EQ(definition.color_rgba8(0, 1).r, definition.color_rgba8(0, 2).r);
  for (const auto& [name, painter] : painters()) EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name;
}

// Equal surfaces: of two fragments of one depth the first stays, in whichever order tiles are painted.
TEST(Painter, KeepsTheFirstOfEquallyNearFragments) {
  const Stages stages = production_stages();
  const auto all = painters();
  for (const double offset : {0.0, -0.5, 0.5}) {
    Scene scene = spheres(20, Cull::none);
    scene.draws = {scene.draws[1], scene.draws[1], scene.draws[1]};
    for (std::size_t i = 0; i < 3; ++i) {
      scene.draws[i].lit = false;
      scene.draws[i].material.diffuse = {i == 0, i == 1, i == 2, 1};
    }
    scene.draws[2].transforms.insert(scene.draws[2].transforms.begin(), Translate{{0, 0, offset}});
    const Frame definition = render(scene, stages);
    for (const auto& [name, painter] : all) EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name;
  }
}

// Tiles that are painted, and tiles in which nothing is, in whole lanes and not; a frame of that size was there before.
TEST(Painter, WritesFramesOfEveryWidth) {
  const Stages stages = production_stages();
  const auto all = painters();
  Scene scene = spheres(20, Cull::none);
  scene.draws.resize(1);
  scene.draws[0].transforms = {Translate{{-1, -0.5, 0}}, Scale{{0.3, 0.3, 0.3}}};
  scene.frame.clear_color = {0.2f, 0.4f, 0.6f, 0.8f};
  scene.frame.clear_depth = 0.75f;
  for (int width = 120; width <= 145; ++width) {
    scene.frame.width = width;
    const Frame definition = render(scene, stages);
    for (const auto& [name, painter] : all) {
      const Frame& frame = painter->draw(scene);
      EXPECT_TRUE(same_bits(frame, definition)) << name << " " << width;
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(frame.color_rgba8.row(0)) % 64, 0u);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(frame.depth_code.row(0)) % 64, 0u);
    }
  }
}

TEST(Painter, TellsOneStepOfDepth) {
  const Scene scene = suite_scene("coverage/shared_edges");
  Frame other = render(scene, production_stages());
  EXPECT_TRUE(same_bits(render(scene), other));
  other.depth_code(3, 3) ^= 1;
  EXPECT_FALSE(same_bits(render(scene), other));
}

}  // namespace
}  // namespace plumbline::pipeline
