// Error bounds of a fragment's final colour, for a renderer that evaluates planes in float from the window's origin
// (llvmpipe).
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

/// Fragments by pixel, in draw order.
class FragmentsByPixel {
 public:
  /// Drawn fragments; none where the records do not hold `drawn`.
  static FragmentsByPixel drawn(const FrameFormat& frame, const Records<double>& records);
  /// All covered fragments, drawn or not.
  static FragmentsByPixel covered(const FrameFormat& frame, const Records<double>& records);
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
  FragmentsByPixel(const FrameFormat& frame, const Records<double>& records, std::vector<std::size_t> fragments);
  int width_;
  const Records<double>& records_;
  std::vector<std::size_t> fragments_;
};

/// Bounds of the difference between both sides' colours, per channel. Only plain draws have `line_shift` and `apart`.
struct FragmentBound {
  Vec4<double> color{0};  ///< error of the reference's arithmetic (not plain: all errors); infinite: no bound
  /// Shift of a line's colour. of_winner(): PlaneBounds::line_shift_color, signed. of_fragment(): the larger of its
  /// absolute value and of the distance to another edge's colour.
  Vec4<double> line_shift{0};
  Vec4<double> apart{0};    ///< errors of vertex colours, of cuts and of the candidate's interpolation
  std::string_view reason;  ///< the reference's fault that explains a larger difference; empty: none
};

class FragmentBounds {
 public:
  /// `factor`: of u of the planes' magnitudes (bounds.h, bounds_from_origin).
  FragmentBounds(const Scene& scene, const Capture& candidate, const Capture& reference, double factor);

  /// Bound of the candidate's fragment `i` < covered.size() [colour]. Its triangle is recorded, its primitive in the
  /// scene.
  FragmentBound of_fragment(std::size_t i) const;
  /// Draw of the primitive, which the scene must have.
  const Draw& draw_of(std::uint32_t primitive) const { return *draws_.draw(primitive); }
  /// Bound of a fragment's texel; infinite where the candidate's capture has no legal texels. The draw has a texture.
  TexelBound texel(std::size_t i) const;
  /// How much of the fragment's pixel is open, by the triangle's planes (texture_bounds.h).
  OpenShare open_texels(std::size_t i) const;
  /// Bound of the winner at a pixel. Plain draw: the largest over the primitive's triangles. Else: of the primitive's
  /// last fragment drawn there, infinite without one.
  FragmentBound of_winner(std::int32_t primitive, int x, int y) const;

 private:
  /// The largest of a column's values at a primitive's vertices, by their absolute values.
  Vec4<double> largest_of(std::uint32_t primitive, const std::vector<Vec4<double>>& column, bool flat_applies) const;
  bool reaches_behind_eye(std::uint32_t primitive) const;
  FragmentBound surface(std::size_t i) const;
  /// The fragment's triangle with a varying in place of its colours; none: the varying is not recorded.
  std::optional<WindowTriangle<double>> as_color(std::size_t i, Varying v) const;
  Vec4<double> varying_error(std::size_t i, Varying v) const;
  /// Error of corners made by cuts: the ledger's opengl.clip times the largest value at the primitive's vertices; 0
  /// where nothing is cut. On an edge whose ends are 10^6 apart, it may exceed all later stages' errors.
  Vec4<double> cut_error(std::uint32_t primitive, const std::vector<Vec4<double>>& column) const;
  /// Largest difference of the two sides' colours at the primitive's corners: `times` the difference at its vertices,
  /// and cut_error() of the colours unless the draw is flat.
  Vec4<double> lit_error(std::uint32_t primitive, double times) const;
  /// Largest difference between the fragment's value and those of its triangle's other edges or corners at the pixel
  /// (bounds.h, EdgeValue). `columns`: a varying's; null: the colour.
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
  FragmentsByPixel drawn_;
};

}  // namespace plumbline::check
