// Evidence of a diagnosis: one wrong stage of the candidate, and the same stage as it should be.
#pragma once

#include "capture/capture.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

/// One stage of the candidate beside the expected stage. With `referee`: exact's stage of the candidate's records.
/// Without: the stage in a reference's capture of the same scene.
struct Evidence {
  const Scene& scene;
  Stage stage;
  const Capture& candidate;      ///< with the records that came in
  const Capture& expected;       ///< exact's are real numbers
  Renderer* referee = nullptr;   ///< renderer that made `expected` and can try causes; null: none
  Conventions conventions = {};  ///< of the candidate
  bool foreign = false;          ///< the candidate is Profile::foreign
};

}  // namespace plumbline::check
