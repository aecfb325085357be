#include "mutation/tree.h"

#include <fstream>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "mutation/run.h"

namespace plumbline::mutation {

namespace {

namespace fs = std::filesystem;

constexpr unsigned kBuildSeconds = 600;  ///< time limit of configuring; of a compilation six times as long

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

// Copies all files that git knows, or would add, but the goldens. Equal files stay untouched: only changes are
// rebuilt.
void copy_sources(const fs::path& root, const fs::path& tree, const fs::path& list) {
  const std::vector<std::string> git = {
      "git",      "-C",       root.string(),        "-c",           "core.quotePath=off", "ls-files",
      "--cached", "--others", "--exclude-standard", "--deduplicate"};
  if (!run(git, list, 60).ok()) throw std::runtime_error(fmt::format("git ls-files fails: see {}", list.string()));
  std::set<fs::path> wanted;
  std::ifstream in(list);
  for (std::string name; std::getline(in, name);) {
    if (name.starts_with("golden/") || !fs::is_regular_file(root / name)) continue;
    wanted.insert(tree / name);
    fs::create_directories((tree / name).parent_path());
    if (fs::exists(tree / name) && text_of(root / name) == text_of(tree / name)) continue;
    fs::copy_file(root / name, tree / name, fs::copy_options::overwrite_existing);
    fs::last_write_time(tree / name, fs::file_time_type::clock::now());
  }
  std::vector<fs::path> gone;
  for (const auto& entry : fs::recursive_directory_iterator(tree)) {
    if (entry.is_regular_file() && !wanted.contains(entry.path())) gone.push_back(entry.path());
  }
  for (const fs::path& file : gone) fs::remove(file);
}

// A file with its time, by which ninja knows it.
void copy_with_time(const fs::path& from, const fs::path& to) {
  fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  fs::last_write_time(to, fs::last_write_time(from));
}

// The regular files of `from` that `to` has not, or has with another time or size.
void copy_differing(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    const fs::path target = to / entry.path().lexically_relative(from);
    if (entry.is_symlink()) continue;
    if (entry.is_directory()) {
      fs::create_directories(target);
    } else if (!fs::exists(target) || fs::last_write_time(target) != entry.last_write_time() ||
               fs::file_size(target) != entry.file_size()) {
      copy_with_time(entry.path(), target);
    }
  }
}

}  // namespace

Tree::Tree(const fs::path& root, const fs::path& out, unsigned workers) : out_(out), workers_(workers) {
  fs::create_directories(source());
  copy_sources(root, source(), out_ / "files");
  const std::vector<std::string> configure = {"cmake",
                                              "-S",
                                              source().string(),
                                              "-B",
                                              build().string(),
                                              "-G",
                                              "Ninja",
                                              "-DCMAKE_BUILD_TYPE=None",
                                              "-DCMAKE_CXX_FLAGS=-O1 -w",
                                              "-DPLUMBLINE_TESTS=OFF",
                                              "-DPLUMBLINE_CHANGES=ON"};
  const fs::path log = out_ / "build.log";
  if (!run(configure, log, kBuildSeconds).ok() || !compile("build.log")) {
    throw std::runtime_error(fmt::format("the sources do not build: see {}", log.string()));
  }
  fs::remove_all(out_ / "kept");
  copy_differing(build(), out_ / "kept");
}

bool Tree::compile(const std::string& log) const {
  return run({"ninja", "-C", build().string(), fmt::format("-j{}", workers_), "plumb", "scene_hashes", "data_tests"},
             out_ / log, 6 * kBuildSeconds)
      .ok();
}

bool Tree::build_changed(const Change& change, const fs::path& to) {
  const fs::path file = source() / change.file, kept = out_ / "kept_source";
  copy_with_time(file, kept);
  write_text(file, changed(text_of(file), change));
  const bool built = compile("change.log");
  if (built) copy_programs(to);
  copy_with_time(kept, file);
  restore();
  return built;
}

void Tree::copy_programs(const fs::path& to) const {
  fs::create_directories(to);
  for (const char* name :
       {"plumb", "scene_hashes", "data_tests", "plumbline_mesh_reader", "plumbline_openimageio.so"}) {
    fs::copy_file(build() / name, to / name, fs::copy_options::overwrite_existing);
  }
}

// Objects, libraries and ninja's own notes: compiling the changed file once more would take as long again.
void Tree::restore() const { copy_differing(out_ / "kept", build()); }

}  // namespace plumbline::mutation
