#include "check/compare/compare_planes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "check/bounds/bounds.h"
#include "check/bounds/open_pixels.h"
#include "check/bounds/units.h"
#include "check/compare/same_winners.h"
#include "scene/draw_index.h"

namespace plumbline::check {

Measurement compare_coverage(const Planes& candidate, const Planes& reference, const Legal& legal) {
  std::string why;
  const bool counts_alone = candidate.id_sum.empty() && !reference.id_sum.empty();
  if (!counts_alone &&
      (!same_size(candidate.id_sum, reference.id_sum, why) || !same_size(candidate.id_sum, candidate.count, why)))
    return mismatch("fragments", why, candidate.id_sum.size());
  const auto compare = [&](const Legal& open) {
    return compare_planes(candidate.count, reference.count, "fragments", [&](Meter& meter, int x, int y) {
      const double a = candidate.count(x, y), b = reference.count(x, y);
      const bool other = !counts_alone && a == b && candidate.id_sum(x, y) != reference.id_sum(x, y);
      if ((a != b || other) && is_open(open, candidate, x, y)) return meter.ambiguous();
      meter.value(difference(a, b), 0, {x, y, -1, "count"}, a, b);
      meter.value(other ? 1 : 0, 0, {x, y, -1, "fragments of other primitives"}, other ? 1 : 0, 0);
    });
  };
  Measurement illegal = compare(legal);
  return legal.empty() || illegal.differing > 0 ? illegal : compare({});
}

Measurement compare_winners(const Planes& candidate, const Planes& reference, const Legal& legal, Stencils stencils) {
  const auto is_open = [&](Meter& meter, int x, int y, const Winner&, const Winner&, bool) {
    if (legal.empty() || answer_of_winner(legal, candidate, x, y) == nullptr) return false;
    if (answer_of_winner(legal, reference, x, y) != nullptr) return true;
    meter.suspect("its winner is none of the legal ones, ours is");
    return false;
  };
  return compare_winners_at_pixels(candidate, reference, stencils, is_open);
}

namespace {

// Depths that another renderer's frame may hold where the winner writes no depth (depth_mask off): values of the
// fragment that left the candidate's depth and, where a depth test is open (open_pixels.h), of fragments that tie with
// it; also the clear depth, if that ties. With a stencil test at such a pixel, whose outcome depends on earlier
// fragments, every fragment counts as tied.
class DepthsBeneath {
 public:
  DepthsBeneath(const Scene& scene, const Capture& candidate, const DrawIndex& draws)
      : scene_(scene),
        records_(depths_replace(scene) ? none_ : candidate.records),
        draws_(draws),
        fragments_(FragmentsByPixel::covered(scene.frame, records_)),
        offsets_(scene) {
    const std::size_t fragments = records_.covered.size();
    const bool are_known = records_.drawn.size() == fragments && records_.depth.size() == fragments;
    if (are_known && fragments > 0) open_ = open_by_depth(scene, candidate);
  }
  // Calls visit(depth - z, bound [u]) for each such depth, if a fragment or the clear value left z.
  template <class Visit>
  void each(int x, int y, double z, double factor, Visit visit) const {
    if (open_.empty()) return;
    const auto leaves = [&](std::size_t i) {
      const Draw* draw = draws_.draw(triangle_of(i).primitive);
      return draw != nullptr && draw->merge.depth_mask;
    };
    std::optional<Values> left;
    bool by_stencil = false;
    fragments_.each(x, y, [&](std::size_t i) {
      const Draw* draw = draws_.draw(triangle_of(i).primitive);
      by_stencil = by_stencil || (draw != nullptr && draw->stencil);
      if (records_.drawn[i].drawn && records_.depth[i] == z && leaves(i)) left = values(i, x, y);
    });
    if (!left && z == static_cast<double>(scene_.frame.clear_depth)) left = Values{{z}, 0};  // nothing was drawn
    if (!left) return;
    const auto of_left = std::ranges::minmax(left->depths);
    const auto is_near = [&](const Values& of) {
      const double reach = factor * u * (left->bound + of.bound) + depth_step(scene_.frame.depth, z);
      const auto [low, high] = std::ranges::minmax(of.depths);
      return low <= of_left.max + reach && high >= of_left.min - reach;
    };
    const bool is_open = open_(x, y) != 0;
    fragments_.each(x, y, [&](std::size_t i) {
      if (!leaves(i)) return;
      const Values of = values(i, x, y);
      if (records_.depth[i] != z && !(is_open && (by_stencil || is_near(of)))) return;
      for (const double depth : of.depths) visit(depth - z, of.bound);
    });
    const double cleared = scene_.frame.clear_depth;
    if (is_open && is_near({{cleared}, 0})) visit(cleared - z, 0);
  }

 private:
  struct Values {
    std::vector<double> depths;
    double bound;
  };
  const WindowTriangle<double>& triangle_of(std::size_t i) const {
    return records_.triangles[records_.covered[i].triangle];
  }
  Values values(std::size_t i, int x, int y) const {
    const WindowTriangle<double>& triangle = triangle_of(i);
    const auto primitive = static_cast<std::int32_t>(triangle.primitive);
    const DepthLimits limits = depth_limits(draws_, primitive);
    const PlaneBounds bounds = bounds_from_origin(triangle, x, y, limits);
    Values out{{records_.depth[i], records_.depth[i] + bounds.line_shift_depth}, bounds.depth + offsets_.of(triangle)};
    for (const EdgeValue& edge : edge_values(triangles_of(records_, primitive), x, y, limits)) {
      out.depths.push_back(edge.depth);
    }
    return out;
  }

  const Scene& scene_;
  const Records<double> none_;
  const Records<double>& records_;
  const DrawIndex& draws_;
  FragmentsByPixel fragments_;
  OffsetErrors offsets_;
  Plane<std::uint8_t> open_;  // empty: no fragment is known
};

}  // namespace

Measurement compare_depth_planes(const Scene& scene, const Capture& candidate, const Capture& reference,
                                 double factor) {
  const Planes &a = candidate.planes, &b = reference.planes;
  const OffsetErrors offsets(scene);
  const DrawIndex draws(scene);
  const DepthsBeneath beneath(scene, candidate, draws);
  const OthersCover others_cover(a, b);
  // True if a fragment beneath the winner that one side lacks may have left the depth.
  const auto others_left_it = [&](int x, int y) { return !depths_replace(scene) && others_cover(x, y); };
  return where_winners_agree(a, b, &Planes::depth, "u", [&](Meter& meter, int x, int y, std::int32_t id) {
    const double z = a.depth(x, y), z_ref = b.depth(x, y);
    const Place place{x, y, id, "z", true};
    if (id == kBackground) {
      meter.value(difference(z, z_ref) / u, 0, place, z, z_ref);
      return;
    }
    if (others_left_it(x, y)) return add_open_value(meter, z, place, z_ref);
    const DepthLimits limits = depth_limits(draws, id);
    const PlaneBounds bounds = primitive_bounds(candidate.records, id, x, y, limits);
    double bound = bounds.depth + offsets.of(candidate.records, id, x, y),
           diff = std::min(difference(z, z_ref), difference(z + bounds.line_shift_depth, z_ref));
    const double step = depth_step(scene.frame.depth, z_ref), reach = factor * u * bound + step;
    const std::vector<EdgeValue> edges = edge_values(triangles_of(candidate.records, id), x, y, limits);
    const auto is_own = [&](const EdgeValue& edge) { return std::abs(edge.depth - z) <= reach; };
    if (std::ranges::any_of(edges, is_own)) {
      for (const EdgeValue& edge : edges) diff = std::min(diff, difference(edge.depth, z_ref));
    }
    beneath.each(x, y, z, factor, [&](double apart, double its_bound) {
      bound = std::max(bound, its_bound);
      diff = std::min(diff, difference(z + apart, z_ref));
    });
    if (!std::isfinite(bound)) return add_open_value(meter, z, place, z_ref);
    meter.value(diff / u, factor * bound, place, z, z_ref, step / u);
  });
}

}  // namespace plumbline::check
