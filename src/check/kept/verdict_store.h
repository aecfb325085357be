// Bytes on disk by their key, for later runs, of which several may use the folder at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "check/golden/golden_hash.h"

namespace plumbline::check {

/// A folder of files, each with the hash of its own bytes. A file appears whole or not at all; a truncated or damaged
/// file counts as absent. Errors of writing are ignored: the bytes are then not kept. Files of others are left alone.
class VerdictStore {
 public:
  explicit VerdictStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::optional<std::string> find(const Hash& key) const;
  void keep(const Hash& key, std::string_view bytes) const;
  void forget(const Hash& key) const;
  /// Removes the least recently found of its files until the rest takes at most `most_bytes` [bytes].
  void trim(std::uint64_t most_bytes) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace plumbline::check
