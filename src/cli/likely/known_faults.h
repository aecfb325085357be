// Known faults that a frame may show: those of stages (src/faults), states that are misread (misread_states.h), and
// faults of a viewport, of a depth test, of writing the file.
#pragma once

#include <span>
#include <vector>

#include "cli/likely/frames_apart.h"
#include "cli/likely/known_fault.h"
#include "cli/options/renderers.h"

namespace plumbline::cli {

/// Whether the fault is of one of these stages: one of the viewport is of `window`, one of a file of `merge`.
bool is_of(const StageSet& stages, const KnownFault& fault);
/// Whether the fault makes one of these stages wrong: its own (is_of()); vertex, whose records are numbered by the
/// order of draws; light, whose records lack the attributes of a texture or a fog that is left out, and whose normals a
/// stranger may bring to unit length later than at stage vertex.
bool makes_wrong(const StageSet& stages, const KnownFault& fault);

/// Faults drawn for comparison only, not selectable by --fault; one for each name.
std::vector<KnownFault> picture_faults();

/// All that are known, less those of stages that are right (GivenFrame::right), and those that the conventions declare.
std::vector<KnownFault> known_faults(const Scene& scene, const GivenFrame& given);

/// The scene's frame as plumbline's renderer draws it with these faults, its colours encoded as the conventions say.
ColorAndDepth draw_with(std::span<const KnownFault* const> faults, const Scene& scene, const Conventions& conventions,
                        CutAt cut_at = CutAt::frame_sides);

}  // namespace plumbline::cli
