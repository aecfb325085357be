#include "reference/osmesa/gl/context.h"

namespace plumbline::osmesa {

std::unique_ptr<Context> make_opengl_context(MesaDriver driver, ShaderCode code) {
#ifdef PLUMBLINE_OSMESA
  return make_osmesa_context(driver, code);
#else
  return make_egl_context(driver, code);
#endif
}

}  // namespace plumbline::osmesa
