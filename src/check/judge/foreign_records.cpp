#include "check/judge/foreign_records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <span>
#include <vector>

#include "check/bounds/matched_by_primitive.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/stage_inputs.h"

namespace plumbline::check {

namespace {

constexpr std::size_t kRotations = 3;
using Run = std::span<const WindowTriangle<double>>;
using Rotations = std::array<bool, kRotations>;

constexpr double kNear = 1e-3, kRoundings = 1e-6;  // relative differences

double apart(double a, double b) { return std::abs(a - b) / std::max(1.0, std::abs(b)); }

// Fit of two triangles: the number of their numbers that match, and the sum of these numbers' relative differences.
struct Fit {
  int alike = 0;
  double apart = 0;
  void add(double difference) {
    if (!(difference <= kNear)) return;
    ++alike;
    apart += difference;
  }
  bool operator<(const Fit& other) const { return alike != other.alike ? alike < other.alike : apart > other.apart; }
};

// Numbers of a corner: x, y, z, 1/w, and the colour as one.
void add_corner(Fit& fit, const WindowVertex<double>& a, const WindowVertex<double>& b) {
  fit.add(apart(a.inv_w, b.inv_w));
  for (int c = 0; c < 3; ++c) fit.add(apart(a.p_win[c], b.p_win[c]));
  double color = 0;
  for (int c = 0; c < 4; ++c) color = std::max(color, apart(a.color[c], b.color[c]));
  fit.add(color);
}

// Rotations under which most numbers match those of one of `theirs`; of equally good ones the nearest, but for
// roundings.
Rotations best_rotations(const WindowTriangle<double>& mine, Run theirs) {
  std::array<Fit, kRotations> fits;
  for (const WindowTriangle<double>& other : theirs) {
    for (std::size_t rotation = 0; rotation < kRotations; ++rotation) {
      Fit fit;
      for (std::size_t k = 0; k < 3; ++k) add_corner(fit, mine.v[(k + rotation) % 3], other.v[k]);
      fits[rotation] = std::max(fits[rotation], fit);
    }
  }
  const Fit best = std::max({fits[0], fits[1], fits[2]});
  const auto is_best = [&](const Fit& fit) { return fit.alike == best.alike && fit.apart <= best.apart + kRoundings; };
  return {is_best(fits[0]), is_best(fits[1]), is_best(fits[2])};
}

template <class Corners>
void rotate_by(Corners& corners, std::size_t rotation) {
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(rotation), corners.end());
}

}  // namespace

void rotate_corners(Records<double>& candidate, const Records<double>& reference) {
  std::vector<WindowTriangle<double>>& all = candidate.triangles;
  std::vector<Rotations> rotations(all.size(), Rotations{true, false, false});
  matched_by_primitive(Run(all), Run(reference.triangles), [&](Run mine, Run theirs) {
    for (const WindowTriangle<double>& t : mine) {
      if (t.corners == 3 && !theirs.empty())
        rotations[static_cast<std::size_t>(&t - all.data())] = best_rotations(t, theirs);
    }
  });
  std::array<std::size_t, kRotations> votes{};
  for (const Rotations& best : rotations) {
    if (std::ranges::count(best, true) != 1) continue;
    ++votes[static_cast<std::size_t>(std::ranges::find(best, true) - best.begin())];
  }
  const auto usual = static_cast<std::size_t>(std::ranges::max_element(votes) - votes.begin());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Rotations& best = rotations[i];
    const std::size_t first = static_cast<std::size_t>(std::ranges::find(best, true) - best.begin());
    const std::size_t rotation = best[usual] ? usual : first;
    if (rotation == 0) continue;
    rotate_by(all[i].v, rotation);
    for (const Varying v : kAllVaryings) {
      auto& columns = candidate.varyings[v].triangles;
      if (columns.size() == all.size()) rotate_by(columns[i], rotation);
    }
  }
}

void rotate_as_made(const Scene& scene, const RendererInfo& shown, Renderer& referee, Capture& candidate) {
  if (!lacking_per_stage(scene, shown, Stage::window).empty()) return;
  try {
    const Capture made = run_by_conventions(referee, scene, Stage::window, candidate, shown.conventions);
    rotate_corners(candidate.records, made.records);
  } catch (const std::exception&) {  // the stage's own row says so
  }
}

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
