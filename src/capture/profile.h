// Profile of a renderer: how its numbers may differ from exact numbers.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace plumbline {

enum class Profile {
  foreign,  ///< its conventions are not declared
  dialect,  ///< float, by every convention of the scene's dialect: plumbline's own
  exact,    ///< integers and double precision, stage by stage: the referee
  opengl,   ///< OpenGL in float: planes are evaluated from the window's origin
  oracle    ///< legal answers, each with its own bound
};
inline constexpr std::array<std::string_view, 5> kProfileNames = {"foreign", "dialect", "exact", "opengl", "oracle"};
constexpr std::string_view name_of(Profile profile) { return kProfileNames[static_cast<std::size_t>(profile)]; }

}  // namespace plumbline
