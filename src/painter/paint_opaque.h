// Stages 5 to 11, in frames of rgba8 and z24, of triangles under depth function less without further tests, whose
// fragments replace the colour, are blended over it, are shaded by a surface, or write depth only (PaintKernel):
// paint_fragments() (fragments.h), its loop-invariant terms hoisted.
#pragma once

#include <array>
#include <bit>
#include <limits>
#include <optional>

#include "painter/paint_pixels.h"
#include "painter/paint_shaded.h"
#include "painter/visit_covered.h"

namespace plumbline::pipeline {

/// Fast-path class of a triangle (LaneTriangles). `nothing`: clamp depth and guard 1/w. `one_color`: depth needs no
/// clamp; the colour is constant, or not computed here. `colors`: neither clamp nor guard; alpha is constant.
enum class Plain { nothing, one_color, colors };

/// Paints one run of filled triangles into one tile.
template <class R, PaintKernel kKernel, int kSamples>
class OpaqueRun {
 public:
  /// `tiles`: one for each sample. `from_last`: triangles are painted from the last to the first, so a fragment
  /// replaces a stored fragment of equal depth (it is earlier in draw order), but never passes at the clear depth.
  OpaqueRun(const Painting& painting, const PaintRun& run, PackedTile* tiles, bool from_last)
      : painting_(painting),
        draw_(painting.draws[run.draw]),
        tiles_(tiles),
        lanes_(painting, run, from_last, tiles[0].x0, tiles[0].y0),
        cleared_(static_cast<float>(painting.clear_code())),
        tie_(from_last ? 1.0f : 0.0f),
        limit_(from_last ? cleared_ : std::numeric_limits<float>::infinity()) {}

  void paint() {
    while (lanes_.next()) {
      lanes_.set_up();
      if (lanes_.all_fit() && paint_together()) continue;
      const unsigned covering = lanes_.all_fit() ? covering_lanes() : ~0u;
      for (int lane = 0; lane < lanes_.count; ++lane) {
        if ((covering >> lane & 1u) == 0) continue;
        if (lanes_.fits(lane)) {
          paint_lane(lane);
        } else {
          each_sample<kSamples>(painting_, tiles_, [&](const Painting& of, PackedTile& tile) {
            paint_alone(of, draw_, lanes_.triangle(lane), tile);
          });
        }
      }
    }
  }

 private:
  static constexpr int kLanes = Lanes<R>::width;
  static constexpr int kSmall = 30;  // pixels of a small box, a bit each of a positive int (visit_pixels)
  static constexpr bool kFromEither = kKernel == PaintKernel::replaces && kSamples == 1;  // from_last may be set
  static constexpr bool kDepthFirst = kKernel == PaintKernel::depth_only || kKernel == PaintKernel::shades;

  // Paints all lanes' triangles at once, where their boxes are small; else paints nothing and returns false.
  bool paint_together() {
    const auto& lanes = lanes_.lanes;
    const int box = std::max(lanes.width, 0) * std::max(lanes.height, 0);
    if (kKernel == PaintKernel::blends_over || box > kSmall) return false;
    if constexpr (kKernel == PaintKernel::shades && kSamples == 1) return box == 0 || shade_small();
    if (kKernel == PaintKernel::shades) return false;
    if (kKernel == PaintKernel::replaces && lanes.in_blocks != 0) return false;
    const bool plain = kSamples == 1 && (lanes.plain_depth & lanes.plain_color) == ~0u >> (32 - kLanes);
    for (int i = 0; i < kSamples && box != 0; ++i) plain ? paint_small<kSamples == 1>(i) : paint_small<false>(i);
    return true;
  }

  // Bit mask of the lanes whose triangles cover a pixel; of all lanes, where boxes are not small.
  unsigned covering_lanes() const {
    const auto& lanes = lanes_.lanes;
    if (lanes.width <= 0 || lanes.height <= 0) return 0;
    if (lanes.width * lanes.height > kSmall) return ~0u;
    Int<R> covered(0);
    for (int i = 0; i < kSamples; ++i) covered = covered | covered_in_boxes(i);
    return ~bits_of(covered == Int<R>(0));
  }

  [[gnu::always_inline]] void paint_lane(int lane) {
    bool hidden = true;
    for (int i = 0; i < kSamples; ++i) hidden &= lanes_.lanes.nearest[lane] >= tiles_[i].farthest_of_all;
    if (hidden) return;
    const PaintTriangle& triangle = lanes_.triangle(lane);
    const LaneSetup<kSamples> s = lanes_.lanes.of(lane, triangle.front, tiles_[0].x0, tiles_[0].y0);
    if constexpr (kKernel == PaintKernel::shades) {
      ShadedPixels<R, kSamples> shaded(painting_, draw_, triangle, s, tiles_);
      paint_plain<Plain::one_color>(s.plain_depth, s, &shaded);
      shaded.finish();
    } else if (kKernel == PaintKernel::depth_only || s.attributes.constant) {
      paint_plain<Plain::one_color>(s.plain_depth, s, nullptr);
    } else if (s.perspective.in_blocks) {
      paint_plain<Plain::colors, true>(s.plain_depth && s.plain_color, s, nullptr);
    } else {
      paint_plain<Plain::colors>(s.plain_depth && s.plain_color, s, nullptr);
    }
  }

  // Paints the triangle by the fast path kPlain where it is `plain`, else without one. Frames of four samples have no
  // fast path: a compiled one took a third of the painter's build time and drew spheres 1.2 times as fast.
  template <Plain kPlain, bool kInBlocks = false>
  [[gnu::always_inline]] void paint_plain(bool plain, const LaneSetup<kSamples>& s, ShadedPixels<R, kSamples>* shaded) {
    if constexpr (kSamples == 1) {
      if (plain) return paint_triangle<kPlain, kInBlocks>(s, shaded);
    }
    paint_triangle<Plain::nothing, kInBlocks>(s, shaded);
  }

  // Paints a lane's triangle block by block. `shaded`: collects the pixels of PaintKernel::shades, else null.
  // `kInBlocks`: PerspectiveSetup::in_blocks.
  template <Plain kPlain, bool kInBlocks = false>
  [[gnu::always_inline]] void paint_triangle(const LaneSetup<kSamples>& s,
                                             [[maybe_unused]] ShadedPixels<R, kSamples>* shaded) {
    using W = Wide<R>;
    constexpr bool kColors = !kDepthFirst && kPlain != Plain::one_color;
    const Color<R> one_color(s.attributes.value0);
    const Int<R> one_code = packed_merge(one_color);

    const Affine<double>* const weight_plane[3] = {&s.perspective.q1, &s.perspective.q2, &s.perspective.sum};
    constexpr int kPlanes = kSamples + (kColors && !kInBlocks ? 3 : 0);  // the samples' depths, and the weights
    const Affine<double>* plane[kSamples + 3];
    for (int i = 0; i < kSamples; ++i) plane[i] = &s.code[i];
    std::ranges::copy(weight_plane, plane + kSamples);

    [[maybe_unused]] const R tie(tie_), limit(limit_);
    bool hidden = true;
    const auto nearer_blocks = [&](int y) {
      unsigned nearer = 0;
      for (int b = 0; b < kTile / kBlock; b += kLanes) {
        Mask<R> some = Lanes<R>::mask_of(0);
        for (int i = 0; i < kSamples; ++i) {
          some = some | (Lanes<R>::load(tiles_[i].farthest + y / kBlock * (kTile / kBlock) + b) > R(s.nearest));
        }
        nearer |= bits_of(some) << b;
      }
      hidden &= nearer == 0;
      return nearer;
    };
    W of_row[kPlanes][kParts<R>];
    int row_y = -1;
    const auto go_to_row = [&](int y) {
      if (y == row_y) return;
      row_y = y;
      for (int part = 0; part < kParts<R>; ++part) {
        const W dy = Lanes<R>::rows_of_block(y, part * kLanes);
        for (int k = 0; k < kPlanes; ++k) of_row[k][part] = plane[k]->at_0 + dy * plane[k]->y;
      }
    };
    R in_block[3][kParts<R>];  // added_in_block() of the weights' planes
    for (int k = 0; k < 3 && kColors && kInBlocks; ++k) {
      for (int part = 0; part < kParts<R>; ++part) {
        const auto of_part = [&](const auto& table) { return to_float(Lanes<R>::load(table + part * kLanes)); };
        in_block[k][part] = added_in_block(*weight_plane[k], of_part(kColumnInBlock), of_part(kRowInBlock));
      }
    }
    // Per block of a group: the weights' planes at its first pixel; and, if it is whole, an upper bound of its depth
    // codes: the plane's value at the farthest corner, plus one code for rounding.
    alignas(64) float weight_ahead[3][kLanes], farthest_ahead[kLanes];
    const auto ahead = [&](int x, int y, const BlockGroup<R>& group, bool any_whole) {
      if constexpr (kColors && kInBlocks) {
        const Offset<R> first{to_wide(group.x() + Int<R>(x)), to_wide(group.y() + Int<R>(y))};
        for (int k = 0; k < 3; ++k) store(to_float(value_at<R>(*weight_plane[k], first)), weight_ahead[k]);
      }
      if (!any_whole) return;
      const Affine<double>& code = s.code[0];
      const double corner =
          code.at_0 + (code.y > 0 ? y + (kBlock - 1) : y) * code.y + ((code.x > 0 ? x + (kBlock - 1) : x) * code.x + 1);
      const W codes = W(corner) + to_wide(group.x()) * W(code.x) + to_wide(group.y()) * W(code.y);
      store(to_float(round_even(clamped(codes, W(0), W(kMostZ24)))), farthest_ahead);
    };
    PackedTile* const tiles = tiles_;  // a local: the compiler would reload a member after each store
    const auto block = [&](int x, int y, int lane, const Mask<R>(&covered)[kSamples][kParts<R>], auto whole) {
      constexpr bool kWhole = decltype(whole)::value;
      go_to_row(y);
      const int place = block_offset(x, y);  // 16 a block
      W of_column[kPlanes];
      for (int k = kSamples - 1; k < kPlanes; ++k) of_column[k] = Lanes<R>::columns_of_block(x, 0) * plane[k]->x;
      const auto value = [&](int k, int part) {  // value_at(); all depths have the same slopes
        const int slope = k < kSamples ? kSamples - 1 : k;
        return of_row[k][part] + of_column[slope];
      };
      std::array<Mask<R>, kSamples> kept[kParts<R>];
      Mask<R> some = Lanes<R>::mask_of(0), full[kSamples];
      R farthest[kSamples];
      for (int i = 0; i < kSamples; ++i) {
        full[i] = Lanes<R>::mask_of(~0u), farthest[i] = R(0);
        for (int part = 0; part < kParts<R>; ++part) {
          R z;
          if constexpr (kPlain == Plain::nothing) {
            z = to_float(round_even(clamped(value(i, part), W(0), W(kMostZ24))));
          } else {
            z = to_float(nearest_int(value(i, part)));
          }
          float* const to = tiles[i].depth + place + part * kLanes;
          const R held = Lanes<R>::load(to);
          Mask<R>& here = kept[part][static_cast<std::size_t>(i)];
          here = kFromEither ? z < held + tie : z < held;
          if constexpr (!kWhole) here = covered[i][part] & here;
          if constexpr (kFromEither && kPlain == Plain::nothing) here = here & (z < limit);
          some = some | here;
          full[i] = full[i] & here;
          if constexpr (kSamples > 1) farthest[i] = greater_of(farthest[i], z);
          store(here, z, to);
        }
      }
      if (!any(some)) return;
      for (int part = 0; part < kParts<R>; ++part) {
        if constexpr (kKernel == PaintKernel::shades) shaded->add(place + part * kLanes, kept[part]);
        if constexpr (!kDepthFirst) {
          const auto color = [&]() -> Color<R> {
            if constexpr (!kColors) return one_color;
            const auto weight = [&](int k) -> R {
              if constexpr (kInBlocks) return R(weight_ahead[k][lane]) + in_block[k][part];
              return to_float(value(kSamples + k, part));
            };
            const R q1 = weight(0), q2 = weight(1), sum = weight(2);
            if constexpr (kPlain == Plain::nothing) return mean<R>(s.attributes, weights<R>(q1, q2, sum));
            return plain_color(s.attributes, q1, q2, sum, one_color.a);
          };
          const auto store_each = [&](auto codes) {
            for (int i = 0; i < kSamples; ++i) {
              std::uint32_t* const to = tiles[i].color + place + part * kLanes;
              store_packed(kept[part][static_cast<std::size_t>(i)], codes(to), to);
            }
          };
          if constexpr (kKernel == PaintKernel::blends_over) {
            const Color<R> over = color();
            store_each([&](const std::uint32_t* held) { return packed_over<R>(over, Lanes<R>::load(held)); });
          } else {
            const auto merged = [&] {
              if constexpr (kPlain == Plain::one_color) return one_code;
              if constexpr (kPlain == Plain::colors) return packed_merge_near(color());
              return packed_merge(color());
            };
            const Int<R> codes = merged();
            store_each([&](const std::uint32_t*) { return codes; });
          }
        }
      }
      if constexpr (kSamples == 1 && !kWhole) return;
      for (int i = 0; i < kSamples; ++i) {
        if (!all(full[i])) continue;
        tiles[i].farthest[place >> 4] = kWhole ? farthest_ahead[lane] : greatest_lane(farthest[i]);
      }
    };
    visit_covered<R, kSamples>(s, nearer_blocks, ahead, block);
    const bool all_blocks = s.x0 == 0 && s.y0 == 0 && s.x1 == kTile && s.y1 == kTile;
    // Depth that hides the tile: paint_lane() rejects triangles behind it.
    for (int i = 0; i < kSamples && hidden && all_blocks; ++i) {
      tiles_[i].farthest_of_all = *std::ranges::max_element(tiles_[i].farthest);
    }
  }

  // Pixels that each lane's triangle covers: one bit each, row by row, of a box of lanes.width x lanes.height pixels.
  Int<R> covered_in_boxes(int sample) const {
    const auto& lanes = lanes_.lanes;
    using I = Int<R>;
    const I x0 = Lanes<R>::load(lanes.bounds[0]), y0 = Lanes<R>::load(lanes.bounds[1]);
    const I columns = Lanes<R>::load(lanes.bounds[2]) - x0, rows = Lanes<R>::load(lanes.bounds[3]) - y0;
    const Mask<R> wanted = Lanes<R>::load(kBlockNumbers) < I(lanes_.count);
    I e_of_row[3], step_x[3], step_y[3];
    for (int k = 0; k < 3; ++k) {
      step_x[k] = Lanes<R>::load(lanes.step_x[k]), step_y[k] = Lanes<R>::load(lanes.step_y[k]);
      e_of_row[k] = Lanes<R>::load(lanes.at_sample[sample][k]) + step_x[k] * x0 + step_y[k] * y0;
    }
    I covered(0);
    for (int row = 0, bit = 0; row < lanes.height; ++row) {
      const Mask<R> in_row = wanted & (I(row) < rows);
      I e[3] = {e_of_row[0], e_of_row[1], e_of_row[2]};
      for (int column = 0; column < lanes.width; ++column, ++bit) {
        const Mask<R> inside = in_row & (I(column) < columns) & ((e[0] & e[1] & e[2]) < I(0));
        covered = covered | select(inside, I(1 << bit), I(0));
        for (int k = 0; k < 3; ++k) e[k] = e[k] + step_x[k];
      }
      for (int k = 0; k < 3; ++k) e_of_row[k] = e_of_row[k] + step_y[k];
    }
    return covered;
  }

  // Calls visit(i, x, y, mask) for i from 0 to most - 1: (x, y) is each lane's i-th covered pixel, `mask` the lanes
  // that have one.
  void visit_pixels(Int<R> covered, int most, auto visit) const {
    using I = Int<R>;
    const auto& lanes = lanes_.lanes;
    const I x0 = Lanes<R>::load(lanes.bounds[0]), y0 = Lanes<R>::load(lanes.bounds[1]);
    const I width(lanes.width), per_width((1 << 16) / lanes.width + 1);
    for (int i = 0; i < most; ++i) {
      const I rest = covered & (covered - I(1)), lowest = covered ^ rest;
      const I bit = shifted_right<23>(as_int(to_float(lowest))) - I(127);  // a float's exponent
      const I row = shifted_right<16>(bit * per_width);
      visit(i, x0 + (bit - row * width), y0 + row, lowest != I(0));
      covered = rest;
    }
  }

  // Number of covered pixels of each lane, and the greatest.
  struct Counts {
    explicit Counts(const Int<R>& covered) {
      alignas(64) std::int32_t covered_of[kLanes];
      store(covered, covered_of);
      for (int lane = 0; lane < kLanes; ++lane) {
        of[lane] = std::popcount(static_cast<unsigned>(covered_of[lane]));
        most = std::max(most, of[lane]);
      }
    }
    int of[kLanes], most = 0;
  };

  // Paints triangles of small boxes, one pixel of each lane at a time (paint_pixels.h).
  template <bool kPlain>
  void paint_small(int sample) {
    const Int<R> covered = covered_in_boxes(sample);
    const Counts counts(covered);
    constexpr PixelColors kColors = kKernel == PaintKernel::replaces ? PixelColors::own : PixelColors::none;
    PixelsOfLanes<R, kColors, kPlain, kSmall> values(lanes_.lanes, sample);
    visit_pixels(covered, counts.most,
                 [&](int i, const Int<R>& x, const Int<R>& y, const Mask<R>&) { values.work_out(i, x, y); });
    for (int lane = 0; lane < lanes_.count; ++lane) {
      values.paint(lane, counts.of[lane], tie_ != 0, cleared_, tiles_[sample]);
    }
  }

  // paint_small() with colours of the surface. Returns false and paints nothing where shading triangle by triangle
  // takes fewer calls, or where light has two sides and the triangles' faces differ.
  bool shade_small() {
    const Int<R> covered = covered_in_boxes(0);
    const Counts counts(covered);
    int alone = 0, front = 0;  // calls of shade() triangle by triangle; number of front faces
    for (int lane = 0; lane < lanes_.count; ++lane) {
      alone += (counts.of[lane] + kLanes - 1) / kLanes;
      front += lanes_.triangle(lane).front ? 1 : 0;
    }
    const Surface& surface_of_draw = *draw_.surface;
    const bool by_face = surface_of_draw.light && surface_of_draw.scene->light_model.sides == LightModel::Sides::two;
    if (counts.most > alone || (by_face && front != 0 && front != lanes_.count)) return false;
    PixelsOfLanes<R, PixelColors::given, false, kSmall> values(lanes_.lanes, 0);
    std::optional<SurfaceLanes<R>> surface;
    visit_pixels(covered, counts.most, [&](int i, const Int<R>& x, const Int<R>& y, const Mask<R>& wanted) {
      values.work_out(i, x, y);
      if (!values.any_nearer(i, bits_of(wanted), tiles_[0])) return;
      if (!surface) surface.emplace(painting_, draw_, lanes_.corner, lanes_.lanes, front != 0);
      values.set_codes(i, surface->codes({to_wide(x), to_wide(y)}, wanted));
    });
    for (int lane = 0; lane < lanes_.count; ++lane) values.paint(lane, counts.of[lane], false, cleared_, tiles_[0]);
    return true;
  }

  const Painting& painting_;
  const PaintDraw& draw_;
  PackedTile* tiles_;
  LanesOfRun<R, kSamples> lanes_;
  const float cleared_, tie_, limit_;
};

}  // namespace plumbline::pipeline
