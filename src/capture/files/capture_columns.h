// The one list of what a capture folder holds: written and read by visitors of it, so that the two cannot drift apart.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "capture/capture.h"

namespace plumbline {

static_assert(std::endian::native == std::endian::little,
              "capture folders are little-endian, and written as memory is");

/// What one array's element is: the scalar's name, and its extents (none for a scalar; a matrix: columns, rows).
template <class T>
struct Element;
template <>
struct Element<double> {
  static constexpr std::string_view dtype = "f64";
  static constexpr std::array<std::size_t, 0> extents{};
};
template <>
struct Element<float> : Element<double> {
  static constexpr std::string_view dtype = "f32";
};
template <>
struct Element<std::uint64_t> : Element<double> {
  static constexpr std::string_view dtype = "u64";
};
template <>
struct Element<std::uint32_t> : Element<double> {
  static constexpr std::string_view dtype = "u32";
};
template <>
struct Element<std::int32_t> : Element<double> {
  static constexpr std::string_view dtype = "i32";
};
template <>
struct Element<std::uint16_t> : Element<double> {
  static constexpr std::string_view dtype = "u16";
};
template <>
struct Element<std::uint8_t> : Element<double> {
  static constexpr std::string_view dtype = "u8";
};
/// 0 or 1.
template <>
struct Element<bool> : Element<double> {
  static constexpr std::string_view dtype = "u8";
};
template <int N, class T>
struct Element<glm::vec<N, T>> {
  static constexpr std::string_view dtype = Element<T>::dtype;
  static constexpr std::array<std::size_t, 1> extents{N};
};
template <int C, int R, class T>
struct Element<glm::mat<C, R, T>> {
  static constexpr std::string_view dtype = Element<T>::dtype;
  static constexpr std::array<std::size_t, 2> extents{C, R};
};

/// One member of a group's records. A column's at() is a reference to its value in a record (at a corner).
template <class Member>
struct Column {
  static constexpr std::size_t kCorners = 0;
  std::string_view name;
  Member member;
  auto& at(auto& record, std::size_t) const { return record.*member; }
};
/// One member of each of a triangle's three corners.
template <class Member>
struct CornerColumn {
  static constexpr std::size_t kCorners = 3;
  std::string_view name;
  Member member;
  auto& at(auto& triangle, std::size_t corner) const { return triangle.v[corner].*member; }
};
/// The records are plain numbers.
struct ItselfColumn {
  static constexpr std::size_t kCorners = 0;
  std::string_view name;
  auto& at(auto& record, std::size_t) const { return record; }
};
/// Each of three corners is plain numbers.
struct CornerItselfColumn {
  static constexpr std::size_t kCorners = 3;
  std::string_view name;
  auto& at(auto& corners, std::size_t corner) const { return corners[corner]; }
};
template <class Member>
Column(std::string_view, Member) -> Column<Member>;
template <class Member>
CornerColumn(std::string_view, Member) -> CornerColumn<Member>;

template <class C, class Record>
using ColumnType = std::remove_cvref_t<decltype(std::declval<C>().at(std::declval<Record&>(), 0))>;

/// Calls visit.group(name, records, columns...) and visit.plane(name, plane) for all that a capture folder holds.
/// An array's name is "group.column", or the plane's.
template <class CaptureRef, class Visitor>
void visit_capture(CaptureRef& capture, Visitor& visit) {
  auto& records = capture.records;
  using M = Matrices<double>;
  visit.group("matrices", records.matrices, Column{"model_view", &M::model_view}, Column{"projection", &M::projection},
              Column{"normal", &M::normal}, Column{"win_scale", &M::win_scale},
              Column{"win_translate", &M::win_translate});
  using L = LightSource<double>;
  visit.group("matrices.light", records.lights, Column{"p_eye", &L::p_eye}, Column{"spot_eye", &L::spot_eye});
  using V = Vertex<double>;
  visit.group("vertex", records.vertices, Column{"p_eye", &V::p_eye}, Column{"p_clip", &V::p_clip},
              Column{"n_eye", &V::n_eye});
  visit.group("light", records.lit, Column{"color", &Lit<double>::color});
  using C = ClipVertex<double>;
  visit.group("clip", records.polygons.vertices, Column{"p_clip", &C::p_clip}, Column{"color", &C::color},
              Column{"cut", &C::cut});
  using P = ClipPolygon;
  visit.group("clip.polygon", records.polygons.polygons, Column{"primitive", &P::primitive}, Column{"first", &P::first},
              Column{"count", &P::count});
  using W = WindowVertex<double>;
  using T = WindowTriangle<double>;
  visit.group("window", records.triangles, CornerColumn{"p_win", &W::p_win}, CornerColumn{"inv_w", &W::inv_w},
              CornerColumn{"snapped", &W::snapped}, CornerColumn{"color", &W::color},
              Column{"primitive", &T::primitive}, Column{"front", &T::front}, Column{"corners", &T::corners},
              Column{"width", &T::width});
  visit.group("coverage", records.covered, Column{"triangle", &Covered::triangle}, Column{"x", &Covered::x},
              Column{"y", &Covered::y});
  visit.group("depth", records.depth, ItselfColumn{"value"});
  visit.group("attributes", records.attributes, Column{"color", &Attributes<double>::color});
  visit.group("texture", records.texels, Column{"color", &Texel<double>::color}, Column{"lod", &Texel<double>::lod});
  visit.group("shade", records.shaded, Column{"color", &Shaded<double>::color});
  visit.group("visibility", records.drawn, Column{"drawn", &Drawn::drawn});

  for (const Varying v : kAllVaryings) {
    auto& columns = records.varyings[v];
    const std::string name = "varyings." + std::string(name_of(v));
    visit.group(name + ".vertices", columns.vertices, ItselfColumn{"value"});
    visit.group(name + ".clipped", columns.clipped, ItselfColumn{"value"});
    visit.group(name + ".window", columns.triangles, CornerItselfColumn{"value"});
    visit.group(name + ".fragments", columns.fragments, ItselfColumn{"value"});
  }

  auto& planes = capture.planes;
  visit.plane("planes.count", planes.count);
  visit.plane("planes.id_sum", planes.id_sum);
  visit.plane("planes.id", planes.id);
  visit.plane("planes.stencil", planes.stencil);
  visit.plane("planes.texel", planes.texel);
  visit.plane("planes.shaded", planes.shaded);
  visit.plane("planes.color", planes.color);
  visit.plane("planes.depth", planes.depth);
}

}  // namespace plumbline
