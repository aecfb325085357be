// Vectors of three numbers, each of them lanes.h's number type.
#pragma once

#include "kernels/lanes.h"

namespace plumbline::pipeline {

template <class R>
struct Vector {
  R x, y, z;
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator-(const Vector& v) { return {-v.x, -v.y, -v.z}; }
  friend Vector operator*(const Vector& a, const Vector& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Vector operator*(R k, const Vector& v) { return {k * v.x, k * v.y, k * v.z}; }
  friend Vector operator/(const Vector& v, R k) { return {v.x / k, v.y / k, v.z / k}; }
};

/// The same numbers in every lane; what is of lanes already stays as it is.
template <class R, class V>
Vector<R> spread(const V& v) {
  return {R(v.x), R(v.y), R(v.z)};
}

template <class R>
R dot(const Vector<R>& a, const Vector<R>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class R>
Vector<R> unit(const Vector<R>& v) {
  return v / square_root(dot(v, v));
}
template <class R>
Vector<R> select(Mask<R> mask, const Vector<R>& yes, const Vector<R>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

}  // namespace plumbline::pipeline
