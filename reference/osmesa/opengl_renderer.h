// A renderer that draws by OpenGL's fixed function, in any Context.
#pragma once

#include <memory>
#include <string>

#include "capture/renderer.h"
#include "reference/osmesa/gl/context.h"

namespace plumbline::osmesa {

/// Makes the renderer that osmesa.h describes. Throws RendererFailed if the context is not one of `driver`.
std::unique_ptr<Renderer> make_opengl_renderer(std::string name, MesaDriver driver, std::unique_ptr<Context> context);

}  // namespace plumbline::osmesa
