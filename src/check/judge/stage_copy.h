// Operations on single stages of a capture: copying and clearing them, and rounding exact's real numbers to the formats
// that a renderer in float hands on.
#pragma once

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Replaces the stage's records and planes in `to` by those of `from`; with texture also legal.texels, with resolve
/// also planes.color. Other stages stay.
void copy_stage(Stage stage, const Capture& from, Capture& to);

/// Empties the stages after `stage`, up to merge.
void clear_stages_after(Stage stage, Capture& capture);

/// Rounds what the capture holds of the stage: fragments' depths and planes.color to the frame's codes where it has
/// codes, records of all other stages to float. Snapped positions and facing stay as they are.
void round_to_formats(const Scene& scene, Stage stage, Capture& capture);

}  // namespace plumbline::check
