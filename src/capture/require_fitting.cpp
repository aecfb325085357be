#include "capture/require_fitting.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "scene/draw_index.h"

namespace plumbline {

namespace {

void require(bool fits, std::string_view records) {
  if (!fits)
    throw std::invalid_argument(fmt::format("records.{} does not fit the scene or the other records", records));
}

// Whether records are in draw order, of primitives that the scene has, and each with as many corners as its primitive
// may have: a line 2, a point 1, what is left of a triangle 3 to `most`; of one that is not filled `least` are enough.
bool fit(const Scene& scene, const auto& records, auto corners_of, std::uint32_t least, std::uint32_t most) {
  const DrawIndex draws(scene);
  const auto fits = [&](const auto& record) {
    const Draw* draw = draws.draw(record.primitive);
    if (draw == nullptr) return false;
    const std::uint32_t corners = corners_of(record), of_mesh = corner_count(scene.meshes[draw->mesh].topology);
    const bool filled = draw->front_mode == PolygonMode::fill && draw->back_mode == PolygonMode::fill;
    return of_mesh < 3 ? corners == of_mesh : corners >= (filled ? 3 : least) && corners <= most;
  };
  return std::ranges::is_sorted(records, {}, [](const auto& r) { return r.primitive; }) &&
         std::ranges::all_of(records, fits);
}

}  // namespace

void require_fitting(const Scene& scene, Stage stage, const Capture& in) {
  const Records<double>& r = in.records;
  const std::size_t vertices = DrawIndex(scene).vertices();
  const std::size_t triangles = r.triangles.size(), fragments = r.covered.size();
  const auto read_by = [&](std::initializer_list<Stage> stages) { return std::ranges::count(stages, stage) > 0; };
  if (read_by({Stage::vertex, Stage::window})) require(r.matrices.size() == scene.draws.size(), "matrices");
  if (read_by({Stage::light, Stage::shade}))
    require(r.lights.empty() || r.lights.size() == scene.lights.size(), "lights");
  if (read_by({Stage::light, Stage::clip})) require(r.vertices.size() == vertices, "vertices");
  if (stage == Stage::clip) require(r.lit.size() == vertices, "lit");
  const std::size_t corners = r.polygons.vertices.size();
  const auto in_corners = [&](const ClipPolygon& p) { return p.first <= corners && p.count <= corners - p.first; };
  if (stage == Stage::window)
    require(fit(
                scene, r.polygons.polygons, [](const ClipPolygon& p) { return p.count; }, 3, kMostPolygonVertices) &&
                std::ranges::all_of(r.polygons.polygons, in_corners),
            "polygons");
  for (const Varying v : carried(scene)) {
    const VaryingColumns<double>& columns = r.varyings[v];
    const bool of_texture = stage == Stage::texture && v == Varying::texture;
    bool fits = (stage != Stage::clip || columns.vertices.size() == r.vertices.size()) &&
                (stage != Stage::window || columns.clipped.size() == corners);
    if (!is_back(v) && (stage == Stage::attributes || of_texture)) fits &= columns.triangles.size() == triangles;
    if (!is_back(v) && (stage == Stage::shade || of_texture)) fits &= columns.fragments.size() == fragments;
    require(fits, fmt::format("varyings.{}", name_of(v)));
  }
  if (kGeometryStages.has(stage)) return;
  const auto has_width = [](const auto& t) { return t.width >= 1 && t.width <= 64; };
  require(fit(
              scene, r.triangles, [](const auto& t) { return t.corners; }, 1, 3) &&
              std::ranges::all_of(r.triangles, has_width),
          "triangles");
  if (stage == Stage::coverage) return;
  const auto inside = [&](const Covered& c) {
    return c.triangle < triangles && c.x < scene.frame.width && c.y < scene.frame.height;
  };
  require(std::ranges::all_of(r.covered, inside) && std::ranges::is_sorted(r.covered, {}, &Covered::triangle),
          "covered");
  if (stage == Stage::shade && textured(scene)) require(r.texels.size() == fragments, "texels");
  if (stage == Stage::shade) require(r.attributes.size() == fragments, "attributes");
  if (stage < Stage::visibility) return;
  require(r.depth.size() == fragments, "depth");
  const bool by_alpha = std::ranges::any_of(scene.draws, [](const Draw& d) { return d.alpha_test.has_value(); });
  if (stage != Stage::merge && !by_alpha) return;
  require(r.shaded.size() == fragments, "shaded");
  require(r.drawn.empty() || r.drawn.size() == fragments, "drawn");
  const Plane<std::int32_t>& id = in.planes.id;
  const bool winners_fit = id.width() == scene.frame.width && id.height() == scene.frame.height;
  if (!id.empty() && !winners_fit) throw std::invalid_argument("planes.id is not of the frame's size");
}

}  // namespace plumbline
