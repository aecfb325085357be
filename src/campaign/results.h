// Results of a campaign, merged from all its journals.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "campaign/entry.h"
#include "campaign/states/reached.h"

namespace plumbline::campaign {

/// All scenes of one signature.
struct Group {
  Signature signature;
  std::uint64_t scenes = 0;
  std::vector<SceneId> first;  ///< the lowest, at most kMostFirst
};
inline constexpr std::size_t kMostFirst = 3;

struct Results {
  std::map<Generator, std::uint64_t> judged;    ///< scenes
  std::uint64_t held = 0;                       ///< scenes
  std::map<std::string, std::uint64_t> unable;  ///< scenes of which nothing could be judged, by the reason
  std::vector<Group> found, disputes;           ///< by signature
  std::vector<SceneId> conflicts;               ///< scenes that two journals judge differently
  Reached reached;
  /// Scenes that first reached a state or a pair, by round (a scene's number of seeds), in the order of names.
  std::map<std::size_t, std::vector<SceneId>> kept;
  double milliseconds = 0;  ///< of judging, in all processes together
  std::uint64_t scenes() const;
};

/// Results of the union of the journals' entries: equal entries count once, and the order of journals does not matter.
Results merged(const std::vector<std::vector<Entry>>& journals);

/// Lines for people: scenes, a line for each group, the most frequent first.
std::string text_of(const Results& results);
/// JSON: the same bytes for the same verdicts, whoever judged them and in whatever time.
std::string json_of(const Results& results, const std::string& terms);

}  // namespace plumbline::campaign
