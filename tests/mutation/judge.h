// Verdict on a change: who sees it, on which scene, and which stage is named.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "mutation/choose.h"

namespace plumbline::mutation {

enum class Outcome {
  references,  ///< a row of a reference is `different` or `failed`
  picture,     ///< the row `picture` alone is
  ended,       ///< plumb check ends by a signal, never, or with 2
  tables,      ///< plumb check ends 0; of data that every renderer is given, its tests fail (unit/, by formulas)
  goldens,     ///< bits of tests/scenes differ, and plumb check ends 0
  survived,    ///< not a bit of tests/scenes differs
  equivalent   ///< and a reason is known: the same program, or a row of equivalent.tsv
};
inline constexpr std::size_t kOutcomes = 7;
std::string_view name_of(Outcome outcome);

/// Names that one check of a scene, or one diagnosis, gives.
struct Named {
  std::string first;  ///< stage, "picture", "ended", or "none"
  std::string by;     ///< reference and stage of the first row that fails
};

struct Verdict {
  Outcome outcome = Outcome::survived;
  std::size_t affected = 0;           ///< scenes of tests/scenes of which a bit differs
  std::string scene;                  ///< by which it is seen; else the first that is affected
  std::vector<std::string> expected;  ///< of which one must be named; none: any will do
  Named check, diagnose;
  std::string note;  ///< one line: how plumb ended, the reason of an equivalent, what random scenes say

  bool found() const { return outcome <= Outcome::tables; }
  /// True: an expected stage is named.
  bool named_by_check() const;
  bool named_by_diagnose() const;
};

/// The hashes of scenes (program/scene_hashes.cpp), by name.
struct SceneHashes {
  struct Line {
    std::size_t work = 0;
    std::vector<std::string> hashes;  ///< of the stages, and of the picture; of one that failed "failed" and why
    bool failed() const { return !hashes.empty() && hashes[0] == "failed"; }
  };
  std::map<std::string, Line> of;
  std::string stopped;  ///< how the program ended, if not well
};

/// Scenes that a change affects, in the order in which they are judged: those with another stage's bits first, the
/// cheapest first.
struct Affected {
  std::string scene;
  bool picture_alone = false;  ///< no stage's bits differ, but the picture's
  bool failed = false;
};
std::vector<Affected> affected(const SceneHashes& as_it_is, const SceneHashes& changed);

/// The stage that plumb check announces, of each scene that fails, from its JSON; the first row's where it announces
/// none (a crash), and `picture` where no other row fails.
std::map<std::string, Named> named_by_check(const std::string& json);
/// Names in plumb diagnose's JSON, which has one scene.
Named named_by_diagnose(const std::string& json);

class Judge {
 public:
  /// `programs`: of the sources as they are; `scenes`: the folder. Throws std::runtime_error where they cannot be
  /// drawn.
  Judge(std::filesystem::path programs, std::filesystem::path scenes, std::filesystem::path out);

  /// `programs`: of the changed sources; `reason`: of equivalent.tsv, or empty; files of `name` are left in the folder
  /// `out`. May be called by many threads. Throws std::runtime_error where a scene that fails does so in the sources as
  /// they are.
  Verdict judge(const std::filesystem::path& programs, const FileRule& rule, const std::string& reason,
                const std::string& name) const;

 private:
  SceneHashes hashes(const std::filesystem::path& programs, const std::vector<std::string>& of,
                     const std::filesystem::path& file) const;
  void find(const std::filesystem::path& programs, const FileRule& rule, const std::vector<Affected>& scenes,
            const std::string& name, Verdict& verdict) const;
  void require_held(const std::string& scene, const std::string& name) const;
  void survive(const std::filesystem::path& programs, const std::string& reason, const std::string& name,
               Verdict& verdict) const;

  std::filesystem::path programs_, scenes_, out_;
  SceneHashes as_it_is_;
  mutable std::once_flag random_drawn_;
  mutable SceneHashes random_as_it_is_;  ///< drawn when first needed
};

}  // namespace plumbline::mutation
