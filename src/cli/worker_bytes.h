// Requests and answers between plumb and the workers that judge scenes for it.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "cli/scene_judge.h"

namespace plumbline::cli {

/// A scene to be judged: its number, the steps that ended workers before, and, where the comparison itself did, how.
struct JudgeRequest {
  std::size_t scene = 0;
  EndedSteps ended;
  std::string not_compared;
};
std::string to_bytes(JudgeRequest request);
JudgeRequest request_of(std::string_view bytes);

/// A diagnosis: plumb's exit code and output.
struct DiagnosisAnswer {
  int code = 0;
  std::string text;
};
std::string to_bytes(DiagnosisAnswer answer);
DiagnosisAnswer diagnosis_of(std::string_view bytes);

/// Leaves out the pixels that differ (Measurement::differing_at, disputed_at): pages are drawn before, by the worker.
std::string to_bytes(JudgedScene scene, const CheckRules& rules);
/// Inverse of to_bytes(). `words` receives the texts that the verdict points to (Place::field), and must outlive it.
JudgedScene judged_scene_of(std::string_view bytes, const CheckRules& rules, std::set<std::string>& words);

}  // namespace plumbline::cli
