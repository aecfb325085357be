// Limits that a process sets itself, before it does what may crash or take all memory.
#pragma once

#include <cstdint>

namespace plumbline {

/// From now on the process may have `bytes` of address space more than it has now, if its hard limit allows them. The
/// hard limit stays: programs that the process starts may set limits of their own. No effect without /proc.
void limit_memory(std::uint64_t bytes);

/// A crash of the process leaves no core file. May be called between fork() and execv().
void leave_no_core();

}  // namespace plumbline
