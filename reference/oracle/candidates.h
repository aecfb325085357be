// Which triangles may be at which pixels: two independent ways of finding those that contain a pixel's centre (rays,
// in reference/embree; boxes, here), and one of finding those that only come near it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "reference/arithmetic/project.h"

namespace plumbline::math {

/// A triangle to be looked at for a pixel: a claim, not a fact; duplicates do no harm.
struct Candidate {
  std::uint32_t pixel;  ///< y * width + x
  std::uint32_t primitive;
};

/// Candidates, up to a number of them: what is added beyond it is dropped and remembered, so that nothing is thrown
/// through a foreign library's call.
class Candidates {
 public:
  /// `wanted`: by pixel, others are left out; empty: all.
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

/// Every triangle with the pixels whose centres are within its edges, by testing all of its bounding box.
/// Throws OverBudget.
void add_by_boxes(const Projected& projected, Candidates& out);
/// Every triangle with the pixels whose centres are within snapping and float error of an edge of it, by walking along
/// its edges; of a loose one, all pixels. Throws OverBudget.
void add_by_edges(const Projected& projected, Candidates& out);

}  // namespace plumbline::math
