// A fault: a real bug in one stage, as functions that replace the stage's own in the pipeline; all other stages stay
// right. Faults prove that the harness sees and names what breaks a renderer.
#pragma once

#include <string_view>

#include "capture/stages.h"
#include "pipeline/stages.h"

namespace plumbline::faults {

struct Fault {
  std::string_view name;             ///< stage.bug, or notes.note.mistake (notes.h)
  std::string_view changes;          ///< what it does, in words
  Stage stage;                       ///< the stage that must be named
  void (*apply)(pipeline::Stages&);  ///< replaces stage functions by the fault's
  /// The thread of a public renderer that reports it (owner/repository#number): the fault was written from that report
  /// alone, without knowledge of the diagnosis.
  std::string_view report = {};

  /// The pipeline's stages with the fault alone.
  pipeline::Stages stages() const;
};

}  // namespace plumbline::faults
