// Search of the triangles at each pixel by Embree.
#pragma once

#include <string>

#include "reference/arithmetic/project.h"
#include "reference/oracle/candidates.h"

namespace plumbline::embree {

/// Adds each triangle that a ray through a pixel's centre (or sample) hits, hidden ones included, up to Embree's own
/// float rounding. Throws Unsupported (a vertex beyond Embree's range), RendererFailed (the device reports an
/// error) and OverBudget.
void add_by_rays(const math::Projected& projected, math::Candidates& out);

/// Embree's version, such as "3.13.5", as the device reports it. Throws RendererFailed where no device can be made.
std::string version();

}  // namespace plumbline::embree
