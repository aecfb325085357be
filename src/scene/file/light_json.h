// The "lights" and the "light_model" of a scene file.
#pragma once

#include "scene/json/json_tree.h"
#include "scene/scene.h"

namespace plumbline {

/// [r, g, b], each in [0, 1e6]. Throws JsonError.
glm::vec3 read_light_color(const JsonNode& node);

/// One of "lights". Throws JsonError.
Light read_light(const JsonNode& node);

/// "light_model"; LightModel::ambient, a key of its own in scene files, keeps its default. Throws JsonError.
LightModel read_light_model(const JsonNode& node);

}  // namespace plumbline
