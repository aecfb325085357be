// A scene's state as JSON, every default written out, mostly under the keys of scene files
// (tests/scenes/scene.schema.json). Lights are in eye space, as stage 0 leaves them; camera, projection and transforms
// are left out.
#pragma once

#include <nlohmann/json.hpp>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline {

using Json = nlohmann::ordered_json;

/// Size, formats and clear values; rows_from_top, depth_clamp, and the offset of the pass' sample [1/256 pixel].
Json frame_json(const Scene& scene);
/// The light model, its ambient light included.
Json light_model_json(const LightModel& model);
/// A light's colours, attenuation and cone, with its position and direction in eye space.
Json light_json(const Light& light, const LightSource<double>& in_eye_space);
/// Format, sampler, and the size of each level; no texels. `border` is converted to the format's source components.
Json texture_json(const Texture& texture);
/// A draw's state, with the numbers of its mesh and texture, without matrices. State that a draw does not use (blend,
/// fog, texture...) is null.
Json draw_json(const Draw& draw);

}  // namespace plumbline
