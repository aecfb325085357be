// Scenes of a campaign by name: each is a function of its name alone, on every machine.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::campaign {

/// Who writes a scene. `ordinary` and `hard` share nothing: what one never draws, the other may. `plain` has
/// the geometry of `hard`, for a renderer that draws opaque triangles alone.
enum class Generator { ordinary, hard, plain };
inline constexpr Generator kGenerators[] = {Generator::ordinary, Generator::hard, Generator::plain};
std::string_view name_of(Generator generator);

/// A scene: its generator and its seeds. One seed is a scene by itself; each further one changes a few of its choices.
struct SceneId {
  Generator generator = Generator::ordinary;
  std::vector<std::uint64_t> seeds;
  std::strong_ordering operator<=>(const SceneId&) const = default;
  bool operator==(const SceneId&) const = default;
};

/// GENERATOR/SEED, or GENERATOR/SEED.SEED...: "hard/17", "hard/17.3".
std::string to_string(const SceneId& id);
/// Throws std::invalid_argument where the text is none of to_string().
SceneId scene_id_of(std::string_view text);

/// The scene's file (tests/scenes/scene.schema.json).
std::string scene_text(const SceneId& id);

}  // namespace plumbline::campaign
