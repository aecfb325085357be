#include "reference/exact/selection.h"

#include <algorithm>

namespace plumbline::exact {

Selection::Selection(const Scene& scene, const Request& request) : request_(request) {
  if (request.pixels.empty()) return;
  const FrameFormat& frame = scene.frame;
  pixels_ = Plane<std::uint8_t>(frame.width, frame.height);
  for (const glm::ivec2 p : request.pixels)
    if (p.x >= 0 && p.y >= 0 && p.x < frame.width && p.y < frame.height) pixels_(p.x, p.y) = 1;
}

bool Selection::primitive(std::uint32_t number) const {
  const auto& wanted = request_.primitives;
  return wanted.empty() || std::binary_search(wanted.begin(), wanted.end(), number);
}

std::size_t Selection::bytes_per_fragment() const {
  const StageSet& stages = request_.records;
  return (stages.has(Stage::coverage) ? sizeof(Covered) : 0) + (stages.has(Stage::depth) ? sizeof(double) : 0) +
         (stages.has(Stage::attributes) ? sizeof(Attributes<double>) : 0) +
         (stages.has(Stage::shade) ? sizeof(Shaded<double>) : 0) + (stages.has(Stage::visibility) ? sizeof(Drawn) : 0);
}

void Selection::add(const Covered& covered, double depth, const glm::dvec4& color, bool drawn,
                    Records<double>& out) const {
  const StageSet& stages = request_.records;
  if (stages.has(Stage::coverage)) out.covered.push_back(covered);
  if (stages.has(Stage::depth)) out.depth.push_back(depth);
  if (stages.has(Stage::attributes)) out.attributes.push_back({color});
  if (stages.has(Stage::shade)) out.shaded.push_back({color});
  if (stages.has(Stage::visibility)) out.drawn.push_back({drawn});
}

void Selection::reserve(std::size_t fragments, Records<double>& out) const {
  const StageSet& stages = request_.records;
  if (stages.has(Stage::coverage)) out.covered.reserve(fragments);
  if (stages.has(Stage::depth)) out.depth.reserve(fragments);
  if (stages.has(Stage::attributes)) out.attributes.reserve(fragments);
  if (stages.has(Stage::shade)) out.shaded.reserve(fragments);
  if (stages.has(Stage::visibility)) out.drawn.reserve(fragments);
}

void Selection::prune(Records<double>& records) const {
  const StageSet& stages = request_.records;
  if (!stages.has(Stage::matrices)) records.matrices = {};
  if (!stages.has(Stage::vertex)) records.vertices = {};
  if (!stages.has(Stage::light)) records.lit = {};
  if (!stages.has(Stage::clip)) records.polygons = {};
  if (!stages.has(Stage::window)) records.triangles = {};
  if (request_.primitives.empty()) return;

  const auto other = [&](const auto& record) { return !primitive(record.primitive); };
  std::erase_if(records.triangles, other);
  std::erase_if(records.polygons.polygons, other);
  std::vector<ClipVertex<double>> vertices;
  for (ClipPolygon& polygon : records.polygons.polygons) {
    const auto first = records.polygons.vertices.begin() + polygon.first;
    polygon.first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), first, first + polygon.count);
  }
  records.polygons.vertices = std::move(vertices);
}

std::size_t geometry_bytes(const Records<double>& r) {
  return r.matrices.size() * sizeof(r.matrices[0]) + r.vertices.size() * sizeof(r.vertices[0]) +
         r.lit.size() * sizeof(r.lit[0]) + r.polygons.vertices.size() * sizeof(r.polygons.vertices[0]) +
         r.polygons.polygons.size() * sizeof(r.polygons.polygons[0]) + r.triangles.size() * sizeof(r.triangles[0]);
}

}  // namespace plumbline::exact
