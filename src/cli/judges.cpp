#include "cli/judges.h"

#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "check/golden/golden_hash.h"

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
  for (std::string line; std::getline(in, line) && !line.empty();) {  // the first of them
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

std::string judges_of(const CheckOptions& o) {
  return fmt::format("{}\n{}{}{}against {} fault {} program {} from {} primitives {}", kJudgesPrint, loaded_libraries(),
                     processor(), settings(), fmt::join(o.against, ","), o.fault, o.candidate.command, o.candidate.from,
                     o.candidate.probes);
}

namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace

std::string program_print() { return to_string(check::hash_of(bytes_of("/proc/self/exe"))); }

std::string files_print(const std::string& command) {
  std::string all;
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(word, none)) continue;
    const std::string bytes = bytes_of(word);
    all += fmt::format("{} {}\n", word, bytes.size()) + bytes;
  }
  return all.empty() ? "" : fmt::format(" ({})", to_string(check::hash_of(all)));
}

}  // namespace plumbline::cli
