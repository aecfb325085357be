// The fault matrix: every fault on the scenes that it affects, pairs of faults, and legal variants, each diagnosed by
// exact. What a renderer's author would read is asked: was it seen, and is the stage that was broken the one that is
// named.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "faults/table.h"
#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::matrix {

/// A pipeline to be diagnosed.
struct Subject {
  std::string name;
  faults::Table table;
  std::vector<Stage> broken;  ///< the stages that must be named, in order; none: nothing may be raised
};

/// One subject on one scene.
struct Answer {
  std::size_t scene = 0;
  std::string by;              ///< reference and stage of the first row that is different; empty: nothing was seen
  std::optional<Stage> first;  ///< as check::Diagnosis has them
  std::vector<Stage> wrong;
  std::string failed;  ///< the note of a row that failed; empty: none
};

/// Of one fault: its stage is the first that differs, and the one that is wrong by itself. Of more: each of them is
/// wrong by itself.
bool names(const Answer& answer, const Subject& subject);

/// For each subject the scenes, ascending, on which its capture is not the pipeline's own, in any bit of any record or
/// plane.
std::vector<std::vector<std::size_t>> affected(std::span<const Scene> scenes, std::span<const Subject> subjects,
                                               unsigned workers);

/// For each subject the answers for its scenes, in their order.
std::vector<std::vector<Answer>> diagnosed(std::span<const Scene> scenes, std::span<const Subject> subjects,
                                           std::span<const std::vector<std::size_t>> on, unsigned workers);

/// At most `most` of the scenes, evenly spread over the list, which goes by groups.
std::vector<std::size_t> sample(const std::vector<std::size_t>& scenes, std::size_t most);

}  // namespace plumbline::matrix
