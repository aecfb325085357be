// A campaign's scenes: judged in a worker process, and made smaller.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "campaign/entry.h"
#include "campaign/results.h"
#include "cli/scene_judge.h"

namespace plumbline::cli {

class CampaignJudge {
 public:
  /// Scene files are written to `scratch`, one at a time.
  CampaignJudge(const CheckRules& rules, Progress& progress, std::filesystem::path scratch);

  /// `ended`: the steps that ended workers before. Throws SceneError where the scene needs a file that is not there.
  campaign::Entry judge(const campaign::SceneId& id, EndedSteps ended);

  /// The text of a smaller scene with the same signature. Shrinks first by the signature's own reference alone, which
  /// is quick, where that reference yields the signature by itself; then by all references.
  std::string shrink(const campaign::SceneId& id, const campaign::Signature& signature);

 private:
  std::optional<campaign::Signature> signature_of(SceneJudge& judge, const std::string& text);
  std::filesystem::path write(const std::string& name, const std::string& text) const;

  const CheckRules* rules_;
  Progress* progress_;
  std::filesystem::path scratch_;
  SceneJudge all_;
};

/// Signature of the scene's failure; none where the scene holds. `command`: the program's command line, which is
/// removed from the signature's cause.
std::optional<campaign::Signature> signature_of(const check::SceneVerdict& verdict, const std::string& command = {});

}  // namespace plumbline::cli
