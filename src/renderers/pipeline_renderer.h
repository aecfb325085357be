// Our pipeline behind the Renderer interface (capture/renderer.h).
#pragma once

#include <memory>

#include "capture/renderer.h"
#include "pipeline/render.h"

namespace plumbline::pipeline {

/// Renderer "ours". Shows and runs every stage; resolve shows in antialiased scenes alone. Pictures (no records asked
/// for, WantedPlanes::picture) are the painter's (painter.h), all other captures the definition's (render.h): the same
/// bits. capture() throws OverBudget, and std::invalid_argument where no painter has the name that was asked for.
std::unique_ptr<Renderer> make_pipeline();
/// Renderer "definition": pictures are the definition's, too.
std::unique_ptr<Renderer> make_definition();
/// Renderer "ours" of other stage functions: pictures and captures are render()'s with `stages`.
std::unique_ptr<Renderer> make_pipeline(const Stages& stages);

}  // namespace plumbline::pipeline
