#include "reference/osmesa/osmesa.h"

#include "reference/osmesa/gl/context.h"
#include "reference/osmesa/opengl_renderer.h"

namespace plumbline {

std::unique_ptr<Renderer> make_osmesa(MesaDriver driver) {
  const char* name = driver == MesaDriver::llvmpipe ? "osmesa" : "softpipe";
  return osmesa::make_opengl_renderer(name, driver, osmesa::make_osmesa_context(driver));
}

}  // namespace plumbline
