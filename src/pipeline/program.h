// Programmable stages: a vertex() and a fragment() of one's own in the place of stages 1, 2 and 9.
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
// Both are compiled into the loop over fragments (fragment.h): what a program knows besides, its uniforms, are its
// members. Varyings travel as colours do, four floats at a time: stages 3 and 4 run once for every four of them, and
// what holds of a vertex colour (cut by cut, bit by bit) holds of them.
#pragma once

#include <array>
#include <concepts>
#include <cstring>
#include <type_traits>

#include "pipeline/tiles.h"

namespace plumbline::pipeline {

/// Varyings: a struct of floats and of vectors and matrices of floats, nothing else; it may be empty.
template <class V>
concept VaryingStruct = (std::is_empty_v<V> || alignof(V) == alignof(float)) && std::is_trivially_copyable_v<V>;

/// vertex(triangle, corner, out) returns p_clip. It is called once for each corner (0, 1, 2) of each triangle, in order.
/// A triangle with a p_clip that is not finite is dropped.
template <class P>
concept VertexProgram = requires(const P& program, typename P::Varyings out) {
  { program.vertex(std::size_t{0}, 0, out) } -> std::same_as<glm::vec4>;
};

/// fragment(in, color) is called for each fragment that passes the depth test, with perspective-correct varyings. The
/// colour is clamped and rounded to the frame's format. Where it returns true, the fragment is discarded: colour and depth
/// stay as they are.
template <class P>
concept FragmentProgram = requires(const P& program, const typename P::Varyings& in, glm::vec4 color) {
  { program.fragment(in, color) } -> std::same_as<bool>;
};

template <class P>
concept Program = VaryingStruct<typename P::Varyings> && VertexProgram<P> && FragmentProgram<P>;

/// The fixed state under which a program draws (scene.h, Draw).
struct ProgramState {
  Shading shading = Shading::gouraud;  ///< flat: every corner takes the last one's varyings
  Cull cull = Cull::none;
  DepthFunc depth_func = DepthFunc::less;
};

/// Throws std::invalid_argument for more than 2^24 triangles, or a frame of no or more than 16384 pixels a side.
void require_drawable(std::size_t triangles, const FrameFormat& format);

/// Stages 3 and 4 for four of the varyings: `p_clip` and `four` per corner, three corners to a triangle.
std::vector<WindowTriangle<float>> program_triangles(std::span<const Vertex<float>> p_clip,
                                                     std::span<const Lit<float>> four, const FrameFormat& format,
                                                     const ProgramState& state);

/// A program as stage functions.
template <Program P>
class ProgramStages : public FragmentStages {
 public:
  using Varyings = typename P::Varyings;
  static constexpr bool has_surfaces = false;
  static constexpr std::size_t kFloats = std::is_empty_v<Varyings> ? 0 : sizeof(Varyings) / sizeof(float);
  static constexpr std::size_t kFours = kFloats == 0 ? 1 : (kFloats + 3) / 4;
  /// The same triangles once for every four varyings, which stand for the colour.
  using Triangles = std::array<std::vector<WindowTriangle<float>>, kFours>;
  struct Shaded : Color<float> {
    bool discarded;
  };

  ProgramStages(const P& program, const Triangles& triangles) : program_(program), triangles_(triangles) {}

  std::array<AttributeSetup, kFours> attribute_setup(const WindowTriangle<float>&, std::uint32_t triangle) const {
    std::array<AttributeSetup, kFours> out;
    for (std::size_t i = 0; i < kFours; ++i) out[i] = pipeline::attribute_setup(triangles_[i][triangle]);
    return out;
  }
  template <class R>
  static Varyings attributes(const auto& s, const std::array<AttributeSetup, kFours>& of, const Pixels<R>& p) {
    Varyings out{};
    if constexpr (kFloats != 0) {
      const Weights<R> k = weights<R>(s.perspective, from_anchor<R>(s.planes, p));
      std::array<Color<R>, kFours> fours;
      for (std::size_t i = 0; i < kFours; ++i) fours[i] = mean<R>(of[i], k);
      std::memcpy(&out, fours.data(), sizeof out);
    }
    return out;
  }
  template <class R>
  Shaded shade(const Varyings& in) const {
    glm::vec4 color(0, 0, 0, 1);
    const bool discarded = program_.fragment(in, color);
    return {{color.r, color.g, color.b, color.a}, discarded};
  }
  template <class R>
  static bool kept(bool passes, const Shaded& shaded) {
    return passes && !shaded.discarded;
  }

 private:
  const P& program_;
  const Triangles& triangles_;
};

/// Draws the program's triangles, in order, on a cleared frame. Throws as require_drawable.
template <Program P>
Frame draw_program(const P& program, std::size_t triangles, const FrameFormat& format, const ProgramState& state = {}) {
  using OfProgram = ProgramStages<P>;
  require_drawable(triangles, format);
  std::vector<Vertex<float>> vertices(3 * triangles);
  std::array<std::vector<Lit<float>>, OfProgram::kFours> fours;
  fours.fill(std::vector<Lit<float>>(3 * triangles));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    typename P::Varyings out{};
    vertices[i].p_clip = program.vertex(i / 3, static_cast<int>(i % 3), out);
    std::array<glm::vec4, OfProgram::kFours> floats{};
    if constexpr (OfProgram::kFloats != 0) std::memcpy(floats.data(), &out, sizeof out);
    for (std::size_t k = 0; k < OfProgram::kFours; ++k) fours[k][i].color = floats[k];
  }
  typename OfProgram::Triangles of_four;
  for (std::size_t k = 0; k < OfProgram::kFours; ++k) of_four[k] = program_triangles(vertices, fours[k], format, state);
  const std::uint32_t first[] = {0, static_cast<std::uint32_t>(of_four[0].size())};
  Draw draw;
  draw.depth_func = state.depth_func;
  Frame frame(format);
  NoTap tap;
  draw_tiles<float>(OfProgram(program, of_four), {of_four[0], first, std::span(&draw, 1)}, format, frame, tap);
  return frame;
}

}  // namespace plumbline::pipeline
