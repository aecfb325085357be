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
/// References in a worker, with arbiters: each reference is watched, with a number from 1 on. `fault`: of one of the
/// references (faults/endings.h), or of none.
References make_references(const std::vector<std::string>& names, const std::vector<std::string>& assets,
                           const Watch& watch, const std::string& fault = "");

/// Throws std::runtime_error where a reference of `names` runs in its own process, and no temporary folder can be made.
void require_references(const std::vector<std::string>& names);

/// The known references among `names`, each once, in the order of known_reference_names().
std::vector<std::string> without_repeats(const std::vector<std::string>& names);

/// Names that a row may be against: all known references, "golden" and "picture".
std::vector<std::string> names_of_rows();

/// Versions by renderer's name: the candidate's, and those of references.list.
std::map<std::string, std::string> versions_of(const Renderer& candidate, const References& references);

}  // namespace plumbline::cli
