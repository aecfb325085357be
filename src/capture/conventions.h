// Conventions of a renderer: declared by the renderer, or found by plumb learn. A difference that the conventions
// explain is no mistake of a stage.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "scene/names.h"

namespace plumbline {

/// Conventions of one renderer. Each default is OpenGL's, and plumbline's own.
struct Conventions {
  enum class Rows { from_bottom, from_top };
  enum class Rounding { nearest, down, up };
  enum class WindowY { up, down };
  enum class TieRule { any, left_bottom, left_top, right_bottom, right_top, inclusive, exclusive };
  enum class DepthRange { zero_to_one, minus_one_to_one, one_to_zero };
  enum class Depth { as_asked, z16, z24, z32f };
  enum class DepthArithmetic {
    in_double,
    in_float,
    in_float_stepped,
    in_float_stepped_edges,
    in_float_from_origin,
    in_float_from_origin_stepped
  };
  enum class DepthOf { z, inv_w };
  enum class Encoding { linear, srgb };
  enum class ClipDepth { minus_w_to_w, zero_to_w };
  enum class DepthPlanes { cut, clamped };
  enum class Interpolation { perspective, affine };
  enum class ColorInterpolation { as_others, affine, perspective };
  enum class Corners { as_they_are, snapped };
  enum class DepthCorners { either, as_they_are, snapped };
  enum class Provoking { last, first };
  enum class AlphaTest { in_codes, in_float, either };
  enum class LevelOfDetail { per_pixel, per_square, approximate };
  enum class Blending { in_float, in_codes, in_codes_down };
  enum class FogFactor { per_fragment, per_vertex };
  enum class FogDistance { eye_plane, eye_radial };
  enum class ColorNumbers { in_float, in_codes };
  enum class Magnified { up_to_half, up_to_zero };
  enum class HalfWay { down, either };
  enum class Alpha { stored, none };

  /// Sample position of coverage, depth and attributes [pixels from the pixel's lower left corner].
  glm::dvec2 sample{0.5};
  /// r of a polygon offset, which OpenGL leaves open (2.1, 3.5.5), in depths of 24 and of 16 bits [codes].
  glm::dvec2 offset_unit{2};
  /// r in depths of floats [window z]; 0: the step from a polygon's largest depth to the next float.
  double float_offset_unit = 0;
  /// Fraction bits of window positions, which are snapped to 2^-bits pixel: 0 to 16; kFloat: positions are not snapped.
  int subpixel_bits = 8;
  /// Fraction bits of an edge's x, which is added up from row to row; or kFloat: of floats, or not added up.
  int edge_bits = kFloat;
  /// Fraction bits of texture filters' weights; or kFloat.
  int texture_bits = kFloat;
  Rows rows = Rows::from_bottom;
  Rounding subpixel_rounding = Rounding::nearest;
  WindowY window_y = WindowY::up;
  TieRule tie_rule = TieRule::any;
  DepthRange depth_range = DepthRange::zero_to_one;
  Depth depth_format = Depth::as_asked;
  Rounding depth_rounding = Rounding::nearest;
  DepthArithmetic depth_arithmetic = DepthArithmetic::in_double;
  DepthOf depth_of = DepthOf::z;
  Rounding color_rounding = Rounding::nearest;
  Encoding color_encoding = Encoding::linear;
  ClipDepth clip_depth = ClipDepth::minus_w_to_w;
  DepthPlanes depth_planes = DepthPlanes::cut;
  Interpolation interpolation = Interpolation::perspective;
  ColorInterpolation color_interpolation = ColorInterpolation::as_others;
  Corners attribute_corners = Corners::as_they_are;
  DepthCorners depth_corners = DepthCorners::either;
  Provoking provoking_vertex = Provoking::last;
  AlphaTest alpha_test = AlphaTest::in_codes;
  Blending blending = Blending::in_float;
  FogFactor fog_factor = FogFactor::per_fragment;
  FogDistance fog_distance = FogDistance::eye_plane;
  ColorNumbers vertex_colors = ColorNumbers::in_float;
  ColorNumbers fragment_colors = ColorNumbers::in_float;
  LevelOfDetail level_of_detail = LevelOfDetail::per_pixel;
  Magnified magnified = Magnified::up_to_half;
  HalfWay half_way_level = HalfWay::down;
  Alpha alpha = Alpha::stored;

  /// Names of the conventions that plumb learn could not find. Their values are OpenGL's, but that of depth_arithmetic,
  /// where no depth is shown, is in_float_from_origin: of those without steps, the arithmetic of the largest errors.
  std::vector<std::string> open;
  /// Findings of plumb learn that no convention explains, a sentence each. mistaken() lists each of them as a mistake.
  std::vector<std::string> unexplained;
  /// Names of conventions whose mistakes the renderer's author accepts: not_accepted() leaves them out.
  std::vector<std::string> accepted;

  static constexpr int kFloat = -1;
  bool operator==(const Conventions&) const = default;
};

template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::Rows> = {"from_bottom", "from_top"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Conventions::Rounding> = {"nearest", "down", "up"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::WindowY> = {"up", "down"};
template <>
inline constexpr std::array<Name, 7> kNamesOf<Conventions::TieRule> = {
    "any", "left_bottom", "left_top", "right_bottom", "right_top", "inclusive", "exclusive"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Conventions::DepthRange> = {"zero_to_one", "minus_one_to_one",
                                                                          "one_to_zero"};
template <>
inline constexpr std::array<Name, 4> kNamesOf<Conventions::Depth> = {"as_asked", "z16", "z24", "z32f"};
template <>
inline constexpr std::array<Name, 6> kNamesOf<Conventions::DepthArithmetic> = {"in_double",
                                                                               "in_float",
                                                                               "in_float_stepped",
                                                                               "in_float_stepped_edges",
                                                                               "in_float_from_origin",
                                                                               "in_float_from_origin_stepped"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::DepthOf> = {"z", "inv_w"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::Encoding> = {"linear", "srgb"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::ClipDepth> = {"minus_w_to_w", "zero_to_w"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::DepthPlanes> = {"cut", "clamped"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::Interpolation> = {"perspective", "affine"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Conventions::ColorInterpolation> = {"as_others", "affine", "perspective"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::Corners> = {"as_they_are", "snapped"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Conventions::DepthCorners> = {"either", "as_they_are", "snapped"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::Provoking> = {"last", "first"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Conventions::AlphaTest> = {"in_codes", "in_float", "either"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Conventions::LevelOfDetail> = {"per_pixel", "per_square", "approximate"};
template <>
inline constexpr std::array<Name, 3> kNamesOf<Conventions::Blending> = {"in_float", "in_codes", "in_codes_down"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::FogFactor> = {"per_fragment", "per_vertex"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::FogDistance> = {"eye_plane", "eye_radial"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::ColorNumbers> = {"in_float", "in_codes"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::Magnified> = {"up_to_half", "up_to_zero"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::HalfWay> = {"down", "either"};
template <>
inline constexpr std::array<Name, 2> kNamesOf<Conventions::Alpha> = {"stored", "none"};

/// v as a whole number: half to even (nearest), floor (down) or ceil (up). NaN stays NaN.
double rounded(Conventions::Rounding rounding, double v);
/// Middle of the interval that the rounding maps to 0: 0 (nearest), 1/2 (down) or -1/2 (up).
double middle_of(Conventions::Rounding rounding);

/// Rounding of window positions along an axis (0: x; 1: y, which points up here): the declared one, with down and up
/// exchanged for y where window_y is down.
Conventions::Rounding subpixel_rounding(const Conventions& conventions, int axis);

/// The sRGB encoding of a linear intensity, both in [0,1] (IEC 61966-2-1).
double srgb_encoded(double linear);

/// Snapped window coordinate of an axis (0: x, 1: y), counted from the first pixel's centre [1/256 pixel]. Positions of
/// the declared grid are the multiples of 2^-subpixel_bits pixel in the renderer's own window coordinates, which
/// to_dialect() moves by 1/2 - sample: whole pixels (0 bits) are pixels' borders, wherever the sample lies. Rounded to
/// the nearest whole number where that grid is finer than 1/256 pixel, or there is none.
double snapped(const Conventions& conventions, int axis, double from_centre);
/// Largest displacement [pixels] of a position that is converted to the nearest multiple of 2^-11 before it is rounded
/// down or up.
inline constexpr double kOfFixedPoint = 0x1p-12;

/// Range of snapped() over positions within kOfFixedPoint of `from_centre`. Of grids that are rounded to the nearest:
/// one value.
struct SnappedRange {
  double least, most;
};
SnappedRange snapped_range(const Conventions& conventions, int axis, double from_centre);

/// Position of a window coordinate [pixels] in the renderer's own window, before snapping: from the frame's side [the
/// grid's steps, 2^-subpixel_bits pixel]. There must be a grid.
double in_steps(const Conventions& conventions, int axis, double p_win);
/// Whole number of steps that in_steps() is snapped to, whatever the grid's fineness.
double on_grid(const Conventions& conventions, int axis, double p_win);

/// Words for people about one convention.
struct ConventionWords {
  std::string_view name;     ///< key in conventions.json
  std::string_view meaning;  ///< what it says
  bool is_free;              ///< OpenGL leaves the value open; mistaken() states the limits of those that are numbers
};

/// Calls visit(words, member) for each convention that is one of several words, in the order of tables.
template <class Visit>
void each_choice(Visit visit) {
  using C = Conventions;
  visit(ConventionWords{"rows", "the order of the picture's rows, or y turned round", false}, &C::rows);
  visit(ConventionWords{"subpixel_rounding", "how window positions are snapped", true}, &C::subpixel_rounding);
  visit(ConventionWords{"window_y", "the way y points where positions are snapped", true}, &C::window_y);
  visit(ConventionWords{"tie_rule", "edges that own a sample on them", true}, &C::tie_rule);
  visit(ConventionWords{"depth_range", "depths that are left, from the near plane to the far one", false},
        &C::depth_range);
  visit(ConventionWords{"depth_format", "the depth buffer's format", false}, &C::depth_format);
  visit(ConventionWords{"depth_rounding", "how depths become codes", true}, &C::depth_rounding);
  visit(ConventionWords{"depth_arithmetic", "the numbers that depths are interpolated in", true}, &C::depth_arithmetic);
  visit(ConventionWords{"depth_of", "the number that is interpolated for depths: window z, or 1/w", true},
        &C::depth_of);
  visit(ConventionWords{"color_rounding", "how colours become codes", false}, &C::color_rounding);
  visit(ConventionWords{"color_encoding", "what codes of colours stand for", false}, &C::color_encoding);
  visit(ConventionWords{"clip_depth", "the view volume in z", false}, &C::clip_depth);
  visit(ConventionWords{"depth_planes", "geometry beyond the near and far planes", false}, &C::depth_planes);
  visit(ConventionWords{"interpolation", "how attributes are interpolated", false}, &C::interpolation);
  visit(ConventionWords{"color_interpolation", "how colours are, where not as other attributes (OpenGL 2.1, 3.5.1)",
                        true},
        &C::color_interpolation);
  visit(ConventionWords{"attribute_corners", "window positions that attributes are interpolated between", true},
        &C::attribute_corners);
  visit(ConventionWords{"depth_corners", "window positions that depths are interpolated between", true},
        &C::depth_corners);
  visit(ConventionWords{"provoking_vertex", "the vertex that colours a flat triangle", false}, &C::provoking_vertex);
  visit(ConventionWords{"alpha_test", "the numbers that are compared", true}, &C::alpha_test);
  visit(ConventionWords{"blending", "the numbers that are blended", true}, &C::blending);
  visit(ConventionWords{"vertex_colors", "the numbers that colours of vertices are (OpenGL 2.1, 2.14.9)", true},
        &C::vertex_colors);
  visit(ConventionWords{"fragment_colors", "the numbers that colours and texels are before they are merged", true},
        &C::fragment_colors);
  visit(ConventionWords{"fog_factor", "where fog factors are computed (OpenGL 2.1, 3.10)", true}, &C::fog_factor);
  visit(ConventionWords{"fog_distance", "the distance of fog: |z_eye|, or |p_eye| (OpenGL 2.1, 3.10)", true},
        &C::fog_distance);
  visit(ConventionWords{"level_of_detail", "per pixel, per square of 2 x 2 pixels, or approximated (OpenGL 2.1, 3.8.8)",
                        true},
        &C::level_of_detail);
  visit(ConventionWords{"magnified", "levels of detail at which a texture is magnified", true}, &C::magnified);
  visit(ConventionWords{"half_way_level", "the level nearest to a level of detail half way between two", true},
        &C::half_way_level);
  visit(ConventionWords{"alpha", "whether the frame has an alpha, which is 1 where it has none", true}, &C::alpha);
}

/// Calls visit(words, member) for each convention that is a number of bits, or "float".
template <class Visit>
void each_number_of_bits(Visit visit) {
  using C = Conventions;
  visit(ConventionWords{"subpixel_bits", "window positions' fraction bits", true}, &C::subpixel_bits);
  visit(ConventionWords{"edge_bits", "fraction bits of edges' x, which is added up from row to row", true},
        &C::edge_bits);
  visit(ConventionWords{"texture_bits", "fraction bits of texture filters' weights", true}, &C::texture_bits);
}

inline constexpr ConventionWords kSampleWords{"sample", "the sample's place in its pixel", false};
inline constexpr ConventionWords kOffsetWords{"offset_unit", "a polygon offset's unit in codes of depth", true};
inline constexpr ConventionWords kFloatOffsetWords{"float_offset_unit", "a polygon offset's unit in depths of floats",
                                                   true};

/// Whether `open` names the convention.
bool leaves_open(const Conventions& conventions, std::string_view name);

/// Whether the declared grid and sample settle where corners and samples lie: subpixel_bits 0 to 10, the sample at a
/// multiple of 1/256 pixel or on the grid; where rows count from the top, subpixel_rounding nearest or window_y down
/// (else y may be rounded either way).
bool settles_grid(const Conventions& conventions);
/// Whether, besides, the declared tie rule settles which triangle owns a sample on an edge.
bool settles_ties(const Conventions& conventions);
/// Whether it does where positions are floats, between corners that no arithmetic in float rounds: a rule is declared,
/// and the sample is at a multiple of 1/256 pixel.
bool settles_ties_of_floats(const Conventions& conventions);

/// Text of a number of bits: "float", or the number.
std::string bits_text(int bits);
/// Text of a sample position, such as "0.5, 0.5", of four significant digits.
std::string sample_text(const glm::dvec2& sample);

/// Conventions that are mistakes, a line each: "convention rows: from_top, expected from_bottom (the order of the
/// picture's rows)"; then what no convention explains: "no convention: one scene drawn twice differs".
std::vector<std::string> mistaken(const Conventions& conventions);
/// Lines of mistaken() by which a run fails: those of conventions that `accepted` does not name.
std::vector<std::string> not_accepted(const Conventions& conventions);

/// Conventions of a renderer that declares none: OpenGL's defaults, but the alpha test may use either arithmetic (2.1
/// specification, 4.1.4), and levels of detail may be approximated (3.8.8).
Conventions undeclared();

}  // namespace plumbline
