// Enumerators' names as scene files write them, in the order of the enumerators' values.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "scene/scene.h"

namespace plumbline {

using Name = std::string_view;

template <class E>
inline constexpr std::array<Name, 0> kNamesOf{};
template <>
inline constexpr std::array<Name, 4> kNamesOf<Dialect> = {"gl", "gzrender", "games101", "tinyrenderer"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Topology> = {"triangles", "lines", "points"};
template <>
inline constexpr std::array<Name, 4> kNamesOf<ColorFormat> = {"rgba8", "rgba12", "rgba16", "rgba32f"};
template <>
inline constexpr std::array<Name, 4> kNamesOf<DepthFormat> = {"z8", "z16", "z24", "z32f"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<StencilFormat> = {"none", "s8"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<LightModel::Specular> = {"half_vector", "reflection"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<LightModel::Sides> = {"one", "two", "flip"};
template <>
inline constexpr std::array<Name, 6> kNamesOf<ColorMaterial> = {"none",     "ambient", "diffuse", "ambient_and_diffuse",
                                                                "specular", "emission"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Normals> = {"normalize", "rescale", "as_they_are"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Shading> = {"flat", "gouraud", "phong"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Cull> = {"none", "back", "front"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<PolygonMode> = {"fill", "line", "point"};
template <>
inline constexpr std::array<Name, 8> kNamesOf<CompareFunc> = {"never",   "less",      "equal",         "less_equal",
                                                              "greater", "not_equal", "greater_equal", "always"};
template <>
inline constexpr std::array<Name, 8> kNamesOf<StencilOp> = {
    "keep", "zero", "replace", "increment", "increment_wrap", "decrement", "decrement_wrap", "invert"};
template <>
inline constexpr std::array<Name, 16> kNamesOf<LogicOp> = {
    "clear", "and",        "and_reverse", "copy",       "and_inverted",  "noop",        "xor",  "or",
    "nor",   "equivalent", "invert",      "or_reverse", "copy_inverted", "or_inverted", "nand", "set"};
template <>
inline constexpr std::array<Name, 15> kNamesOf<BlendFactor> = {"zero",
                                                               "one",
                                                               "source_color",
                                                               "one_minus_source_color",
                                                               "destination_color",
                                                               "one_minus_destination_color",
                                                               "source_alpha",
                                                               "one_minus_source_alpha",
                                                               "destination_alpha",
                                                               "one_minus_destination_alpha",
                                                               "constant_color",
                                                               "one_minus_constant_color",
                                                               "constant_alpha",
                                                               "one_minus_constant_alpha",
                                                               "source_alpha_saturate"};
template <>
inline constexpr std::array<Name, 5> kNamesOf<BlendEquation> = {"add", "subtract", "reverse_subtract", "min", "max"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Fog::Mode> = {"linear", "exp", "exp2"};
template <>
inline constexpr std::array<Name, 6> kNamesOf<TextureFormat> = {"alpha",     "luminance", "luminance_alpha",
                                                                "intensity", "rgb",       "rgba"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<TexelType> = {"unorm8", "float32"};
template <>
inline constexpr std::array<Name, 6> kNamesOf<MinFilter> = {"nearest",
                                                            "linear",
                                                            "nearest_mipmap_nearest",
                                                            "linear_mipmap_nearest",
                                                            "nearest_mipmap_linear",
                                                            "linear_mipmap_linear"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<MagFilter> = {"nearest", "linear"};
template <>
inline constexpr std::array<Name, 4> kNamesOf<Wrap> = {"repeat", "mirrored_repeat", "clamp_to_edge", "clamp_to_border"};
template <>
inline constexpr std::array<Name, 5> kNamesOf<TextureEnvironment> = {"replace", "modulate", "decal", "blend", "add"};

template <class E>
concept Named = !kNamesOf<E>.empty();

template <Named E>
constexpr Name name_of(E value) {
  return kNamesOf<E>[static_cast<std::size_t>(value)];
}

}  // namespace plumbline
