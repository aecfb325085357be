// The arguments that all subcommands share which read scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace plumbline::cli {

struct SceneArguments {
  std::vector<std::string> assets;  ///< folders where mesh files are looked for, after the scene's own

  Scene load(const std::filesystem::path& file) const;
  /// As they were given, for a command that repeats a run.
  std::string repeated() const;
};

/// The word as a shell takes it back: quoted if it has to be.
std::string shell_word(const std::string& word);

}  // namespace plumbline::cli
