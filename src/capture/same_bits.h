// Whether two planes are the same to the bit.
#pragma once

#include <cstring>

#include "capture/plane.h"

namespace plumbline {

/// Whether both planes have one size and equal bits: NaNs of equal bits are the same, 0 and -0 are not.
template <class T>
bool have_same_bits(const Plane<T>& a, const Plane<T>& b) {
  const bool same_size = a.width() == b.width() && a.height() == b.height();
  return same_size && (a.empty() || std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)) == 0);
}

}  // namespace plumbline
