// Embree as a finder of triangles.
#pragma once

#include <string>

#include "reference/arithmetic/project.h"
#include "reference/oracle/candidates.h"

namespace plumbline::embree {

/// Every triangle that a ray through a pixel's centre hits, behind others or not, up to Embree's own float rounding.
/// Throws Unsupported (a vertex beyond Embree's range), RendererFailed.
void add_by_rays(const math::Projected& projected, math::Candidates& out);

/// "3.13.5", as the device reports it. Throws RendererFailed.
std::string version();

}  // namespace plumbline::embree
