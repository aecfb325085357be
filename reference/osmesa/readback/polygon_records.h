// GL's records of stages 3 and 4, by feedback mode.
#pragma once

#include <span>
#include <string_view>

#include "capture/renderer.h"
#include "reference/osmesa/gl/mesa_driver.h"
#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// Appends to records.polygons and records.triangles, as far as the request has stages 3 and 4. `lit`: the colours of
/// all draws' vertices. Call with a Target bound. Throws Unsupported where clipping exceeds float's range or cuts an
/// unfilled triangle (Mesa draws no edges there), RendererFailed where the feedback is not as expected.
void read_polygons(const Gl& gl, const SceneInGl& scene, std::span<const Lit<double>> lit, const Request& request,
                   Records<double>& records);

/// Whether read_polygons() ends the process for this scene. Mesa 25 segfaults there in LLVM (LLVMBuildSelect) where
/// feedback mode runs a vertex program that branches; such a program lights the draws that are lit on two sides and
/// that needs_light_program(). Measured: Mesa 22.3.6 does not, 25.0.7 does, versions between were not tried; softpipe
/// does not. feedback_crash_test.cpp fails where the Mesa at hand does otherwise. `gl_version`: GL_VERSION.
bool crashes_in_feedback(const Scene& scene, MesaDriver driver, std::string_view gl_version);

}  // namespace plumbline::osmesa
