// Bugs that people really make, each in one stage: a stage function of the pipeline replaced by one with the bug. The
// stages after it run as they are. They prove that the harness sees, and names, what breaks a renderer.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "faults/table.h"
#include "stages/stages.h"

namespace plumbline::faults {

struct Fault {
  std::string_view name;     ///< stage.bug, or notes.note.mistake (notes.h)
  std::string_view changes;  ///< what it does, in words
  Stage stage;               ///< the stage that must be named
  void (*apply)(Table&);     ///< puts its functions in
  /// The thread of a public renderer that reports it (owner/repository#number): written from that report alone, before
  /// its writer had read how faults are found.
  std::string_view report = {};

  /// The pipeline with it.
  pipeline::Stages stages() const;
};

/// By stage.
std::span<const Fault> of_stages();
/// Those, and the notes' (notes.h).
std::vector<Fault> all();

}  // namespace plumbline::faults
