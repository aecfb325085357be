// The fault matrix: every fault on the scenes that it affects, pairs of faults, and what is legal, each diagnosed by
// exact. Asked is what a renderer's author would want: is it seen, and is what is broken what is named?
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
  std::string by;              ///< reference and stage of the first row that differs; empty: nothing was seen
  std::optional<Stage> first;  ///< as check::Diagnosis has them
  std::vector<Stage> wrong;
  std::string failed;  ///< the note of a row that failed, or empty

  bool seen() const { return !by.empty() || !wrong.empty() || !failed.empty(); }
};

/// Of one fault: its stage is the first that differs, and the only one that is wrong by itself. Of more: each is wrong
/// by itself. Of none: nothing is seen.
bool is_right(const Answer& answer, const Subject& subject);

/// Numbers of scenes, ascending.
using SceneList = std::vector<std::size_t>;

/// For each subject the first `most` scenes on which the pipeline hands on anything else than it should: any bit of any
/// record, or of the picture. Throws std::runtime_error that names subject and scene where it throws.
std::vector<SceneList> affected(std::span<const Scene> scenes, std::span<const Subject> subjects, std::size_t most,
                                unsigned workers);

/// For each subject the answers for its scenes, in their order.
std::vector<std::vector<Answer>> diagnosed(std::span<const Scene> scenes, std::span<const Subject> subjects,
                                           std::span<const SceneList> on, unsigned workers);

/// `most` of the scenes, evenly spread over the list, which goes by groups; or all, if they are fewer.
SceneList spread(const SceneList& scenes, std::size_t most);

}  // namespace plumbline::matrix
