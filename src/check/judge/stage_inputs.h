// Inputs that judging a stage needs, and which of them a candidate lacks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

/// The note of stage attributes, of a renderer that hands out no colour before shade.
inline constexpr std::string_view kOnlyShaded = "it hands out the final colour alone; see shade";

/// Whether the count plane has fragments and the records none: beyond the budget, or a capture of planes alone.
inline bool lacks_fragment_records(const Capture& c) {
  const auto& count = c.planes.count.values();
  return c.records.covered.empty() && std::any_of(count.begin(), count.end(), [](std::uint32_t n) { return n != 0; });
}

inline bool draws_lines_or_points(const Scene& scene) {
  return may_draw(scene, Topology::lines) || may_draw(scene, Topology::points);
}

/// Whether `planes` holds the plane that an oracle's legal answers of the stage are compared with.
bool has_plane(const Planes& planes, Stage stage);

/// Why a stage cannot be compared side by side, or with the referee's from the scene; empty: it can. Counts and winners
/// have no tolerance and need planes alone; winners of lines and points also records of coverage and depth. Other
/// planes are compared where both sides' winners agree, within bounds computed from the records of earlier stages.
std::string lacking_beside(const Scene& scene, const Planes& planes, const RendererInfo& candidate, Stage stage);

/// Why a stage cannot be compared with the referee's of the candidate's own records; empty: it can. Of coverage,
/// visibility and merge themselves planes suffice; of a stage's inputs records are needed.
std::string lacking_per_stage(const Scene& scene, const RendererInfo& candidate, Stage stage);

}  // namespace plumbline::check
