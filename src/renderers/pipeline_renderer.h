// Our pipeline behind the interface that all renderers share.
#pragma once

#include <memory>

#include "capture/renderer.h"
#include "pipeline/render.h"

namespace plumbline::pipeline {

/// Name "ours". Shows and runs every stage; resolve shows in antialiased scenes alone. Pictures are the painter's
/// (painter.h), captures with records the definition's (render.h): the same bits.
std::unique_ptr<Renderer> make_pipeline();
/// Name "definition": pictures are the definition's, too.
std::unique_ptr<Renderer> make_definition();
/// Name "ours", of other stage functions; pictures are the definition's.
std::unique_ptr<Renderer> make_pipeline(const Stages& stages);

}  // namespace plumbline::pipeline
