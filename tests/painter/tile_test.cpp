// A tile's blocks, and the way from them into the frame.
#include "painter/tile.h"

#include <gtest/gtest.h>

#include <thread>

#include "painter/painting.h"

namespace plumbline::pipeline {
namespace {

FrameFormat format_of_size(int width, int height, ColorFormat color, DepthFormat depth) {
  FrameFormat f;
  f.width = width;
  f.height = height;
  f.color = color;
  f.depth = depth;
  return f;
}

const std::pair<int, int> kTileSizes[] = {{1, 1}, {3, 2}, {64, 64}, {65, 63}, {70, 130}, {130, 5}, {128, 1}};

TEST(PainterTile, WriteOutPutsEachPixelInItsPlace) {
  for (const auto& [width, height] : kTileSizes) {
    for (const bool small : {false, true}) {
      const FrameFormat f = small ? format_of_size(width, height, ColorFormat::rgba8, DepthFormat::z24)
                                  : format_of_size(width, height, ColorFormat::rgba32f, DepthFormat::z32f);
      Frame frame(f);
      Tile tile{};
      for (tile.y0 = 0; tile.y0 < height; tile.y0 += kTile) {
        for (tile.x0 = 0; tile.x0 < width; tile.x0 += kTile) {
          // Block by block, as the header says: a block's 16 pixels together, row by row.
          for (int i = 0; i < kTile * kTile; ++i) {
            const int block = i / kBlockPixels, in_block = i % kBlockPixels, blocks = kTile / kBlock;
            const int x = tile.x0 + block % blocks * kBlock + in_block % kBlock;
            const int y = tile.y0 + block / blocks * kBlock + in_block / kBlock;
            tile.depth[i] = static_cast<float>(x + 1000 * y);
            const int channels[] = {x, y, x ^ y, x + y};
            for (int k = 0; k < 4; ++k) tile.color[k][i] = static_cast<float>(channels[k]);
          }
          write_out(tile, frame);
        }
      }
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const auto code = static_cast<std::uint32_t>(x + 1000 * y);
          if (small) {
            ASSERT_EQ(frame.color_rgba8(x, y), glm::u8vec4(x, y, x ^ y, x + y));
            ASSERT_EQ(frame.depth_code(x, y), code);
          } else {
            ASSERT_EQ(frame.color_rgba32f(x, y), glm::vec4(x, y, x ^ y, x + y));
            ASSERT_EQ(frame.depth_z32f(x, y), static_cast<float>(code));
          }
        }
      }
    }
  }
}

TEST(TileCounter, DealsOutEachTileOnceInFewClaims) {
  for (const int threads : {1, 2, 7, 256}) {
    for (const int count : {0, 1, 15, 256, 4096}) {
      TileCounter counter(count, threads);
      int next = 0, claims = 0;
      for (TileCounter::Range of = counter.claim(); of.begin < of.end; of = counter.claim(), ++claims) {
        EXPECT_EQ(of.begin, next);
        EXPECT_LE(of.end - of.begin, count / (4 * threads) + 1);
        next = of.end;
      }
      EXPECT_EQ(next, count);
      // Down to one tile each after 4 threads ln(count / (4 threads)) claims.
      if (threads == 1 && count == 4096) {
        EXPECT_LT(claims, 40);
      }
    }
  }
}

TEST(TileCounter, ThreadsShareAllTiles) {
  constexpr int kCount = 100'000;
  TileCounter counter(kCount, 4);
  std::vector<std::atomic<int>> times(kCount);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (TileCounter::Range of = counter.claim(); of.begin < of.end; of = counter.claim()) {
        for (int tile = of.begin; tile < of.end; ++tile) ++times[static_cast<std::size_t>(tile)];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::atomic<int>& of_tile : times) ASSERT_EQ(of_tile, 1);
}

}  // namespace
}  // namespace plumbline::pipeline
