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

/// Area that decides the facing of a polygon: that of corners on the grid of the conventions, of each triangle of its
/// fan; or, for foreign renderers, which may decide before they snap, or once for a polygon of n corners, any of these.
/// OpenGL 2.1, equation 3.6, leaves snapping open.
enum class FacingArea { snapped, either };

struct WindowCorner;

class LegalWindow {
 public:
  /// `records`: matrices and clip polygons of the renderer that is judged, with the varying back_color where faces have
  /// colours of their own. `factor`: of u of the magnitude of p_win, its error (ledger, exact.window). `conventions`:
  /// the grid, and the sample, to whose pixel's centre window positions were moved (capture/by_conventions.h).
  LegalWindow(const Scene& scene, const Records<double>& records, double factor, FacingArea area,
              const Conventions& conventions = {});

  /// Lists of records, one of which the primitive's polygons become. Filled on both faces: one list, each answer with
  /// its own legal facings. Else a list for each legal facing, empty where that face is culled. No list: a line, a
  /// point, no such polygon or no matrices, a corner without a finite window position, or several polygons that are not
  /// filled.
  std::vector<std::vector<WindowAnswer>> of(std::uint32_t primitive) const;

  /// For each record of `run`, the number of its answer, ascending; none where `run` is not legal: a record without an
  /// answer, or an answer missing that is not `absent`. Positions and 1/w within their error; colours are not compared.
  std::optional<std::vector<std::size_t>> match(std::span<const WindowTriangle<double>> run,
                                                const std::vector<WindowAnswer>& answers) const;

  /// Error of a window position of the primitive, which the scene has, per coordinate.
  Vec3<double> error(std::uint32_t primitive, const Vec3<double>& p_win) const;

  const DrawIndex& draws() const { return draws_; }

 private:
  bool fits(const WindowTriangle<double>& t, const WindowAnswer& answer) const;
  // None: a line, a point, or a corner without a finite window position. `draw`: the number of the polygon's draw.
  std::vector<WindowCorner> corners_of(const ClipPolygon& polygon, std::size_t draw) const;

  const Scene& scene_;
  const Records<double>& records_;
  double factor_;
  FacingArea area_;
  Conventions conventions_;
  DrawIndex draws_;
};

/// Primitives, ascending, of triangle meshes that are not filled on both faces, whose facing rounding leaves open, and
/// which both sides draw legally but perhaps as different faces. Such a difference shows in polygon mode or culling, in
/// colours or stencil operations that depend on the face, or, with a polygon offset, in depth. Facing may follow the
/// snapped or the unsnapped area; edges and corners of the reference need no facing.
std::vector<std::uint32_t> turned_outlines(const Scene& scene, const Records<double>& candidate,
                                           const Records<double>& reference);

}  // namespace plumbline::check
