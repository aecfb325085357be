// Programmable stages: a user's vertex() and fragment() in the place of stages 1, 2 and 9.
//
//   struct Gouraud {
//     struct Varyings {
//       float intensity;
//     };
//     glm::vec4 vertex(std::size_t triangle, int corner, Varyings& out) const;  // fills `out`, returns p_clip
//     bool fragment(const Varyings& in, glm::vec4& color) const;                // true: discard
//   };
//   const Frame frame = draw_program(Gouraud{...}, triangles, format);
//
// vertex() makes the input of stage 3 (render.h); fragment() replaces Stages::shade. Uniforms are members of the
// program. Varyings are stored, clipped and interpolated as vertex attributes of four floats each.
#pragma once

#include <array>
#include <concepts>
#include <cstring>
#include <type_traits>

#include "pipeline/render.h"

namespace plumbline::pipeline {

/// Varyings: a struct of floats and of vectors and matrices of floats, nothing else; it may be empty.
///
/// vertex(triangle, corner, out) returns p_clip. It is called once for each corner (0, 1, 2) of each triangle, in
/// order. A triangle with a p_clip that is not finite is dropped.
///
/// fragment(in, color) is called for each fragment that passes the depth test, with perspective-correct varyings, whose
/// weights are of double precision where there are more than four floats (PerspectiveSetup, in_blocks). `color` is
/// (0, 0, 0, 1) before the call, and then converted to the frame's format: clamped and rounded to codes, or float as it
/// is. A fragment for which fragment() returns true is discarded: the frame's colour and depth stay as they are.
template <class P, class V = typename P::Varyings>
concept Program = requires(const P& program, V out, const V& in, glm::vec4 color) {
  { program.vertex(std::size_t{0}, 0, out) } -> std::same_as<glm::vec4>;
  { program.fragment(in, color) } -> std::same_as<bool>;
  requires std::is_trivially_copyable_v<V>;
  requires std::is_empty_v<V> || alignof(V) == alignof(float);
};

/// The fixed state under which a program draws (scene.h, Draw).
struct ProgramState {
  Shading shading = Shading::gouraud;  ///< flat: every corner takes the last corner's varyings; else smooth
  Cull cull = Cull::none;
  DepthFunc depth_func = DepthFunc::less;
};

/// Throws std::invalid_argument for more than 2^24 triangles, an antialiased frame, or a frame side outside of [1,
/// 16384] pixels.
void require_drawable(std::size_t triangles, const FrameFormat& format);

/// Draws a program's vertices, of which p_clip alone is read, on a cleared frame: three to a triangle, with one entry
/// of `varyings` each. `varying_fours`: entries of Attributes in use, 0 to kAttributes; `shade`: stage 9, with
/// `program` in its Surface. The caller has called require_drawable().
Frame draw_program(std::span<const Vertex<float>> vertices, std::span<const Attributes> varyings,
                   std::size_t varying_fours, const FrameFormat& format, const ProgramState& state,
                   decltype(Stages::shade) shade, const void* program);

/// Stage 9 by the program's fragment().
template <Program P>
Shaded shade_program(const Surface& surface, bool /*front*/, const SurfaceAttributes<float>& attributes) {
  typename P::Varyings in{};
  if constexpr (!std::is_empty_v<typename P::Varyings>) std::memcpy(&in, &attributes, sizeof in);  // colour, varyings
  glm::vec4 color(0, 0, 0, 1);
  const bool discarded = static_cast<const P*>(surface.program)->fragment(in, color);
  return {color, discarded};
}

/// Draws the program's triangles, in order, on a cleared frame. Throws as require_drawable.
template <Program P>
Frame draw_program(const P& program, std::size_t triangles, const FrameFormat& format, const ProgramState& state = {}) {
  using Varyings = typename P::Varyings;
  constexpr std::size_t kFloats = std::is_empty_v<Varyings> ? 0 : sizeof(Varyings) / sizeof(float);
  static_assert(kFloats <= 4 * kAttributes, "varyings of at most 28 floats");
  require_drawable(triangles, format);
  std::vector<Vertex<float>> vertices(3 * triangles);
  std::vector<Attributes> varyings(3 * triangles);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Varyings out{};
    vertices[i].p_clip = program.vertex(i / 3, static_cast<int>(i % 3), out);
    if constexpr (kFloats != 0) std::memcpy(varyings[i].data(), &out, sizeof out);
  }
  return draw_program(vertices, varyings, (kFloats + 3) / 4, format, state, shade_program<P>, &program);
}

}  // namespace plumbline::pipeline
