// Journal of a campaign's process. Each verdict is on disk before the next scene is judged: a killed process, started
// again, goes on where it was. An SQLite file in WAL mode, which one process at a time writes.
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

/// Error of a journal. The message names the file, what is wrong, and what was expected.
struct JournalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Error of a journal that another process holds open.
struct JournalInUse : JournalError {
  using JournalError::JournalError;
};

class Journal {
 public:
  /// Creates or opens the journal. `terms`: everything but the scene that decides a verdict; a journal has one text of
  /// terms. `wait`: for a process that holds the journal, for instance to read it. Throws JournalInUse, or JournalError
  /// for a journal of other terms and for a file that is no journal.
  Journal(const std::filesystem::path& file, const std::string& terms, std::chrono::milliseconds wait = {});
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Scenes that the journal holds.
  const std::set<SceneId>& judged() const { return judged_; }
  /// Adds an entry; a scene that the journal holds stays as it is. After the call SIGKILL loses nothing; a power
  /// failure may.
  void add(const Entry& entry);
  /// Entries of all scenes that the journal holds, sorted by scene.
  std::vector<Entry> entries() const;

 private:
  struct Database;
  std::unique_ptr<Database> database_;
  std::set<SceneId> judged_;
};

}  // namespace plumbline::campaign
