#include "reference/osmesa/gl/context.h"
#include "reference/osmesa/opengl_renderer.h"
#include "reference/osmesa/osmesa.h"

namespace plumbline {

std::unique_ptr<Renderer> make_egl(MesaDriver driver) {
  const char* name = driver == MesaDriver::llvmpipe ? "egl" : "softpipe";
  return osmesa::make_opengl_renderer(name, driver, osmesa::make_egl_context(driver));
}

}  // namespace plumbline
