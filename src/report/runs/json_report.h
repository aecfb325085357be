// The verdict as JSON, for programs.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "check/compare/compare_stored.h"
#include "check/diagnose/diagnose.h"
#include "check/verdict/verdict.h"

namespace plumbline::report {

/// A part of a run: of the scenes in their order, every of-th, beginning with number `index` (from 1).
struct Shard {
  int index = 1, of = 1;
  std::size_t scenes = 0;  ///< of all shards together
  bool operator==(const Shard&) const = default;
};

/// The request of a run of plumb check, and its failures outside scenes.
struct RunHead {
  std::map<std::string, std::string> versions;  ///< by renderer
  std::string fault;                            ///< of the candidate; empty: none
  std::vector<std::string> against;             ///< the references asked
  bool golden = false;                          ///< whether goldens were
  Shard shard;
  std::vector<std::string> failures;  ///< a line each, such as an expectation of a scene that is not there
};

/// {"format": "plumbline run", "version": 1, "versions": {renderer: version}, "fault", "against", "golden", "failures",
/// "tolerances": {the ledger's row: factor}, "shard": {index, of, scenes}, "scenes": [{scene, file, seconds, failure,
/// repeat}] (the last two where it does not hold), "comparisons": [{scene, reference, kind, title, stage, outcome,
/// pixels, differing, ambiguous, max_difference, unit, worst, disputed, max_ratio, histogram, dispute, ledger, note}]
/// (the last three where there are any)}. Numbers that JSON cannot hold are the strings "inf", "-inf" and "nan". Text
/// that is no UTF-8 has U+FFFD for each byte. Written whole or not at all. Throws OutputError (atomic_path.h).
void write_json(const std::filesystem::path& file, std::span<const check::SceneVerdict> verdicts, const RunHead& head);

/// {"format": "plumbline diagnosis", "version": 1, "scene", "file", "versions", "first" (a stage or null), "wrong":
/// [stages], "findings": [{stage, reference, kind, title, pixels, differing, explains, numbers, causes, picture}],
/// "comparisons": as above}; "pixel_history", where there is one (history_text.h, history_json()).
void write_json(const std::filesystem::path& file, const check::Diagnosis& diagnosis,
                const std::map<std::string, std::string>& versions, const std::string& pixel_history = "");

/// {"format": "plumbline comparison", "version": 1, "a", "b", "tolerance", "comparisons": [{what, outcome, items,
/// differing, max_difference, codes, worst, ...}]}
void write_json(const std::filesystem::path& file, const std::string& a, const std::string& b, double tolerance,
                std::span<const check::StoredComparison> comparisons);

/// The ledger with the largest difference seen for each row, as a share of its tolerance, and where; and of each group
/// of scenes (the folder) their number and the largest differences by reference, stage and unit.
void write_ledger(const std::filesystem::path& file, std::span<const check::SceneVerdict> verdicts);

}  // namespace plumbline::report
