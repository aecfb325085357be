#include "check/golden/golden_set.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include <fmt/format.h>

#include "base/atomic_path.h"
#include "base/supervise.h"
#include "capture/files/image_file.h"

namespace plumbline::check {

namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = "manifest.json";
constexpr const char* kTolerances = "tolerances.json";  // beside the goldens of the suite
constexpr const char* kReadme = "README.md";            // likewise

// "color.0123456789abcdef.png", and what AtomicPath writes before it has a name.
bool is_ours(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.starts_with(".plumb-")) return true;
  const std::size_t dot = name.find('.');
  const std::string kind = name.substr(0, dot);
  return (kind == "color" || kind == "depth" || kind == "stages") &&
         name.size() == dot + 1 + 16 + 1 + (kind == "stages" ? 4 : 3) &&
         name.find_first_not_of("0123456789abcdef", dot + 1) == dot + 17 && name[dot + 17] == '.';
}

std::string bytes_of(const fs::path& file) {
  const bool there = fs::is_regular_file(file);  // before it is opened: a pipe would wait for a writer
  std::ifstream in;
  if (there) in.open(file, std::ios::binary);
  std::stringstream bytes;
  if (!there || !in) throw GoldenError(fmt::format("{}: is not there", file.string()));
  bytes << in.rdbuf();
  return bytes.str();
}

// A new set needs an empty folder: other files are somebody's, or of a set that has lost its manifest.
void require_empty(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == kTolerances || name == kReadme || name.starts_with(".plumb-")) continue;
    throw GoldenError(fmt::format("{}: expected goldens, or an empty folder; there is {}, and no {}", folder.string(),
                                  name, kManifest));
  }
}

}  // namespace

GoldenSet::GoldenSet(const fs::path& folder, Access access) : folder_(folder) {
  const bool update = access == Access::update;
  lock_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0)
    throw GoldenError(
        fmt::format("{}: expected the goldens' folder, found: {}", folder.string(), std::strerror(errno)));
  // A run that was killed holds the lock until the last of its processes has ended: a moment.
  constexpr int kAttempts = 100;
  const auto try_lock = [&] { return ::flock(lock_, (update ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0; };
  bool locked = try_lock();
  for (int i = 0; i < kAttempts && !locked; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    locked = try_lock();
  }
  if (!locked) {
    ::close(lock_);
    throw GoldenError(fmt::format("{}: another run {} these goldens: try again when it has ended", folder.string(),
                                  update ? "reads or updates" : "updates"));
  }
  try {
    if (update && !fs::exists(folder / kManifest)) {
      require_empty(folder);
    } else {
      manifest_ = read_golden_manifest(folder / kManifest);
    }
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

GoldenSet::~GoldenSet() { ::close(lock_); }

Fingerprint GoldenSet::load(const std::string& scene, const FrameFormat& frame) const {
  const Golden& golden = manifest_.scenes.at(scene);
  for (const auto& [kind, file] : golden.files) {
    const std::string bytes = bytes_of(folder_ / file.file);
    if (bytes.size() != file.bytes || hash_of(bytes) != file.hash) {
      throw GoldenError(fmt::format("{}: expected the {} bytes of hash {} that the manifest names, found {} of {}",
                                    (folder_ / file.file).string(), file.bytes, to_string(file.hash), bytes.size(),
                                    to_string(hash_of(bytes))));
    }
  }
  const auto require = [&](const char* kind, const std::string& format) {
    if (golden.files.at(kind).format != format) {
      throw GoldenError(
          fmt::format("{}: expected {} in {}, found {}", scene, kind, format, golden.files.at(kind).format));
    }
    return folder_ / golden.files.at(kind).file;
  };
  const fs::path color = require("color", std::string(name_of(frame.color))),
                 depth = require("depth", std::string(name_of(frame.depth)));
  return {read_stages(require("stages", "json")), frame_color(color, read_stored(color), frame.color),
          frame_depth(depth, read_stored(depth), frame.depth)};
}

GoldenSet::Strays GoldenSet::strays() const {
  std::set<std::string> named = {kManifest, kTolerances, kReadme};
  for (const auto& [name, golden] : manifest_.scenes) {
    for (const auto& [kind, file] : golden.files) named.insert(file.file);
  }
  Strays out;
  for (auto it = fs::recursive_directory_iterator(folder_); it != fs::recursive_directory_iterator(); ++it) {
    const fs::directory_entry& entry = *it;
    if (fs::is_directory(entry.symlink_status())) {
      if (!fs::exists(entry.path() / kManifest)) continue;
      it.disable_recursion_pending();  // another set's
    }
    const std::string file = entry.path().lexically_relative(folder_).generic_string();
    if (!named.contains(file)) (is_ours(entry.path()) ? out.leftovers : out.others).push_back(file);
  }
  std::ranges::sort(out.leftovers);
  std::ranges::sort(out.others);
  return out;
}

void GoldenSet::write(GoldenManifest next, const std::map<std::string, std::string>& files) {
  const std::string text = manifest_text(next);
  const EndsLater whole;
  // A new set gets an empty manifest first, so that files of a killed update are leftovers, not somebody's.
  if (!fs::exists(folder_ / kManifest)) write_file(folder_ / kManifest, manifest_text({}));
  for (const auto& [name, bytes] : files) {
    std::error_code failed;  // the file's own writing says why
    fs::create_directories((folder_ / name).parent_path(), failed);
    write_file(folder_ / name, bytes);
  }
  AtomicPath manifest(folder_ / kManifest);
  manifest.write(text);
  // Whatever is on the way to the disk is there before the manifest that speaks of it, should the power fail.
  if (::syncfs(lock_) != 0) throw OutputError(folder_, std::strerror(errno));
  manifest.commit();
  ::fsync(lock_);
  manifest_ = std::move(next);
  remove_leftovers();
}

void GoldenSet::remove_leftovers() const {
  for (const std::string& file : strays().leftovers) {
    std::error_code failed;  // then it stays: nobody reads it
    fs::path path = folder_ / file;
    fs::remove(path, failed);
    while ((path = path.parent_path()) != folder_ && fs::is_empty(path, failed)) fs::remove(path, failed);
  }
}

Golden make_golden(const Scene& scene, const Fingerprint& drawn, std::map<std::string, std::string>& files) {
  Golden out;
  out.scene = scene_hash(scene);
  const auto add = [&](const char* kind, const std::string& format, const std::string& bytes) {
    const Hash hash = hash_of(bytes);
    const GoldenFile file{golden_file_name(scene.name, kind, hash, format), format, bytes.size(), hash};
    files[file.file] = bytes;
    out.files[kind] = file;
  };
  const std::string color(name_of(scene.frame.color));
  add("color", color, encode_image(color == "rgba32f" ? "color.exr" : "color.png", drawn.color, scene.frame.color));
  add("depth", std::string(name_of(scene.frame.depth)),
      encode_depth_codes("depth.exr", drawn.depth, scene.frame.depth));
  add("stages", "json", stages_text(drawn.stages));
  return out;
}

}  // namespace plumbline::check
