// A renderer that draws by OpenGL's fixed function, wherever its context comes from.
#pragma once

#include <memory>
#include <string>

#include "capture/renderer.h"
#include "reference/osmesa/gl/context.h"

namespace plumbline::osmesa {

/// What it shows: osmesa.h. Throws RendererFailed if the context is none of `driver`'s.
std::unique_ptr<Renderer> make_opengl_renderer(std::string name, MesaDriver driver, std::unique_ptr<Context> context);

}  // namespace plumbline::osmesa
