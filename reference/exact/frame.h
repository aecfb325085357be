// Stages 10 and 11: fragments are folded in draw order into the frame.
#pragma once

#include <utility>
#include <vector>

#include "capture/capture.h"
#include "reference/arithmetic/frame_color.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// A fragment as its tests see it.
struct Fragment {
  int x, y;
  const Draw& draw;
  bool front;    ///< facing of the triangle, or of the polygon of an outline; true for a mesh's lines and points
  double depth;  ///< window z
  double alpha;  ///< looked at where the draw tests it
};

/// The planes that tests go by: depth in the frame's format, and stencil values where it has them. Cleared.
class TestedFrame {
 public:
  explicit TestedFrame(const FrameFormat& frame);
  /// A fragment arrives: alpha, stencil and depth test, in that order (OpenGL 2.1 spec 4.1.4 to 4.1.6). Where it
  /// passes, its depth is stored, if the draw writes depth; the stencil value changes either way.
  bool test(const Fragment& fragment);
  /// One that is known to pass.
  void store(const Fragment& fragment);
  Plane<double> take_depth() { return std::move(depth_); }
  Plane<std::uint8_t> take_stencil() { return std::move(stencil_); }

 private:
  DepthFormat format_;
  ColorFormat color_;
  Plane<double> depth_;
  Plane<std::uint8_t> stencil_{};
};

/// The colour plane, cleared. Clamped to [0,1] where the frame has codes, but what is written last not rounded to them;
/// as it is for rgba32f.
class ColorBuffer {
 public:
  explicit ColorBuffer(const Scene& scene);
  void write(int x, int y, const Merge& state, const glm::dvec4& color);
  /// The middle, where rounding on the way may go either way.
  Plane<glm::vec4> take();
  /// Its bounds there, as Legal has them; empty where no colour is blended or masked.
  void take_bounds(Legal& out) const;

 private:
  ColorFormat format_;
  Plane<glm::vec4> replaced_;          // where each colour replaces the one before it,
  Plane<math::FrameColor> blended_{};  // or else
};

/// Stage 10, from records.triangles, covered, depth and (for alpha tests) shaded: which fragments pass all tests, and
/// the stencil plane that these leave; and planes.id, the last of them. Both throw std::invalid_argument where the
/// records do not fit the scene or each other.
std::vector<Drawn> drawn_fragments(const Scene& scene, const Records<double>& records, Plane<std::uint8_t>& stencil);
Plane<std::int32_t> visible_primitives(const Scene& scene, const Records<double>& records,
                                       const std::vector<Drawn>& drawn);

/// Stage 11: planes.color and planes.depth, and the legal colours where they are not one, into `out`; from in.records'
/// triangles, covered, depth, shaded and drawn. Where the last is not there, the fragments drawn are those of the
/// winning primitives, in.planes.id, or of depth's own fold.
/// Throws std::invalid_argument where the records do not fit the scene or each other.
void merge_fragments(const Scene& scene, const Capture& in, Capture& out);

}  // namespace plumbline::exact
