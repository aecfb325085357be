// The frame buffer in numbers: exam questions with known answers, and what our frames really take.
#include "scene/frame_buffer.h"

#include <gtest/gtest.h>

#include "pipeline/frame.h"

namespace plumbline {
namespace {

TEST(FrameBuffer, SizeIsResolutionTimesPixelDepth) {
  EXPECT_EQ(buffer_bytes(1024, 768, 3), 2359296u) << "2.25 MiB";
  EXPECT_EQ(buffer_bytes(640, 480, 1), 307200u) << "VGA, 256 colours";
  EXPECT_EQ(buffer_bytes(1280, 1024, 4), 5242880u) << "5 MiB";
  EXPECT_EQ(buffer_bytes(1920, 1080, 3), 6220800u);
  EXPECT_EQ(buffer_bytes(16384, 16384, 20), 5368709120u) << "beyond 32 bits";
}

template <class T>
std::size_t bytes(const Plane<T>& plane) {
  return plane.size() * sizeof(T);
}

TEST(FrameBuffer, IsWhatAFrameTakes) {
  for (const ColorFormat color : {ColorFormat::rgba8, ColorFormat::rgba12, ColorFormat::rgba16, ColorFormat::rgba32f}) {
    for (const DepthFormat depth : {DepthFormat::z8, DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
      const FrameFormat format{13, 7, color, depth, glm::vec4(0), 1};
      const pipeline::Frame f(format);
      EXPECT_EQ(buffer_bytes(format), bytes(f.color_rgba8) + bytes(f.color_rgba16) + bytes(f.color_rgba32f) +
                                          bytes(f.depth_code) + bytes(f.depth_z32f));
    }
  }
  EXPECT_EQ(pixel_bytes({1, 1, ColorFormat::rgba12, DepthFormat::z24, glm::vec4(0), 1}), 12u)
      << "as GzRender's pixel: four shorts and an int";
}

}  // namespace
}  // namespace plumbline
