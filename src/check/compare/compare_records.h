// Comparators of records, stages 0 to 2, 4 to 7, 9 and 10 (3: compare_polygons.h, 8: compare_texels.h). Tolerances are
// proportional to magnitudes of the candidate's records.
#pragma once

#include <span>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "capture/float_depth.h"
#include "capture/stages.h"
#include "check/bounds/bounds.h"
#include "check/compare/legal_window.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Compares matrices with a reference's matrices in float, except the normal matrix, which OpenGL does not hand out.
/// Unit: 1e-12 of the column's largest entry, at least 1e-12.
Measurement compare_rounded_matrices(const Records<double>& candidate, const Records<double>& reference, double factor);
/// Precision in which a renderer inverts the model-view M for its normal matrix N.
enum class Inversion { in_double, in_float };
/// Compares matrices with unrounded ones. Unit: half an ULP, plus 1e-12 of the column's largest entry (at least 1e-12).
/// Inversion::in_float, of M rounded to float: each entry of N may be off by 8 u of the same entry of |N| |M|^T |N|
/// more, as in Mesa (ledger, opengl.vertex).
Measurement compare_matrices(const Records<double>& candidate, const Records<double>& reference, double factor,
                             Inversion inversion = Inversion::in_double);

/// Compares the scene's lights in eye space with unrounded ones; no items where the candidate's records hold no lights.
/// A light's position is R v + t, its direction R v. Unit: half an ULP, plus the error before rounding, by
/// compare_matrices()' unit of the entries of R and t: 1e-12 |v|_1 for R v, and 1e-12 max(1, |t|) for t. R is
/// orthonormal, so that |v|_1 <= 2 |v| and |t| <= |p_eye| + |v|.
Measurement compare_lights(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor);

/// Compares vertices. Tolerance of p_eye and p_clip: `positions` u of their magnitudes; if `positions` is 0, the effect
/// of the difference between the two sides' matrices. Tolerance of n_eye: `normals` u of the magnitude for `inversion`.
Measurement compare_vertices(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double positions, double normals, Inversion inversion = Inversion::in_double);
/// Underflow and overflow of a reference's float arithmetic.
struct FloatRange {
  double underflow = kGradualUnderflow;
  /// The reference's fault where a channel's power overflows (light_bounds.h); empty: none.
  std::string_view overflow = {};
};
/// Compares colours at vertices. Tolerance of lit colours: `factor` u of LightBounds::magnitude, plus
/// LightBounds::jump, plus the effect of the difference between the two sides' normals, which stage vertex judges.
/// Colours of draws that are not lit at vertices: equal but for underflow.
Measurement compare_lit(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                        double factor, LitPart part = {}, const FloatRange& range = {});

/// Rules of a candidate's window triangles.
struct WindowRules {
  double factor;                          ///< tolerance of p_win and 1/w [u of their magnitudes]
  Conventions conventions = {};           ///< the grid of snapped positions, and the sample
  double colors = 0;                      ///< tolerance of colours [u of the value, at least of 1]
  FacingArea area = FacingArea::snapped;  ///< decides facings (legal_window.h)
};
/// Compares window triangles with exact ones. Snapped positions must be the candidate's own p_win, rounded to the grid
/// (under FacingArea::either, half way between two grid positions: to either). Another facing, and a missing or extra
/// triangle, is legal where the candidate's clip polygons leave it open. Colours must be those of the face.
Measurement compare_window(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           const WindowRules& rules);
/// Compares window triangles bit for bit (as floats), 1/w with tolerance `factor` [ULP]. Colours are not compared:
/// OpenGL's feedback gives none for flat draws. `turned`: primitives, counted as ambiguous, that the two sides may
/// legally draw as different faces (legal_window.h, turned_outlines).
Measurement compare_window_equal(const Records<double>& candidate, const Records<double>& reference, double factor,
                                 std::span<const std::uint32_t> turned = {});

/// Calls visit(fragment, is in `a`, is in `b`) for each fragment of either list, both sorted by draw_order().
void each_covered(std::span<const Covered> a, std::span<const Covered> b, auto visit) {
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const bool in_a = i < a.size() && (j == b.size() || draw_order(a[i]) <= draw_order(b[j]));
    const bool in_b = j < b.size() && (i == a.size() || draw_order(b[j]) <= draw_order(a[i]));
    visit(in_a ? a[i] : b[j], in_a, in_b);
    i += in_a ? 1 : 0;
    j += in_b ? 1 : 0;
  }
}
/// Compares fragments of stage 5, both sides sorted by draw_order(): each extra or missing fragment is a difference of
/// 1.
Measurement compare_covered(const Records<double>& candidate, const Records<double>& reference);
/// compare_covered() for a candidate whose tie rule or grid is not the dialect's. An extra or missing fragment is
/// ambiguous where the sample lies within d [pixels] of an edge of the candidate's triangle. d is the sum of the edge's
/// displacements by the declared grid (no grid: by rounding in float), by exact's snapping to 1/256 pixel, and by
/// stepping in float where depth_arithmetic declares stepping. On a declared grid of whole to 1/256 pixels the first
/// two are 0, unless has_corner_between_places(); float edge functions reach 8 u of the largest coordinates, unless
/// depth_arithmetic is in_double.
/// A fragment differs nevertheless where the sample lies on an edge that two triangles share (shared_edges.h), near no
/// other edge of these, and is not in exactly one of the two (inclusive: nor in both; exclusive: nor in neither).
/// `sample`: sample position [pixels from the pixel's corner of smallest coordinates]. `frame`: its size [pixels], in
/// whose rows and columns edges are stepped.
Measurement compare_covered_except_edges(const Records<double>& candidate, const Records<double>& reference,
                                         const Conventions& conventions, glm::dvec2 sample = glm::dvec2(0.5),
                                         glm::dvec2 frame = kNoSides, SnappedBy snapped_by = SnappedBy::conventions);
/// True if the candidate may have snapped a corner to either of two grid positions: its records hold no snapped
/// positions, and a corner lies within 4 u of the middle between two grid positions (rounding to the nearest) or within
/// kOfFixedPoint of a grid position (rounding down or up).
bool has_corner_between_places(const WindowTriangle<double>& t, const Conventions& conventions, SnappedBy snapped_by);
/// compare_covered() for a candidate whose tie rule and grid the reference follows (run_by_conventions.h). Fragments at
/// edges are ambiguous only in triangles for which has_corner_between_places() is true.
Measurement compare_covered_by_rule(const Records<double>& candidate, const Records<double>& reference,
                                    const Conventions& conventions, SnappedBy snapped_by = SnappedBy::renderer,
                                    glm::dvec2 frame = kNoSides);
/// Planes count and id_sum (capture.h) of fragments whose `triangle` is an index into `triangles`.
struct FragmentSums {
  Plane<std::uint32_t> count;
  Plane<std::uint64_t> id_sum;
};
FragmentSums fragment_sums(std::span<const Covered> fragments, std::span<const WindowTriangle<double>> triangles,
                           int width, int height);
/// True if planes.count, and planes.id_sum unless it is empty, are the sums of the records' fragments. False if
/// planes.count is empty.
bool are_sums_of(const Records<double>& records, const Planes& planes);
/// compare_covered() with open pixels (`legal` allows several counts; compare_coverage(), compare_planes.h).
/// Differences at open pixels are ambiguous if a fragment differs at a pixel that is not open, else different.
Measurement compare_open_covered(const Capture& candidate, const Records<double>& reference, const Legal& legal);
/// Compares depths [steps of the depth format], rounded as the candidate's conventions declare. `from_origin`:
/// allowance for a foreign renderer's planes in float [u of bounds_from_origin()'s magnitude]; 0: none. The allowance
/// applies to z32f; to codes only under a declared depth_arithmetic in float, as elsewhere truncated codes would pass.
Measurement compare_depth(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                          double factor, const Conventions& conventions = {}, double from_origin = 0);
/// Compares interpolated colours. `from_origin`: as in compare_depth(); above 0, the error of the declared
/// depth_arithmetic is allowed as well, in a frame of that size [pixels].
Measurement compare_attributes(const Records<double>& candidate, const Records<double>& reference, double factor,
                               double from_origin = 0, const Conventions& conventions = {},
                               glm::dvec2 frame = kNoSides);
/// Compares shaded colours. Plain draws: bit for bit (as floats), but for `copies` u of the value. Other draws:
/// `factor` u of each step's magnitude (shade_bounds.h). With `copies` above 0, in a frame of codes, colours may be
/// clamped to [0, 1], and may be off by u / 2 codes, which rounding to codes in float loses beside 1/2 code.
Measurement compare_shaded(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, double copies = 0);
/// Compares a varying that is not lit at the vertices, bit for bit (as floats), as stage light only copies it.
Measurement compare_carried(Varying varying, const Records<double>& candidate, const Records<double>& reference);
/// Compares `drawn` of each fragment; a difference is 1. No items where the candidate's records do not hold `drawn`.
Measurement compare_drawn(const Records<double>& candidate, const Records<double>& reference);

}  // namespace plumbline::check
