// Changes of seeds, compiled one after the other, and judged beside that.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mutation/score.h"

namespace plumbline::mutation {

struct CampaignOptions {
  std::filesystem::path root;       ///< of the repository
  std::filesystem::path out;        ///< where the copy is built, and files are left
  std::vector<std::string> seeds;   ///< hexadecimal
  std::size_t changes = 67;         ///< that compile, of each seed
  std::optional<std::size_t> only;  ///< the number of the one that is wanted
  std::optional<unsigned> minutes;  ///< after which no other change is begun
  std::filesystem::path keep;       ///< a log of the same sources; the changes that it has found are not judged again
  unsigned workers = 2;  ///< 1: compiled and judged in turns; else one change is compiled while others are judged
};

/// Judges the changes of all seeds, and returns them by seed and number. Calls took() with each change as soon as it is
/// judged, one at a time, from any thread. Throws std::runtime_error where the sources as they are do not build or
/// hold, and for a bad table or log.
std::vector<Judged> run_campaign(const CampaignOptions& options, const std::vector<FileRule>& rules,
                                 const std::function<void(const Judged&)>& took);

/// All changes of the sources below `root`, in the order in which the seed draws them, numbered from 1. Throws
/// std::runtime_error or std::invalid_argument where `seed` is not hexadecimal.
std::vector<Judged> changes_of_seed(const std::filesystem::path& root, const std::vector<FileRule>& rules,
                                    const std::string& seed);

}  // namespace plumbline::mutation
