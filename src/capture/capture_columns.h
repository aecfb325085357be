// List of a capture's groups and planes, by stage: visitors of the list write, read, copy, round, compare and hash
// captures.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "capture/capture.h"

namespace plumbline {

static_assert(std::endian::native == std::endian::little,
              "capture folders are little-endian, and written as memory is");

/// Element type of an array: the name of its scalars, and extents (scalar: none; vector: size; matrix: columns, rows).
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
  bool derivable = false;  ///< a capture folder may leave it out: it follows from others (complete_records.h)
  auto& at(auto& record, std::size_t) const { return record.*member; }
};
/// One member of each of a triangle's three corners.
template <class Member>
struct CornerColumn {
  static constexpr std::size_t kCorners = 3;
  std::string_view name;
  Member member;
  bool derivable = false;
  auto& at(auto& triangle, std::size_t corner) const { return triangle.v[corner].*member; }
};
/// Column of a group whose records are plain numbers.
struct ItselfColumn {
  static constexpr std::size_t kCorners = 0;
  static constexpr bool derivable = false;
  std::string_view name;
  auto& at(auto& record, std::size_t) const { return record; }
};
/// Column of a group whose records are three corners of plain numbers.
struct CornerItselfColumn {
  static constexpr std::size_t kCorners = 3;
  static constexpr bool derivable = false;
  std::string_view name;
  auto& at(auto& corners, std::size_t corner) const { return corners[corner]; }
};
template <class Member>
Column(std::string_view, Member, bool = false) -> Column<Member>;
template <class Member>
CornerColumn(std::string_view, Member, bool = false) -> CornerColumn<Member>;
inline constexpr bool kDerivable = true;

template <class C, class Record>
using ColumnType = std::remove_cvref_t<decltype(std::declval<C>().at(std::declval<Record&>(), 0))>;

/// Values of a column in one record.
template <class C>
inline constexpr std::size_t kPerRecord = std::max<std::size_t>(std::remove_cvref_t<C>::kCorners, 1);

/// A column's bytes, packed: the values of all records (a vector or a span), without the other members between them.
template <class Records, class C>
std::vector<char> packed(const Records& records, const C& column) {
  using Record = typename Records::value_type;
  constexpr std::size_t kSize = sizeof(ColumnType<C, const Record>);
  std::vector<char> bytes(records.size() * kPerRecord<C> * kSize);
  char* to = bytes.data();
  for (const auto& record : records) {
    for (std::size_t k = 0; k < kPerRecord<C>; ++k, to += kSize) std::memcpy(to, &column.at(record, k), kSize);
  }
  return bytes;
}

/// The columns of a group.
template <class... C>
class Columns {
 public:
  explicit Columns(C... columns) : all_(columns...) {}
  static constexpr std::size_t kCount = sizeof...(C);
  /// Calls visit(column) for each column.
  void each(auto visit) const {
    std::apply([&](const C&... column) { (visit(column), ...); }, all_);
  }

 private:
  std::tuple<C...> all_;
};

/// Source of a group or plane: its stage, its name in a capture folder, and the owner of each of its records.
struct Handed {
  constexpr Handed(Stage of, std::string_view named) : Handed(of, named, plumbline::per(of)) {}
  constexpr Handed(Stage of, std::string_view named, Per owner, std::optional<Varying> v = {})
      : stage(of), name(named), per(owner), varying(v) {}
  Stage stage;
  std::string_view name;
  Per per;
  std::optional<Varying> varying;  ///< whose column the group is
};

/// Name of the group that has one record per owner, and the number of owners. Other groups of these owners have as many
/// records, or none.
struct Owners {
  std::string_view group;
  std::size_t count;
};
inline Owners owners_of(const Records<double>& r, Per per) {
  switch (per) {
    case Per::light: return {"matrices.light", r.lights.size()};
    case Per::draw: return {"matrices", r.matrices.size()};
    case Per::vertex: return {"vertex", r.vertices.size()};
    case Per::clip_vertex: return {"clip", r.polygons.vertices.size()};
    case Per::polygon: return {"clip.polygon", r.polygons.polygons.size()};
    case Per::triangle: return {"window", r.triangles.size()};
    case Per::fragment: return {"coverage", r.covered.size()};
    case Per::pixel: break;
  }
  return {"", 0};
}

/// Calls visit.group(handed, columns, records...) and visit.plane(handed, plane...) for all that a capture folder
/// holds, with the vectors and planes of each of the captures. An array's name is "group.column", or the plane's.
template <class Visitor, class... Captures>
void visit_capture(Visitor&& visit, Captures&... captures) {
  const auto group = [&](Handed handed, auto records_of, auto... columns) {
    visit.group(handed, Columns(columns...), records_of(captures.records)...);
  };
  using R = Records<double>;
  const auto of = [](auto member) {
    const auto records_of = [member](auto& records) -> auto& { return records.*member; };
    return records_of;
  };
  using M = Matrices<double>;
  group({Stage::matrices, "matrices"}, of(&R::matrices), Column{"model_view", &M::model_view},
        Column{"projection", &M::projection}, Column{"normal", &M::normal}, Column{"win_scale", &M::win_scale},
        Column{"win_translate", &M::win_translate});
  using L = LightSource<double>;
  group({Stage::matrices, "matrices.light", Per::light}, of(&R::lights), Column{"p_eye", &L::p_eye},
        Column{"spot_eye", &L::spot_eye});
  using V = Vertex<double>;
  group({Stage::vertex, "vertex"}, of(&R::vertices), Column{"p_eye", &V::p_eye, kDerivable},
        Column{"p_clip", &V::p_clip}, Column{"n_eye", &V::n_eye, kDerivable});
  group({Stage::light, "light"}, of(&R::lit), Column{"color", &Lit<double>::color});
  using Clipped = ClipVertex<double>;
  group(
      {Stage::clip, "clip", Per::clip_vertex}, [](auto& r) -> auto& { return r.polygons.vertices; },
      Column{"p_clip", &Clipped::p_clip}, Column{"color", &Clipped::color}, Column{"cut", &Clipped::cut, kDerivable});
  using P = ClipPolygon;
  group(
      {Stage::clip, "clip.polygon"}, [](auto& r) -> auto& { return r.polygons.polygons; },
      Column{"primitive", &P::primitive}, Column{"first", &P::first}, Column{"count", &P::count});
  using W = WindowVertex<double>;
  using T = WindowTriangle<double>;
  group({Stage::window, "window"}, of(&R::triangles), CornerColumn{"p_win", &W::p_win},
        CornerColumn{"inv_w", &W::inv_w}, CornerColumn{"snapped", &W::snapped, kDerivable},
        CornerColumn{"color", &W::color}, Column{"primitive", &T::primitive}, Column{"front", &T::front, kDerivable},
        Column{"corners", &T::corners, kDerivable}, Column{"width", &T::width, kDerivable});
  group({Stage::coverage, "coverage"}, of(&R::covered), Column{"triangle", &Covered::triangle},
        Column{"x", &Covered::x}, Column{"y", &Covered::y});
  group({Stage::depth, "depth"}, of(&R::depth), ItselfColumn{"value"});
  group({Stage::attributes, "attributes"}, of(&R::attributes), Column{"color", &Attributes<double>::color});
  group({Stage::texture, "texture"}, of(&R::texels), Column{"color", &Texel<double>::color},
        Column{"lod", &Texel<double>::lod, kDerivable});
  group({Stage::shade, "shade"}, of(&R::shaded), Column{"color", &Shaded<double>::color});
  group({Stage::visibility, "visibility"}, of(&R::drawn), Column{"drawn", &Drawn::drawn});

  for (const Varying v : kAllVaryings) {
    using A = VaryingColumns<double>;
    const std::string name = "varyings." + std::string(name_of(v));
    const auto of_varying = [v](auto member) {
      const auto records_of = [=](auto& r) -> auto& { return r.varyings[v].*member; };
      return records_of;
    };
    const auto part = [&](Stage stage, const char* suffix, Per per, auto records_of, auto column) {
      const std::string full = name + suffix;
      group({stage, full, per, v}, records_of, column);
    };
    part(Stage::light, ".vertices", Per::vertex, of_varying(&A::vertices), ItselfColumn{"value"});
    part(Stage::clip, ".clipped", Per::clip_vertex, of_varying(&A::clipped), ItselfColumn{"value"});
    part(Stage::window, ".window", Per::triangle, of_varying(&A::triangles), CornerItselfColumn{"value"});
    part(Stage::attributes, ".fragments", Per::fragment, of_varying(&A::fragments), ItselfColumn{"value"});
  }

  const auto plane = [&](Stage stage, std::string_view name, auto member) {
    visit.plane(Handed{stage, name}, captures.planes.*member...);
  };
  plane(Stage::coverage, "planes.count", &Planes::count);
  plane(Stage::coverage, "planes.id_sum", &Planes::id_sum);
  plane(Stage::visibility, "planes.id", &Planes::id);
  plane(Stage::visibility, "planes.stencil", &Planes::stencil);
  plane(Stage::texture, "planes.texel", &Planes::texel);
  plane(Stage::shade, "planes.shaded", &Planes::shaded);
  plane(Stage::merge, "planes.color", &Planes::color);
  plane(Stage::merge, "planes.depth", &Planes::depth);
}

}  // namespace plumbline
