// Work in a process of its own: whatever becomes of it, the caller hears of it and goes on.
#include "base/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

namespace plumbline {
namespace {

std::string failure(const std::function<std::string()>& work, unsigned seconds = 60) {
  try {
    in_child_process(work, seconds);
  } catch (const ChildFailed& error) {
    return error.what();
  }
  return "none";
}

TEST(ChildProcess, HandsBackTheResult) {
  std::string large(5'000'000, 'x');
  large[3] = '\0';
  EXPECT_EQ(in_child_process([&] { return large; }, 60), large);
  EXPECT_EQ(in_child_process([] { return ""; }, 60), "");
  const pid_t here = getpid();
  EXPECT_NE(in_child_process([] { return std::to_string(getpid()); }, 60), std::to_string(here));
}

TEST(ChildProcess, TellsOfExceptionsCrashesAndHangs) {
  try {
    in_child_process([]() -> std::string { throw std::logic_error("so it is"); }, 60);
    ADD_FAILURE();
  } catch (const ChildFailed&) {
    ADD_FAILURE() << "it came to an end of its own";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "so it is");
  }
  EXPECT_EQ(failure([]() -> std::string {
              kill(getpid(), SIGKILL);
              return "";
            }),
            "one on which its reader crashes (Killed)");
  EXPECT_EQ(failure([]() -> std::string { throw 3; }), "one on which its reader gives up");
  EXPECT_EQ(failure([]() -> std::string { _exit(0); }), "one on which its reader gives up");
  EXPECT_EQ(failure(
                []() -> std::string {
                  while (true) pause();
                },
                1),
            "one that takes more than 1 seconds to read");
  EXPECT_EQ(failure([]() -> std::string { throw std::bad_alloc(); }),
            "one that takes more than 4 GiB of memory to read");
}

}  // namespace
}  // namespace plumbline
