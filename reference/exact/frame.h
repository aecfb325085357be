// Stages 10 and 11: fragments are folded in draw order into the frame.
#pragma once

#include <utility>
#include <vector>

#include "capture/capture.h"
#include "reference/arithmetic/frame_color.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Input of a fragment's tests.
struct Fragment {
  int x, y;
  const Draw& draw;
  bool front;    ///< facing of the triangle, or of the polygon of an outline; true for a mesh's lines and points
  double depth;  ///< window z
  double alpha;  ///< used where the draw has an alpha test
};

/// The depth plane, in the frame's format, and the stencil plane, where the frame has one; constructed with clear
/// values.
class TestedFrame {
 public:
  explicit TestedFrame(const FrameFormat& frame);
  /// Alpha, stencil and depth test, in that order (OpenGL 2.1 spec 4.1.4 to 4.1.6); true: the fragment passes all, and
  /// stores its depth if the draw writes depth. A fragment that passes the alpha test updates the stencil value, also
  /// where it fails the other two.
  bool test(const Fragment& fragment);
  /// Stores the depth of a fragment that is known to pass, if the draw writes depth.
  void store(const Fragment& fragment);
  Plane<double> take_depth() { return std::move(depth_); }
  Plane<std::uint8_t> take_stencil() { return std::move(stencil_); }

 private:
  DepthFormat format_;
  ColorFormat color_;
  Plane<double> depth_;
  Plane<std::uint8_t> stencil_{};
};

/// The colour plane, constructed with the clear colour. Where the frame has codes, colours are clamped to [0,1]; the
/// last one written to a pixel is not rounded to codes.
class ColorBuffer {
 public:
  explicit ColorBuffer(const Scene& scene);
  void write(int x, int y, const Merge& state, const glm::dvec4& color);
  /// Takes the colours: where an earlier rounding may go either way, the middle of the interval. The plane is
  /// unspecified afterwards.
  Plane<glm::vec4> take();
  /// Sets the intervals of Legal (color_lo, color_hi); leaves them empty where no colour is blended or masked.
  void take_bounds(Legal& out) const;

 private:
  ColorFormat format_;
  Plane<glm::vec4> replaced_;          // used if colors_replace(scene)
  Plane<math::FrameColor> blended_{};  // used otherwise
};

/// Stage 10, from records.triangles, covered, depth and (for alpha tests) shaded. drawn_fragments(): which fragments
/// pass all tests, and the resulting stencil plane. visible_primitives(): planes.id, the primitive of the last drawn
/// fragment. Both throw std::invalid_argument where the records do not fit the scene or each other.
std::vector<Drawn> drawn_fragments(const Scene& scene, const Records<double>& records, Plane<std::uint8_t>& stencil);
Plane<std::int32_t> visible_primitives(const Scene& scene, const Records<double>& records,
                                       const std::vector<Drawn>& drawn);

/// Stage 11: sets planes.color and planes.depth, and the interval of legal colours where there is one, in `out`, from
/// in.records' triangles, covered, depth, shaded and drawn. If `drawn` is empty, the drawn fragments are those of the
/// winners in.planes.id or, if in.planes.id is empty too, those of drawn_fragments(). Throws std::invalid_argument
/// where the records do not fit the scene or each other.
void merge_fragments(const Scene& scene, const Capture& in, Capture& out);

}  // namespace plumbline::exact
