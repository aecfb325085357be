// Hard scenes by seed: geometry and state at which pipelines break, in all states of the scene format.
//
// Written from the scene format's schema and from cases at which pipelines break (shapes.cpp). Shares nothing with
// src/campaign/ordinary but random numbers and JSON text: each may draw states that the other lacks.
#pragma once

#include "campaign/text/choices.h"

#include <string>

namespace plumbline::hard {

/// Text of a scene file, made of the numbers that `choices` hands out. The scene names no mesh file and no image file.
std::string hard_scene(campaign::Choices choices, const std::string& description);

/// Text of a scene in the geometry of hard scenes and in a simple state: opaque filled triangles by OpenGL's rules, in
/// the colours of their corners or in one colour, unlit, without textures, by the depth test `less`, none culled.
std::string plain_scene(campaign::Choices choices, const std::string& description);

/// Text of a plain scene in perspective whose triangles lie inside the view volume: for a renderer that does not clip.
std::string inside_scene(campaign::Choices choices, const std::string& description);

/// Text of a plain scene whose draws have one colour each and pass every depth test: for a renderer that has no depth
/// buffer yet, and interpolates nothing.
std::string flat_scene(campaign::Choices choices, const std::string& description);

}  // namespace plumbline::hard
