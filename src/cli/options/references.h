// The references that a run asks.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "capture/renderers/watched_renderer.h"
#include "check/judge/judge.h"

namespace plumbline::cli {

struct References {
  std::vector<std::unique_ptr<Renderer>> owned;
  std::vector<check::Reference> list;
  std::vector<check::Reference> arbiters{};  ///< Embree and exact where they were not named (check::judge)
};
/// `assets`: folders of --assets, for references in processes of their own.
References make_references(const std::vector<std::string>& names, const std::vector<std::string>& assets);
/// In a worker: each is watched, numbered from 1, and there are arbiters. `fault`: of one of them (faults/endings.h),
/// or of none.
References make_references(const std::vector<std::string>& names, const std::vector<std::string>& assets,
                           const Watch& watch, const std::string& fault = "");

/// Throws std::runtime_error where one of them runs in a process of its own, and no temporary folder can be made.
void require_references(const std::vector<std::string>& names);

/// Each once, in their order: `exact,exact` is `exact`, and all three are all, however they are written.
std::vector<std::string> without_repeats(const std::vector<std::string>& names);

/// Names that a row may be against: all known references, "golden" and "picture".
std::vector<std::string> names_of_rows();

/// Versions by renderer's name: the candidate's, and those of references.list.
std::map<std::string, std::string> versions_of(const Renderer& candidate, const References& references);

}  // namespace plumbline::cli
