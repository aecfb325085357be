// What a polygon must be, to be cut into triangles in one way that everybody expects.
#pragma once

#include <span>
#include <string>

#include <glm/glm.hpp>

namespace plumbline {

/// What is wrong with a polygon of three corners or more, in words that follow "found"; empty if nothing is. It must be
/// flat (no corner further from its plane than a 128th of its extent), have an area, and not touch itself.
/// A triangle is always right. Corners are finite.
std::string polygon_fault(std::span<const glm::dvec3> corners);

}  // namespace plumbline
