// Contradictions within one capture: mistakes of its export, found before any renderer is judged.
#pragma once

#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "capture/stages.h"

namespace plumbline {

/// Lines for people, each with the array, its numbers and the probable cause: depths still in [-1,1], codes where
/// numbers in [0,1] belong, rows upside down, transposed matrices, winners where nothing was drawn, colours that are no
/// winner's, a picture without triangles, window corners that are not finite or far from where they were snapped to.
/// Empty: none found.
std::vector<std::string> contradictions(const Capture& capture);
/// Contradictions of one stage. window: no triangle, but pixels drawn in planes.id, planes.count or planes.color;
/// corners whose x, y, 1/w or colour is not finite; window.snapped that is not window.p_win on the declared grid (beyond
/// the frame: rounded towards it, too), or, where none is declared, is 2 pixels away or farther.
/// coverage: the fragments' number against planes.count. texture, shade: planes.texel and planes.shaded against the
/// records of the winner's fragment. visibility: planes.id against planes.count and planes.color. Other stages: none.
std::vector<std::string> contradictions_of(const Capture& capture, Stage stage, const Conventions& conventions);

}  // namespace plumbline
