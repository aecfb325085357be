#include "cli/options/scene_arguments.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#include <fmt/format.h>

#include "cli/options/say.h"
#include "scene/file/scene_file.h"

namespace plumbline::cli {

namespace {

Scene read(const std::filesystem::path& file, std::span<const std::string> assets) {
  SceneFileOptions options;
  options.asset_folders.insert(options.asset_folders.begin(), assets.begin(), assets.end());
  return load_scene(file, options);
}

void say_notes(const Scene& scene, const std::filesystem::path& file) {
  for (const std::string& note : scene.notes) say(fmt::format("note: {}: {}", file.string(), note));
}

}  // namespace

Scene SceneArguments::load_silently(const std::filesystem::path& file) const { return read(file, assets); }

Scene SceneArguments::load(const std::filesystem::path& file) const {
  Scene scene = read(file, assets);
  say_notes(scene, file);
  return scene;
}

std::vector<Scene> SceneArguments::load(std::span<const std::filesystem::path> files,
                                        const std::function<void(const Scene&)>& require) const {
  std::vector<Scene> out(files.size());
  std::vector<std::exception_ptr> errors(files.size());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> any_bad{false};
  const auto work = [&] {
    while (!any_bad) {  // a file once taken is read: all files before the first bad one are
      const std::size_t i = next++;
      if (i >= files.size()) return;
      try {
        out[i] = read(files[i], assets);
        require(out[i]);
      } catch (...) {
        errors[i] = std::current_exception();
        any_bad = true;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    const std::size_t threads = std::min<std::size_t>(std::thread::hardware_concurrency(), files.size());
    while (others.size() + 1 < threads) others.emplace_back(work);
    work();
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (errors[i]) std::rethrow_exception(errors[i]);
    say_notes(out[i], files[i]);
  }
  return out;
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
