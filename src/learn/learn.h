// Conventions of a renderer, found from its pictures and depths alone.
#pragma once

#include <string>

#include "learn/prober.h"

namespace plumbline::learn {

/// Draws the probes. Throws RendererFailed if the first probe or any three others fail, and Unsupported where the
/// renderer cannot draw a rectangle.
Learned learn(Renderer& renderer);

/// A table for people: each convention, its evidence, and what no convention explains.
std::string learned_text(const Learned& learned);

}  // namespace plumbline::learn
