// Worker processes: answers in order, and what becomes of a crash, a hang and a lack of memory.
#include "base/workers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/sanitizer.h"

namespace plumbline {
namespace {

using namespace std::chrono_literals;

std::vector<std::size_t> numbers(std::size_t n) {
  std::vector<std::size_t> out(n);
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

// The requests that workers ended at, and all answers in the order in which they were taken.
struct Ran {
  std::vector<std::pair<std::size_t, std::string>> taken;
  std::vector<std::pair<std::size_t, WorkerEnd>> ends;
};

// Requests are their numbers; after an end "again".
Ran run(std::size_t workers, std::size_t requests, const std::function<Workers::Answer(Progress&)>& make,
        const WorkerLimits& limits = {}, std::vector<std::size_t> order = {}) {
  Ran out;
  if (order.empty()) order = numbers(requests);
  Workers(workers, limits, make)
      .run({order, [](std::size_t i) { return std::to_string(i); },
            [&](std::size_t i, std::string answer) { out.taken.emplace_back(i, std::move(answer)); },
            [&](std::size_t i, const WorkerEnd& end) {
              out.ends.emplace_back(i, end);
              return std::string("again");
            }});
  return out;
}

TEST(Workers, AnswersAreTakenInOrderAndWorkersStayWarm) {
  const auto make = [](Progress&) -> Workers::Answer {
    return [made_by = getpid(), count = 0](const std::string& request) mutable {
      if (request == "0") std::this_thread::sleep_for(50ms);
      return request + " " + std::to_string(made_by) + " " + std::to_string(count++);
    };
  };
  for (const std::size_t workers : {1u, 3u}) {
    std::vector<std::size_t> order = numbers(40);
    if (workers == 3) std::swap(order[0], order[30]);
    const Ran ran = run(workers, 40, make, {}, order);
    ASSERT_EQ(ran.taken.size(), 40u);
    std::map<std::string, int> answers;
    for (std::size_t i = 0; i < 40; ++i) {
      EXPECT_EQ(ran.taken[i].first, i);
      const std::string& answer = ran.taken[i].second;
      EXPECT_EQ(answer.substr(0, answer.find(' ')), std::to_string(i));
      ++answers[answer.substr(answer.find(' ') + 1, answer.rfind(' ') - answer.find(' ') - 1)];
    }
    EXPECT_EQ(answers.size(), workers) << "each answers many";
    EXPECT_FALSE(answers.contains(std::to_string(getpid())));
  }
}

TEST(Workers, LongAndEmptyAnswersComeWhole) {
  const auto make = [](Progress&) -> Workers::Answer {
    return [](const std::string& request) { return request == "1" ? std::string(30'000'000, '\0') : std::string(); };
  };
  const Ran ran = run(2, 3, make);
  EXPECT_EQ(ran.taken[1].second.size(), 30'000'000u);
  EXPECT_EQ(ran.taken[2].second, "");
}

// Of five requests, number 2 does `harm` within step 7 when it is first asked.
Ran harmed(const std::function<void()>& harm, const WorkerLimits& limits = {}) {
  return run(
      2, 5,
      [harm, limits](Progress& progress) -> Workers::Answer {
        return [&progress, harm, limits](const std::string& request) {
          progress.begin(7, limits.step);
          if (request == "2") harm();
          progress.end(limits.step);
          return "done " + request;
        };
      },
      limits);
}

void expect_one_end(const Ran& ran, const std::string& how, int signal = 0) {
  ASSERT_EQ(ran.taken.size(), 5u);
  EXPECT_EQ(ran.taken[2].second, "done again");
  EXPECT_EQ(ran.taken[4].second, "done 4");
  ASSERT_EQ(ran.ends.size(), 1u);
  EXPECT_EQ(ran.ends[0].first, 2u);
  EXPECT_EQ(ran.ends[0].second.step, 7u);
  EXPECT_EQ(ran.ends[0].second.how, how);
  EXPECT_EQ(ran.ends[0].second.signal, signal);
}

TEST(Workers, ACrashEndsOneWorkerAndItsStepIsKnown) {
  expect_one_end(harmed([] { raise(SIGSEGV); }), "was killed by signal 11 (Segmentation fault)", SIGSEGV);
  expect_one_end(harmed([] { raise(SIGKILL); }), "was killed by signal 9 (Killed)", SIGKILL);
  expect_one_end(harmed([] { _exit(3); }), "ended its process with status 3");
}

TEST(Workers, AnExitDoesNotWaitForWhatTheParentRegistered) {
  static const pid_t parent = getpid();
  std::atexit([] {
    while (getpid() != parent) pause();
  });
  expect_one_end(harmed([] { std::exit(4); }, {.step = 30s}), "ended its process with status 4");
}

TEST(Workers, AHangEndsOneWorker) {
  expect_one_end(harmed([] { pause(); }, {.step = 3s}), "took longer than 3s and was killed");
}

TEST(Workers, AHangEndsThoughAnotherProcessHoldsTheWorkersSocket) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const auto leave_an_orphan = [&] {
    if (fork() == 0) {
      close(ends[1]);
      char byte;
      _exit(static_cast<int>(read(ends[0], &byte, 1)));  // until this test ends
    }
    pause();
  };
  expect_one_end(harmed(leave_an_orphan, {.step = 1s}), "took longer than 1s and was killed");
  for (const int end : ends) close(end);
}

TEST(Workers, EachStepHasTheWholeLimit) {
  const auto make = [](Progress& progress) -> Workers::Answer {
    return [&progress](const std::string&) {
      for (std::uint32_t step = 1; step < 6; ++step) {
        progress.begin(step, 3s);
        std::this_thread::sleep_for(800ms);
        progress.end(3s);
      }
      return std::string("done");
    };
  };
  EXPECT_TRUE(run(1, 1, make, {.step = 3s}).ends.empty());
}

TEST(Workers, MemoryIsLimited) {
  if (kAddressSanitizer) GTEST_SKIP() << "AddressSanitizer's new ends the process where it ought to throw";
  const auto make = [](Progress&) -> Workers::Answer {
    return [](const std::string& request) {
      try {
        std::vector<char> much(request == "0" ? std::size_t{1} << 20 : std::size_t{1} << 30);
        [[maybe_unused]] const char* volatile place = much.data();  // else a compiler may leave out what is not used
        return std::string("had ") + std::to_string(much.size());
      } catch (const std::bad_alloc&) {
        return std::string("refused");
      }
    };
  };
  const Ran ran = run(1, 2, make, {.memory = std::uint64_t{256} << 20});
  EXPECT_EQ(ran.taken[0].second, "had 1048576");
  EXPECT_EQ(ran.taken[1].second, "refused");
}

TEST(Workers, ALackOfMemoryNamesTheLimit) {
  const auto make = [](Progress&) -> Workers::Answer {
    return [](const std::string&) -> std::string { throw std::bad_alloc(); };
  };
  try {
    run(1, 1, make, {.memory = std::uint64_t{256} << 20});
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "std::bad_alloc (a worker's memory is limited to 256 MiB)");
  }
}

TEST(Workers, AnExceptionIsThrownInItsTurnAndNothingBeginsAfterIt) {
  for (const std::size_t workers : {1u, 3u}) {
    std::vector<std::size_t> taken;
    std::set<std::size_t> begun;
    const std::vector<std::size_t> order = numbers(60);
    const auto make = [](Progress&) -> Workers::Answer {
      return [](const std::string& request) {
        if (request == "4") std::this_thread::sleep_for(30ms);
        if (request == "5" || request == "6") throw std::logic_error("no " + request);
        return request;
      };
    };
    const auto request = [&](std::size_t i) {
      begun.insert(i);
      return std::to_string(i);
    };
    try {
      Workers(workers, {}, make)
          .run({order, request, [&](std::size_t i, const std::string&) { taken.push_back(i); },
                [](std::size_t, const WorkerEnd&) { return std::string(); }});
      ADD_FAILURE();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "no 5");
    }
    EXPECT_EQ(taken, numbers(5));
    EXPECT_LT(begun.size(), 40u);
  }
}

TEST(Workers, ARequestThatEndsEveryWorkerIsGivenUp) {
  const auto make = [](Progress&) -> Workers::Answer { return [](const std::string&) -> std::string { _exit(1); }; };
  EXPECT_THROW(run(1, 1, make), std::runtime_error);
}

// A process that runs workers which never answer, ended by `signal`: nothing of it is left.
TEST(Workers, EndWithTheirParent) {
  for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t parent = fork();
    if (parent == 0) {
      std::signal(signal, SIG_DFL);  // a shell's background jobs ignore SIGINT
      const auto make = [&](Progress&) -> Workers::Answer {
        return [&](const std::string&) -> std::string {
          EXPECT_EQ(write(ends[1], "x", 1), 1);
          while (true) pause();
        };
      };
      run(2, 2, make);
      _exit(0);
    }
    close(ends[1]);
    char byte;
    for (int i = 0; i < 2; ++i) ASSERT_EQ(read(ends[0], &byte, 1), 1);
    kill(parent, signal);
    EXPECT_EQ(read(ends[0], &byte, 1), 0) << "the last end of the pipe is closed";
    int status = 0;
    waitpid(parent, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    close(ends[0]);
  }
}

}  // namespace
}  // namespace plumbline
