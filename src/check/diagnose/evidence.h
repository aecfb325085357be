// Evidence of a diagnosis: one wrong stage of the candidate, and the same stage as it should be; how much of the final
// picture it explains, and its worst record.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "check/verdict/measure.h"
#include "check/verdict/verdict.h"
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

/// Number of pixels whose colour or depth differs between two frames that the referee completes: one from the
/// candidate's records up to the evidence's stage, one with the expected records of that stage. Differences of at most
/// 1/255 in colour and one step in depth do not count. 0 without a referee, or where it fails.
std::size_t pixels_explained(const Evidence& evidence);

/// Text lines: the record's place, input, output, expected output (of a judge of legal answers: the nearest legal
/// value) and the difference; also the triangle and its corners where the record belongs to a triangle
/// (worst_record.cpp).
std::vector<std::string> worst_record(const Evidence& evidence, const JudgeId& judge, const Measurement& measurement);

}  // namespace plumbline::check
