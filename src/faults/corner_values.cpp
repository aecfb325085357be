// Barycentric coordinates in another order, for depths and attributes. The last list: where depths are
// constant, a fault of the attributes alone draws the same frame, and is named first.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "faults/lists.h"
#include "faults/variants.h"
#include "pipeline/geometry.h"

namespace plumbline::faults {

namespace {

using pipeline::ShadedTriangle;
using pipeline::WindowVertex;

// Corner i of each triangle has the depth, w and attributes of corners[i]. An uncut triangle has its second corner
// first, its first last.
template <std::size_t... corners>
void values_of(const pipeline::DrawInput& input, const pipeline::Polygon& polygon, std::vector<ShadedTriangle>& out) {
  const std::size_t first = out.size();
  pipeline::to_window(input, polygon, out);
  for (ShadedTriangle& t : std::span(out).subspan(first)) {
    if (t.corners != 3) continue;
    const ShadedTriangle right = t;
    t.attributes = {right.attributes[corners]...};
    const std::array<WindowVertex, 3> from = {right.v[corners]...};
    for (std::size_t i = 0; i < 3; ++i) t.v[i].p_win.z = from[i].p_win.z, t.v[i].inv_w = from[i].inv_w;
  }
}

template <std::size_t... corners>
constexpr Fault in_order(std::string_view name, std::string_view changes) {
  return stage_fault(name, changes, put<&pipeline::Stages::window, values_of<corners...>>);
}

constexpr std::array kCornerValues = {
    in_order<0, 2, 1>("window.values_swapped", "two corners have each other's depth and attributes"),
    in_order<2, 1, 0>("window.first_values_swapped", "the first two corners have each other's depth and attributes"),
    in_order<1, 0, 2>("window.last_values_swapped", "the last two corners have each other's depth and attributes"),
    in_order<1, 2, 0>("window.next_values", "each corner has the depth and attributes of the next"),
    in_order<2, 0, 1>("window.values_before", "each corner has the depth and attributes of the one before it"),
};

}  // namespace

std::span<const Fault> of_corner_values() { return kCornerValues; }

}  // namespace plumbline::faults
