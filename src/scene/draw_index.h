// Look-up of the draw to which a vertex or primitive of the scene belongs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace plumbline {

/// Index of a scene's draws by vertex and primitive numbers, which run over all draws (DrawRange). The scene has to
/// outlive the index, unchanged.
class DrawIndex {
 public:
  explicit DrawIndex(const Scene& scene) : scene_(&scene), ranges_(draw_ranges(scene)) {}

  /// Index into Scene::draws of the draw that a vertex or a primitive belongs to; nullopt: no such number in the scene.
  std::optional<std::size_t> of_vertex(std::size_t vertex) const {
    return find<&DrawRange::first_vertex, &DrawRange::vertex_count>(vertex);
  }
  std::optional<std::size_t> of_primitive(std::uint32_t primitive) const {
    return find<&DrawRange::first_primitive, &DrawRange::primitive_count>(primitive);
  }
  /// The primitive's draw; null: no such primitive in the scene.
  const Draw* draw(std::uint32_t primitive) const {
    const auto number = of_primitive(primitive);
    return number ? &scene_->draws[*number] : nullptr;
  }
  /// Vertex numbers of a primitive's corners. Throws std::bad_optional_access: no such primitive in the scene.
  glm::uvec3 corners(std::uint32_t primitive) const {
    const std::size_t d = of_primitive(primitive).value();
    const Mesh& mesh = scene_->meshes[scene_->draws[d].mesh];
    return mesh.triangles[primitive - ranges_[d].first_primitive] + ranges_[d].first_vertex;
  }
  const Scene& scene() const { return *scene_; }
  /// One range per draw.
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
