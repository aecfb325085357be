// The painter draws what the stages' functions draw, bit for bit: by every SIMD target, on any number of threads; and
// in memory that is kept.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <new>
#include <random>
#include <tuple>

#include "../extent.h"
#include "pipeline/painter.h"
#include "pipeline/render.h"
#include "scene/antialias.h"
#include "scene/mesh_shapes.h"
#include "scene/scene_file.h"
#include "scene/texture_images.h"

namespace {
std::atomic<std::size_t> asked_for_memory{0};
thread_local std::size_t asked_by_this_thread = 0;
std::atomic<std::size_t> refused_at{0};  // that many are given before one is not; 0: all are

void* given(void* memory) {
  ++asked_for_memory;
  ++asked_by_this_thread;
  if (refused_at != 0 && --refused_at == 0) {
    std::free(memory);
    throw std::bad_alloc();
  }
  return memory != nullptr ? memory : throw std::bad_alloc();
}
}  // namespace

// Counted, for all of this program. (gtest's own calls as well: the tests look at differences.)
[[gnu::noinline]] void* operator new(std::size_t size) { return given(std::malloc(size == 0 ? 1 : size)); }
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {  // std::stable_sort's
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace plumbline::pipeline {
namespace {

template <class T>
bool same_bits(const Plane<T>& a, const Plane<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)) == 0);
}

bool same_bits(const Frame& a, const Frame& b) {
  return same_bits(a.color_rgba8, b.color_rgba8) && same_bits(a.color_rgba12, b.color_rgba12) &&
         same_bits(a.color_rgba16, b.color_rgba16) && same_bits(a.color_rgba32f, b.color_rgba32f) &&
         same_bits(a.depth_code, b.depth_code) && same_bits(a.depth_z32f, b.depth_z32f) &&
         same_bits(a.stencil, b.stencil);
}

// One for each target, and for some numbers of threads of the widest.
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

// All scenes and all passes of theirs; painters keep their memory from one to the next, whatever its size.
TEST(Painter, DrawsEverySceneAsItsDefinitionDoes) {
  const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
  const std::vector<std::filesystem::path> files = find_scenes(folder);
  const Stages stages = production_stages();
  const auto all = painters();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < files.size(); i += one_of(6)) {
    const Scene scene = load_scene(files[i], {});
    std::vector<Scene> scenes = passes_of(scene);
    if (scene.frame.antialias.kind != Antialias::Kind::none) scenes.push_back(scene);
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

Scene spheres(int slices, Cull cull) {
  Scene scene;
  scene.frame.width = 200;
  scene.frame.height = 136;
  scene.camera.eye = {0, 0, 3};
  scene.meshes.push_back(make_uv_sphere(slices, slices / 2));
  scene.lights.emplace_back();
  for (int i = 0; i < 4; ++i) {
    Draw draw;
    draw.cull = cull;
    draw.transforms = {Translate{{0.3 * i - 0.4, 0, -0.4 * i}}, Rotate{20.0 * i, {1, 0.3, 0}}};
    scene.draws.push_back(draw);
  }
  return scene;
}

// From large triangles to those smaller than pixels; nearer ones first and last.
TEST(Painter, DrawsTrianglesOfAllSizesAsItsDefinitionDoes) {
  const Stages stages = production_stages();
  const auto all = painters();
  for (const int slices : {6, 30, 120}) {
    for (const bool nearest_first : {false, true}) {
      for (const Cull cull : {Cull::none, Cull::back}) {
        Scene scene = spheres(slices, cull);
        if (nearest_first) std::reverse(scene.draws.begin(), scene.draws.end());
        for (const double clear : {1.0, 0.97}) {
          scene.frame.clear_depth = clear;
          scene.frame.antialias = {clear == 1.0 ? Antialias::Kind::none : Antialias::Kind::multisample, 1};
          const Frame definition = render(scene, stages);
          for (const auto& [name, painter] : all) {
            EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name << ", " << slices << " slices";
          }
        }
      }
    }
  }
}

// Steep triangles behind a wall, but for some of a pixel's four samples, in tiles that the wall covers wholly.
TEST(Painter, HidesNoSampleThatIsNearer) {
  constexpr int kSize = 256;
  Scene scene;
  scene.frame.width = scene.frame.height = kSize;
  scene.frame.antialias = {Antialias::Kind::multisample, 1};
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, kSize, 0, kSize, 0, 100};
  std::mt19937 random(6);
  const auto up_to = [&](double most) { return most * 0x1p-32 * static_cast<double>(random()); };
  std::vector<glm::vec3> corners;
  std::vector<glm::uvec3> triangles;
  for (unsigned i = 0; i < 4000; ++i) {
    const double angle = up_to(6.28), slope = 0.01 + up_to(0.5), nearest = up_to(1.5);
    const glm::dvec2 middle(up_to(kSize), up_to(kSize)), toward(std::cos(angle), std::sin(angle));
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 p = middle + glm::dvec2(up_to(12), up_to(12));
      const double behind = slope * (glm::dot(p - middle, toward) + nearest);
      corners.emplace_back(p.x, p.y, -50 - behind);
    }
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  scene.meshes = {make_triangles({{0, 0, -50}, {2 * kSize, 0, -50}, {0, 2 * kSize, -50}}, {{0, 1, 2}}, {}),
                  make_triangles(corners, triangles, {})};
  Draw draw;
  draw.lit = false;
  scene.draws = {draw, draw};
  scene.draws[1].mesh = 1;
  scene.draws[1].material.diffuse = {1, 0, 0, 1};
  const Frame definition = render(scene, production_stages());
  const auto red = [](const glm::u8vec4& c) { return c.r > c.g && c.g > 0; };
  EXPECT_GT(std::ranges::count_if(definition.color_rgba8.values(), red), 100) << "pixels that are partly behind";
  for (const auto& [name, painter] : painters()) {
    EXPECT_TRUE(same_bits(painter->draw(scene), definition)) << name;
  }
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

// The same surface twice: of two fragments as near as each other the first stays, whichever way tiles are painted.
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

TEST(Painter, TellsOneStepOfDepth) {
  const Scene scene = load_scene(PLUMBLINE_SOURCE_DIR "/tests/scenes/coverage/shared_edges.json", {});
  Frame other = render(scene, production_stages());
  EXPECT_TRUE(same_bits(render(scene), other));
  other.depth_code(3, 3) ^= 1;
  EXPECT_FALSE(same_bits(render(scene), other));
}

// How often drawing once more asks for memory. Of a painter of one thread, that thread; else all threads, of which
// those of libraries (TBB's, as they start late) ask now and then, so that the least of some frames is the painter's.
std::size_t asks_again(Painter& painter, const Scene& scene, int threads) {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < (threads == 1 ? 1 : 20) && least > 0; ++i) {
    const std::size_t before = threads == 1 ? asked_by_this_thread : asked_for_memory.load();
    painter.draw(scene);
    least = std::min(least, (threads == 1 ? asked_by_this_thread : asked_for_memory.load()) - before);
  }
  return least;
}

// Antialiased, clipped, lit from two sides, textured: all.
TEST(Painter, AsksForNoMemoryAfterAnyScenesFirstFrame) {
  const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
  const std::vector<std::filesystem::path> files = find_scenes(folder);
  for (const int threads : {1, 2}) {
    Painter painter(threads);
    for (std::size_t i = static_cast<std::size_t>(threads); i < files.size(); i += one_of(6)) {
      const Scene scene = load_scene(files[i], {});
      painter.draw(scene);
      EXPECT_EQ(asks_again(painter, scene, threads), 0u) << files[i] << ", " << threads << " threads";
    }
  }
}

// Whatever there is no memory for, the next scene is drawn right.
TEST(Painter, DrawsOnAfterItWasRefusedMemory) {
  Scene small = spheres(4, Cull::none), large = spheres(5, Cull::back);
  small.frame.width = small.frame.height = 9;
  small.frame.color = ColorFormat::rgba12;
  large.frame.width = large.frame.height = 70;
  large.draws[0].transforms = {Translate{{0, 0, 2}}};  // clipped
  large.light_model.sides = LightModel::Sides::two;
  constexpr Antialias kNone, kTwice = {Antialias::Kind::supersample, 2}, kTaps = {Antialias::Kind::taps, 1};
  for (const auto& [of_one, of_other] : {std::pair(kNone, kTwice), std::pair(kTaps, kTwice), std::pair(kTaps, kTaps)}) {
    small.frame.antialias = of_one, large.frame.antialias = of_other;
    const Frame of_small = render(small, production_stages()), of_large = render(large, production_stages());
    bool any_refused = true;
    std::size_t n = 0;
    while (any_refused) {
      ++n;
      any_refused = false;
      Painter painter;
      for (const auto& [scene, other, definition] :
           {std::tuple(&small, &large, &of_small), std::tuple(&large, &small, &of_large)}) {
        painter.draw(*scene);
        refused_at = n;
        try {
          painter.draw(*other);
        } catch (const std::bad_alloc&) {
          any_refused = true;
        }
        refused_at = 0;
        ASSERT_TRUE(same_bits(painter.draw(*scene), *definition)) << "the " << n << "th";
      }
    }
    EXPECT_GT(n, 10u);
  }
}

TEST(Painter, AsksForNoMemoryAfterTheFirstFrame) {
  for (const int threads : {1, 2}) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      for (const Antialias::Kind kind : {Antialias::Kind::none, Antialias::Kind::multisample}) {
        Scene scene = spheres(60, Cull::back);
        for (Draw& draw : scene.draws) draw.shading = shading;
        scene.draws[1].merge.blend = Blend{};
        Mesh lines = scene.meshes[scene.draws[0].mesh];
        lines.topology = Topology::lines;
        for (glm::uvec3& line : lines.triangles) line[2] = line[1];
        scene.draws.push_back(scene.draws[0]);
        scene.draws.back().mesh = static_cast<std::uint32_t>(scene.meshes.size());
        scene.draws.back().shading = Shading::gouraud;
        scene.meshes.push_back(lines);
        scene.frame.antialias.kind = kind;
        Painter painter(threads);
        painter.draw(scene);
        EXPECT_EQ(asks_again(painter, scene, threads), 0u) << threads << " threads";
        const std::size_t of_another = asked_for_memory;
        scene.frame.width += 70;
        painter.draw(scene);
        EXPECT_GT(asked_for_memory, of_another) << "a larger frame does";
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::pipeline
