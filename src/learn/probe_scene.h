// Probes: scenes made to show one convention of a renderer.
#pragma once

#include <array>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "capture/conventions.h"
#include "scene/scene.h"

namespace plumbline::learn {

/// A corner in the window: x and y in pixels from the lower left corner, z a depth, 0 near and 1 far.
struct ProbeCorner {
  glm::dvec3 p;
  glm::vec4 color{1};
  glm::vec2 texcoord{0};
};

/// Depth of probes that ask for nothing of it: inside OpenGL's view volume, and inside its far half.
inline constexpr double kFlatDepth = 0.75;

/// Depth in OpenGL's view volume, [0,1], at which the renderer's view volume yields the depth `z`. The volume [0,w] in
/// z is the far half of OpenGL's.
inline double in_volume(const Conventions& conventions, double z) {
  return conventions.clip_depth == Conventions::ClipDepth::zero_to_w ? (1 + z) / 2 : z;
}

/// A black frame, and no draw. Model space is the window (ProbeCorner): with sides of powers of two, and positions at
/// multiples of 2^-10 pixel, floats on the way to the window are exact.
Scene probe_frame(std::string name, int width, int height);

/// Adds an unlit draw of the triangles. Prober::draw() chooses the depth function.
Draw& add_triangles(Scene& scene, std::span<const std::array<ProbeCorner, 3>> triangles);

/// Two triangles that fill [low, high) at one depth, in one colour.
std::array<std::array<ProbeCorner, 3>, 2> rectangle(glm::dvec2 low, glm::dvec2 high, double z, const glm::vec4& color);
/// Two triangles of four corners, in turn.
std::array<std::array<ProbeCorner, 3>, 2> quad(const std::array<ProbeCorner, 4>& corners);

/// True: a probe's white covers the pixel.
inline bool is_white(const glm::vec4& color) { return color.r > 0.5f; }

}  // namespace plumbline::learn
