// What a renderer that evaluates planes in float from the window's origin, as llvmpipe does, may make of a fragment's
// final colour.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "capture/capture.h"
#include "check/bounds/bounds.h"
#include "check/bounds/shade_bounds.h"
#include "check/bounds/texture_bounds.h"
#include "scene/draw_index.h"
#include "scene/scene.h"

namespace plumbline::check {

/// The candidate's fragments that are drawn, by pixel.
class DrawnAt {
 public:
  DrawnAt(const FrameFormat& frame, const Records<double>& records);
  /// Hidden ones too.
  static DrawnAt covered(const FrameFormat& frame, const Records<double>& records);
  /// Calls visit(number of the fragment) for each of them at (x, y), in draw order.
  template <class Visit>
  void each(int x, int y, Visit visit) const {
    const std::int64_t at = std::int64_t{y} * width_ + x;
    for (auto i = std::ranges::lower_bound(fragments_, at, {}, [&](std::size_t f) { return pixel(f); });
         i != fragments_.end() && pixel(*i) == at; ++i) {
      visit(*i);
    }
  }

 private:
  std::int64_t pixel(std::size_t i) const {
    return std::int64_t{records_.covered[i].y} * width_ + records_.covered[i].x;
  }
  DrawnAt(const FrameFormat& frame, const Records<double>& records, std::vector<std::size_t> fragments);
  int width_;
  const Records<double>& records_;
  std::vector<std::size_t> fragments_;
};

/// Per channel.
struct FragmentBound {
  Vec4<double> color{0};    ///< the reference's own arithmetic; of a draw that is not plain, all; infinite: no bound
  Vec4<double> along{0};    ///< plain line: its colour's shift by the major axis (of_fragment: or by another edge)
  Vec4<double> apart{0};    ///< plain draw: errors of vertex colours, of cuts and of the candidate's interpolation
  std::string_view reason;  ///< why a larger difference is the reference's fault; empty: it is not
};

class FragmentBounds {
 public:
  /// `factor`: of u of the planes' magnitudes (bounds.h, bounds_from_origin).
  FragmentBounds(const Scene& scene, const Capture& candidate, const Capture& reference, double factor);

  /// Of the candidate's fragment number `i`.
  FragmentBound of_fragment(std::size_t i) const;
  /// The primitive's, one of the scene.
  const Draw& draw_of(std::uint32_t primitive) const { return *draws_.draw(primitive); }
  /// Of a fragment's texel; the draw has a texture, and the candidate's legal answers its texels.
  TexelBound texel(std::size_t i) const;
  /// How much of the fragment's pixel is open, by the triangle's planes (texture_bounds.h).
  OpenShare open_texels(std::size_t i) const;
  /// Of the winner at a pixel: the largest over the primitive's triangles, or the last fragment drawn.
  FragmentBound of_winner(std::int32_t primitive, int x, int y) const;

 private:
  /// The largest of a column's values at a primitive's vertices, by their absolute values.
  Vec4<double> largest_of(std::uint32_t primitive, const std::vector<Vec4<double>>& column, bool flat_applies) const;
  bool reaches_behind_eye(std::uint32_t primitive) const;
  FragmentBound surface(std::size_t i) const;
  /// The fragment's triangle, a varying's corners for its colours; none: nothing can be said.
  std::optional<WindowTriangle<double>> as_color(std::size_t i, Varying v) const;
  Vec4<double> varying_error(std::size_t i, Varying v) const;
  /// Error of the corners that cuts make: opengl.clip of the ledger times the largest value at the primitive's
  /// vertices; 0 where the primitive is not cut. On an edge whose ends are 10^6 apart it may exceed the errors of all
  /// later stages.
  Vec4<double> cut_error(std::uint32_t primitive, const std::vector<Vec4<double>>& column) const;
  /// Largest difference of the two sides' colours at the primitive's corners: `times` the difference at its vertices,
  /// and cut_error() of the colours unless the draw is flat.
  Vec4<double> lit_error(std::uint32_t primitive, double times) const;
  /// How far the values of other edges or corners of the fragment's triangle that the pixel may hold (bounds.h,
  /// EdgeValue) are from its own: of the columns' varying, or of the colour.
  Vec4<double> by_other_edges(std::size_t i, const VaryingColumns<double>* columns) const;

  const Scene& scene_;
  const Records<double>& records_;
  const std::vector<TexelRange>& texels_;
  double factor_;
  DrawIndex draws_;
  std::vector<Vec4<double>> lit_;  // per vertex: the larger of both faces' colours
  std::vector<Vec4<double>> lit_apart_, secondary_apart_, eye_apart_, normals_apart_;  // per vertex
  std::vector<bool> plain_;                                                            // per draw
  std::vector<double> texel_arithmetic_;                                               // per texture
  DrawnAt drawn_;
};

}  // namespace plumbline::check
