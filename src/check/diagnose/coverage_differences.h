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

/// Triangle with the most missing and extra pixels (the first, if several have as many). If the pixel `worst` is
/// missing or extra in any triangle, only such triangles count: elsewhere a tie rule may leave larger differences,
/// which are legal. nullopt: no triangle differs.
std::optional<CoverageDifference> worst_triangle(const Evidence& evidence, const Place& worst);

/// Text picture, highest y first: `#` both, `?` missing, `!` extra, `.` neither. At most 64 x 32 pixels about the first
/// missing pixel (none: the first extra pixel); the line above the picture names its lower left pixel.
std::string coverage_picture(const CoverageDifference& triangle);

}  // namespace plumbline::check
