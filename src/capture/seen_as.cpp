#include "capture/seen_as.h"

namespace plumbline {

Records<double> seen_as(const Records<double>& records, Varying varying) {
  const VaryingColumns<double>& columns = records.varyings[varying];
  Records<double> out;
  out.matrices = records.matrices;
  out.vertices = records.vertices;
  out.covered = records.covered;
  for (const Vec4<double>& four : columns.vertices) out.lit.push_back({four});
  for (const Vec4<double>& four : columns.fragments) out.attributes.push_back({four});
  if (columns.clipped.size() == records.polygons.vertices.size()) {
    out.polygons = records.polygons;
    for (std::size_t i = 0; i < columns.clipped.size(); ++i) out.polygons.vertices[i].color = columns.clipped[i];
  }
  if (columns.triangles.size() == records.triangles.size()) {
    out.triangles = records.triangles;
    for (std::size_t i = 0; i < columns.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) out.triangles[i].v[k].color = columns.triangles[i][k];
    }
  }
  return out;
}

}  // namespace plumbline
