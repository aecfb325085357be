#include "cli/options/scene_arguments.h"

#include <fmt/format.h>

#include "cli/options/say.h"
#include "scene/file/scene_file.h"

namespace plumbline::cli {

Scene SceneArguments::load(const std::filesystem::path& file) const {
  SceneFileOptions options;
  options.asset_folders.insert(options.asset_folders.begin(), assets.begin(), assets.end());
  Scene scene = load_scene(file, options);
  for (const std::string& note : scene.notes) say(fmt::format("note: {}: {}", file.string(), note));
  return scene;
}

std::string SceneArguments::repeated() const {
  std::string out;
  for (const std::string& folder : assets) out += " --assets " + shell_word(folder);
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
