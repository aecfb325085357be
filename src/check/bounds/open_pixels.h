// Pixels at which a reference's alpha or depth test may keep or drop another fragment than the candidate's: there its
// planes may show something else, and both be right.
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

/// Whether any draw tests alpha.
bool tests_alpha(const Scene& scene);

/// 1 where some fragment of the candidate's, with an alpha off by up to its bound (fragment_bounds.h), may pass the
/// test in the format `theirs` and fails it in the candidate's, or the other way round; and where the reference alone has
/// a fragment. The candidate's records have to be there.
Plane<std::uint8_t> open_by_alpha(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  ColorFormat theirs, double factor);

/// 1 where some fragment's depth is so near to what the frame held that the bounds of compare_depth_planes, and what
/// goes by the major axis (bounds.h), let its depth test come out otherwise: also of one that another hides later.
/// Needs the candidate's records of stages 5, 6 and 10; without them nothing is open.
Plane<std::uint8_t> open_by_depth(const Scene& scene, const Capture& candidate);

/// Legal winners of a pixel, and the stencil values beside them, where each fragment's depth is off by up to the bounds
/// of compare_depth_planes and what goes by the major axis (bounds.h). By the candidate's fragments, depths and alphas
/// (records of stages 5, 6 and 9): what it made of them at visibility is not looked at.
class LegalWinners {
 public:
  /// Each fragment has a depth.
  LegalWinners(const Scene& scene, const Records<double>& records);
  std::vector<LegalAnswer> at(int x, int y) const;

 private:
  const Scene& scene_;
  const Records<double>& records_;
  DrawIndex draws_;
  OffsetErrors offsets_;
  DrawnAt fragments_;
};

/// Both sides' coverage without the outlines that each draws legally as another face (legal_window.h, turned_outlines),
/// and the pixels that they cover on either side: 1. Of the candidate's outlines, and of the reference's points and
/// filled faces, `referee` says what they cover; of the reference's lines, its own records.
struct BesideTurned {
  Capture candidate, reference;  ///< planes count and id_sum; records of window and coverage, outlines not among them
  Plane<std::uint8_t> open;
};
BesideTurned beside_turned(const Scene& scene, const Capture& candidate, const Capture& reference,
                           std::span<const std::uint32_t> turned, Renderer& referee);

/// The reference's planes from texture on get the candidate's own values where `open` is 1; returns how many pixels.
std::uint64_t copy_open_pixels(const Plane<std::uint8_t>& open, const Planes& candidate, Planes& reference);

/// An OpenGL renderer's planes get the candidate's own values where the pixel is open; returns how many are. It tests
/// alpha in the frame's format of 8 bits, else in float, as it does where colours before merge are drawn.
std::uint64_t copy_pixels_open_by_alpha(const Scene& scene, const Capture& candidate, Stage stage, double factor,
                                        Capture& reference);

}  // namespace plumbline::check
