// Compiled once for each target: plumbline_simd() in CMakeLists.txt.
#include "painter/painter.h"

#include "kernels/simd.h"
#include "painter/cull_lanes.h"
#include "painter/paint_tile.h"
#include "painter/paint_vertices.h"

#define PLUMBLINE_JOIN(a, b) a##b
#define PLUMBLINE_NAME(a, b) PLUMBLINE_JOIN(a, b)
#define PLUMBLINE_TEXT(a) #a
#define PLUMBLINE_TEXT_OF(a) PLUMBLINE_TEXT(a)

namespace plumbline::pipeline {

extern constinit const SimdTarget PLUMBLINE_NAME(kSimd_, PLUMBLINE_TARGET);
constinit const SimdTarget PLUMBLINE_NAME(kSimd_, PLUMBLINE_TARGET) = {
    PLUMBLINE_TEXT_OF(PLUMBLINE_TARGET), paint_vertices<PLUMBLINE_TARGET::Simd>, cull_triangles<PLUMBLINE_TARGET::Simd>,
    paint_tiles<PLUMBLINE_TARGET::Simd>};

}  // namespace plumbline::pipeline
