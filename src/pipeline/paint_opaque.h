// Stages 5 to 11 of triangles whose nearer fragments replace what is there, without further tests, in frames of rgba8
// and z24: what covered_pixels() does (fragment.h), its terms taken out of the loops that they do not change in.
#pragma once

#include "pipeline/visit_covered.h"

namespace plumbline::pipeline {

/// A lane's triangle. `code`: the colour of one that is of one colour.
template <class R, bool kOneColor, bool kFromLast>
[[gnu::always_inline]] inline void paint_opaque_triangle(const LaneSetup<Z24Setup>& s, const Int<R>& code,
                                                         float cleared, PackedTile& tile) {
  using W = Wide<R>;
  constexpr int kLanes = Lanes<R>::width;
  const BarycentricPlanes& planes = s.planes;
  // From last to first, a fragment as near as one that was painted before it comes before it; one as near as the clear
  // depth is none.
  const float tie = kFromLast ? 1.0f : 0.0f;
  W of_row[2][kParts<R>];  // dy l1_y, dy l2_y
  const auto row = [&](int y) {
    for (int part = 0; part < kParts<R>; ++part) {
      const W dy = rows_of_block<R>(y, part * kLanes);
      of_row[0][part] = dy * planes.l1_y;
      of_row[1][part] = dy * planes.l2_y;
    }
    unsigned nearer = 0;
    for (int b = 0; b < kTile / kBlock; b += kLanes) {
      nearer |= bits_of(load<R>(tile.farthest + y / kBlock * (kTile / kBlock) + b) + R(tie) > R(s.nearest)) << b;
    }
    return nearer;
  };
  visit_covered<R>(s, row, [&](int x, int y, const Mask<R>(&covered)[kParts<R>]) {
    R farthest(0);
    bool full = true;
    for (int part = 0; part < kParts<R>; ++part) {
      if (!any(covered[part])) {
        full = false;
        continue;
      }
      const W dx = columns_of_block<R>(x, part * kLanes);
      const StoredCodes to = tile.at(block_offset(x, y) + part * kLanes);
      const W l1 = planes.l1_0 + (dx * planes.l1_x + of_row[0][part]),
              l2 = planes.l2_0 + (dx * planes.l2_x + of_row[1][part]);
      const Barycentric<R> b{1.0 - l1 - l2, l1, l2};
      const R z = depth<R>(s.depth, b), held = load<R>(to.depth);
      Mask<R> kept = covered[part] & (z < held + R(tie));
      if constexpr (kFromLast) kept = kept & (z < R(cleared));
      full = full && all(kept);
      if (!any(kept)) continue;
      farthest = greater_of(farthest, z);
      store(kept, z, to.depth);
      if constexpr (kOneColor) {
        store_packed(kept, code, to.color);
      } else {
        store_packed(kept, packed_merge(attributes<R>(s.attributes, b)), to.color);
      }
    }
    if (full) tile.farthest[y / kBlock * (kTile / kBlock) + x / kBlock] = greatest_lane(farthest);
  });
}

template <class R, bool kFromLast>
void paint_opaque(const Painting& painting, const PaintRun& run, PackedTile& tile, auto alone) {
  const auto cleared = static_cast<float>(depth_code(painting.format.clear_depth, painting.formats.depth_scale));
  each_lane<R>(painting, run, kFromLast, tile.x0, tile.y0, alone,
               [&](const PaintTriangle&, const auto& lanes, int lane) {
                 const auto s = lanes.template of<Z24Setup>(lane);
                 if (s.attributes.constant) {
                   const Vec4<float>& c = s.attributes.color0;
                   const Int<R> code = packed_merge(Color<R>{R(c.r), R(c.g), R(c.b), R(c.a)});
                   paint_opaque_triangle<R, true, kFromLast>(s, code, cleared, tile);
                 } else {
                   paint_opaque_triangle<R, false, kFromLast>(s, Int<R>(0), cleared, tile);
                 }
               });
}

}  // namespace plumbline::pipeline
