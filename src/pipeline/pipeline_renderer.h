// Our pipeline behind the interface that all renderers share.
#pragma once

#include <memory>

#include "pipeline/render.h"
#include "stages/renderer.h"

namespace plumbline::pipeline {

/// Name "ours". Shows and runs every stage; resolve shows in antialiased scenes alone.
std::unique_ptr<Renderer> make_pipeline(const Stages& stages = production_stages());

}  // namespace plumbline::pipeline
