// Every SIMD target draws what float draws, bit for bit; and none leaves code behind that others would run.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "../extent.h"
#include "pipeline/draw_simd.h"
#include "pipeline/render.h"
#include "pipeline/window.h"
#include "scene/antialias.h"
#include "scene/scene_file.h"

namespace plumbline::pipeline {
namespace {

template <class T>
bool same_bits(const Plane<T>& a, const Plane<T>& b) {
  return a.size() == b.size() && std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)) == 0;
}

bool same_bits(const Frame& a, const Frame& b) {
  return same_bits(a.color_rgba8, b.color_rgba8) && same_bits(a.color_rgba12, b.color_rgba12) &&
         same_bits(a.color_rgba16, b.color_rgba16) && same_bits(a.color_rgba32f, b.color_rgba32f) &&
         same_bits(a.depth_code, b.depth_code) && same_bits(a.depth_z32f, b.depth_z32f) &&
         same_bits(a.stencil, b.stencil);
}

Frame drawn(const Scene& scene, const SimdTarget& target) {
  const Geometry geometry = run_geometry(scene, geometry_stages());
  const std::vector<Surface> surfaces = surfaces_of(scene, geometry.records);
  Frame frame(scene.frame);
  draw_frame(target.draw_tile,
             {geometry.records.triangles, geometry.first_triangle, scene.draws, surfaces, scene.depth_clamp},
             scene.frame, frame);
  return frame;
}

TEST(SimdTargets, DrawEverySceneAsFloatDoes) {
  const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
  const std::vector<std::filesystem::path> files = find_scenes(folder);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < files.size(); i += one_of(3)) {
    for (const Scene& pass : passes_of(load_scene(files[i], {}))) {
      const Frame definition = drawn(pass, simd_targets()[0]);
      for (const SimdTarget& target : simd_targets().subspan(1)) {
        EXPECT_TRUE(same_bits(drawn(pass, target), definition)) << target.name << ", " << files[i];
        ++compared;
      }
    }
  }
  std::printf("%zu frames compared, by %zu targets\n", compared, simd_targets().size() - 1);
}

// Corners as far away as stage 4 lets them be (window.h), where an edge's steps do not fit 32 bits.
TEST(SimdTargets, DrawTrianglesOfFarCornersAsFloatDoes) {
  FrameFormat format;
  format.width = format.height = 130;
  const std::vector<Draw> draws(1);
  const float far = 1 << 20;
  const glm::vec2 corners[][3] = {{{-far, 3}, {far, 70}, {60, far}},
                                  {{far, -far}, {far, far}, {64.5f, 64.25f}},
                                  {{-far, -far}, {far, 128}, {-far, far}},
                                  {{0.5f, -far}, {130, far}, {-20, far}}};
  for (const auto& c : corners) {
    WindowTriangle<float> t{};
    for (std::size_t k = 0; k < 3; ++k) {
      t.v[k].p_win = {c[k].x, c[k].y, 0.25f * static_cast<float>(k)};
      t.v[k].inv_w = 1;
      t.v[k].color = {0.5f * static_cast<float>(k), 1, 0.25f, 1};
      t.v[k].snapped = {snap(c[k].x), snap(c[k].y)};
    }
    t.front = snapped_area(t) > 0;
    const std::vector<WindowTriangle<float>> triangles = {t};
    const std::vector<std::uint32_t> first = {0, 1};
    const DrawList list{triangles, first, draws};
    Frame definition(format), clear(format);
    draw_frame(simd_targets()[0].draw_tile, list, format, definition);
    const std::vector<std::uint32_t> none = {0, 0};
    draw_frame(simd_targets()[0].draw_tile, {{}, none, draws}, format, clear);
    EXPECT_FALSE(same_bits(definition, clear)) << "it covers pixels";
    for (const SimdTarget& target : simd_targets().subspan(1)) {
      Frame frame(format);
      draw_frame(target.draw_tile, list, format, frame);
      EXPECT_TRUE(same_bits(frame, definition)) << target.name << ", corner " << c[0].x;
    }
  }
}

TEST(SimdTargets, TheWidestIsWhatDraws) {
  const Scene scene = load_scene(PLUMBLINE_SOURCE_DIR "/tests/scenes/coverage/shared_edges.json", {});
  EXPECT_EQ(simd_targets()[0].name, "float");
  Frame other = drawn(scene, simd_targets()[0]);
  EXPECT_TRUE(same_bits(render(scene), other));
  other.depth_code(3, 3) ^= 1;
  EXPECT_FALSE(same_bits(render(scene), other)) << "one step";
}

// What the linker may put in the place of others of its name is this target's own.
TEST(SimdTargets, NoneOfTheirFunctionsAreSharedWithOtherCode) {
  std::istringstream objects(PLUMBLINE_SIMD_OBJECTS);
  int functions = 0;
  for (std::string object; std::getline(objects, object, ':');) {
    const std::string stem = std::filesystem::path(object).stem(), target = stem.substr(stem.rfind('_') + 1);
    FILE* nm = popen(("nm --defined-only --extern-only --format=posix '" + object + "'").c_str(), "r");
    ASSERT_NE(nm, nullptr);
    std::array<char, 65536> line;
    while (std::fgets(line.data(), line.size(), nm) != nullptr) {
      const std::string symbol = line.data();
      EXPECT_NE(symbol.find(target), std::string::npos) << symbol;
      ++functions;
    }
    EXPECT_EQ(pclose(nm), 0) << object;
  }
  EXPECT_GE(functions, 2);
}

}  // namespace
}  // namespace plumbline::pipeline
