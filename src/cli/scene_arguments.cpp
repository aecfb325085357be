#include "cli/scene_arguments.h"

#include <CLI/CLI.hpp>

#include "scene/scene_file.h"

namespace plumbline::cli {

void SceneArguments::add_to(CLI::App& app) {
  app.add_option("--assets", assets_, "Folders where mesh files are looked for, after the scene's own")
      ->check(CLI::ExistingDirectory);
}

Scene SceneArguments::load(const std::filesystem::path& file) const {
  SceneFileOptions options;
  options.asset_folders.insert(options.asset_folders.begin(), assets_.begin(), assets_.end());
  return load_scene(file, options);
}

std::string SceneArguments::repeated() const {
  std::string out;
  for (const std::string& folder : assets_) out += " --assets " + shell_word(folder);
  return out;
}

std::string shell_word(const std::string& word) {
  if (!word.empty() &&
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+,=") ==
          std::string::npos) {
    return word;
  }
  std::string out = "'";
  for (char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace plumbline::cli
