// The Embree reference: rays through the pixels' centres, in homogeneous space, each hit confirmed in double.
#pragma once

#include <memory>

#include "capture/renderer.h"

namespace plumbline::embree {

/// A renderer named "embree": an oracle. It hands out legal answers, planes as double precision has them,
/// and, where a request names pixels, all hits there (oracle.h). Embree
/// finds the triangles; no number of its own is used. capture() throws Unsupported where a vertex is not finite or
/// beyond Embree's range, naming it, and RendererFailed where the device reports an error.
std::unique_ptr<Renderer> make_embree();

}  // namespace plumbline::embree
