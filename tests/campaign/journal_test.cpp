// Journals: nothing that was added is lost, and one process at a time adds.
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "campaign/journal.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::campaign {
namespace {

Entry entry(std::uint64_t seed) {
  Entry out{{Generator::hard, {seed}}, {}, {}, seed % 5 == 0 ? "fog" : "", std::string("\0\x81", 2), 1.5};
  if (seed % 2 == 0) out.found = {{"shade", "different color", "exact, per stage"}};
  if (seed % 3 == 0) out.disputes = {{"merge", "Mesa's fog", "osmesa"}, {"shade", "it's \"so\"", "osmesa"}};
  return out;
}
std::vector<Entry> entries(std::uint64_t count) {
  std::vector<Entry> out;
  for (std::uint64_t seed = 1; seed <= count; ++seed) out.push_back(entry(seed));
  return out;
}
void expect_same(const std::vector<Entry>& a, const std::vector<Entry>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(same_verdict(a[i], b[i])) << to_string(a[i].id);
}

class Journals : public TestFolder {
 protected:
  void expect_refused(const std::string& why, const std::string& terms = "terms") const {
    try {
      const Journal journal(file_, terms);
      ADD_FAILURE() << "opened, expected: " << why;
    } catch (const JournalError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_TRUE(std::string(error.what()).starts_with(file_.string())) << error.what();
    }
  }
  void make() const { const Journal journal(file_, "terms"); }
  void run_sql(const char* statements) const {
    sqlite3* handle = nullptr;
    ASSERT_EQ(sqlite3_open(file_.c_str(), &handle), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle, statements, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(handle);
  }

  std::filesystem::path file_ = root_ / "a.journal";
};

// Forks a process that holds the journal for `duration`, before this process opens the file: a fork of a process that
// holds it would inherit what SQLite remembers of locks.
pid_t begin_holding(const std::filesystem::path& file, std::chrono::milliseconds duration) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    {
      const Journal journal(file, "terms");
      if (::write(ends[1], "x", 1) != 1) ::_exit(1);
      std::this_thread::sleep_for(duration);
    }
    ::_exit(0);
  }
  char byte;
  EXPECT_EQ(::read(ends[0], &byte, 1), 1);
  for (const int end : ends) ::close(end);
  return child;
}

TEST_F(Journals, HoldWhatWasAdded) {
  {
    Journal journal(file_, "terms");
    EXPECT_TRUE(journal.judged().empty());
    for (std::uint64_t seed = 30; seed >= 1; --seed) journal.add(entry(seed));
    expect_same(journal.entries(), entries(30));
  }
  Journal again(file_, "terms");
  EXPECT_EQ(again.judged().size(), 30u);
  EXPECT_TRUE(again.judged().contains({Generator::hard, {30}}));
  expect_same(again.entries(), entries(30));
  EXPECT_EQ(again.entries().front().milliseconds, 1.5);
}

TEST_F(Journals, CountASceneOnce) {
  Journal journal(file_, "terms");
  for (int i = 0; i < 2; ++i) journal.add(entry(6));
  Entry other = entry(6);
  other.found.clear();
  journal.add(other);
  expect_same(journal.entries(), {entry(6)});
}

TEST_F(Journals, HaveOneWriter) {
  const pid_t other = begin_holding(file_, std::chrono::minutes(5));
  expect_refused("in use");
  EXPECT_THROW(Journal(file_, "terms", std::chrono::milliseconds(50)), JournalInUse);
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  const Journal journal(file_, "terms");
  expect_refused("in use");
}

TEST_F(Journals, AreWaitedForWhileAnotherReadsThem) {
  const pid_t other = begin_holding(file_, std::chrono::milliseconds(200));
  expect_refused("in use");
  EXPECT_NO_THROW(Journal(file_, "terms", std::chrono::minutes(1)));
  int status = 0;
  ::waitpid(other, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(Journals, AreOfOneCampaign) {
  make();
  expect_refused("expected a journal of this campaign (others), found one of terms", "others");
}

TEST_F(Journals, ThatWereCutAreRefused) {
  {
    Journal journal(file_, "terms");
    for (const Entry& of : entries(30)) journal.add(of);
  }
  const std::string whole = test::text_of(file_);
  for (const std::size_t cut : {1u, 10u, 100u, 300u, 600u, 1000u, 2000u, 4000u, 4096u, 8192u}) {
    test::write_text(file_, whole.substr(0, whole.size() - cut));
    SCOPED_TRACE(cut);
    expect_refused("expected the journal of a campaign, found ");
  }
  test::write_text(file_, whole);
  expect_same(Journal(file_, "terms").entries(), entries(30));
  run_sql("UPDATE signature SET stage = '' WHERE id = 'hard/6';");
  EXPECT_THROW(Journal(file_, "terms").entries(), JournalError);
}

TEST_F(Journals, OfAnotherKindAreRefused) {
  std::ofstream(file_) << "no database, but text that is long enough to be read as the header of one: "
                       << std::string(200, '.');
  expect_refused("expected the journal of a campaign, found file is not a database");
  std::filesystem::remove(file_);
  run_sql("CREATE TABLE terms (text TEXT); INSERT INTO terms VALUES ('terms');");
  expect_refused("found another database");
  std::filesystem::remove(file_);
  make();
  run_sql("PRAGMA user_version = 3;");
  expect_refused("expected a journal of version 2, found 3");
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  expect_refused("unable to open");
}

// A process that adds one entry after another, and says so, is killed: what it said is there.
TEST_F(Journals, OutliveTheirProcess) {
  std::uint64_t before = 0;
  for (int kill = 0; kill < 20; ++kill) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      Journal journal(file_, "terms");
      for (std::uint64_t seed = before + 1;; ++seed) {
        journal.add(entry(seed));
        if (::write(pipe[1], &seed, sizeof seed) != sizeof seed) ::_exit(1);
      }
    }
    ::close(pipe[1]);
    std::uint64_t said = 0;
    for (int i = 0; i <= kill; ++i) ASSERT_EQ(::read(pipe[0], &said, sizeof said), static_cast<ssize_t>(sizeof said));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(pipe[0], &said, sizeof said) == sizeof said) {
    }
    ::close(pipe[0]);
    Journal journal(file_, "terms");
    const std::uint64_t now = journal.judged().size();
    EXPECT_GE(now, said);
    EXPECT_LE(now, said + 1);  // one may be on disk and not said
    expect_same(journal.entries(), entries(now));
    before = now;
  }
}

}  // namespace
}  // namespace plumbline::campaign
