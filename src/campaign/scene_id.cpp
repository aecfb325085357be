#include "campaign/scene_id.h"

#include <charconv>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "campaign/hard/hard_scene.h"
#include "campaign/ordinary/ordinary_scene.h"

namespace plumbline::campaign {

std::string_view name_of(Generator generator) {
  constexpr std::string_view kNames[] = {"ordinary", "hard", "plain", "flat", "inside"};
  return kNames[static_cast<std::size_t>(generator)];
}

std::string to_string(const SceneId& id) {
  return fmt::format("{}/{}", name_of(id.generator), fmt::join(id.seeds, "."));
}

SceneId scene_id_of(std::string_view text) {
  for (const Generator generator : kGenerators) {
    const std::string_view name = name_of(generator);
    if (!text.starts_with(name)) continue;
    SceneId out{generator, {}};
    const char *at = text.data() + name.size(), *end = text.data() + text.size();
    while (at != end && *at == (out.seeds.empty() ? '/' : '.')) {
      const auto [stop, error] = std::from_chars(at + 1, end, out.seeds.emplace_back());
      if (error != std::errc()) break;
      at = stop;
    }
    if (at == end && to_string(out) == text) return out;
  }
  throw std::invalid_argument(fmt::format("expected GENERATOR/SEED such as hard/17, found {}", text));
}

std::string scene_text(const SceneId& id) {
  const std::string seeds = fmt::format("{}", fmt::join(id.seeds, "."));
  const Choices choices(id.seeds);
  switch (id.generator) {
    case Generator::ordinary: return ordinary::ordinary_scene(choices, fmt::format("Ordinary scene {}.", seeds));
    case Generator::plain: return hard::plain_scene(choices, fmt::format("Plain scene {}.", seeds));
    case Generator::flat: return hard::flat_scene(choices, fmt::format("Flat scene {}.", seeds));
    case Generator::inside: return hard::inside_scene(choices, fmt::format("Inside scene {}.", seeds));
    case Generator::hard: break;
  }
  return hard::hard_scene(choices, fmt::format("Hard scene {}.", seeds));
}

}  // namespace plumbline::campaign
