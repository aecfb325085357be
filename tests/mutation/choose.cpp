#include "mutation/choose.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "mutation/fields.h"

namespace plumbline::mutation {

namespace {

std::vector<std::vector<std::string>> rows_of(const std::filesystem::path& table, std::size_t fields) {
  std::ifstream in(table);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", table.string()));
  std::vector<std::vector<std::string>> out;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    out.push_back(fields_of(line, '\t'));
    if (out.back().size() != fields || std::ranges::count(out.back(), std::string()) > 0) {
      throw std::runtime_error(fmt::format("{}:{}: expected {} fields apart by tabs", table.string(), number, fields));
    }
  }
  return out;
}

}  // namespace

std::vector<FileRule> read_file_rules(const std::filesystem::path& table) {
  std::vector<FileRule> out;
  for (auto& row : rows_of(table, 3)) out.push_back({row[0], fields_of(row[1], ','), row[2]});
  return out;
}

const FileRule* rule_of(const std::vector<FileRule>& rules, const std::string& path, const std::string& function) {
  const FileRule* out = nullptr;
  const std::string place = path + "#" + function;
  for (const FileRule& rule : rules) {
    if (place.starts_with(rule.prefix) && (out == nullptr || rule.prefix.size() > out->prefix.size())) out = &rule;
  }
  return out;
}

std::map<std::string, std::string> sources_of(const std::filesystem::path& root, const std::vector<FileRule>& rules) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "src")) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || (extension != ".cpp" && extension != ".h")) continue;
    const std::string path = entry.path().lexically_relative(root).generic_string();
    const FileRule* rule = rule_of(rules, path, "");
    if (rule == nullptr) throw std::runtime_error(fmt::format("{}: no row of files.tsv says what it is", path));
    const bool by_function =
        std::ranges::any_of(rules, [&](const FileRule& r) { return r.prefix.starts_with(path + "#"); });
    if (rule->names[0] == "-" && !by_function) continue;
    std::ifstream in(entry.path());
    out[path] = std::string(std::istreambuf_iterator<char>(in), {});
  }
  return out;
}

Draw::Draw(const std::map<std::string, std::string>& sources, const std::vector<FileRule>& rules, std::uint64_t seed)
    : random_(seed) {
  for (const auto& [file, text] : sources) {
    std::map<std::size_t, std::vector<Change>> by_line;
    for (Change& change : changes_of(file, text)) {
      if (rule_of(rules, file, change.function)->names[0] != "-") by_line[change.line].push_back(std::move(change));
    }
    for (auto& [line, changes] : by_line) lines_.push_back(std::move(changes));
  }
}

bool Draw::next(Change& change) {
  if (lines_.empty()) return false;
  const auto line = lines_.begin() + static_cast<std::ptrdiff_t>(random_() % lines_.size());
  std::vector<std::string> kinds;
  for (const Change& c : *line) {
    if (std::ranges::count(kinds, c.kind) == 0) kinds.push_back(c.kind);
  }
  const std::string& kind = kinds[random_() % kinds.size()];
  std::erase_if(*line, [&](const Change& c) { return c.kind != kind; });
  change = (*line)[random_() % line->size()];
  lines_.erase(line);
  return true;
}

std::vector<Equivalent> read_equivalents(const std::filesystem::path& table) {
  std::vector<Equivalent> out;
  for (auto& row : rows_of(table, 4)) out.push_back({row[0], row[1], row[2], row[3]});
  return out;
}

}  // namespace plumbline::mutation
