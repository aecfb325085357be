// Legal outcomes of stage 4 (window) for the polygons of one primitive, where rounding and snapping decide its facing.
// Computed from the records of earlier stages, so that a wrong window record excuses nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "capture/conventions.h"
#include "capture/stages.h"
#include "scene/draw_index.h"
#include "scene/scene.h"

namespace plumbline::check {

/// A window triangle, line or point that a polygon may become.
struct WindowAnswer {
  WindowTriangle<double> record;           ///< in double, with the colours of a front face
  std::array<Vec4<double>, 3> back_color;  ///< the corners' colours on a back face
  bool front = false, back = false;        ///< facings with which it may be there
  bool absent = false;                     ///< may be missing: no snapped area, or culled
  bool has_no_area = false;                ///< on the grid: it covers nothing, drawn or not
};

/// Area that decides a polygon's facing (OpenGL 2.1, equation 3.6, leaves snapping open). `snapped`: area on the grid
/// of the conventions, of each triangle of the fan. `either`, for foreign renderers: snapped or unsnapped area, of each
/// triangle of the fan or of the whole polygon.
enum class FacingArea { snapped, either };

struct WindowCorner;

class LegalWindow {
 public:
  /// `records`: matrices and clip polygons of the renderer that is judged, with the varying back_color where faces have
  /// colours of their own. `factor`: error of p_win [u of its magnitude] (ledger, exact.window). `conventions`: the
  /// grid, and the sample position; window positions have been moved by 1/2 - sample [pixels]
  /// (capture/by_conventions.h).
  LegalWindow(const Scene& scene, const Records<double>& records, double factor, FacingArea area,
              const Conventions& conventions = {});

  /// Legal outcomes for the primitive: lists of answers, one of which its window records must match. A draw that is
  /// filled on both faces has one list, each answer with its own legal facings. Any other draw has a list for each
  /// legal facing, empty where that face is culled. No list: a line, a point, no such polygon or no matrices, a corner
  /// without a finite window position, or several polygons that are not filled.
  std::vector<std::vector<WindowAnswer>> of(std::uint32_t primitive) const;

  /// Index in `answers` of each record's answer, ascending; nullopt where `run` is not legal: a record has no answer,
  /// or an answer that is not `absent` has no record. Positions and 1/w match within their error; colours are not
  /// compared.
  std::optional<std::vector<std::size_t>> match(std::span<const WindowTriangle<double>> run,
                                                const std::vector<WindowAnswer>& answers) const;

  /// Error of a window position of the primitive, which the scene has, per coordinate.
  Vec3<double> error(std::uint32_t primitive, const Vec3<double>& p_win) const;

  const DrawIndex& draws() const { return draws_; }

 private:
  bool fits(const WindowTriangle<double>& t, const WindowAnswer& answer) const;
  // Corners in the window; none: a line, a point, or a corner without a finite window position. `draw`: draw number.
  std::vector<WindowCorner> corners_of(const ClipPolygon& polygon, std::size_t draw) const;

  const Scene& scene_;
  const Records<double>& records_;
  double factor_;
  FacingArea area_;
  Conventions conventions_;
  DrawIndex draws_;
};

/// Primitives, ascending, that both sides draw legally but may draw as different faces: triangles that are not filled
/// on both faces, with a facing that rounding leaves open. The difference shows in polygon mode or culling, in colours
/// or stencil operations of the face, or, with a polygon offset, in depth. Facing may follow the snapped or the
/// unsnapped area. The facing of the reference's edges and corners is not read.
std::vector<std::uint32_t> turned_outlines(const Scene& scene, const Records<double>& candidate,
                                           const Records<double>& reference);

}  // namespace plumbline::check
