// Which pixels two sides' triangles cover, where they differ.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/diagnose/evidence.h"

namespace plumbline::check {

/// One triangle's pixels on both sides.
struct CoverageDifference {
  std::uint32_t triangle = 0;
  std::vector<glm::ivec2> both, missing, extra;
};

/// Of each triangle whose pixels differ, in order.
std::vector<CoverageDifference> coverage_differences(const Evidence& evidence);

/// The one of them with the most missing and extra pixels, the first of several; of those where `worst` is one of these
/// pixels, if there are such. (Beside it a tie rule may leave larger ones, which are legal.)
std::optional<CoverageDifference> worst_triangle(const Evidence& evidence, const Place& worst);

/// `#` both, `?` missing, `!` extra, rows from the last to the first, at most 64 x 32 about what differs; above it a
/// line that says where the lower left character is.
std::string coverage_picture(const CoverageDifference& triangle);

}  // namespace plumbline::check
