// A scene's state as JSON, every default written out, under the keys of scene files (tests/scenes/scene.schema.json).
// Lights are in eye space, as stage 0 leaves them; camera, projection and transforms are left out.
#pragma once

#include <nlohmann/json.hpp>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline {

using Json = nlohmann::ordered_json;

/// Size, formats and clear values; rows_from_top, depth_clamp, and the pass' sample.
Json frame_json(const Scene& scene);
/// GL_LIGHT_MODEL_..., the ambient light among it.
Json light_model_json(const LightModel& model);
/// A light's colours, with its place and direction in eye space.
Json light_json(const Light& light, const LightSource<double>& in_eye_space);
/// Format, sampler, and the size of each level.
Json texture_json(const Texture& texture);
/// All but the mesh and the matrices. What a draw does not use is null: blend, fog, texture...
Json draw_json(const Draw& draw);

}  // namespace plumbline
