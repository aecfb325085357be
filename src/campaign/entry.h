// An entry of a campaign's journal: a scene that was judged.
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "campaign/scene_id.h"

namespace plumbline::campaign {

/// A bug's signature: scenes of one signature are one finding.
struct Signature {
  std::string stage;  ///< name of the first different stage
  std::string cause;  ///< the row's outcome and its worst record's field, "different color"; of a dispute, the reason
  std::string reference;  ///< the judge's name for people
  auto operator<=>(const Signature&) const = default;
};
/// STAGE, CAUSE (against REFERENCE).
std::string to_string(const Signature& signature);

struct Entry {
  SceneId id;
  std::vector<Signature> found;     ///< the finding; empty: the scene holds, or is unable
  std::vector<Signature> disputes;  ///< where a reference is shown to be wrong; sorted, each once
  std::string unable{};             ///< why nothing that the candidate drew could be judged; empty: something was
  std::string states{};             ///< StateBits of the scene (states/states.h)
  double milliseconds = 0;          ///< time of judging; differs from run to run
};
/// True: two entries have the same scene, verdict and states; times may differ.
inline bool same_verdict(const Entry& a, const Entry& b) {
  return a.id == b.id && a.found == b.found && a.disputes == b.disputes && a.unable == b.unable && a.states == b.states;
}

}  // namespace plumbline::campaign
