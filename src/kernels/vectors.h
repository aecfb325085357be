// Colours and vectors over the lane type: glm's, with what glm has for plain floats alone.
#pragma once

#include "kernels/lanes.h"

namespace plumbline::pipeline {

/// rgba of `Lanes<R>::width` fragments.
template <class R>
using Color = Vec4<R>;
/// f of each channel, or of each channel of two colours.
template <class R>
[[gnu::always_inline]] inline auto by_channel(const Color<R>& c, auto f) {
  return Color<decltype(f(c.r))>{f(c.r), f(c.g), f(c.b), f(c.a)};
}
template <class R, class S>
[[gnu::always_inline]] inline auto by_channel(const Color<R>& c, const Color<S>& d, auto f) {
  return Color<decltype(f(c.r, d.r))>{f(c.r, d.r), f(c.g, d.g), f(c.b, d.b), f(c.a, d.a)};
}

template <class R>
Color<R> select(Mask<R> mask, const Color<R>& yes, const Color<R>& no) {
  return by_channel(yes, no, [&](const R& a, const R& b) { return select(mask, a, b); });
}
template <class R>
Vec3<R> select(Mask<R> mask, const Vec3<R>& yes, const Vec3<R>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

template <class R>
R dot(const Vec3<R>& a, const Vec3<R>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class R>
R length(const Vec3<R>& v) {
  return square_root(dot(v, v));
}
template <class R>
Vec3<R> unit(const Vec3<R>& v) {
  return v / length(v);
}

/// m p of a point, and of a direction: summed left to right.
template <class R>
[[gnu::always_inline]] inline Vec4<R> product(const Mat4<float>& m, const Vec3<R>& p) {
  return ((Vec4<R>(m[0]) * p.x + Vec4<R>(m[1]) * p.y) + Vec4<R>(m[2]) * p.z) + Vec4<R>(m[3]);
}
template <class R>
[[gnu::always_inline]] inline Vec3<R> product(const Mat3<float>& m, const Vec3<R>& v) {
  return (Vec3<R>(m[0]) * v.x + Vec3<R>(m[1]) * v.y) + Vec3<R>(m[2]) * v.z;
}

}  // namespace plumbline::pipeline
