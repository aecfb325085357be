// Journal of a campaign's process. Each verdict is written before the next scene is judged: a killed process, started
// again, resumes. An SQLite file in WAL mode, with one writing process at a time.
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
  /// Creates or opens the journal. `terms`: all inputs of a verdict but the scene, one text a journal. `wait`: longest
  /// wait for a process that holds the journal. Throws JournalInUse, or JournalError for a journal of other terms and
  /// for a file that is no journal.
  Journal(const std::filesystem::path& file, const std::string& terms, std::chrono::milliseconds wait = {});
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Scenes that the journal holds.
  const std::set<SceneId>& judged() const { return judged_; }
  /// Adds an entry, unless the journal holds the scene. After the call SIGKILL loses nothing; a power failure may.
  void add(const Entry& entry);
  /// Entries of all scenes that the journal holds, sorted by scene.
  std::vector<Entry> entries() const;

 private:
  struct Database;
  std::unique_ptr<Database> database_;
  std::set<SceneId> judged_;
};

}  // namespace plumbline::campaign
