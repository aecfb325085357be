#include "base/process_limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <fstream>

namespace plumbline {

void limit_memory(std::uint64_t bytes) {
  std::size_t pages = 0;
  if (!(std::ifstream("/proc/self/statm") >> pages)) return;
  rlimit memory{};
  getrlimit(RLIMIT_AS, &memory);
  const rlim_t most = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + bytes;
  memory.rlim_cur = std::min(most, memory.rlim_max);
  setrlimit(RLIMIT_AS, &memory);
}

void leave_no_core() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

}  // namespace plumbline
