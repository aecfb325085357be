// Varyings: vertex attributes of four numbers beside the colour. Clip, window and attributes treat each as the colour.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline {

struct Scene;
struct Draw;

enum class Varying : std::uint8_t {
  secondary,       ///< rgb: the specular part, where it is kept apart; a is 0
  back_color,      ///< colour of back faces; ends at the window stage
  back_secondary,  ///< secondary of back faces; ends at the window stage
  texture,         ///< s, t, 0, 1
  normal,          ///< n_eye, 0
  position         ///< p_eye, w not 1 where the matrices say so
};
inline constexpr std::array<std::string_view, 6> kVaryingNames = {"secondary", "back_color", "back_secondary",
                                                                  "texture",   "normal",     "position"};
inline constexpr std::size_t kVaryings = kVaryingNames.size();
inline constexpr std::array<Varying, kVaryings> kAllVaryings = {Varying::secondary,      Varying::back_color,
                                                                Varying::back_secondary, Varying::texture,
                                                                Varying::normal,         Varying::position};
constexpr std::size_t index_of(Varying v) { return static_cast<std::size_t>(v); }
constexpr std::string_view name_of(Varying v) { return kVaryingNames[index_of(v)]; }

/// Whether the varying is a colour that lighting makes: under flat shading all corners have the provoking vertex'
/// value.
constexpr bool is_lit(Varying v) { return v <= Varying::back_secondary; }
/// Whether the varying is of back faces. It ends at the window stage, which chooses each triangle's colours by facing.
constexpr bool is_back(Varying v) { return v == Varying::back_color || v == Varying::back_secondary; }
/// Whether the varying is a separate specular colour, of front or back faces (OpenGL 2.1 spec 3.9).
constexpr bool is_secondary(Varying v) { return v == Varying::secondary || v == Varying::back_secondary; }

/// Whether the draw uses the varying. Where another draw of the scene does, this draw's entries of the columns are 0.
bool carries(const Scene& scene, const Draw& draw, Varying v);
/// Varyings that any draw of the scene carries, in the enum's order.
std::vector<Varying> carried(const Scene& scene);
/// Sets `out` to carried(scene); the memory of `out` is reused.
void carried(const Scene& scene, std::vector<Varying>& out);
/// Whether the draw's fragments have the interpolated colour, unchanged.
bool is_plain(const Scene& scene, const Draw& draw);
/// Whether is_plain() holds for all draws.
bool is_plain(const Scene& scene);

/// One varying's columns, beside the records of the stages (stages.h); empty where no draw carries it.
template <class T>
struct VaryingColumns {
  using Four = glm::vec<4, T>;
  std::vector<Four> vertices;                  ///< beside vertices
  std::vector<Four> clipped;                   ///< beside polygons.vertices
  std::vector<std::array<Four, 3>> triangles;  ///< beside triangles, per corner; empty where is_back()
  std::vector<Four> fragments;                 ///< beside covered; empty where is_back()
};
template <class T>
class Varyings {
 public:
  VaryingColumns<T>& operator[](Varying v) { return columns_[index_of(v)]; }
  const VaryingColumns<T>& operator[](Varying v) const { return columns_[index_of(v)]; }

 private:
  std::array<VaryingColumns<T>, kVaryings> columns_;
};

}  // namespace plumbline
