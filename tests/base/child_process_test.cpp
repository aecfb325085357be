// Work in a program of its own: whatever becomes of it, the caller hears of it and goes on.
#include "base/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace plumbline {
namespace {

// program/child.cpp
std::string answer(const std::string& how, unsigned seconds = 60) { return answer_of_child("child", {how}, seconds); }

std::string failure(const std::string& how, unsigned seconds = 60) {
  try {
    answer(how, seconds);
  } catch (const ChildFailed& error) {
    return error.what();
  }
  return "none";
}
std::string words_of_exception(const std::string& program, const std::string& how) {
  try {
    answer_of_child(program, {how}, 60);
  } catch (const ChildFailed&) {
    return "it came to no end of its own";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(ChildProcess, HandsBackTheResult) {
  std::string large(5'000'000, 'x');
  large[3] = '\0';
  EXPECT_EQ(answer("writes 5000000"), large);
  EXPECT_EQ(answer("nothing"), "");
}

TEST(ChildProcess, TellsOfExceptionsCrashesAndHangs) {
  EXPECT_EQ(words_of_exception("child", "throws"), "so it is");
  EXPECT_EQ(words_of_exception("no_child", ""), "no program no_child where plumbline's libraries are");
  EXPECT_EQ(failure("crashes"), "crashes (Killed)");
  EXPECT_EQ(failure("throws a number"), "ends without an answer");
  EXPECT_EQ(failure("ends"), "ends without an answer");
  EXPECT_EQ(failure("hangs", 1), "takes more than 1 seconds");
  EXPECT_EQ(failure("takes 5 GiB"), "takes more than 4 GiB of memory");
}

// Then the pipe's ends are descriptors 0 and 1.
TEST(ChildProcess, AnswersAParentWithoutStdinAndStdout) {
  EXPECT_EXIT(
      {
        close(STDIN_FILENO);
        close(STDOUT_FILENO);
        _exit(answer("writes 5000000").size() == 5'000'000 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

// Threads that allocate all the time hold the allocator's locks at any moment.
TEST(ChildProcess, StartsFromAProcessOfManyThreads) {
  std::atomic<bool> ends = false;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      while (!ends) std::make_unique<std::string>(100'000, 'x');
    });
  }
  for (int i = 0; i < 20; ++i) EXPECT_EQ(answer("nothing", 20), "");
  ends = true;
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace plumbline
