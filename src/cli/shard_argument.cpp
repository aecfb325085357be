#include "cli/shard_argument.h"

#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::cli {

report::Shard take_shard(std::vector<std::filesystem::path>& files, const std::string& text) {
  report::Shard shard{1, 1, files.size()};
  if (text.empty()) return shard;
  int end = 0;
  const bool is_one = std::sscanf(text.c_str(), "%5d/%5d%n", &shard.index, &shard.of, &end) == 2 &&
                      end == static_cast<int>(text.size()) && shard.index >= 1 && shard.index <= shard.of;
  if (!is_one) throw std::invalid_argument(fmt::format("--shard {}: expected I/N, I from 1 to N, such as 2/4", text));
  std::vector<std::filesystem::path> mine;
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < files.size(); i += static_cast<std::size_t>(shard.of)) {
    mine.push_back(files[i]);
  }
  files = std::move(mine);
  return shard;
}

}  // namespace plumbline::cli
