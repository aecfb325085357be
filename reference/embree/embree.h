// The Embree reference: rays through the pixels' centres, in homogeneous space, each hit confirmed in double.
#pragma once

#include <memory>

#include "capture/renderer.h"

namespace plumbline::embree {

/// A renderer named "embree": an oracle. Hands out legal answers, planes in double precision and, where a request names
/// pixels, all hits there (oracle.h). Embree only finds the triangles; none of its numbers is used. capture() throws
/// Unsupported where the scene draws lines or points, or where a vertex (named in the message) is not finite or beyond
/// Embree's range, and RendererFailed where the device reports an error.
std::unique_ptr<Renderer> make_embree();

}  // namespace plumbline::embree
