// A vector of at most N values, stored in place, without allocation. push_back() beyond N throws
// std::length_error.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>

namespace plumbline {

template <class T, std::size_t N>
class FixedVector {
 public:
  static constexpr std::size_t kMost = N;
  void push_back(const T& value) {
    if (size_ == N) throw std::length_error("FixedVector: all values are in use");
    values_[size_++] = value;
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  const T& back() const { return values_[size_ - 1]; }
  T* begin() { return values_.data(); }
  T* end() { return values_.data() + size_; }
  const T* begin() const { return values_.data(); }
  const T* end() const { return values_.data() + size_; }

 private:
  std::array<T, N> values_;
  std::size_t size_ = 0;
};

}  // namespace plumbline
