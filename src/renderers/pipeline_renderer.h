// Our pipeline behind the interface that all renderers share.
#pragma once

#include <memory>

#include "capture/renderer.h"
#include "pipeline/render.h"

namespace plumbline::pipeline {

/// Name "ours". Shows and runs every stage; resolve shows in antialiased scenes alone.
/// Pictures are the painter's (painter.h), what is watched its definition's: the same bits.
std::unique_ptr<Renderer> make_pipeline();
/// Of other stage functions.
std::unique_ptr<Renderer> make_pipeline(const Stages& stages);

}  // namespace plumbline::pipeline
