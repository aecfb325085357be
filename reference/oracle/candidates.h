// Candidates: triangles that may cover a pixel. Two independent searches find triangles that contain the pixel's centre
// (rays: reference/embree; boxes: here), one finds triangles near the centre.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "reference/arithmetic/project.h"

namespace plumbline::math {

/// A triangle to be tested at a pixel. It need not cover the pixel; duplicates do no harm.
struct Candidate {
  std::uint32_t pixel;  ///< y * width + x
  std::uint32_t primitive;
};

/// A list of up to `most` candidates. add() drops further ones, because it must not throw through Embree's callback;
/// require_complete() reports them.
class Candidates {
 public:
  /// `wanted`: per pixel, whether its candidates are kept; empty: all are.
  explicit Candidates(std::size_t most, std::vector<bool> wanted = {}) : most_(most), wanted_(std::move(wanted)) {}
  void add(std::uint32_t pixel, std::uint32_t primitive) {
    if (!wanted_.empty() && !wanted_[pixel]) return;
    if (all_.size() < most_) {
      all_.push_back({pixel, primitive});
    } else {
      dropped_ = true;
    }
  }
  /// Throws OverBudget if anything was dropped.
  void require_complete() const;
  const std::vector<Candidate>& all() const { return all_; }

 private:
  std::size_t most_;
  std::vector<bool> wanted_;
  bool dropped_ = false;
  std::vector<Candidate> all_;
};

/// Adds each triangle with an area at the pixels whose centres are inside it or on an edge, by testing all pixels of
/// its bounding box (of the frame, where the triangle is not wholly in front of the eye). Throws OverBudget.
void add_by_boxes(const Projected& projected, Candidates& out);
/// Adds each triangle at the pixels whose centres are within snapping and float error of one of its edges, and at some
/// farther ones, by walking along the edges; a loose triangle at all pixels. Throws OverBudget.
void add_by_edges(const Projected& projected, Candidates& out);

}  // namespace plumbline::math
