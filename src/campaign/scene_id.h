// Scenes of a campaign by name: a scene is a function of its name, on every machine.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::campaign {

/// Generator of a scene. `ordinary` and `hard` are independent: each may draw states that the other never draws.
/// `plain`: opaque triangles in the geometry of `hard`, for renderers of no more; `inside`: such triangles in
/// perspective, inside the view volume; `flat`: of one colour a draw, without a depth test.
enum class Generator { ordinary, hard, plain, flat, inside };
inline constexpr Generator kGenerators[] = {Generator::ordinary, Generator::hard, Generator::plain, Generator::flat,
                                            Generator::inside};
std::string_view name_of(Generator generator);

/// Name of a scene: its generator and its seeds. The first seed makes a scene; each further seed changes a few of its
/// choices.
struct SceneId {
  Generator generator = Generator::ordinary;
  std::vector<std::uint64_t> seeds;
  std::strong_ordering operator<=>(const SceneId&) const = default;
  bool operator==(const SceneId&) const = default;
};

/// GENERATOR/SEED, or GENERATOR/SEED.SEED...: "hard/17", "hard/17.3".
std::string to_string(const SceneId& id);
/// Inverse of to_string(). Throws std::invalid_argument for any other text.
SceneId scene_id_of(std::string_view text);

/// The scene's file (tests/scenes/scene.schema.json).
std::string scene_text(const SceneId& id);

}  // namespace plumbline::campaign
