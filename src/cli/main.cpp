// plumb: the command line of plumbline.
#include <malloc.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/commands.h"

int main(int argc, char** argv) {
  using namespace plumbline::cli;
  // Memory once had is kept: large records come and go, and clearing their pages anew takes a third of the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  try {
    const Parsed parsed = parse(argc, argv);
    const int code = parsed.command ? parsed.command() : parsed.exit;
    if (std::fflush(stdout) != 0) {
      throw std::runtime_error(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
    }
    return code;
  } catch (const std::filesystem::filesystem_error& e) {
    fmt::print(stderr, "plumb: {}: {}\n", e.path1().string(), e.code().message());
  } catch (const std::exception& e) {
    fmt::print(stderr, "plumb: {}\n", e.what());
  }
  return kBadInput;
}
