#include "check/judge/turn_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <span>
#include <vector>

#include "check/compare/matched_by_primitive.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/stage_inputs.h"

namespace plumbline::check {

namespace {

constexpr std::size_t kTurns = 3;
using Run = std::span<const WindowTriangle<double>>;
using Turns = std::array<bool, kTurns>;

bool is_near(double a, double b) { return std::abs(a - b) <= 1e-3 * std::max(1.0, std::abs(b)); }

// Numbers of a corner that are those of the other: x, y, z, 1/w, and the colour as one.
int numbers_alike(const WindowVertex<double>& a, const WindowVertex<double>& b) {
  int out = is_near(a.inv_w, b.inv_w) ? 1 : 0;
  for (int c = 0; c < 3; ++c) out += is_near(a.p_win[c], b.p_win[c]) ? 1 : 0;
  bool is_color = true;
  for (int c = 0; c < 4; ++c) is_color = is_color && is_near(a.color[c], b.color[c]);
  return out + (is_color ? 1 : 0);
}

// Turns under which as many numbers as possible are those of one of `theirs`.
Turns best_turns(const WindowTriangle<double>& mine, Run theirs) {
  std::array<int, kTurns> most{};
  for (const WindowTriangle<double>& other : theirs) {
    for (std::size_t turn = 0; turn < kTurns; ++turn) {
      int alike = 0;
      for (std::size_t k = 0; k < 3; ++k) alike += numbers_alike(mine.v[(k + turn) % 3], other.v[k]);
      most[turn] = std::max(most[turn], alike);
    }
  }
  const int best = *std::ranges::max_element(most);
  return {most[0] == best, most[1] == best, most[2] == best};
}

template <class Corners>
void turn_by(Corners& corners, std::size_t turn) {
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(turn), corners.end());
}

}  // namespace

void turn_triangles(Records<double>& candidate, const Records<double>& reference) {
  std::vector<WindowTriangle<double>>& all = candidate.triangles;
  std::vector<Turns> turns(all.size(), Turns{true, false, false});
  matched_by_primitive(Run(all), Run(reference.triangles), [&](Run mine, Run theirs) {
    for (const WindowTriangle<double>& t : mine) {
      if (t.corners == 3 && !theirs.empty()) turns[static_cast<std::size_t>(&t - all.data())] = best_turns(t, theirs);
    }
  });
  std::array<std::size_t, kTurns> votes{};
  for (const Turns& best : turns) {
    if (std::ranges::count(best, true) != 1) continue;
    ++votes[static_cast<std::size_t>(std::ranges::find(best, true) - best.begin())];
  }
  const auto usual = static_cast<std::size_t>(std::ranges::max_element(votes) - votes.begin());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Turns& best = turns[i];
    const std::size_t first = static_cast<std::size_t>(std::ranges::find(best, true) - best.begin());
    const std::size_t turn = best[usual] ? usual : first;
    if (turn == 0) continue;
    turn_by(all[i].v, turn);
    for (const Varying v : kAllVaryings) {
      auto& columns = candidate.varyings[v].triangles;
      if (columns.size() == all.size()) turn_by(columns[i], turn);
    }
  }
}

void turn_as_made(const Scene& scene, const RendererInfo& shown, Renderer& referee, Capture& candidate) {
  if (!lacking_per_stage(scene, shown, Stage::window).empty()) return;
  try {
    const Capture made = run_by_conventions(referee, scene, Stage::window, candidate, shown.conventions);
    turn_triangles(candidate.records, made.records);
  } catch (const std::exception&) {  // the stage's own row says so
  }
}

}  // namespace plumbline::check
