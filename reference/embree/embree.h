// The Embree reference: rays through pixel centres (or samples), in homogeneous space, each hit confirmed in double.
#pragma once

#include <memory>

#include "capture/renderer.h"

namespace plumbline::embree {

/// A renderer named "embree": an oracle. Its captures have legal answers, planes in double and, where a request names
/// pixels, all hits there (oracle.h). Embree only finds the triangles; none of its numbers is used. capture() throws
/// Unsupported where the scene draws lines or points, and where a vertex (named in the message) is not finite or beyond
/// Embree's range; RendererFailed where the device reports an error; OverBudget where the request's budget does not
/// suffice. make_embree() throws RendererFailed where no device can be made.
std::unique_ptr<Renderer> make_embree();

}  // namespace plumbline::embree
