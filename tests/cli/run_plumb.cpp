#include "tests/cli/run_plumb.h"

#include <wordexp.h>

#include <cstdlib>
#include <vector>

#include "cli/plumb_main.h"
#include "images/image_codec.h"
#include "tests/sanitizer.h"

namespace plumbline {

namespace {

// No run recalls the verdict of an earlier one.
[[maybe_unused]] const int kNoCache = ::setenv("PLUMBLINE_NO_CACHE", "1", 1);

bool needs_program(const std::string& arguments) {
  // Images' libraries start threads, and GCC 12's sanitizer does not copy what they have locked (child_process.h).
  if (kAddressSanitizer) return true;
  if (arguments.find_first_of("|<>;&$`*?\n") != std::string::npos) return true;
  for (const char* child : {"egl", "softpipe", "--program"}) {
    if (arguments.find(child) != std::string::npos) return true;
  }
  return arguments.starts_with("list");  // tries egl and softpipe
}

[[noreturn]] void run_and_exit(const wordexp_t& words, int output) {
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  std::string program = PLUMBLINE_PLUMB;
  std::vector<char*> argv = {program.data()};
  argv.insert(argv.end(), words.we_wordv, words.we_wordv + words.we_wordc);
  argv.push_back(nullptr);
  const int code = cli::plumb_main(static_cast<int>(argv.size() - 1), argv.data());
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

Outcome plumb(const std::string& arguments) {
  wordexp_t words;
  if (needs_program(arguments) || ::wordexp(arguments.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF) != 0) {
    return shell(PLUMBLINE_PLUMB " " + arguments);
  }
  image_codec();  // loads OpenImageIO once, for all forks
  std::fflush(nullptr);
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    run_and_exit(words, ends[1]);
  }
  ::close(ends[1]);
  ::wordfree(&words);
  Outcome run{-1, ""};
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t n = ::read(ends[0], buffer.data(), buffer.size());
    if (n <= 0) break;
    run.text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) run.code = WEXITSTATUS(status);
  return run;
}

}  // namespace plumbline
