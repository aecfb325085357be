#include "mutation/kept.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "mutation/fields.h"
#include "mutation/run.h"

namespace plumbline::mutation {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFields = 16;  // of log_of

Outcome outcome_of(const std::string& name, const std::string& place) {
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    if (name_of(static_cast<Outcome>(i)) == name) return static_cast<Outcome>(i);
  }
  throw std::runtime_error(fmt::format("{}: expected an outcome, found {}", place, name));
}

}  // namespace

ChangeKey key_of(const Judged& j) {
  return {j.seed, std::to_string(j.number), j.change.file, j.lines.before, j.lines.after};
}

std::string sources_hash(const fs::path& root) {
  std::vector<fs::path> files;
  for (const char* folder : {"src", "reference"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(root));
    }
  }
  std::ranges::sort(files);
  std::string hashes;
  for (const fs::path& file : files) {
    const std::string text = text_of(root / file);
    hashes += fmt::format("{} {:016x}\n", file.string(), XXH3_64bits(text.data(), text.size()));
  }
  return fmt::format("{:016x}", XXH3_64bits(hashes.data(), hashes.size()));
}

std::string log_head(const std::string& sources) { return fmt::format("# sources {}\n", sources); }

std::map<ChangeKey, Verdict> read_found(const fs::path& log, const std::string& sources) {
  std::istringstream in(text_of(log));
  std::string line;
  std::getline(in, line);
  if (line + "\n" != log_head(sources)) {
    throw std::runtime_error(fmt::format("{}:1: expected \"# sources {}\", as these sources are; found \"{}\"",
                                         log.string(), sources, line));
  }
  std::getline(in, line);  // the columns' names
  std::map<ChangeKey, Verdict> out;
  for (int number = 3; std::getline(in, line); ++number) {
    const std::string place = fmt::format("{}:{}", log.string(), number);
    const std::vector<std::string> f = fields_of(line, '\t');
    if (f.size() != kFields) {
      throw std::runtime_error(fmt::format("{}: expected {} fields, found {}", place, kFields, f.size()));
    }
    Verdict v{outcome_of(f[5], place), number_of(f[6], 10, place), f[7], {}, {f[9], f[10]}, {f[11], f[12]}, f[15]};
    if (!f[8].empty()) v.expected = fields_of(f[8], ',');
    const bool is_settled = v.found() ? v.named_by_check() && v.named_by_diagnose() : v.outcome == Outcome::equivalent;
    if (is_settled) out[{f[0], f[1], f[2], f[13], f[14]}] = std::move(v);
  }
  return out;
}

}  // namespace plumbline::mutation
