#include "check/diagnose/evidence.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include <fmt/format.h>
#include <glm/gtc/matrix_access.hpp>

#include "capture/capture_columns.h"
#include "check/bounds/units.h"
#include "check/diagnose/coverage_differences.h"
#include "check/judge/stage_inputs.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

using TextLines = std::vector<std::string>;

template <class T>
std::string text(const T& v, int digits = 9) {
  if constexpr (std::is_floating_point_v<T>) return fmt::format("{:.{}g}", v, digits);
  if constexpr (std::is_integral_v<T>) return std::to_string(v);
  if constexpr (!std::is_arithmetic_v<T>) {
    std::string out = "(";
    for (int c = 0; c < T::length(); ++c) out += fmt::format("{}{}", c == 0 ? "" : " ", text(v[c], digits));
    return out + ")";
  }
}

double ulps(double a, double b) { return a == b ? 0 : (a - b) / ulp(b); }
template <int n>
glm::vec<n, double> ulps(const glm::vec<n, double>& a, const glm::vec<n, double>& b) {
  glm::vec<n, double> out;
  for (int c = 0; c < n; ++c) out[c] = ulps(a[c], b[c]);
  return out;
}

std::string depth_text(const FrameFormat& frame, double z) {
  const double scale = depth_scale(frame.depth);
  return scale == 0 ? text(z) : fmt::format("{:.9g} (code {:.9g})", z, z * scale);
}

// Prints the columns of the candidate's record `mine` of a stage: alone, as input, or beside the expected `theirs`.
struct ColumnPrinter {
  Stage stage;
  std::size_t mine;
  std::optional<std::size_t> theirs;  // none: it came in
  const FrameFormat& frame;
  TextLines& out;
  bool of_light = false;  // of the stage matrices: a light, no draw

  void group(Handed group, const auto& columns, const auto& a, const auto& b) {
    if (group.stage != stage || (group.per == Per::light) != of_light || mine >= a.size() ||
        (theirs && *theirs >= b.size()))
      return;
    columns.each([&](const auto& column) {
      const bool nameless = column.name == "value";  // depth, or varyings.NAME.GROUP
      std::string_view name = nameless ? group.name.substr(group.name.find('.') + 1) : column.name;
      name = name.substr(0, name.find('.'));
      for (std::size_t k = 0; k < kPerRecord<decltype(column)>; ++k) {
        const std::string full =
            kPerRecord<decltype(column)> == 1 ? std::string(name) : fmt::format("corner {} {}", k, name);
        if (theirs) {
          beside(full, column.at(a[mine], k), column.at(b[*theirs], k));
        } else {
          came_in(full, column.at(a[mine], k));
        }
      }
    });
  }
  void plane(Handed, const auto&, const auto&) const {}

 private:
  std::string value_text(std::string_view name, double v) const {
    return name == "depth" ? depth_text(frame, v) : text(v);
  }
  static std::string value_text(std::string_view, const auto& v) { return text(v); }
  // Whether the candidate tells the value: a level of detail of NaN stands for a column left out (complete_records.h).
  static bool is_told(std::string_view name, double v) { return name != "lod" || !std::isnan(v); }
  static bool is_told(std::string_view, const auto&) { return true; }
  template <int n>
  void came_in(const std::string& name, const glm::mat<n, n, double>& m) {
    for (int row = 0; row < n; ++row) came_in(fmt::format("{} row {}", name, row), glm::row(m, row));
  }
  void came_in(const std::string& name, const auto& v) {
    if (!is_told(name, v)) return;
    out.push_back(fmt::format("came in of {}: {} {}", name_of(stage), name, value_text(name, v)));
  }

  template <int n>
  void beside(const std::string& name, const glm::mat<n, n, double>& a, const glm::mat<n, n, double>& b) {
    for (int row = 0; row < n; ++row) {
      if (glm::row(a, row) != glm::row(b, row))
        beside(fmt::format("{} row {}", name, row), glm::row(a, row), glm::row(b, row));
    }
  }
  template <class T>
  void beside(const std::string& name, const T& a, const T& b) {
    if (!is_told(name, a)) return;
    if constexpr (std::is_same_v<T, double>) {
      if (std::isnan(a) || std::isnan(b))
        return out.push_back(fmt::format("{} {}, expected {}", name, value_text(name, a), value_text(name, b)));
    }
    if constexpr (std::is_same_v<T, bool>) {
      const auto yes = [](bool v) { return v ? "yes" : "no"; };
      if (a != b) out.push_back(fmt::format("{}: {}, expected {}", name, yes(a), yes(b)));
      return;
    }
    if constexpr (!std::is_integral_v<T>) {
      if (a == b) return out.push_back(fmt::format("{} {}, as expected", name, value_text(name, a)));
    }
    std::string apart;
    if constexpr (std::is_same_v<T, glm::dvec4>) {
      const bool is_color = name.ends_with("color") || name.ends_with("secondary");
      apart = is_color ? fmt::format("{}/255", text((a - b) * 255.0, 4)) : text(ulps(a, b), 4) + " ULP";
    } else if constexpr (std::is_same_v<T, glm::ivec2>) {
      apart = fmt::format("{}/{} pixel", text(a - b), kSubpixel);
    } else if constexpr (std::is_integral_v<T>) {
      if (a == b) return;
      apart = text(static_cast<double>(a) - static_cast<double>(b));
    } else if constexpr (std::is_same_v<T, double>) {
      const double scale = name == "depth" ? depth_scale(frame.depth) : 0;
      apart = scale == 0 ? text(ulps(a, b), 4) + " ULP" : text((a - b) * scale, 4) + " steps";
    } else {
      apart = text(ulps(a, b), 4) + " ULP";
    }
    out.push_back(fmt::format("{} {}, expected {}: {} apart", name, value_text(name, a), value_text(name, b), apart));
  }
};

// Printer of records, the candidate's beside the expected ones.
class RecordPrinter {
 public:
  explicit RecordPrinter(const Evidence& e)
      : scene_(e.scene), stage_(e.stage), mine_(e.candidate), theirs_(e.expected), draws_(e.scene) {}

  void matrices(std::size_t record, bool of_light, TextLines& out) const {
    out.push_back(fmt::format("{} {}", of_light ? "light" : "draw", record));
    visit_capture(ColumnPrinter{stage_, record, record, scene_.frame, out, of_light}, mine_, theirs_);
  }

  void vertex(std::size_t i, TextLines& out) const {
    const std::size_t d = draws_.of_vertex(i).value(), k = i - draws_.ranges()[d].first_vertex;
    const Mesh& mesh = scene_.meshes[scene_.draws[d].mesh];
    out.push_back(fmt::format("vertex {} (number {} of draw {}): p_model {}, normal {}", i, k + 1, d,
                              text(mesh.positions.at(k)), text(mesh.normals.at(k))));
    came_in(stage_ == Stage::vertex ? Stage::matrices : Stage::vertex, stage_ == Stage::vertex ? d : i, out);
    beside(i, i, out);
  }

  void polygon(std::uint32_t primitive, TextLines& out) const {
    out.push_back(primitive_text(primitive));
    const glm::uvec3 of = draws_.corners(primitive);
    for (int c = 0; c < 3; ++c) {
      out.push_back(fmt::format("its vertex {}:", of[c]));
      came_in(Stage::vertex, of[c], out), came_in(Stage::light, of[c], out);
    }
    for (const auto& [who, side] : {std::pair("got", &mine_), std::pair("expected", &theirs_)}) {
      const auto polygons = polygons_of(*side, primitive);
      if (polygons.empty()) out.push_back(fmt::format("{} no polygon", who));
      for (const auto vertices : polygons) {
        out.push_back(fmt::format("{} a polygon of {}:", who, vertices.size()));
        for (const ClipVertex<double>& v : vertices)
          out.push_back(
              fmt::format("  {} p_clip {}, color {}", v.cut ? "cut   " : "vertex", text(v.p_clip), text(v.color)));
      }
    }
  }

  // First of the primitive's window triangles that differ, and the polygon that they came from.
  void window(std::uint32_t primitive, TextLines& out) const {
    out.push_back(primitive_text(primitive));
    for (const auto vertices : polygons_of(mine_, primitive)) {
      for (const ClipVertex<double>& v : vertices) out.push_back(fmt::format("came in: p_clip {}", text(v.p_clip)));
    }
    const auto a = triangles_of(mine_.records, static_cast<std::int32_t>(primitive)),
               b = triangles_of(theirs_.records, static_cast<std::int32_t>(primitive));
    if (a.size() != b.size()) out.push_back(fmt::format("{} window triangles, expected {}", a.size(), b.size()));
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      const bool same =
          std::ranges::equal(a[i].v, b[i].v, {}, &WindowVertex<double>::p_win, &WindowVertex<double>::p_win);
      if (same && a[i].front == b[i].front && a.size() > 1) continue;
      return beside(static_cast<std::size_t>(&a[i] - mine_.records.triangles.data()),
                    static_cast<std::size_t>(&b[i] - theirs_.records.triangles.data()), out);
    }
  }

  void triangle(std::uint32_t number, TextLines& out) const {
    const auto& triangles = mine_.records.triangles;
    if (number >= triangles.size()) return;
    const WindowTriangle<double>& t = triangles[number];
    out.push_back(
        fmt::format("triangle {} of {}, {}", number, primitive_text(t.primitive), t.front ? "front" : "back"));
    for (std::size_t k = 0; k < t.corners && k < 3; ++k) {
      out.push_back(fmt::format("its corner {}: p_win {}, 1/w {}, snapped {} (1/256 pixel), color {}", k,
                                text(t.v[k].p_win), text(t.v[k].inv_w), text(t.v[k].snapped), text(t.v[k].color)));
    }
  }

  void fragment(std::uint32_t number, int x, int y, TextLines& out) const {
    triangle(number, out);
    const auto& covered = mine_.records.covered;
    const auto found =
        std::ranges::find_if(covered, [&](const Covered& c) { return c.triangle == number && c.x == x && c.y == y; });
    if (found == covered.end()) return;
    const auto i = static_cast<std::size_t>(found - covered.begin());
    for (const Stage input : kAllStages) {
      if (per(input) == Per::fragment && input != Stage::coverage && inputs_of(stage_).has(input))
        came_in(input, i, out);
    }
    beside(i, i, out);
  }

  // Planes of the last stages, at a pixel.
  void pixel(int x, int y, TextLines& out) const {
    const Planes &a = mine_.planes, &b = theirs_.planes;
    const auto both = [&](const char* what, const auto& mine, const auto& theirs, auto text_of) {
      if (x < mine.width() && y < mine.height() && x < theirs.width() && y < theirs.height())
        out.push_back(fmt::format("{} {}, expected {}", what, text_of(mine(x, y)), text_of(theirs(x, y))));
    };
    const auto plain = [](const auto& v) { return text(v); };
    out.push_back(fmt::format("pixel {},{}", x, y));
    if (stage_ == Stage::coverage) both("fragments:", a.count, b.count, plain);
    if (stage_ == Stage::visibility) {
      both("winner:", a.id, b.id, [&](std::int32_t id) {
        return id == kBackground ? std::string("background") : primitive_text(static_cast<std::uint32_t>(id));
      });
      both("stencil value", a.stencil, b.stencil, plain);
    }
    if (stage_ > Stage::coverage && stage_ < Stage::resolve) arrivals(x, y, out);
    if (stage_ == Stage::attributes || stage_ == Stage::shade) both("shaded", a.shaded, b.shaded, plain);
    if (stage_ >= Stage::merge) both("color", a.color, b.color, plain);
    if (stage_ == Stage::depth || stage_ == Stage::merge)
      both("depth", a.depth, b.depth, [&](double z) { return depth_text(scene_.frame, z); });
    const int factor = scene_.frame.antialias.factor;  // supersampled: the first of a pixel's block
    for (std::size_t pass = 0; pass < mine_.samples.size() && stage_ == Stage::resolve; ++pass) {
      const auto& samples = mine_.samples[pass];
      if (x * factor < samples.width() && y * factor < samples.height())
        out.push_back(fmt::format("came in: pass {} {}", pass, text(samples(x * factor, y * factor))));
    }
  }

 private:
  void came_in(Stage stage, std::size_t record, TextLines& out) const {
    visit_capture(ColumnPrinter{stage, record, std::nullopt, scene_.frame, out}, mine_, theirs_);
  }
  void beside(std::size_t mine, std::size_t theirs, TextLines& out) const {
    visit_capture(ColumnPrinter{stage_, mine, theirs, scene_.frame, out}, mine_, theirs_);
  }
  std::string primitive_text(std::uint32_t primitive) const {
    const std::size_t d = draws_.of_primitive(primitive).value();
    return fmt::format("primitive {} (number {} of draw {})", primitive,
                       primitive - draws_.ranges()[d].first_primitive + 1, d);
  }
  static std::vector<std::span<const ClipVertex<double>>> polygons_of(const Capture& side, std::uint32_t primitive) {
    const auto& [vertices, polygons] = side.records.polygons;
    std::vector<std::span<const ClipVertex<double>>> out;
    for (const ClipPolygon& p : polygons) {
      if (p.primitive == primitive && std::size_t{p.first} + p.count <= vertices.size())
        out.push_back(std::span(vertices).subspan(p.first, p.count));
    }
    return out;
  }
  // Every fragment that reached the pixel, in draw order.
  void arrivals(int x, int y, TextLines& out) const {
    const Records<double>& r = mine_.records;
    for (std::size_t i = 0; i < r.covered.size(); ++i) {
      const Covered& c = r.covered[i];
      if (c.x != x || c.y != y || c.triangle >= r.triangles.size()) continue;
      std::string line = "came in: " + primitive_text(r.triangles[c.triangle].primitive);
      if (i < r.depth.size()) line += ", depth " + depth_text(scene_.frame, r.depth[i]);
      if (i < r.shaded.size()) line += ", shaded " + text(r.shaded[i].color);
      for (const auto& [who, drawn] : {std::pair("", &r.drawn), std::pair("expected ", &theirs_.records.drawn)}) {
        if (i < drawn->size()) line += fmt::format(", {}{}", who, (*drawn)[i].drawn ? "drawn" : "rejected");
      }
      out.push_back(std::move(line));
    }
  }

  const Scene& scene_;
  Stage stage_;
  const Capture &mine_, &theirs_;
  DrawIndex draws_;
};

}  // namespace

std::vector<std::string> worst_record(const Evidence& e, const JudgeId& judge, const Measurement& m) {
  TextLines out;
  if (!m.mismatch.empty()) return {m.mismatch};
  const Place& place = m.worst.place;
  if (m.max_difference > 0)
    out.push_back("worst: " +
                  to_string(m.worst, judges_legality(judge, e.stage) ? "nearest legal" : "expected", m.unit));
  const RecordPrinter printer(e);
  const auto record = static_cast<std::uint32_t>(std::max<std::int64_t>(place.record, 0));
  switch (e.stage) {
    case Stage::matrices: printer.matrices(record, std::string_view(place.field).starts_with("light"), out); break;
    case Stage::vertex:
    case Stage::light: printer.vertex(record, out); break;
    case Stage::clip: printer.polygon(record, out); break;
    case Stage::window: {
      const auto& triangles = e.candidate.records.triangles;
      if (place.of_primitive || record < triangles.size())
        printer.window(place.of_primitive ? record : triangles[record].primitive, out);
      break;
    }
    case Stage::coverage:
      if (place.x >= 0) printer.pixel(place.x, place.y, out);
      if (lacks_fragment_records(e.candidate) || lacks_fragment_records(e.expected))
        break;  // one side has planes alone
      if (const auto worst = worst_triangle(e, place)) printer.triangle(worst->triangle, out);
      break;
    default:
      if (place.record >= 0 && e.stage < Stage::merge && !place.of_primitive)
        printer.fragment(record, place.x, place.y, out);
      if (place.x >= 0 && (e.stage >= Stage::visibility || place.of_primitive)) printer.pixel(place.x, place.y, out);
  }
  return out;
}

}  // namespace plumbline::check
