// Every SIMD target's tiles are those of the definition (render.h), whatever the triangles; and none leaves code behind
// that others would run.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <utility>

#include "kernels/coverage.h"
#include "painter/painter.h"
#include "tests/pipeline/window_frame.h"

namespace plumbline::pipeline {
namespace {

using Triangles = std::vector<ShadedTriangle>;

FrameFormat format_of(int width, int height) {
  FrameFormat format;
  format.width = width;
  format.height = height;
  return format;
}

ShadedTriangle triangle(const std::array<glm::vec3, 3>& p_win, const std::array<float, 3>& inv_w) {
  ShadedTriangle t{};
  for (std::size_t k = 0; k < 3; ++k) {
    t.v[k].p_win = p_win[k];
    t.v[k].inv_w = inv_w[k];
    t.attributes[k].color() = {0.5f * static_cast<float>(k), 1, 0.25f, 0.5f};
    t.v[k].snapped = {snap(p_win[k].x), snap(p_win[k].y)};
  }
  t.front = snapped_area(t) > 0;
  return t;
}

Frame by_definition(const Triangles& triangles, const Draw& draw, const FrameFormat& format) {
  const std::uint32_t first[] = {0, static_cast<std::uint32_t>(triangles.size())};
  return test::frame_of(triangles, first, std::span(&draw, 1), format);
}

// `any_long_edge`: else the triangles may be painted from the last to the first.
Frame by_target(const SimdTarget& target, const Triangles& triangles, const Draw& draw, PaintKernel kernel,
                const FrameFormat& format, bool any_long_edge = true) {
  Painting painting{};
  painting.format = format;
  painting.formats = formats_of(format);
  painting.samples = std::span<const glm::ivec2>(&painting.formats.sample, 1);
  painting.columns = (format.width + kTile - 1) / kTile;
  painting.rows = (format.height + kTile - 1) / kTile;
  painting.any_long_edge = any_long_edge;
  const auto tiles = static_cast<std::size_t>(painting.columns * painting.rows);
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::vector<PaintVertex> vertices;
  std::vector<glm::ivec2> snapped;
  std::array<Chunk, 1> chunk;
  PaintTriangle* of_chunk = room_for(count, chunk[0].triangles);
  std::uint32_t* numbers = room_for(count * tiles, chunk[0].numbers);
  for (std::uint32_t i = 0; i < count; ++i) {
    of_chunk[i] = {{3 * i, 3 * i + 1, 3 * i + 2}, triangles[i].front, 3, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      const WindowVertex& v = triangles[i].v[k];
      vertices.push_back({v.p_win, v.inv_w, triangles[i].attributes[k].color()});
      snapped.push_back(v.snapped);
    }
    for (std::size_t t = 0; t < tiles; ++t) numbers[t * count + i] = i;
  }
  for (std::size_t t = 0; t <= tiles; ++t) chunk[0].first.push_back(static_cast<std::uint32_t>(t * count));
  chunk[0].draws = {{0, count}};
  const PaintDraw draws[] = {{&draw, depth_state(draw, format.depth, false), nullptr, kernel}};
  painting.vertices = vertices.data(), painting.snapped = snapped.data();
  painting.chunks = chunk;
  painting.draws = draws;
  Frame frame(format);
  const auto memory = std::make_unique<TileMemory>();
  TileCounter counter(static_cast<int>(tiles), 1);
  target.tiles(painting, counter, *memory, frame);
  return frame;
}

// Every kernel that may paint them, of every target.
void expect_same(const Triangles& triangles, const FrameFormat& format, const std::string& what,
                 bool any_long_edge = true) {
  Draw draw, over, depth_only;
  over.merge.blend = kOver;
  depth_only.merge.color_mask = glm::bvec4(false);
  for (const SimdTarget& target : simd_targets()) {
    for (const PaintKernel kernel : {PaintKernel::any, PaintKernel::replaces}) {
      const Frame frame = by_target(target, triangles, draw, kernel, format, any_long_edge);
      const Frame definition = by_definition(triangles, draw, format);
      EXPECT_TRUE(frame.color_rgba8.values() == definition.color_rgba8.values()) << target.name << ", " << what;
      EXPECT_TRUE(frame.depth_code.values() == definition.depth_code.values()) << target.name << ", " << what;
    }
    for (const PaintKernel kernel : {PaintKernel::any, PaintKernel::depth_only}) {
      const Frame frame = by_target(target, triangles, depth_only, kernel, format);
      const Frame definition = by_definition(triangles, depth_only, format);
      EXPECT_TRUE(frame.color_rgba8.values() == definition.color_rgba8.values()) << target.name << ", " << what;
      EXPECT_TRUE(frame.depth_code.values() == definition.depth_code.values()) << target.name << ", " << what;
    }
    for (const PaintKernel kernel : {PaintKernel::any, PaintKernel::blends_over}) {
      const Frame frame = by_target(target, triangles, over, kernel, format);
      const Frame definition = by_definition(triangles, over, format);
      EXPECT_TRUE(frame.color_rgba8.values() == definition.color_rgba8.values()) << target.name << ", " << what;
    }
  }
}

// Corners as far away as stage 4 lets them be (geometry.h), where an edge's steps do not fit 32 bits.
TEST(SimdTargets, PaintTrianglesOfFarCorners) {
  constexpr float far = 1 << 20;
  const std::array<glm::vec3, 3> corners[] = {{{{-far, 3, 0}, {far, 70, .25f}, {60, far, .5f}}},
                                              {{{far, -far, 0}, {far, far, .25f}, {64.5f, 64.25f, .5f}}},
                                              {{{-far, -far, 0}, {far, 128, .25f}, {-far, far, .5f}}},
                                              {{{0.5f, -far, 0}, {130, far, .25f}, {-20, far, .5f}}}};
  for (const auto& c : corners) {
    const Triangles one = {triangle(c, {1, 1, 1})};
    const Frame definition = by_definition(one, {}, format_of(130, 130)),
                clear = by_definition({}, {}, format_of(130, 130));
    EXPECT_FALSE(definition.depth_code.values() == clear.depth_code.values()) << "it covers pixels";
    expect_same(one, format_of(130, 130), "far");
  }
}

// Large ones, slivers and those smaller than a pixel, over each other; of one colour, of one alpha, of neither; their
// depths all nearer than the clear depth, and not.
TEST(SimdTargets, PaintRandomTriangles) {
  std::mt19937 random(8);
  const auto between = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  for (const float size : {0.7f, 2.5f, 6.0f, 20.0f, 90.0f, 3000.0f}) {
    for (const bool sliver : {false, true}) {
      Triangles triangles;
      for (int i = 0; i < 150; ++i) {
        const glm::vec2 at(between(-10, 150), between(-10, 80)), along(between(-size, size), between(-size, size));
        const float beyond = i % 2 == 0 ? 0.0f : 0.2f;
        const auto corner = [&](float k) {
          const glm::vec2 p = sliver ? at + k * along + glm::vec2(between(-.01f, .01f), between(-.01f, .01f))
                                     : at + glm::vec2(between(-size, size), between(-size, size));
          return glm::vec3(p, between(-beyond, 1 + beyond));
        };
        ShadedTriangle t =
            triangle({corner(0), corner(.4f), corner(1)}, {between(.1f, 2), between(.1f, 2), between(.1f, 2)});
        if (i % 3 == 1) t.attributes[1 + static_cast<std::size_t>(i % 2)].color().a = between(0, 1);
        if (i % 5 == 1) t.attributes[1] = t.attributes[2] = t.attributes[0];
        if (i % 7 == 1) t.v[2].inv_w = 1e-6f;
        if (snapped_area(t) != 0) triangles.push_back(t);
      }
      FrameFormat format = format_of(140, 70);
      for (const float clear : {1.0f, 0.4f}) {
        format.clear_depth = clear;
        for (std::size_t i = 0; i < triangles.size(); i += 11) {  // as far as the clear depth
          for (auto& v : triangles[i].v) v.p_win.z = clear;
        }
        const std::string what = std::to_string(size) + (sliver ? ", slivers" : "");
        expect_same(triangles, format, what, size > 1000);
        std::reverse(triangles.begin(), triangles.end());
        expect_same(triangles, format, what, size > 1000);
      }
    }
  }
}

// Kept triangles, by the definition's area and bounds (geometry.h, coverage.h): all sizes that fit a frame, some of no
// area; seen from the centre, and from all samples.
TEST(SimdTargets, TellWhatOfATriangleIsDrawn) {
  std::mt19937 random(9);
  std::vector<glm::uvec3> corners(501);
  std::vector<glm::ivec2> snapped(300);
  const auto any = [&](std::uint32_t of) { return static_cast<std::uint32_t>(random() % of); };
  for (const float size : {1.0f, 70.0f, 3000.0f, 8192.0f}) {
    std::uniform_real_distribution<float> place(-size, size);
    for (glm::ivec2& s : snapped) {
      const float x = 64 + place(random), y = 64 + (any(5) == 0 ? 0.5f : place(random));
      s = {snap(x), snap(y)};
    }
    for (auto& c : corners) c = {any(300), any(300), any(9) == 0 ? c[1] : any(300)};
    for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
      for (const bool sampled : {false, true}) {
        const glm::ivec2 least(sampled ? -96 : 0), most(sampled ? 96 : 0), samples[] = {least, most};
        Draw draw;
        draw.cull = cull;
        Painting painting{};
        painting.format.width = 700, painting.format.height = 300;
        painting.samples = samples;
        painting.snapped = snapped.data();
        for (const SimdTarget& target : simd_targets()) {
          std::vector<KeptTriangle> known(corners.size());
          target.cull(painting, {&draw, nullptr, {}, 0, nullptr, 0}, corners, known.data());
          for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::uvec3 c = corners[i];
            WindowTriangle t;
            for (std::size_t k = 0; k < 3; ++k) t.v[k].snapped = snapped[c[static_cast<int>(k)]];
            const std::int64_t area = snapped_area(t);
            const PixelBounds low = pixel_bounds(as_seen_from(t, most)), high = pixel_bounds(as_seen_from(t, least));
            const int x0 = std::max(low.x0, 0), x1 = std::min(high.x1, 700) - 1;
            const int y0 = std::max(low.y0, 0), y1 = std::min(high.y1, 300) - 1;
            const bool drawn = area != 0 && cull != (area > 0 ? Cull::front : Cull::back) && x0 <= x1 && y0 <= y1;
            const Kept kept = !drawn ? Kept::none : area > 0 ? Kept::front : Kept::back;
            ASSERT_EQ(known[i].kept, kept) << target.name << ", " << i << " of " << size;
            if (!drawn) continue;
            const TileBox box = known[i].box;
            ASSERT_TRUE(box.x0 == x0 / 64 && box.y0 == y0 / 64 && box.x1 == x1 / 64 && box.y1 == y1 / 64)
                << target.name;
          }
        }
      }
    }
  }
}

TEST(SimdTargets, BeginWithFloat) { EXPECT_EQ(simd_targets()[0].name, "float"); }

// Symbols that the linker may merge bear their own target's name.
TEST(SimdTargets, NoneOfTheirFunctionsAreSharedWithOtherCode) {
  const std::pair<std::string, std::string> objects[] = {
      {"sse4", PLUMBLINE_OBJECT_sse4}, {"avx2", PLUMBLINE_OBJECT_avx2}, {"avx512", PLUMBLINE_OBJECT_avx512}};
  for (const auto& [target, object] : objects) {
    int functions = 0;
    FILE* nm = popen(("nm --defined-only --extern-only --format=posix '" + object + "'").c_str(), "r");
    ASSERT_NE(nm, nullptr);
    std::array<char, 65536> line;
    while (std::fgets(line.data(), line.size(), nm) != nullptr) {
      const std::string symbol = line.data();
      EXPECT_NE(symbol.find(target), std::string::npos) << symbol;
      ++functions;
    }
    EXPECT_EQ(pclose(nm), 0) << object;
    EXPECT_GE(functions, 1) << object;
  }
}

}  // namespace
}  // namespace plumbline::pipeline
