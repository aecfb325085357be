#include "check/judge/unit_normals.h"

#include <cmath>
#include <vector>

namespace plumbline::check {

Records<double> with_unit_normals(const Scene& scene, Records<double> records, OfDraws of) {
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  for (std::size_t d = 0; d < ranges.size(); ++d) {
    const Draw& draw = scene.draws[d];
    if (draw.normals != Normals::normalize || (of == OfDraws::lit_at_vertices && is_lit_per_fragment(draw))) continue;
    for (std::uint32_t i = 0; i < ranges[d].vertex_count && ranges[d].first_vertex + i < records.vertices.size(); ++i) {
      Vec3<double>& n = records.vertices[ranges[d].first_vertex + i].n_eye;
      const double length = glm::length(n);
      if (length > 0 && std::isfinite(length) && std::abs(length - 1) > 0x1p-16) n /= length;
    }
  }
  return records;
}

void stretch_unit_normals(std::vector<Attributes<double>>& normals, const std::vector<Attributes<double>>& expected) {
  if (normals.size() != expected.size()) return;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double length = glm::length(Vec3<double>(normals[i].color));
    if (std::abs(length - 1) > 0x1p-16) continue;
    normals[i].color *= glm::length(Vec3<double>(expected[i].color)) / length;
  }
}

const Records<double>& vertex_records(const SceneJudgement& c, Records<double>& made) {
  if (!c.foreign) return c.candidate.records;
  return made = with_unit_normals(c.scene, c.candidate.records, OfDraws::all);
}

}  // namespace plumbline::check
