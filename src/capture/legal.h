// Legal answers: where the rules leave open what a pixel shows (a centre within the snapping bound of an edge, two
// surfaces closer than the depth format can tell apart), the set of all answers that they allow.
//
// An oracle finds every triangle that is, or may be, at a pixel: its *hits*. fold_hits() runs them in draw order
// through the scene's depth functions, following every outcome that the intervals allow, and returns the winners that
// may remain. The set may be wider than the truth, never narrower.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/plane.h"
#include "scene/scene.h"

namespace plumbline {

inline constexpr std::int32_t kBackground = -1;  ///< primitive number of a pixel that shows the cleared frame

/// Surface number of a hit whose depth is not certain to equal any other hit's.
inline constexpr std::int32_t kNoSurface = -1;

/// Equality of the state that decides a primitive's depth: transforms, depth state, and state by which renderers may
/// choose another program (light, shading, texture, fog).
bool placed_alike(const Draw& a, const Draw& b);

/// One triangle at one pixel.
struct Hit {
  std::uint32_t primitive = 0;
  DepthFunc depth_func = DepthFunc::less;
  bool certain = false;  ///< every legal renderer covers the pixel with it; else some may
  int group = -1;        ///< possible hits of one group (>= 0): at least one of them covers the pixel
  double z_lo = 0;       ///< window z, clamped to [0,1]: the depths that a legal renderer may give it
  double z_hi = 0;
  glm::dvec4 color{0};     ///< its colour at the pixel's centre
  double color_bound = 0;  ///< bound on the error of `color` in float arithmetic from the scene on, per channel
  bool depth_mask = true;  ///< whether its depth is written where it is drawn
  bool alpha_passes = true, alpha_fails = false;  ///< outcomes that the alpha test may have
  /// Stencil state of the face that the hit shows; `or_stencil`: of the other face where facing is open. Null: no test.
  const StencilFace* stencil = nullptr;
  const StencilFace* or_stencil = nullptr;
  std::uint32_t pieces = 1;  ///< most pieces of the triangle at the pixel, each with a stencil operation
  /// Hits of one surface (>= 0) have one depth in every legal renderer, to the bit: the same triangle is drawn again.
  std::int32_t surface = kNoSurface;
};

/// One winner that the rules allow, and the stencil value that stands beside it.
struct LegalAnswer {
  std::int32_t primitive = kBackground;  ///< the winner; kBackground: the cleared frame
  float color_bound = 0;
  double z_lo = 0, z_hi = 0;  ///< the window z that the frame then holds
  glm::vec4 color{0};
  std::uint8_t stencil = 0;
  std::int32_t surface = kNoSurface;  ///< whose depth the frame then holds (Hit)
};

/// The legal winners of one pixel while its hits are drawn, in draw order. Time per hit: the number of different depth
/// intervals among the winners, or the number of winners n where one is removed or narrowed; with stencil
/// values n log n.
class LegalFold {
 public:
  explicit LegalFold(const FrameFormat& frame);
  /// The cleared frame again. Memory is kept.
  void clear();
  /// Draws a hit; `certain` stands in for hit.certain.
  void draw(const Hit& hit, bool certain);
  /// Replaces the winners: in draw order, one entry per primitive and stencil value.
  void set(const std::vector<LegalAnswer>& winners);
  /// In draw order, the background first; one entry per winner and stencil value.
  const std::vector<LegalAnswer>& winners() const { return winners_; }

 private:
  /// Winners of equal depth intervals and one surface, one after another: the depth test treats them alike.
  struct Run {
    std::size_t first;
    double z_lo, z_hi;
    std::int32_t surface;
  };

  void draw_either_side(const Hit& hit, bool certain);
  void draw(const Hit& hit, bool certain, const StencilFace* face);
  void draw_in_runs(const Hit& hit, bool certain);
  void add(const LegalAnswer& winner);

  DepthFormat format_;
  LegalAnswer background_;
  std::vector<LegalAnswer> winners_;
  std::vector<Run> runs_;    ///< of winners_
  bool one_stencil_ = true;  ///< all winners stand beside one stencil value
};

/// All legal winners of a pixel, in draw order, the background first; one entry per winner and stencil value.
/// `hits`: in draw order (ascending primitive), groups numbered from 0 on. Two depths within depth_step() (scene.h) of
/// each other may compare either way, except two that are clamped to the same end, two of one surface, and any depth
/// against 1 by less_equal or against 0 by greater_equal, which passes. Empties `out` first.
void fold_hits(std::span<const Hit> hits, const FrameFormat& frame, std::vector<LegalAnswer>& out);

/// Legal texels of a fragment: the level of detail may be computed for four pixels together, with a logarithm that is
/// linear between powers of two (as in Mesa's drivers), and the texture coordinates may have a small error.
struct TexelRange {
  glm::dvec4 lo{0}, hi{0};                                  ///< per channel, over the interval of lambda
  glm::dvec4 slope_s{0}, slope_t{0};                        ///< by how much per unit of s and of t, within half a texel
  glm::dvec2 gap{std::numeric_limits<double>::infinity()};  ///< in s and t, to where another texel is the nearest
  int first_nearest = 0, last_nearest = -1;                 ///< the levels whose nearest texel it may be; or none
  int first_linear = 0, last_linear = -1;                   ///< the levels that may be filtered linearly; or none
  double lambda_lo = 0, lambda_hi = 0;                      ///< the interval of lambda
};

/// The legal answers of a whole frame. Empty: not asked for, or not shown.
struct Legal {
  Plane<std::uint32_t> certain;   ///< number of certain hits at the pixel; a group counts as one
  Plane<std::uint32_t> possible;  ///< number of all hits; planes.count must lie in [certain, possible]
  /// 1 where the sample lies on edges that several triangles share, or so near to them that snapping decides: by any
  /// tie rule, exactly one of these triangles covers the pixel (one per layer where they overlap).
  Plane<std::uint8_t> shared;
  std::vector<std::uint32_t> first;  ///< pixel y * width + x has answers [first[i], first[i + 1])
  std::vector<LegalAnswer> answers;
  /// Interval of the frame's colour, not rounded to codes; empty where the colour is the winner's (scene.h,
  /// colors_replace). Infinite where it is open which fragments made the colour.
  Plane<glm::vec4> color_lo, color_hi;
  std::vector<TexelRange> texels;  ///< of the fragments asked about, parallel to records.covered
  double predicted_ambiguous = 0;  ///< expected number of pixels that edges (snapping bound) or depths leave open

  bool empty() const { return first.empty(); }
  /// Legal answers of pixel (x, y), in draw order; a view into `answers`. Only where !empty().
  std::span<const LegalAnswer> at(int x, int y) const {
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(certain.width()) + static_cast<std::size_t>(x);
    return {answers.data() + first[i], answers.data() + first[i + 1]};
  }
};

}  // namespace plumbline
