// Legal outcomes of stage 4 for one polygon, where rounding and snapping decide its facing. From the records of the
// stages before: a window record that is wrong excuses nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "capture/stages.h"
#include "scene/draw_index.h"
#include "scene/scene.h"

namespace plumbline::check {

/// A window triangle, line or point that a polygon may become.
struct WindowAnswer {
  WindowTriangle<double> record;           ///< in double, with the colours of a front face
  std::array<Vec4<double>, 3> back_color;  ///< the corners' colours on a back face
  bool front = false, back = false;        ///< facings with which it may be there
  bool absent = false;                     ///< may be lacking: of no snapped area, or culled
};

/// Area that decides the facing of a polygon that is not filled: the snapped one (stages.h), or, for renderers that
/// decide before they snap, either. OpenGL 2.1, equation 3.6, leaves snapping open.
enum class FacingArea { snapped, either };

class LegalWindow {
 public:
  /// `records`: matrices and clip polygons of the renderer that is judged, with the varying back_color where faces have
  /// colours of their own. `factor`: of u of the magnitude of p_win, its error (ledger, exact.window).
  LegalWindow(const Scene& scene, const Records<double>& records, double factor, FacingArea area);

  /// Everything that the primitive's polygon may become: a list for each facing that is legal. Empty: there is no such
  /// polygon, or a corner of it has no window position.
  std::vector<std::vector<WindowAnswer>> of(std::uint32_t primitive) const;

  /// Numbers of the answers that a primitive's records are, in their order; nothing where the records are not legal.
  /// Positions within their error; colours are not looked at.
  std::optional<std::vector<std::size_t>> match(std::span<const WindowTriangle<double>> run,
                                                const std::vector<WindowAnswer>& answers) const;

  /// Error of a window position of the primitive, which the scene has, per coordinate.
  Vec3<double> error(std::uint32_t primitive, const Vec3<double>& p_win) const;

  const DrawIndex& draws() const { return draws_; }

 private:
  bool fits(const WindowTriangle<double>& t, const WindowAnswer& answer) const;

  const Scene& scene_;
  const Records<double>& records_;
  double factor_;
  FacingArea area_;
  DrawIndex draws_;
};

/// Primitives that are not filled, of open facing, that both sides draw legally and maybe as other faces: in another
/// polygon mode, culled on one side alone, or, where the face shows, in its colours or stencil operations; or, with a
/// polygon offset, at other depths of the reference's. In order.
/// The reference's facing may go by either area; of edges and corners, it need not tell it.
std::vector<std::uint32_t> turned_outlines(const Scene& scene, const Records<double>& candidate,
                                           const Records<double>& reference);

}  // namespace plumbline::check
