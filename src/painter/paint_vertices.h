// Stages 1, 2 and 4 of a mesh's vertices, as many at a time as R has lanes: transform(), light() and to_window()
// (geometry.h) in lanes, and the vertices' outcodes.
#pragma once

#include <cstddef>

#include "painter/painting.h"

namespace plumbline::pipeline {

static_assert(offsetof(PaintVertex, color) == 16 && sizeof(PaintVertex) == 32);

/// Bits of the violated planes, in the order of view_volume(). For finite coordinates, x <= w is clip()'s w - x >= 0.
template <class R>
Int<R> outside_planes(const Vec4<R>& p) {
  const auto bit = [](Mask<R> inside, int value) { return select(inside, Int<R>(0), Int<R>(value)); };
  return bit(p.x <= p.w, 1) | bit(-p.x <= p.w, 2) | bit(p.y <= p.w, 4) | bit(-p.y <= p.w, 8) | bit(-p.z <= p.w, 16) |
         bit(p.z <= p.w, 32);
}

/// Stages 1, 2 and 4 of vertices i to i + width - 1 of the draw; returns their outcodes.
template <class R>
Int<R> paint_vertex_lanes(const VertexWork& work, std::size_t i) {
  constexpr int kLanes = Lanes<R>::width;
  const auto store_beside = [&](const Vec4<R>& four, auto address) {
    float* to[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) to[lane] = address(i + static_cast<std::size_t>(lane));
    store_fours(four, to);
  };
  const auto store_varying = [&](Varying v, const Vec4<R>& four) {
    store_beside(four, [&](std::size_t k) { return &work.varyings[index_of(v)][k].x; });
  };
  const auto carries = [&](Varying v) { return work.varyings[index_of(v)] != nullptr; };

  const Vec3<R> p_model = Lanes<R>::load_threes(&work.mesh->positions[i].x);
  const Vec4<R> p_clip = product<R>(work.to_clip, p_model);
  const R inv_w = R(1) / p_clip.w;
  Vec3<R> p_win;
  for (int k = 0; k < 3; ++k) {
    p_win[k] = fused(p_clip[k] * inv_w, R(work.matrices.win_scale[k]), R(work.matrices.win_translate[k]));
  }
  const auto near = [](R value) { return greater_of(value, -value) <= R(1 << 20); };
  const auto nothing = [](R value) { return value - value; };  // 0 of a finite value, else NaN
  const Mask<R> x_near = near(p_win.x), y_near = near(p_win.y);
  const Mask<R> drawable = x_near & y_near & (nothing(p_win.z) + nothing(inv_w) == R(0));
  const R of_all = nothing(p_clip.x) + nothing(p_clip.y) + nothing(p_clip.z) + nothing(p_clip.w);
  const Mask<R> all_finite = of_all == R(0);
  const Int<R> outside = outside_planes<R>(p_clip) | select(all_finite, Int<R>(0), Int<R>(kNotFinite)) |
                         select(drawable, Int<R>(0), Int<R>(kNotDrawable));
  store_codes(outside, work.outside + i);
  // round((win - 1/2) 256), as snap() has it: 128 is even, and the product exact.
  const auto snapped = [&](R win) { return nearest_int(select(drawable, win, R(0)) * R(256)) - Int<R>(128); };

  Vec3<R> n(R(0));
  Vec4<R> p_eye(R(0));
  if (work.wants_normals) {
    n = product<R>(work.matrices.normal, Lanes<R>::load_threes(&work.mesh->normals[i].x));
    n = n / (work.normalizes ? length(n) : R(work.normal_divisor));
  }
  if (work.wants_normals || carries(Varying::position)) p_eye = product<R>(work.matrices.model_view, p_model);
  if (carries(Varying::normal)) store_varying(Varying::normal, {n, R(0)});
  if (carries(Varying::position)) store_varying(Varying::position, p_eye);
  if (carries(Varying::texture)) {
    for (std::size_t k = i; k < i + kLanes; ++k) {
      work.varyings[index_of(Varying::texture)][k] = {work.mesh->texcoords[k], 0.0f, 1.0f};
    }
  }
  Color<R> color(work.color);
  if (work.illumination != nullptr) {
    color = lit(*work.illumination, work.reflectance, Vec3<R>(p_eye), n);
    if (carries(Varying::secondary)) {
      const Color<R> secondary = lit(*work.illumination, work.secondary, Vec3<R>(p_eye), n);
      store_varying(Varying::secondary, {Vec3<R>(secondary), R(0)});
    }
  } else if (!work.mesh->colors.empty()) {
    const float* from[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) from[lane] = &work.mesh->colors[i + static_cast<std::size_t>(lane)].r;
    color = by_channel(Lanes<R>::load_fours(from), [](R channel) {  // as glm::clamp has it, -0 and all
      channel = select(channel < R(0), R(0), channel);
      return select(R(1) < channel, R(1), channel);
    });
  }
  store_beside({p_win, inv_w}, [&](std::size_t k) { return &work.out[k].p_win.x; });
  store_twos(snapped(p_win.x), snapped(p_win.y), &work.snapped[i].x);
  store_beside(color, [&](std::size_t k) { return &work.out[k].color.r; });
  return outside;
}

/// Stages 1, 2 and 4 of vertices [from, to) of the draw; returns the OR of their outcodes.
template <class R>
std::uint8_t paint_vertices(const VertexWork& work, std::size_t from, std::size_t to) {
  std::size_t i = from;
  Int<R> of_lanes(0);
  for (; i + Lanes<R>::width <= to; i += Lanes<R>::width) of_lanes = of_lanes | paint_vertex_lanes<R>(work, i);
  std::uint8_t bits[Lanes<R>::width], outside = 0;
  store_codes(of_lanes, bits);
  for (const std::uint8_t of_lane : bits) outside |= of_lane;
  for (; i < to; ++i) outside |= static_cast<std::uint8_t>(paint_vertex_lanes<float>(work, i));
  return outside;
}

}  // namespace plumbline::pipeline
