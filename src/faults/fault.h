// A fault: a bug that people really make, in one stage. It replaces that stage's functions in the pipeline; all other
// stages stay right. Faults prove that the harness sees and names what breaks a renderer.
#pragma once

#include <string_view>

#include "capture/stages.h"
#include "pipeline/stages.h"

namespace plumbline::faults {

struct Fault {
  std::string_view name;             ///< stage.bug, or notes.note.mistake (notes.h)
  std::string_view changes;          ///< what it does, in words
  Stage stage;                       ///< the stage that must be named
  void (*apply)(pipeline::Stages&);  ///< puts the fault's functions in, over those that are there
  /// The thread of a public renderer that reports it (owner/repository#number): the fault was written from that report
  /// alone, without knowledge of the diagnosis.
  std::string_view report = {};

  /// The pipeline's stages with the fault alone.
  pipeline::Stages stages() const;
};

}  // namespace plumbline::faults
