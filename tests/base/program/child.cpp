// child HOW: a program for answer_of_child() (child_process_test.cpp) that ends as it is told.
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <string>

#include "base/child_process.h"

namespace {

std::string end(const std::string& how) {
  if (how == "writes 5000000") {
    std::string large(5'000'000, 'x');
    large[3] = '\0';
    return large;
  }
  if (how == "throws") throw std::logic_error("so it is");
  if (how == "throws a number") throw 3;
  if (how == "crashes") kill(getpid(), SIGKILL);
  if (how == "ends") _exit(0);
  while (how == "hangs") pause();
  if (how == "takes 5 GiB") {
    constexpr std::size_t kSize = std::size_t{5} << 30;
    if (mmap(nullptr, kSize, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED) throw std::bad_alloc();
  }
  return "";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  plumbline::answer_parent([&] { return end(argv[1]); });
}
