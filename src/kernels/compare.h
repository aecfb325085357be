// How two numbers are compared by a depth, stencil or alpha function.
#pragma once

#include "kernels/lanes.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

template <class R, class T>
Mask<R> compares(CompareFunc func, T a, T b) {
  switch (func) {
    case CompareFunc::never: return a != a;
    case CompareFunc::less: return a < b;
    case CompareFunc::equal: return a == b;
    case CompareFunc::less_equal: return a <= b;
    case CompareFunc::greater: return a > b;
    case CompareFunc::not_equal: return a != b;
    case CompareFunc::greater_equal: return a >= b;
    case CompareFunc::always: return a == a;
  }
  return a == a;
}

}  // namespace plumbline::pipeline
