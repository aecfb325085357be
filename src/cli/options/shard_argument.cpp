#include "cli/options/shard_argument.h"

#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::cli {

report::Shard take_shard(std::vector<std::filesystem::path>& files, const std::string& text) {
  report::Shard shard{1, 1, files.size()};
  if (text.empty()) return shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto of = has_slash ? std::from_chars(index.ptr + 1, end, shard.of) : index;
  const bool is_one = has_slash && of.ec == std::errc() && of.ptr == end && shard.index >= 1 && shard.index <= shard.of;
  if (!is_one) throw std::invalid_argument(fmt::format("--shard {}: expected I/N, I from 1 to N, such as 2/4", text));
  std::vector<std::filesystem::path> mine;
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < files.size(); i += static_cast<std::size_t>(shard.of)) {
    mine.push_back(files[i]);
  }
  files = std::move(mine);
  return shard;
}

}  // namespace plumbline::cli
