// The GL state from which every pass starts.
#pragma once

#include "reference/osmesa/gl/gl.h"

namespace plumbline::osmesa {

/// Sets all GL state that reference/osmesa changes to its initial value (OpenGL 2.1, tables 6.5 to 6.33), matrices and
/// array bindings included. Left out: frame buffer and viewport, which each pass takes from its Target.
void set_default_state(const Gl& gl);

/// Scope of one pass: GL's default state at its beginning; at its end the state before it is restored.
/// Restoring alone is not enough: where the saved blend equations are equal, Mesa 22.3.6 restores that of alpha only if
/// that of rgb has changed, too (_mesa_PopAttrib in main/attrib.c).
class PassState {
 public:
  explicit PassState(const Gl& gl) : before_(gl) { set_default_state(gl); }

 private:
  SavedState before_;
};

}  // namespace plumbline::osmesa
