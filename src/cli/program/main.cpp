#include <malloc.h>

#include <csignal>

#include "base/supervise.h"
#include "cli/plumb_main.h"

int main(int argc, char** argv) {
  plumbline::supervise();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is then an error of the write
  // Memory once had is kept: large records come and go, and clearing their pages anew takes a third of the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  return plumbline::cli::plumb_main(argc, argv);
}
