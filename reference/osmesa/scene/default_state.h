// The GL state from which every pass starts.
#pragma once

#include "reference/osmesa/gl/gl.h"

namespace plumbline::osmesa {

/// Sets every piece of GL state that this folder changes to its initial value (OpenGL 2.1, tables 6.5 to 6.33),
/// matrices and array bindings included. Left out: frame buffer and viewport, which each pass takes from its Target.
void set_default_state(const Gl& gl);

/// State of one pass: GL's default when the pass begins, the state before the pass when it ends.
/// The pop alone would leave one pass' state to the next: back to equal blend equations, Mesa 22.3.6 restores that of
/// alpha only if that of rgb is another, too (_mesa_PopAttrib in main/attrib.c).
class PassState {
 public:
  explicit PassState(const Gl& gl) : before_(gl) { set_default_state(gl); }

 private:
  SavedState before_;
};

}  // namespace plumbline::osmesa
