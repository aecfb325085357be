// Comparators of records, stages 0 to 7, 9 and 10 (8: compare_texels.h). Tolerances are proportional to magnitudes of
// the candidate's records.
#pragma once

#include <span>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "capture/stages.h"
#include "check/bounds/bounds.h"
#include "check/compare/legal_window.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Against matrices that were rounded to float, too; not the normal matrix, which OpenGL keeps inside. Unit: 1e-12 of
/// the column's largest entry, or of 1.
Measurement compare_rounded_matrices(const Records<double>& candidate, const Records<double>& reference, double factor);
/// Precision in which a renderer inverts the model-view M for its normal matrix N.
enum class Inversion { in_double, in_float };
/// Against unrounded matrices. Inversion in float, of M rounded to float: each entry of N may be off by 8 u of that of
/// |N| |M|^T |N| besides, as Mesa's (ledger, opengl.vertex).
Measurement compare_matrices(const Records<double>& candidate, const Records<double>& reference, double factor,
                             Inversion inversion = Inversion::in_double);

/// The scene's lights in eye space against unrounded ones; nothing to compare where the candidate's records hold none.
/// A place in eye space is R v + t, a direction R v. Unit: half an ULP, and the error of R's and t's entries before the
/// rounding, 1e-12 of their column's largest entry, or of 1, as for matrices: 1e-12 |v|_1, and 1e-12 max(1, |t|) of a
/// place. R is orthonormal: |v|_1 <= 2 |v|, |t| <= |p_eye| + |v|.
Measurement compare_lights(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor);

/// p_eye, p_clip: `positions` u of their magnitudes; if 0, what the two sides' matrices differ by is allowed. n_eye:
/// `normals` u of the magnitude for `inversion`.
Measurement compare_vertices(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double positions, double normals, Inversion inversion = Inversion::in_double);
/// Underflow and overflow of a reference's float arithmetic.
struct FloatRange {
  double underflow = kGradualUnderflow;
  /// Why a channel whose power overflows (light_bounds.h) is the reference's fault; empty: it is not.
  std::string_view overflow = {};
};
/// Lit colours: `factor` u of light_bounds.h's magnitude, and what the two sides' normals cause, which stage vertex
/// judges. Colours of unlit draws: equal but for underflow.
Measurement compare_lit(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                        double factor, LitPart part = {}, const FloatRange& range = {});

/// Polygons as polygons: the same primitives and numbers of vertices; vertices of the mesh in the same place; each cut
/// one on the planes that its counterpart lies on, and in the plane of its triangle, colours included. Where a corner
/// lies within `factor` u of a clip plane, the number of vertices is ambiguous. `flat_applies`: colours are the
/// provoking vertex' where the draw is flat. `copies`: error of a vertex of the mesh [u of its triangle's largest
/// coordinate, or channel], for a renderer that keeps clip positions in another form; a cut no farther than that from
/// such a vertex counts as the vertex.
Measurement compare_polygons(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double factor, bool flat_applies = true, double copies = 0);
/// The same positions but for `factor` u of |p_clip| + w; for references that rebuild p_clip from the window.
Measurement compare_polygon_positions(const Records<double>& candidate, const Records<double>& reference,
                                      double factor);

/// p_win, 1/w and facing against the exact ones, `factor` u of the magnitudes; snapped positions are the rounding of
/// the candidate's own p_win, exactly, to the grid of its conventions. Other facings, and missing or extra triangles,
/// are legal where the candidate's clip polygons leave them open, by `area` (legal_window.h); the colours are those of
/// the face, but for `colors` u of the value, or of 1.
Measurement compare_window(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, const Conventions& conventions = {}, double colors = 0,
                           FacingArea area = FacingArea::snapped);
/// Bit for bit (as floats), but 1/w, which has the tolerance `factor` [ULP]. Colours are not compared: feedback has
/// none of flat draws. `turned`: primitives that both sides draw legally as other faces (legal_window.h,
/// turned_outlines): ambiguous.
Measurement compare_window_equal(const Records<double>& candidate, const Records<double>& reference, double factor,
                                 std::span<const std::uint32_t> turned = {});

/// Fragments of stage 5, both sides in draw_order() [fragments]: each extra or missing one differs by 1.
Measurement compare_covered(const Records<double>& candidate, const Records<double>& reference);
/// Likewise, for a candidate of another tie rule or grid than the dialect's: a fragment more or less is ambiguous where
/// its sample is no farther from an edge of the candidate's triangle than snapping to the declared grid and to 1/256
/// pixel together may move the edge. A candidate without a grid counts as one of 1/256 pixel. `sample`: the place of
/// samples [pixels from the pixel's corner of smaller coordinates].
Measurement compare_covered_but_edges(const Records<double>& candidate, const Records<double>& reference,
                                      const Conventions& conventions, glm::dvec2 sample = glm::dvec2(0.5));
/// Likewise, for a candidate whose tie rule and grid the reference follows (run_by_conventions.h). Ambiguous: the edges
/// of triangles with a corner within 4 u of midway between two grid positions.
Measurement compare_covered_by_rule(const Records<double>& candidate, const Records<double>& reference,
                                    const Conventions& conventions);
/// Planes count and id_sum (capture.h) of fragments whose `triangle` is an index into `triangles`.
struct FragmentSums {
  Plane<std::uint32_t> count;
  Plane<std::uint64_t> id_sum;
};
FragmentSums fragment_sums(std::span<const Covered> fragments, std::span<const WindowTriangle<double>> triangles,
                           int width, int height);
/// Whether planes.count, and id_sum where there is one, are the sums of the records' fragments.
bool are_sums_of(const Records<double>& records, const Planes& planes);
/// compare_covered(); a fragment more or less is ambiguous where `legal` leaves open how many there are
/// (compare_planes.h), as long as others differ.
Measurement compare_open_covered(const Capture& candidate, const Records<double>& reference, const Legal& legal);
/// In steps of the depth format; rounded to it as the candidate's conventions say. `from_origin`: the allowance for a
/// foreign renderer that interpolates by planes in float [u of bounds_from_origin()'s magnitude]; 0: none. It counts for
/// depths of a float format; for codes where the conventions declare depth_arithmetic in float alone (elsewhere a
/// truncated code would pass).
Measurement compare_depth(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                          double factor, const Conventions& conventions = {}, double from_origin = 0);
/// `from_origin`: as in compare_depth(); with it, the error of the arithmetic that the conventions declare.
Measurement compare_attributes(const Records<double>& candidate, const Records<double>& reference, double factor,
                               double from_origin = 0, const Conventions& conventions = {});
/// Colours: of plain draws bit for bit (as floats), but for `copies` u of the value; of others `factor` u of each step's
/// magnitude (shade_bounds.h). With `copies`, in a frame of codes, colours may be clamped to [0, 1].
Measurement compare_shaded(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, double copies = 0);
/// A varying that is not lit, at the vertices, bit for bit (as floats): stage light only copies it.
Measurement compare_carried(Varying varying, const Records<double>& candidate, const Records<double>& reference);
/// `drawn` of each fragment [pixels]: differs by 1. No items where the candidate records none.
Measurement compare_drawn(const Records<double>& candidate, const Records<double>& reference);

}  // namespace plumbline::check
