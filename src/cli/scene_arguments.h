// The arguments that all subcommands share which read scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace CLI {
class App;
}

namespace plumbline::cli {

class SceneArguments {
 public:
  void add_to(CLI::App& app);
  Scene load(const std::filesystem::path& file) const;
  /// As they were given, for a command that repeats a run.
  std::string repeated() const;

 private:
  std::vector<std::string> assets_;
};

/// The word as a shell takes it back: quoted if it has to be.
std::string shell_word(const std::string& word);

}  // namespace plumbline::cli
