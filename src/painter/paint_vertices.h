// Stages 1, 2 and 4 of a mesh's vertices, as many at a time as R has lanes: what transform(), light() and
// to_window() do one by one (vertex.h, light.h, window.h), and which planes of the view volume each violates.
#pragma once

#include <cstddef>

#include "painter/painting.h"

namespace plumbline::pipeline {

static_assert(offsetof(PaintVertex, snapped) == 16 && offsetof(PaintVertex, color) == 24 && sizeof(PaintVertex) == 40);

/// ((a x + b y) + c z) + d for a row of the matrix.
template <class R>
[[gnu::always_inline]] inline R row_of(const Mat4<float>& m, int row, const R (&p)[3]) {
  return ((R(m[0][row]) * p[0] + R(m[1][row]) * p[1]) + R(m[2][row]) * p[2]) + R(m[3][row]);
}

template <class R>
void unit_normals(const VertexWork& work, std::size_t i, R (&n)[3]) {
  R of_model[3];
  load_threes(&work.mesh->normals[i].x, of_model);
  const Mat3<float>& m = work.matrices.normal;
  for (int row = 0; row < 3; ++row) {
    n[row] = (R(m[0][row]) * of_model[0] + R(m[1][row]) * of_model[1]) + R(m[2][row]) * of_model[2];
  }
  const R divisor =
      work.normal_divisor != 0.0f ? R(work.normal_divisor) : square_root((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
  for (R& coordinate : n) coordinate = coordinate / divisor;
}

/// One bit a plane that is violated, in the order of view_volume(); finite coordinates' distances are w + x and so on.
template <class R>
Int<R> outside_planes(const R (&p)[4]) {
  const auto bit = [](Mask<R> inside, int value) { return select(inside, Int<R>(0), Int<R>(value)); };
  return bit(p[0] <= p[3], 1) | bit(-p[0] <= p[3], 2) | bit(p[1] <= p[3], 4) | bit(-p[1] <= p[3], 8) |
         bit(-p[2] <= p[3], 16) | bit(p[2] <= p[3], 32);
}

/// Those from the i-th on; returns what of any lies outside.
template <class R>
Int<R> paint_vertex_lanes(const VertexWork& work, std::size_t i) {
  constexpr int kLanes = Lanes<R>::width;
  const auto store_beside = [&](const R(&four)[4], auto address) {
    float* to[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) to[lane] = address(i + static_cast<std::size_t>(lane));
    store_fours(four, to);
  };
  const auto store_varying = [&](Varying v, const R(&four)[4]) {
    store_beside(four, [&](std::size_t k) { return &work.varyings[static_cast<std::size_t>(v)][k].x; });
  };
  const auto carries = [&](Varying v) { return work.varyings[static_cast<std::size_t>(v)] != nullptr; };

  R p_model[3], p_clip[4];
  load_threes(&work.mesh->positions[i].x, p_model);
  for (int row = 0; row < 4; ++row) p_clip[row] = row_of(work.to_clip, row, p_model);
  const R inv_w = R(1) / p_clip[3];
  R p_win[3];
  for (int k = 0; k < 3; ++k) {
    p_win[k] = fused(p_clip[k] * inv_w, R(work.matrices.win_scale[k]), R(work.matrices.win_translate[k]));
  }
  const auto near = [](R value) { return greater_of(value, -value) <= R(1 << 20); };
  const auto nothing = [](R value) { return value - value; };  // 0, but for what is not finite
  const Mask<R> x_near = near(p_win[0]), y_near = near(p_win[1]);
  const Mask<R> drawable = x_near & y_near & (nothing(p_win[2]) + nothing(inv_w) == R(0));
  const R of_all = nothing(p_clip[0]) + nothing(p_clip[1]) + nothing(p_clip[2]) + nothing(p_clip[3]);
  const Mask<R> all_finite = of_all == R(0);
  const Int<R> outside = outside_planes(p_clip) | select(all_finite, Int<R>(0), Int<R>(kNotFinite)) |
                         select(drawable, Int<R>(0), Int<R>(kNotDrawable));
  store_codes(outside, work.outside + i);
  // round((win - 1/2) 256), as snap() has it: 128 is even, and the product exact.
  const auto snapped = [&](R win) { return as_float(nearest_int(select(drawable, win, R(0)) * R(256)) - Int<R>(128)); };

  R n[3] = {R(0), R(0), R(0)}, p_eye[4] = {R(0), R(0), R(0), R(1)};
  if (work.wants_normals) {
    unit_normals(work, i, n);
    for (int row = 0; row < 4; ++row) p_eye[row] = row_of(work.matrices.model_view, row, p_model);
    if (carries(Varying::normal)) store_varying(Varying::normal, {n[0], n[1], n[2], R(0)});
  } else if (carries(Varying::position)) {
    for (int row = 0; row < 4; ++row) p_eye[row] = row_of(work.matrices.model_view, row, p_model);
  }
  if (carries(Varying::position)) store_varying(Varying::position, p_eye);
  if (carries(Varying::texture)) {
    for (std::size_t k = i; k < i + kLanes; ++k) {
      work.varyings[static_cast<std::size_t>(Varying::texture)][k] = {work.mesh->texcoords[k], 0.0f, 1.0f};
    }
  }
  R color[4];
  if (work.illumination != nullptr) {
    const Vec3<R> p{p_eye[0], p_eye[1], p_eye[2]}, normal{n[0], n[1], n[2]};
    const Color<R> lit_color = lit(*work.illumination, work.reflectance, p, normal);
    color[0] = lit_color.r, color[1] = lit_color.g, color[2] = lit_color.b, color[3] = lit_color.a;
    if (carries(Varying::secondary)) {
      const Color<R> s = lit(*work.illumination, work.secondary, p, normal);
      store_varying(Varying::secondary, {s.r, s.g, s.b, R(0)});
    }
  } else if (work.mesh->colors.empty()) {
    for (int c = 0; c < 4; ++c) color[c] = R(work.color[c]);
  } else {
    const float* from[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) from[lane] = &work.mesh->colors[i + static_cast<std::size_t>(lane)].r;
    load_fours(from, color);
    for (R& channel : color) {  // as glm::clamp has it, -0 and all
      channel = select(channel < R(0), R(0), channel);
      channel = select(R(1) < channel, R(1), channel);
    }
  }
  store_beside({p_win[0], p_win[1], p_win[2], inv_w}, [&](std::size_t k) { return &work.out[k].p_win.x; });
  store_beside({snapped(p_win[0]), snapped(p_win[1]), color[0], color[1]},
               [&](std::size_t k) { return reinterpret_cast<float*>(&work.out[k].snapped); });
  store_beside(color, [&](std::size_t k) { return &work.out[k].color.r; });
  return outside;
}

/// [from, to) of the draw's vertices; returns what of any lies outside.
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
