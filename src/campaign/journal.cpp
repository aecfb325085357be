#include "campaign/journal.h"

#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

namespace plumbline::campaign {

namespace {

constexpr int kVersion = 2;      // of the tables
constexpr int kId = 0x706c6362;  // "plcb": an SQLite file that is a journal

constexpr const char* kTables =
    "CREATE TABLE terms (text TEXT NOT NULL);"
    "CREATE TABLE scene (id TEXT PRIMARY KEY, unable TEXT NOT NULL, states BLOB NOT NULL, milliseconds REAL NOT "
    "NULL) WITHOUT ROWID;"
    "CREATE TABLE signature (id TEXT NOT NULL, disputed INTEGER NOT NULL, stage TEXT NOT NULL, cause TEXT NOT NULL,"
    "  reference TEXT NOT NULL, PRIMARY KEY (id, disputed, stage, cause, reference)) WITHOUT ROWID;";

}  // namespace

struct Journal::Database {
  std::filesystem::path file;
  sqlite3* handle = nullptr;

  ~Database() { sqlite3_close(handle); }

  [[noreturn]] void fail(int code) const {
    if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
      throw JournalInUse(fmt::format("{}: in use: another campaign judges these seeds", file.string()));
    }
    if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) {
      throw JournalError(
          fmt::format("{}: expected the journal of a campaign, found {}", file.string(), sqlite3_errstr(code)));
    }
    throw JournalError(fmt::format("{}: {}", file.string(), sqlite3_errmsg(handle)));
  }
  void require(int code) const {
    if (code != SQLITE_OK) fail(code);
  }
  void run(const char* statements) const { require(sqlite3_exec(handle, statements, nullptr, nullptr, nullptr)); }
};

namespace {

// One statement: values are bound in order, then each row visited.
class Statement {
 public:
  Statement(sqlite3* handle, std::string_view text) {
    code_ = sqlite3_prepare_v2(handle, text.data(), static_cast<int>(text.size()), &statement_, nullptr);
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& text(const std::string& value) {
    if (code_ == SQLITE_OK) {
      code_ = sqlite3_bind_text(statement_, ++bound_, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    }
    return *this;
  }
  Statement& bytes(const std::string& value) {
    if (code_ == SQLITE_OK) {
      code_ = sqlite3_bind_blob(statement_, ++bound_, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    }
    return *this;
  }
  Statement& number(double value) {
    if (code_ == SQLITE_OK) code_ = sqlite3_bind_double(statement_, ++bound_, value);
    return *this;
  }
  /// SQLITE_ROW, SQLITE_DONE, or an error.
  int step() { return code_ == SQLITE_OK ? sqlite3_step(statement_) : code_; }
  std::string text_at(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return text == nullptr ? "" : text;
  }
  std::string bytes_at(int column) const {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
  }
  bool is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
  double number_at(int column) const { return sqlite3_column_double(statement_, column); }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int code_ = SQLITE_OK, bound_ = 0;
};

SceneId id_in(const std::filesystem::path& file, const std::string& text) {
  try {
    return scene_id_of(text);
  } catch (const std::invalid_argument& bad) {
    throw JournalError(fmt::format("{}: {}", file.string(), bad.what()));
  }
}

// True: the file ends within a page, and has no -wal file from which SQLite would restore the last pages.
bool is_cut(const std::filesystem::path& file) {
  constexpr std::uintmax_t kPage = 4096;
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file, none);
  return !none && size % kPage != 0 && !std::filesystem::exists(file.string() + "-wal");
}

}  // namespace

Journal::Journal(const std::filesystem::path& file, const std::string& terms, std::chrono::milliseconds wait)
    : database_(std::make_unique<Database>()) {
  Database& db = *database_;
  db.file = file;
  const bool is_there = std::filesystem::exists(file);
  const std::filesystem::path written = is_there ? file : file.parent_path();
  if (::access(written.c_str(), R_OK | W_OK) != 0) {
    throw JournalError(fmt::format("{}: expected a {} to read and write: {}", written.string(),
                                   is_there ? "journal" : "folder", std::strerror(errno)));
  }
  const bool was_cut = is_cut(file);
  db.require(sqlite3_open_v2(file.c_str(), &db.handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr));
  db.require(sqlite3_busy_timeout(db.handle, static_cast<int>(wait.count())));
  // Exclusive: no second process, and no shared memory, which network file systems lack.
  db.run("PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; BEGIN IMMEDIATE;");
  const auto value_of = [&](std::string_view query) {
    Statement statement(db.handle, query);
    const int code = statement.step();
    if (code != SQLITE_ROW && code != SQLITE_DONE) db.fail(code);
    return code == SQLITE_ROW ? statement.text_at(0) : "";
  };
  const bool is_new = value_of("SELECT count(*) FROM sqlite_schema") == "0";
  if (is_new) {
    db.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; {}", kId, kVersion, kTables).c_str());
    if (const int code = Statement(db.handle, "INSERT INTO terms VALUES (?)").text(terms).step(); code != SQLITE_DONE)
      db.fail(code);
  } else if (value_of("PRAGMA application_id") != std::to_string(kId)) {
    throw JournalError(fmt::format("{}: expected the journal of a campaign, found another database", file.string()));
  } else if (const std::string version = value_of("PRAGMA user_version"); version != std::to_string(kVersion)) {
    throw JournalError(fmt::format("{}: expected a journal of version {}, found {}", file.string(), kVersion, version));
  } else if (const std::string its = value_of("SELECT text FROM terms"); its != terms) {
    throw JournalError(
        fmt::format("{}: expected a journal of this campaign ({}), found one of {}", file.string(), terms, its));
  }
  if (was_cut)
    throw JournalError(fmt::format("{}: expected the journal of a campaign, found a part of one", file.string()));
  if (const std::string found = value_of("PRAGMA quick_check(1)"); found != "ok")
    throw JournalError(
        fmt::format("{}: expected the journal of a campaign, found one with damage: {}", file.string(), found));
  db.run("COMMIT;");
  Statement scenes(db.handle, "SELECT id FROM scene");
  for (int code; (code = scenes.step()) != SQLITE_DONE;) {
    if (code != SQLITE_ROW) db.fail(code);
    judged_.insert(id_in(db.file, scenes.text_at(0)));
  }
}

Journal::~Journal() = default;

void Journal::add(const Entry& entry) {
  if (!judged_.insert(entry.id).second) return;
  const Database& db = *database_;
  const std::string id = to_string(entry.id);
  const auto done = [&](int code) {
    if (code != SQLITE_DONE) db.fail(code);
  };
  db.run("BEGIN IMMEDIATE;");
  Statement scene(db.handle, "INSERT INTO scene VALUES (?, ?, ?, ?)");
  done(scene.text(id).text(entry.unable).bytes(entry.states).number(entry.milliseconds).step());
  for (const auto* list : {&entry.found, &entry.disputes}) {
    for (const Signature& s : *list) {
      Statement insert(db.handle, "INSERT INTO signature VALUES (?, ?, ?, ?, ?)");
      insert.text(id).number(list == &entry.disputes ? 1 : 0).text(s.stage).text(s.cause).text(s.reference);
      done(insert.step());
    }
  }
  db.run("COMMIT;");
}

std::vector<Entry> Journal::entries() const {
  std::vector<Entry> out;
  Statement rows(
      database_->handle,
      "SELECT scene.id, unable, states, milliseconds, disputed, stage, cause, reference FROM scene LEFT JOIN signature "
      "USING (id) ORDER BY scene.id, disputed, stage, cause, reference");
  for (int code; (code = rows.step()) != SQLITE_DONE;) {
    if (code != SQLITE_ROW) database_->fail(code);
    const SceneId id = id_in(database_->file, rows.text_at(0));
    if (out.empty() || out.back().id != id)
      out.push_back({id, {}, {}, rows.text_at(1), rows.bytes_at(2), rows.number_at(3)});
    const Signature signature{rows.text_at(5), rows.text_at(6), rows.text_at(7)};
    if (rows.is_null(4)) continue;  // no signature
    if (signature.stage.empty())
      throw JournalError(fmt::format("{}: {}: expected a stage, found none", database_->file.string(), to_string(id)));
    (rows.number_at(4) != 0 ? out.back().disputes : out.back().found).push_back(signature);
  }
  std::ranges::sort(out, {}, &Entry::id);
  return out;
}

}  // namespace plumbline::campaign
