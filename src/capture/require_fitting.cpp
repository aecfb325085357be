#include "capture/require_fitting.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "capture/capture_columns.h"
#include "scene/draw_index.h"

namespace plumbline {

namespace {

void require(bool fits, std::string_view group) {
  if (!fits) throw std::invalid_argument(fmt::format("{}.* does not fit the scene or the other records", group));
}

bool tests_alpha(const Draw& draw) { return draw.alpha_test.has_value(); }

// Whether run_stage(stage) reads the group: groups of inputs_of(stage), less the exceptions below.
bool reads(const Scene& scene, Stage stage, Handed group) {
  if (!inputs_of(stage).has(group.stage) || !has_stage(scene, group.stage)) return false;
  if (group.varying) {
    if (!std::ranges::count(carried(scene), *group.varying)) return false;
    if (group.per < Per::triangle) return true;
    if (is_back(*group.varying)) return false;
    if (stage == Stage::texture) return group.varying == Varying::texture;
    return group.per == Per::fragment || stage == Stage::attributes;
  }
  switch (group.stage) {
    case Stage::matrices: return group.per == Per::light || stage == Stage::vertex || stage == Stage::window;
    case Stage::attributes: return stage != Stage::texture;  // but for the varying, above
    case Stage::shade: return stage != Stage::visibility || std::ranges::any_of(scene.draws, tests_alpha);
    default: return true;
  }
}

// Refuses a group that the stage reads, and that lacks a record for each of its owners.
struct FittingSizes {
  const Scene& scene;
  Stage stage;
  const Records<double>& all;

  void group(Handed group, const auto&, const auto& records) const {
    if (!reads(scene, stage, group)) return;
    require(records.size() == owners(group.per) || (group.per == Per::light && records.empty()), group.name);
  }
  void plane(Handed, const auto&) const {}

 private:
  std::size_t owners(Per per) const {
    if (per == Per::light) return scene.lights.size();
    if (per == Per::draw) return scene.draws.size();
    if (per == Per::vertex) return DrawIndex(scene).vertices();
    return owners_of(all, per).count;
  }
};

struct LackingVarying {
  const Scene& scene;
  Stage stage;
  VaryingsOf of;
  const Records<double>& all;
  std::string name;

  void group(Handed group, const auto&, const auto& records) {
    if (!group.varying || !std::ranges::count(carried(scene), *group.varying)) return;
    const bool ends_before = is_back(*group.varying) && group.per >= Per::triangle;
    const bool is_output = of == VaryingsOf::inputs_and_output && group.stage == stage && !ends_before;
    if (name.empty() && (is_output || reads(scene, stage, group)) && records.empty() &&
        owners_of(all, group.per).count > 0)
      name = group.name;
  }
  void plane(Handed, const auto&) const {}
};

// Whether records are in draw order, of primitives that the scene has, and each has as many corners as its primitive
// allows: a line 2, a point 1, what is left of a filled triangle 3 to `most`, of an unfilled one `least` to `most`.
bool fit(const Scene& scene, const auto& records, auto corners_of, std::uint32_t least, std::uint32_t most) {
  const DrawIndex draws(scene);
  const auto fits = [&](const auto& record) {
    const Draw* draw = draws.draw(record.primitive);
    if (draw == nullptr) return false;
    const std::uint32_t corners = corners_of(record), of_mesh = corner_count(scene.meshes[draw->mesh].topology);
    const bool filled = is_filled(*draw);
    return of_mesh < 3 ? corners == of_mesh : corners >= (filled ? 3 : least) && corners <= most;
  };
  return std::ranges::is_sorted(records, {}, [](const auto& r) { return r.primitive; }) &&
         std::ranges::all_of(records, fits);
}

}  // namespace

std::string lacking_varying(const Scene& scene, Stage stage, VaryingsOf of, const Capture& in) {
  LackingVarying out{scene, stage, of, in.records, ""};
  visit_capture(out, in);
  return out.name;
}

void require_fitting(const Scene& scene, Stage stage, const Capture& in) {
  const Records<double>& r = in.records;
  visit_capture(FittingSizes{scene, stage, r}, in);
  const std::size_t corners = r.polygons.vertices.size();
  const auto in_corners = [&](const ClipPolygon& p) { return p.first <= corners && p.count <= corners - p.first; };
  if (stage == Stage::window)
    require(fit(
                scene, r.polygons.polygons, [](const ClipPolygon& p) { return p.count; }, 3, kMostPolygonVertices) &&
                std::ranges::all_of(r.polygons.polygons, in_corners),
            "clip.polygon");
  if (kGeometryStages.has(stage)) return;
  const auto has_width = [](const auto& t) { return t.width >= 1 && t.width <= 64; };
  require(fit(
              scene, r.triangles, [](const auto& t) { return t.corners; }, 1, 3) &&
              std::ranges::all_of(r.triangles, has_width),
          "window");
  if (stage == Stage::coverage) return;
  const auto inside = [&](const Covered& c) {
    return c.triangle < r.triangles.size() && c.x < scene.frame.width && c.y < scene.frame.height;
  };
  require(std::ranges::all_of(r.covered, inside) && std::ranges::is_sorted(r.covered, {}, &Covered::triangle),
          "coverage");
  if (stage != Stage::merge) return;
  require(r.drawn.empty() || r.drawn.size() == r.covered.size(), "visibility");
  const Plane<std::int32_t>& id = in.planes.id;
  const bool winners_fit = id.width() == scene.frame.width && id.height() == scene.frame.height;
  if (!id.empty() && !winners_fit) throw std::invalid_argument("planes.id is not of the frame's size");
}

}  // namespace plumbline
