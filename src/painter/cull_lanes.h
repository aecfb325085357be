// Stage 4 of filled triangles whose corners are in the view volume, as many at a time as R has lanes: facing, culling,
// and the tiles of their bounding boxes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "painter/assemble.h"

namespace plumbline::pipeline {

template <class R>
void cull_triangles(const Painting& painting, const AssemblyWork& work, std::span<const glm::uvec3> corners,
                    KeptTriangle* to) {
  using I = Int<R>;
  constexpr std::size_t kLanes = Lanes<R>::width;
  const std::size_t count = corners.size();
  const glm::ivec2* const positions = painting.snapped + work.range.first_vertex;
  const auto [low_sample, high_sample] = painting.sample_bounds();
  const auto least = [](const I(&v)[3]) { return lesser_of(lesser_of(v[0], v[1]), v[2]); };
  const auto most = [](const I(&v)[3]) { return greater_of(greater_of(v[0], v[1]), v[2]); };
  glm::uvec3 last[kLanes];  // surplus lanes repeat the last triangle
  for (std::size_t i = 0; i < count; i += kLanes) {
    const glm::uvec3* of_lane = corners.data() + i;
    if (count - i < kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) last[lane] = corners[std::min(i + lane, count - 1)];
      of_lane = last;
    }
    I x[3], y[3];
    for (int k = 0; k < 3; ++k) {
      const auto [of_x, of_y] = Lanes<R>::load_twos([&](int lane) { return &positions[(&of_lane[lane].x)[k]].x; });
      x[k] = of_x, y[k] = of_y;
    }
    const I x_min = least(x), x_max = most(x), y_min = least(y), y_max = most(y);
    // Products of differences up to 2^22 (16384 pixels) are exact in double, and so is their difference.
    const R area = to_float(to_wide(x[1] - x[0]) * to_wide(y[2] - y[0]) - to_wide(y[1] - y[0]) * to_wide(x[2] - x[0]));
    const Mask<R> front = area > R(0), back = area < R(0);
    // The pixels whose centres the box holds (coverage.h, pixel_bounds).
    const auto up = [](I snapped) { return shifted_right<8>(snapped + I(kSubpixel - 1)); };
    const I x0 = greater_of(up(x_min - I(high_sample.x)), I(0)), y0 = greater_of(up(y_min - I(high_sample.y)), I(0));
    const I x1 = lesser_of(shifted_right<8>(x_max - I(low_sample.x)), I(painting.format.width - 1)),
            y1 = lesser_of(shifted_right<8>(y_max - I(low_sample.y)), I(painting.format.height - 1));
    const Mask<R> drawn = (x0 <= x1) & (y0 <= y1);
    I kept(0);
    if (work.draw->cull != Cull::back) kept = select(drawn & back, I(static_cast<int>(Kept::back)), kept);
    if (work.draw->cull != Cull::front) kept = select(drawn & front, I(static_cast<int>(Kept::front)), kept);
    const I low = shifted_right<6>(x0) | shifted_left<8>(shifted_right<6>(y0));
    const I box = low | shifted_left<16>(shifted_right<6>(x1)) | shifted_left<24>(shifted_right<6>(y1));
    alignas(64) std::int32_t results[2 * kLanes];  // in the layout of KeptTriangle
    store_twos(kept, box, results);
    if (count - i >= kLanes) {
      std::memcpy(to + i, results, sizeof(results));
    } else {
      std::memcpy(to + i, results, (count - i) * sizeof(KeptTriangle));
    }
  }
}

}  // namespace plumbline::pipeline
