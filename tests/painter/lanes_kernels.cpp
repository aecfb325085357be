// Compiled once for each SIMD target (tests/CMakeLists.txt).
#include "tests/painter/lanes_kernels.h"

#include "kernels/simd.h"

#define PLUMBLINE_JOIN(a, b) a##b
#define PLUMBLINE_NAME(a, b) PLUMBLINE_JOIN(a, b)

namespace plumbline::pipeline {

Kernels PLUMBLINE_NAME(kernels_, PLUMBLINE_TARGET)() { return kernels<PLUMBLINE_TARGET::Simd>(); }

}  // namespace plumbline::pipeline
