#include "reference/osmesa/osmesa.h"

namespace plumbline {

std::unique_ptr<Renderer> make_opengl(MesaDriver driver) {
#ifdef PLUMBLINE_OSMESA
  return make_osmesa(driver);
#else
  return make_egl(driver);
#endif
}

}  // namespace plumbline
