// The arguments that all subcommands share which read scenes.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace plumbline::cli {

struct SceneArguments {
  std::vector<std::string> assets;  ///< folders where mesh files are looked for, after the scene's own

  Scene load(const std::filesystem::path& file) const;
  /// A scene as load() reads it, without its notes for people.
  Scene load_silently(const std::filesystem::path& file) const;
  /// All of them, several at a time, each accepted by `require`, which throws else. Throws what the first bad one in
  /// order does. No thread is left: the caller may fork.
  std::vector<Scene> load(std::span<const std::filesystem::path> files,
                          const std::function<void(const Scene&)>& require) const;
  /// As they were given, for a command that repeats a run.
  std::string repeated() const;
};

/// The word as a shell takes it back: quoted if it has to be.
std::string shell_word(const std::string& word);

}  // namespace plumbline::cli
