// Checks that records from outside fit a scene and each other, so that a stage can be run on them.
#pragma once

#include <string>

#include "capture/capture.h"

namespace plumbline {

/// Throws std::invalid_argument that names the records of `in` which the stage reads and which do not fit the scene.
void require_fitting(const Scene& scene, Stage stage, const Capture& in);

/// Varyings of a stage: those that it reads; those that it reads or hands on.
enum class VaryingsOf { inputs, inputs_and_output };
/// Name of the first group of these varyings, such as "varyings.normal.fragments", that has no record although the
/// vertices, corners or fragments that it lies beside have records. Empty: there is no such group.
std::string lacking_varying(const Scene& scene, Stage stage, VaryingsOf of, const Capture& in);

}  // namespace plumbline
