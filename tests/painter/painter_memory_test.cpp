// The painter keeps its memory from frame to frame, and draws right whatever there was none for.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <tuple>
#include <vector>

#include "painter/painter.h"
#include "pipeline/render.h"
#include "scene/antialias.h"
#include "scene/file/scene_file.h"
#include "tests/extent.h"
#include "tests/painter/painter_frames.h"
#include "tests/suite.h"

namespace {
std::atomic<std::size_t> asked_for_memory{0};
thread_local std::size_t asked_by_this_thread = 0;
std::atomic<std::size_t> refused_at{0};  // the allocation that fails, from 1; 0: none

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

// Allocations of one more frame: by this thread for a painter of one thread, else by all threads. TBB's threads, which
// start late, allocate now and then, so that the least of 20 frames is the painter's.
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
TEST(PainterMemory, IsNotAskedForAfterAnyScenesFirstFrame) {
  const std::vector<std::filesystem::path> files = suite_files();
  for (const int threads : {1, 2}) {
    Painter painter(threads);
    for (std::size_t i = static_cast<std::size_t>(threads) % one_of(6); i < files.size(); i += one_of(6)) {
      const Scene scene = load_scene(files[i], {});
      painter.draw(scene);
      EXPECT_EQ(asks_again(painter, scene, threads), 0u) << files[i] << ", " << threads << " threads";
    }
  }
}

// After any failed allocation, the next scene is drawn right.
TEST(PainterMemory, MayBeRefused) {
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

TEST(PainterMemory, IsNotAskedForAfterTheFirstFrame) {
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
