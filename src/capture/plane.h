// A rectangle of values in the order of the scene's dialect: row 0 at the bottom, as GL counts, or at the top.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <new>
#include <vector>

namespace plumbline {

/// Allocates memory aligned to a cache line.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};  // [bytes]

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
  void deallocate(T* values, std::size_t /*count*/) { ::operator delete(values, kLine); }
  bool operator==(const CacheLineAllocator& /*other*/) const { return true; }
};

/// width x height values, stored row by row, row 0 first, without padding, aligned to a cache line.
template <class T>
class Plane {
 public:
  using Values = std::vector<T, CacheLineAllocator<T>>;

  Plane() = default;
  Plane(int width, int height, T fill = T{})
      : width_(width),
        height_(height),
        values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return values_.empty(); }
  std::size_t size() const { return values_.size(); }

  /// Value of pixel (x, y), 0 <= x < width(), 0 <= y < height() (asserted); row(y): the width() values of a row.
  T& operator()(int x, int y) { return values_[index(x, y)]; }
  const T& operator()(int x, int y) const { return values_[index(x, y)]; }
  T* row(int y) { return values_.data() + index(0, y); }
  const T* row(int y) const { return values_.data() + index(0, y); }

  Values& values() { return values_; }
  const Values& values() const { return values_; }

 private:
  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  Values values_;
};

/// The plane with its rows in reverse order: image files are written from planes whose row 0 is the bottom, and some
/// dialects count from the top.
template <class T>
Plane<T> upside_down(const Plane<T>& plane) {
  Plane<T> out(plane.width(), plane.height());
  for (int y = 0; y < plane.height(); ++y) {
    const T* row = plane.row(plane.height() - 1 - y);
    std::copy(row, row + plane.width(), out.row(y));
  }
  return out;
}

}  // namespace plumbline
