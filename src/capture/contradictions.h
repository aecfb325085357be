// Contradictions within one capture: mistakes of its export, found before any renderer is judged.
#pragma once

#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/stages.h"

namespace plumbline {

/// Lines for people, each with the array, its numbers and the probable cause: depths still in [-1,1], codes where
/// numbers in [0,1] belong, rows upside down, transposed matrices, winners where nothing was drawn, colours that are no
/// winner's, a picture without triangles. Empty: none found.
std::vector<std::string> contradictions(const Capture& capture);
/// Contradictions of one stage. window: no triangle, but pixels drawn in planes.id, planes.count or planes.color.
/// coverage: the fragments' number against planes.count. texture, shade: planes.texel and planes.shaded against the
/// records of the winner's fragment. visibility: planes.id against planes.count and planes.color. Other stages: none.
std::vector<std::string> contradictions_of(const Capture& capture, Stage stage);

}  // namespace plumbline
