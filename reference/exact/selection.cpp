#include "reference/exact/selection.h"

#include <algorithm>
#include <type_traits>

#include "capture/capture_columns.h"

namespace plumbline::exact {

Selection::Selection(const Scene& scene, const Request& request)
    : request_(request),
      textured_(textured(scene)),
      varyings_(carried(scene)),
      bytes_(fragment_bytes(scene, request.records)) {
  std::erase_if(varyings_, is_back);
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

void Selection::add(const Fragment& fragment, Records<double>& out) const {
  const StageSet& stages = request_.records;
  if (stages.has(Stage::coverage)) out.covered.push_back(fragment.covered);
  if (stages.has(Stage::depth)) out.depth.push_back(fragment.depth);
  if (stages.has(Stage::attributes)) {
    out.attributes.push_back({fragment.color});
    for (const Varying v : varyings_) out.varyings[v].fragments.push_back(fragment.fours[static_cast<std::size_t>(v)]);
  }
  if (stages.has(Stage::texture) && textured_) out.texels.push_back(fragment.texel);
  if (stages.has(Stage::shade)) out.shaded.push_back({fragment.shaded});
  if (stages.has(Stage::visibility)) out.drawn.push_back({fragment.drawn});
}

void Selection::reserve(std::size_t fragments, Records<double>& out) const {
  const StageSet& stages = request_.records;
  if (stages.has(Stage::coverage)) out.covered.reserve(fragments);
  if (stages.has(Stage::depth)) out.depth.reserve(fragments);
  if (stages.has(Stage::attributes)) {
    out.attributes.reserve(fragments);
    for (const Varying v : varyings_) out.varyings[v].fragments.reserve(fragments);
  }
  if (stages.has(Stage::texture) && textured_) out.texels.reserve(fragments);
  if (stages.has(Stage::shade)) out.shaded.reserve(fragments);
  if (stages.has(Stage::visibility)) out.drawn.reserve(fragments);
}

namespace {

struct KeepOnly {
  StageSet stages;
  void group(Handed group, const auto&, auto& records) const {
    if (!stages.has(group.stage)) std::remove_cvref_t<decltype(records)>().swap(records);  // gives its memory back
  }
  void plane(Handed, auto&) const {}
};

}  // namespace

void Selection::prune(Capture& geometry) const {
  visit_capture(KeepOnly{request_.records}, geometry);
  if (!request_.primitives.empty()) prune_primitives(geometry.records);
}

void Selection::prune_primitives(Records<double>& records) const {
  std::vector<WindowTriangle<double>> triangles;
  std::vector<ClipVertex<double>> vertices;
  Varyings<double> varyings;
  for (std::size_t i = 0; i < records.triangles.size(); ++i) {
    if (!primitive(records.triangles[i].primitive)) continue;
    triangles.push_back(records.triangles[i]);
    for (const Varying v : kAllVaryings) {
      const auto& column = records.varyings[v].triangles;
      if (!column.empty()) varyings[v].triangles.push_back(column[i]);
    }
  }
  std::erase_if(records.polygons.polygons, [&](const ClipPolygon& p) { return !primitive(p.primitive); });
  for (ClipPolygon& polygon : records.polygons.polygons) {
    const std::uint32_t first = polygon.first;
    polygon.first = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t i = first; i < first + polygon.count; ++i) {
      vertices.push_back(records.polygons.vertices[i]);
      for (const Varying v : kAllVaryings) {
        const auto& column = records.varyings[v].clipped;
        if (!column.empty()) varyings[v].clipped.push_back(column[i]);
      }
    }
  }
  records.triangles = std::move(triangles);
  records.polygons.vertices = std::move(vertices);
  for (const Varying v : kAllVaryings) {
    records.varyings[v].triangles = std::move(varyings[v].triangles);
    records.varyings[v].clipped = std::move(varyings[v].clipped);
  }
}

namespace {

struct GeometryBytes {
  std::size_t bytes = 0;
  template <class Record>
  void group(Handed group, const auto&, const std::vector<Record>& records) {
    if (kGeometryStages.has(group.stage)) bytes += records.size() * sizeof(Record);
  }
  void plane(Handed, const auto&) const {}
};

}  // namespace

std::size_t geometry_bytes(const Capture& capture) {
  GeometryBytes out;
  visit_capture(out, capture);
  return out.bytes;
}

}  // namespace plumbline::exact
