#include "check/kept/verdict_store.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "base/atomic_path.h"

namespace plumbline::check {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHashDigits = 32;

// A folder for each of the first two digits: a folder of thousands is slow to look through.
fs::path path_of(const fs::path& folder, const Hash& key) {
  const std::string name = to_string(key);
  return folder / name.substr(0, 2) / (name.substr(2) + ".verdict");
}

// Whether a store of that folder wrote the file: no other is removed.
bool is_kept(const fs::path& folder, const fs::path& file) {
  const std::optional<Hash> key = parse_hash(file.parent_path().filename().string() + file.stem().string());
  return key && file == path_of(folder, *key);
}

}  // namespace

std::optional<std::string> VerdictStore::find(const Hash& key) const {
  const fs::path file = path_of(folder_, key);
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < kHashDigits) return std::nullopt;
  const std::optional<Hash> hash = parse_hash(std::string_view(bytes).substr(0, kHashDigits));
  bytes.erase(0, kHashDigits);
  if (!hash || *hash != hash_of(bytes)) return std::nullopt;
  std::error_code ignored;
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
  return bytes;
}

void VerdictStore::keep(const Hash& key, std::string_view bytes) const {
  const fs::path file = path_of(folder_, key);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) return;
  try {
    AtomicPath whole(file);
    whole.write(to_string(hash_of(bytes)) + std::string(bytes));
    whole.commit();
  } catch (const std::exception&) {  // no room, say
  }
}

void VerdictStore::forget(const Hash& key) const {
  std::error_code ignored;
  fs::remove(path_of(folder_, key), ignored);
}

void VerdictStore::trim(std::uint64_t most_bytes) const {
  struct File {
    fs::file_time_type used;
    std::uint64_t size;
    fs::path path;
  };
  std::vector<File> files;
  std::uint64_t sum = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;  // by another run
    if (!at->is_regular_file(gone) || !is_kept(folder_, at->path())) continue;
    const File file{at->last_write_time(gone), at->file_size(gone), at->path()};
    if (gone) continue;
    sum += file.size;
    files.push_back(file);
  }
  std::ranges::sort(files, {}, &File::used);
  for (const File& file : files) {
    if (sum <= most_bytes) break;
    sum -= file.size;
    fs::remove(file.path, error);
  }
}

}  // namespace plumbline::check
