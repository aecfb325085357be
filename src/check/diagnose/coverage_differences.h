// Triangles that cover different pixels on the candidate's and on the expected side.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/diagnose/evidence.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

/// One triangle's pixels: on both sides, missing from the candidate's, extra in the candidate's.
struct CoverageDifference {
  std::uint32_t triangle = 0;
  std::vector<glm::ivec2> both, missing, extra;
};

/// One for each triangle whose pixels differ, in ascending order.
std::vector<CoverageDifference> coverage_differences(const Evidence& evidence);

/// The triangle with the most missing and extra pixels, the first of several; among those for which the pixel `worst`
/// is missing or extra, if any (a tie rule may leave larger differences elsewhere, which are legal). None: no triangle
/// differs.
std::optional<CoverageDifference> worst_triangle(const Evidence& evidence, const Place& worst);

/// Text picture, highest y first: `#` both, `?` missing, `!` extra, `.` neither. At most 64 x 32 pixels about the first
/// that differs; the line above it names the lower left pixel.
std::string coverage_picture(const CoverageDifference& triangle);

}  // namespace plumbline::check
