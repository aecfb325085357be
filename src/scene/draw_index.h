// Draws of a scene's vertices and primitives, which are numbered over all draws.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace plumbline {

/// The scene has to outlive it.
class DrawIndex {
 public:
  explicit DrawIndex(const Scene& scene) : scene_(&scene), ranges_(draw_ranges(scene)) {}

  /// Number, in Scene::draws, of the draw that a vertex or a primitive is of; none: the scene has no such one.
  std::optional<std::size_t> of_vertex(std::size_t vertex) const {
    return find<&DrawRange::first_vertex, &DrawRange::vertex_count>(vertex);
  }
  std::optional<std::size_t> of_primitive(std::uint32_t primitive) const {
    return find<&DrawRange::first_primitive, &DrawRange::primitive_count>(primitive);
  }
  /// The primitive's draw; null: the scene has no such primitive.
  const Draw* draw(std::uint32_t primitive) const {
    const auto number = of_primitive(primitive);
    return number ? &scene_->draws[*number] : nullptr;
  }
  /// Numbers of the corners' vertices, of a primitive that the scene has.
  glm::uvec3 corners(std::uint32_t primitive) const {
    const std::size_t d = of_primitive(primitive).value();
    const Mesh& mesh = scene_->meshes[scene_->draws[d].mesh];
    return mesh.triangles[primitive - ranges_[d].first_primitive] + ranges_[d].first_vertex;
  }
  const Scene& scene() const { return *scene_; }
  /// One for each draw.
  const std::vector<DrawRange>& ranges() const { return ranges_; }
  std::size_t vertices() const {
    return ranges_.empty() ? 0 : ranges_.back().first_vertex + ranges_.back().vertex_count;
  }
  std::size_t primitives() const {
    return ranges_.empty() ? 0 : ranges_.back().first_primitive + ranges_.back().primitive_count;
  }

 private:
  template <auto first, auto count>
  std::optional<std::size_t> find(std::size_t number) const {
    const auto after = std::ranges::upper_bound(ranges_, number, {}, first);
    if (after == ranges_.begin()) return std::nullopt;
    const DrawRange& range = *(after - 1);
    if (number - range.*first >= range.*count) return std::nullopt;
    return static_cast<std::size_t>(after - 1 - ranges_.begin());
  }

  const Scene* scene_;
  std::vector<DrawRange> ranges_;
};

}  // namespace plumbline
