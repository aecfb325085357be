// The journal of a campaign's process: what was judged is on disk before the next scene, and a process that is killed
// goes on where it was. An SQLite file in WAL mode, which one process at a time writes.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "campaign/entry.h"

namespace plumbline::campaign {

/// The message is: file: what is wrong, and what was expected.
struct JournalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Another process has the journal.
struct JournalInUse : JournalError {
  using JournalError::JournalError;
};

class Journal {
 public:
  /// Makes the file, or goes on with it. `terms`: everything but the scene that decides a verdict; a journal has one.
  /// `wait`: for a process that has it, for instance to read it. Throws JournalInUse, or JournalError where its terms
  /// are others or it is no journal.
  Journal(const std::filesystem::path& file, const std::string& terms, std::chrono::milliseconds wait = {});
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Scenes that the journal holds.
  const std::set<SceneId>& judged() const { return judged_; }
  /// After this call SIGKILL takes nothing away; a failure of power may. A scene that the journal holds is left as it is.
  void add(const Entry& entry);
  /// All of them, by scene.
  std::vector<Entry> entries() const;

 private:
  struct Database;
  std::unique_ptr<Database> database_;
  std::set<SceneId> judged_;
};

}  // namespace plumbline::campaign
