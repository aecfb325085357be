#include "capture/require_fitting.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "scene/draw_of.h"

namespace plumbline {

namespace {

void require(bool fits, const std::string& records) {
  if (!fits) throw std::invalid_argument("records." + records + " does not fit the scene or the other records");
}

// In draw order, and of primitives that the scene has.
template <class Record>
bool in_draw_order(const std::vector<Record>& records, std::uint32_t primitives) {
  return std::is_sorted(records.begin(), records.end(),
                        [](const auto& a, const auto& b) { return a.primitive < b.primitive; }) &&
         (records.empty() || records.back().primitive < primitives);
}

// A line has 2 corners, a point 1, what is left of a triangle 3 to `most`; of one that is not filled,
// `least_of_triangle` are enough.
bool corners_fit(const Scene& scene, const std::vector<DrawRange>& ranges, std::uint32_t primitive,
                 std::uint32_t corners, std::uint32_t least_of_triangle, std::uint32_t most) {
  const Draw& draw = scene.draws[draw_of(ranges, primitive).value()];
  const std::uint32_t of_mesh = corner_count(scene.meshes[draw.mesh].topology);
  if (of_mesh < 3) return corners == of_mesh;
  const bool filled = draw.front_mode == PolygonMode::fill && draw.back_mode == PolygonMode::fill;
  return corners >= (filled ? 3 : least_of_triangle) && corners <= most;
}

// The columns of the varyings that the stage reads.
void require_columns(const Scene& scene, Stage stage, const Records<double>& r) {
  for (const Varying v : carried(scene)) {
    const VaryingColumns<double>& columns = r.varyings[v];
    const std::string name(name_of(v));
    if (stage == Stage::clip) require(columns.vertices.size() == r.vertices.size(), "varyings." + name);
    if (stage == Stage::window) require(columns.clipped.size() == r.polygons.vertices.size(), "varyings." + name);
    if (is_back(v)) continue;
    if (stage == Stage::attributes) require(columns.triangles.size() == r.triangles.size(), "varyings." + name);
    if (stage == Stage::texture && v == Varying::texture) {
      require(columns.triangles.size() == r.triangles.size() && columns.fragments.size() == r.covered.size(),
              "varyings." + name);
    }
    if (stage == Stage::shade) require(columns.fragments.size() == r.covered.size(), "varyings." + name);
  }
}

}  // namespace

void require_fitting(const Scene& scene, Stage stage, const Capture& in) {
  const Records<double>& r = in.records;
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  const DrawRange end = ranges.empty() ? DrawRange{0, 0, 0, 0} : ranges.back();
  const std::size_t vertices = end.first_vertex + end.vertex_count;
  const std::uint32_t primitives = end.first_primitive + end.primitive_count;
  if (stage == Stage::vertex || stage == Stage::window) require(r.matrices.size() == scene.draws.size(), "matrices");
  if (stage == Stage::light || stage == Stage::shade) {
    require(r.lights.empty() || r.lights.size() == scene.lights.size(), "lights");
  }
  if (stage == Stage::light || stage == Stage::clip) require(r.vertices.size() == vertices, "vertices");
  if (stage == Stage::clip) require(r.lit.size() == vertices, "lit");
  if (stage == Stage::window) {
    const std::size_t n = r.polygons.vertices.size();
    const auto fits = [&](const ClipPolygon& p) {
      return corners_fit(scene, ranges, p.primitive, p.count, 3, 9) && p.first <= n && p.count <= n - p.first;
    };
    const auto& polygons = r.polygons.polygons;
    require(in_draw_order(polygons, primitives) && std::all_of(polygons.begin(), polygons.end(), fits), "polygons");
  }
  require_columns(scene, stage, r);
  if (stage <= Stage::window) return;
  const auto has_corners = [&](const auto& t) {
    return corners_fit(scene, ranges, t.primitive, t.corners, 1, 3) && t.width >= 1 && t.width <= 64;
  };
  require(in_draw_order(r.triangles, primitives) && std::all_of(r.triangles.begin(), r.triangles.end(), has_corners),
          "triangles");
  if (stage == Stage::coverage) return;
  const auto inside = [&](const Covered& c) {
    return c.triangle < r.triangles.size() && c.x < scene.frame.width && c.y < scene.frame.height;
  };
  const auto before = [](const Covered& a, const Covered& b) { return a.triangle < b.triangle; };
  require(std::all_of(r.covered.begin(), r.covered.end(), inside), "covered");
  require(std::is_sorted(r.covered.begin(), r.covered.end(), before), "covered");
  if (stage == Stage::shade && textured(scene)) require(r.texels.size() == r.covered.size(), "texels");
  if (stage == Stage::shade) require(r.attributes.size() == r.covered.size(), "attributes");
  if (stage < Stage::visibility) return;
  require(r.depth.size() == r.covered.size(), "depth");
  const bool by_alpha = std::any_of(scene.draws.begin(), scene.draws.end(), [](const Draw& d) { return d.alpha_test; });
  if (stage != Stage::merge && !by_alpha) return;
  require(r.shaded.size() == r.covered.size(), "shaded");
  require(r.drawn.empty() || r.drawn.size() == r.covered.size(), "drawn");
  const bool winners_fit = in.planes.id.width() == scene.frame.width && in.planes.id.height() == scene.frame.height;
  if (!in.planes.id.empty() && !winners_fit) throw std::invalid_argument("planes.id is not of the frame's size");
}

}  // namespace plumbline
