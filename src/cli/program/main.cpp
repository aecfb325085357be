#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <csignal>

#include "base/supervise.h"
#include "cli/plumb_main.h"

namespace {

// A standard stream that is closed is opened where reading (of stdin) or writing fails: else the next file or socket
// would take its place, and be written to.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  plumbline::supervise();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is then an error of the write
  // Memory once had is kept: large records come and go, and clearing their pages anew takes a third of the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  return plumbline::cli::plumb_main(argc, argv);
}
