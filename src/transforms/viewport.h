// Viewport matrices, from NDC to the window [pixels], of three notes, and their inverses.
#pragma once

#include <glm/glm.hpp>

namespace plumbline::transforms {

namespace gzrender {

/// X_sp, class notes (004) 3.2; M_screen, GzRender (000): x, y in [-1, 1] to [0, xs] x [0, ys], y down from the upper
/// left corner; z in [0, 1] to [0, maxint]. Pixel centres are at whole numbers in this dialect: half a pixel off GL.
glm::dmat4 x_sp(double xs, double ys, double maxint);
glm::dmat4 inverse_x_sp(double xs, double ys, double maxint);

}  // namespace gzrender

namespace games101 {

/// M_viewport, GAMES101 (001) "Canonical Cube to Screen": x, y in [-1, 1] to [0, width] x [0, height], y up from the
/// lower left corner, pixel centres at halves; z stays. In x and y, GL's viewport.
glm::dmat4 viewport(double width, double height);
glm::dmat4 inverse_viewport(double width, double height);

}  // namespace games101

namespace tinyrenderer {

/// TinyRenderer (002) "Viewport Matrix": the cube [-1, 1]^3 to [x, x + w] x [y, y + h] x [0, depth], y up. Pixel
/// centres are at whole numbers in this dialect, too.
glm::dmat4 viewport(double x, double y, double w, double h, double depth);
glm::dmat4 inverse_viewport(double x, double y, double w, double h, double depth);

}  // namespace tinyrenderer

}  // namespace plumbline::transforms
