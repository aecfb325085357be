// Checks that records from outside fit a scene and each other, so that a stage can be run on them.
#pragma once

#include <string>

#include "capture/capture.h"

namespace plumbline {

/// Throws std::invalid_argument that names the records of `in` which the stage reads and which do not fit the scene.
void require_fitting(const Scene& scene, Stage stage, const Capture& in);

/// Varyings that a stage reads, or hands on as well.
enum class VaryingsOf { inputs, inputs_and_output };
/// The first group of a varying, such as "varyings.normal.fragments", of these that holds no record, though the
/// vertices, corners or fragments that it lies beside are there. Empty: none is lacking.
std::string lacking_varying(const Scene& scene, Stage stage, VaryingsOf of, const Capture& in);

}  // namespace plumbline
