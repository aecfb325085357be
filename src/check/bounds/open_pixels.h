// Open pixels: pixels at which a reference's alpha or depth test may legally come out otherwise than the candidate's,
// so that the planes may differ.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture/capture.h"
#include "capture/legal.h"
#include "capture/renderer.h"
#include "check/bounds/bounds.h"
#include "check/bounds/fragment_bounds.h"
#include "scene/scene.h"

namespace plumbline::check {

/// True if a draw tests alpha.
bool tests_alpha(const Scene& scene);

/// True if the cleared frame and another frame are legal: every pixel may be background, and a pixel may be of a
/// primitive. False where legal colours are not those of the winners (Legal::color_lo).
bool may_be_empty(const Legal& legal);
/// True if surfaces are drawn and no pixel of theirs has a known colour: each has a legal answer whose bound is at
/// least half of the colours' range.
bool knows_no_color(const Legal& legal);

/// 1 where the alpha test in the format `theirs` may come out otherwise than the candidate's own, for a fragment of the
/// candidate with an alpha off by up to its bound (fragment_bounds.h); and where the reference has more fragments than
/// the candidate. Needs the candidate's records.
Plane<std::uint8_t> open_by_alpha(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  ColorFormat theirs, double factor);

/// 1 where a fragment's depth test may come out otherwise, within the bounds of compare_depth_planes() and by
/// interpolation along a line's major axis (bounds.h), even if a later fragment hides the fragment. Needs the
/// candidate's records of stages 4, 5, 6 and 10; without them nothing is open.
Plane<std::uint8_t> open_by_depth(const Scene& scene, const Capture& candidate);

/// 1 where two depths of the candidate's fragments, or of a fragment and the cleared frame, are different doubles and
/// one float: a renderer that tests depths in double and stores floats may order them, or find them equal. Needs the
/// candidate's records of stages 4 to 6; without them, or in another format than z32f, nothing is open.
Plane<std::uint8_t> open_by_double(const FrameFormat& frame, const Records<double>& records);

/// Legal winners of a pixel, each with its stencil value, for depths off by up to the bounds of compare_depth_planes()
/// and of a line's major axis (bounds.h). Computed from the candidate's fragments, depths and alphas (records of stages
/// 4, 5, 6 and 9), without its visibility.
class LegalWinners {
 public:
  /// Each fragment has a depth.
  LegalWinners(const Scene& scene, const Records<double>& records);
  std::vector<LegalAnswer> at(int x, int y) const;

 private:
  /// Whether fragment b is of the same line or point as fragment a, drawn again.
  bool is_drawn_again(std::size_t a, std::size_t b) const;
  const Scene& scene_;
  const Records<double>& records_;
  DrawIndex draws_;
  OffsetErrors offsets_;
  FragmentsByPixel fragments_;
};

/// Coverage of both sides without the primitives `turned`, which each side may legally draw as another face
/// (legal_window.h, turned_outlines). `open`: 1 where a turned primitive covers the pixel on either side. `referee`
/// computes the coverage of turned primitives; for lines of the reference, the reference's own records count.
struct WithoutTurned {
  /// Planes count and id_sum without `turned`; all records of window (`turned` with `corners` 0) and of coverage.
  Capture candidate, reference;
  Plane<std::uint8_t> open;
};
WithoutTurned without_turned(const Scene& scene, const Capture& candidate, const Capture& reference,
                             std::span<const std::uint32_t> turned, Renderer& referee);

/// Copies the candidate's planes, except count and id_sum, into the reference's where `open` is 1. Returns the number
/// of open pixels.
std::uint64_t copy_open_pixels(const Plane<std::uint8_t>& open, const Planes& candidate, Planes& reference);

/// Copies `drawn` of the candidate's fragments into the reference's where `open` is 1. Nothing is copied unless both
/// sides have one entry per fragment of the candidate.
void copy_open_drawn(const Plane<std::uint8_t>& open, const Records<double>& candidate, Records<double>& reference);

/// copy_open_pixels() at pixels that open_by_alpha() finds open against an OpenGL reference. The reference tests alpha
/// in codes for rgba8 frames; in float for other formats, and for the frames of stages attributes and shade. Returns
/// the number of open pixels.
std::uint64_t copy_pixels_open_by_alpha(const Scene& scene, const Capture& candidate, Stage stage, double factor,
                                        Capture& reference);

}  // namespace plumbline::check
