#include <malloc.h>

#include "cli/plumb_main.h"

int main(int argc, char** argv) {
  // Memory once had is kept: large records come and go, and clearing their pages anew takes a third of the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  return plumbline::cli::plumb_main(argc, argv);
}
