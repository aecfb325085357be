#include "cli/fingerprints.h"

#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/utf8.h"
#include "capture/files/conventions_file.h"
#include "check/golden/golden_hash.h"
#include "cli/options/program_argument.h"

namespace plumbline::cli {

namespace {

std::string loaded_libraries() {
  std::string out;
  const auto add = [](dl_phdr_info* info, std::size_t, void* to) {
    struct stat file;
    const std::string_view name = info->dlpi_name;
    if (!name.empty() && ::stat(info->dlpi_name, &file) == 0)  // the program itself, and the kernel's, have no file
      *static_cast<std::string*>(to) += fmt::format("{} {} {}\n", name, file.st_size, file.st_mtime);
    return 0;
  };
  dl_iterate_phdr(add, &out);
  return out;
}

std::string processor() {
  std::string out;
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line) && !line.empty();) {  // the first processor's lines
    if (line.starts_with("model name") || line.starts_with("flags") || line.starts_with("Features")) out += line + "\n";
  }
  return out;
}

std::string settings() {
  constexpr std::string_view kPrefixes[] = {"MESA_", "GALLIUM_", "GALLIVM_", "LP_", "ST_", "LIBGL_", "EMBREE_"};
  std::vector<std::string> out;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const auto begins = [&](std::string_view prefix) { return text.starts_with(prefix); };
    if (std::ranges::any_of(kPrefixes, begins) && !text.starts_with("MESA_SHADER_CACHE")) out.emplace_back(text);
  }
  std::ranges::sort(out);
  return fmt::format("{}\n", fmt::join(out, "\n"));
}

}  // namespace

std::string judges_fingerprint(const CheckOptions& o) {
  return fmt::format("{}\n{}{}{}against {} fault {} program {} from {} primitives {}", kJudgesFingerprint,
                     loaded_libraries(), processor(), settings(), fmt::join(o.against, ","), o.fault,
                     o.candidate.command, o.candidate.from, o.candidate.probes);
}

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string fingerprint_of(const std::vector<fs::path>& files) {
  std::string all;
  for (const fs::path& file : files) {
    const std::string bytes = bytes_of(file);
    all += fmt::format("{} {}\n", file.filename().string(), bytes.size()) + bytes;
  }
  return files.empty() ? "" : fmt::format(" ({})", to_string(check::hash_of(all)));
}

// The files that words of a command line name; the first word's may be one in PATH.
std::vector<fs::path> files_of(std::string command) {
  std::erase_if(command, [](char c) { return c == '"' || c == '\''; });
  std::vector<fs::path> out;
  std::error_code none;
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    if (fs::is_regular_file(word, none)) {
      out.emplace_back(word);
    } else if (out.empty() && word.find('/') == word.npos && std::getenv("PATH") != nullptr) {
      std::istringstream folders(std::getenv("PATH"));
      for (std::string folder; out.empty() && std::getline(folders, folder, ':');) {
        if (fs::is_regular_file(fs::path(folder) / word, none)) out.push_back(fs::path(folder) / word);
      }
    }
  }
  return out;
}

std::vector<fs::path> files_in(const std::vector<std::string>& folders) {
  std::vector<fs::path> out;
  for (const std::string& folder : folders) {
    const std::size_t begin = out.size();
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file()) out.push_back(entry.path());
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end());
  }
  return out;
}

}  // namespace

std::string campaign_fingerprint(const CheckOptions& o) {
  std::string out = fmt::format("plumb {}{}", PLUMBLINE_VERSION, fingerprint_of({"/proc/self/exe"}));
  if (!o.fault.empty()) out += ", fault " + o.fault;
  if (!o.candidate.command.empty())
    out += ", program " + as_utf8(o.candidate.command) + fingerprint_of(files_of(o.candidate.command));
  if (!o.candidate.from.empty()) out += ", from " + o.candidate.from;
  if (o.candidate.probes) out += ", each primitive";
  if (!o.candidate.conventions.empty())
    out += fmt::format(", conventions ({})",
                       to_string(check::hash_of(conventions_text(conventions_of(o.candidate.conventions)))));
  const CheckOptions usual;
  if (o.limits.step != usual.limits.step || o.limits.memory != usual.limits.memory ||
      o.candidate.time_limit != usual.candidate.time_limit) {
    out += fmt::format(", {} s, of a program {} s, {} MiB", o.limits.step / std::chrono::seconds(1),
                       o.candidate.time_limit.count(), o.limits.memory >> 20);
  }
  return out + fmt::format(", assets{}, against {}", fingerprint_of(files_in(o.scene_arguments.assets)),
                           fmt::join(o.against, ","));
}

}  // namespace plumbline::cli
