// The fault matrix: every fault on the scenes that it affects, pairs of faults, and legal variants, each diagnosed by
// exact. Is the fault seen, and is the broken stage the one that is named?
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/stages.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::matrix {

/// A pipeline to be diagnosed.
struct Subject {
  std::string name;
  pipeline::Stages stages;
  std::vector<Stage> broken;  ///< the stages that must be named, in order; none: nothing may be raised
};

/// One subject on one scene.
struct Answer {
  std::size_t scene = 0;
  std::string by;              ///< reference and stage of the first row that differs; empty: none does
  std::optional<Stage> first;  ///< as check::Diagnosis has them
  std::vector<Stage> wrong;
  std::string failed;  ///< stage and note of the last row that failed; empty: none did

  bool seen() const { return !by.empty() || !wrong.empty() || !failed.empty(); }
};

/// One fault: its stage is the first that differs, and alone wrong by itself. Several: each is wrong by itself. None:
/// nothing is seen.
bool is_right(const Answer& answer, const Subject& subject);

/// Numbers of scenes, ascending.
using SceneList = std::vector<std::size_t>;

/// For each subject the first `most` scenes that it affects: any bit of any record or of the picture is not the
/// pipeline's own. Throws std::runtime_error with subject and scene where a pipeline throws.
std::vector<SceneList> affected(std::span<const Scene> scenes, std::span<const Subject> subjects, std::size_t most,
                                unsigned workers);

/// For each subject the answers on its scenes `on`, in their order. Each scene is judged by one of `workers` threads.
std::vector<std::vector<Answer>> diagnosed(std::span<const Scene> scenes, std::span<const Subject> subjects,
                                           std::span<const SceneList> on, unsigned workers);

/// `most` of the scenes, evenly spread over the list, which goes by groups; or all, if they are fewer.
SceneList spread(const SceneList& scenes, std::size_t most);

}  // namespace plumbline::matrix
