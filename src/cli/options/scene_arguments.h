// Arguments that all subcommands that read scenes share.
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
  /// Loads all files, several at a time. Calls require(scene) for each, which throws to refuse it. Throws the exception
  /// of the first bad file in order. All threads have ended when it returns: the caller may fork.
  std::vector<Scene> load(std::span<const std::filesystem::path> files,
                          const std::function<void(const Scene&)>& require) const;
  /// " --assets FOLDER" for each, quoted for a shell: for a command that repeats a run.
  std::string repeated() const;
};

/// The word as it is written on a shell's command line: quoted if a shell would read it otherwise.
std::string shell_word(const std::string& word);

}  // namespace plumbline::cli
