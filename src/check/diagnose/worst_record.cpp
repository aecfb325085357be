#include "check/diagnose/worst_record.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/matrix_access.hpp>

#include "check/diagnose/coverage_differences.h"
#include "check/judge/scene_case.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

using TextLines = std::vector<std::string>;

template <class V>
std::string text(const V& v) {
  std::string out = "(";
  for (int c = 0; c < V::length(); ++c) out += fmt::format("{}{:.9g}", c == 0 ? "" : " ", static_cast<double>(v[c]));
  return out + ")";
}
std::string text(double v) { return fmt::format("{:.9g}", v); }

double ulps(double a, double b) {
  const auto f = static_cast<float>(std::abs(b));
  const double ulp = static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - f;
  return a == b ? 0 : (a - b) / ulp;
}
template <int n>
glm::vec<n, double> ulps(const glm::vec<n, double>& a, const glm::vec<n, double>& b) {
  glm::vec<n, double> out;
  for (int c = 0; c < n; ++c) out[c] = ulps(a[c], b[c]);
  return out;
}

template <class V>
std::string rough(const V& v) {
  std::string out = "(";
  for (int c = 0; c < V::length(); ++c) out += fmt::format("{}{:.4g}", c == 0 ? "" : " ", v[c]);
  return out + ")";
}

// got, expected, and how far apart in ULP.
template <class V>
std::string in_ulp(const char* what, const V& got, const V& expected) {
  return fmt::format("{} {}, expected {}: {} ULP apart", what, text(got), text(expected), rough(ulps(got, expected)));
}
// Colours and texels, in 1/255.
std::string in_codes(const char* what, const Vec4<double>& got, const Vec4<double>& expected) {
  return fmt::format("{} {}, expected {}: {}/255 apart", what, text(got), text(expected),
                     rough((got - expected) * 255.0));
}

template <class T>
const T* at(const std::vector<T>& v, std::size_t i) {
  return i < v.size() ? &v[i] : nullptr;
}

// What lines are made of: the two sides, and which draw a number belongs to.
class RecordPrinter {
 public:
  explicit RecordPrinter(const Evidence& e)
      : scene_(e.scene), mine_(e.candidate), theirs_(e.expected), draws_(e.scene) {}

  void matrices(std::size_t d, TextLines& out) const {
    const auto *a = at(mine_.records.matrices, d), *b = at(theirs_.records.matrices, d);
    if (a == nullptr || b == nullptr) return;
    out.push_back(fmt::format("draw {}", d));
    for (int row = 0; row < 4; ++row) {
      if (glm::row(a->model_view, row) != glm::row(b->model_view, row))
        out.push_back(in_ulp("model-view row", glm::row(a->model_view, row), glm::row(b->model_view, row)));
    }
    for (int row = 0; row < 4; ++row) {
      if (glm::row(a->projection, row) != glm::row(b->projection, row))
        out.push_back(in_ulp("projection row", glm::row(a->projection, row), glm::row(b->projection, row)));
    }
    for (int row = 0; row < 3; ++row) {
      if (glm::row(a->normal, row) != glm::row(b->normal, row))
        out.push_back(in_ulp("normal matrix row", glm::row(a->normal, row), glm::row(b->normal, row)));
    }
    out.push_back(in_ulp("window scale", a->win_scale, b->win_scale));
    out.push_back(in_ulp("window translation", a->win_translate, b->win_translate));
  }

  void light_source(std::size_t i, TextLines& out) const {
    const auto *a = at(mine_.records.lights, i), *b = at(theirs_.records.lights, i);
    if (a == nullptr || b == nullptr) return;
    out.push_back(in_ulp(fmt::format("light {} p_eye", i).c_str(), a->p_eye, b->p_eye));
    if (b->spot_eye != Vec3<double>(0))
      out.push_back(in_ulp(fmt::format("light {} spot_eye", i).c_str(), a->spot_eye, b->spot_eye));
  }

  void vertex(std::size_t i, TextLines& out) const {
    const auto *a = at(mine_.records.vertices, i), *b = at(theirs_.records.vertices, i);
    if (a == nullptr || b == nullptr) return;
    const std::size_t d = draws_.of_vertex(i).value();
    came_in(i, out);
    if (const auto* m = at(mine_.records.matrices, d)) {
      for (int row = 0; row < 4; ++row) {
        out.push_back(fmt::format("row {}: model-view {}, projection {}", row, text(glm::row(m->model_view, row)),
                                  text(glm::row(m->projection, row))));
      }
    }
    out.push_back(in_ulp("p_eye", a->p_eye, b->p_eye));
    out.push_back(in_ulp("p_clip", a->p_clip, b->p_clip));
    out.push_back(in_ulp("n_eye", a->n_eye, b->n_eye));
  }

  void light(std::size_t i, TextLines& out) const {
    const auto *a = at(mine_.records.lit, i), *b = at(theirs_.records.lit, i);
    if (a == nullptr || b == nullptr) return;
    came_in(i, out);
    if (const auto* v = at(mine_.records.vertices, i))
      out.push_back(fmt::format("p_eye {}, n_eye {}", text(v->p_eye), text(v->n_eye)));
    out.push_back(in_codes("color", a->color, b->color));
    for (const Varying v : kAllVaryings) {
      const auto *x = at(mine_.records.varyings[v].vertices, i), *y = at(theirs_.records.varyings[v].vertices, i);
      if (x != nullptr && y != nullptr) out.push_back(in_ulp(name_of(v).data(), *x, *y));
    }
  }

  void polygon(std::uint32_t primitive, TextLines& out) const {
    out.push_back(primitive_text(primitive));
    corners(primitive, out);
    for (const auto& [who, side] : {std::pair("got", &mine_), std::pair("expected", &theirs_)}) {
      const ClipPolygons<double>& all = side->records.polygons;
      const auto p = std::ranges::find(all.polygons, primitive, &ClipPolygon::primitive);
      out.push_back(p == all.polygons.end() ? fmt::format("{} no polygon", who)
                                            : fmt::format("{} a polygon of {}:", who, p->count));
      for (std::uint32_t i = 0; p != all.polygons.end() && i < p->count; ++i) {
        const auto* v = at(all.vertices, p->first + i);
        if (v != nullptr)
          out.push_back(
              fmt::format("  {} p_clip {}, color {}", v->cut ? "cut   " : "vertex", text(v->p_clip), text(v->color)));
      }
    }
  }

  // Of the window stage: the two sides' triangles, and what p_clip they came from.
  void window(std::uint32_t primitive, TextLines& out) const {
    polygon_in(primitive, out);
    const auto a = triangles_of(mine_, primitive), b = triangles_of(theirs_, primitive);
    if (a.size() != b.size()) out.push_back(fmt::format("{} window triangles, expected {}", a.size(), b.size()));
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      if (!std::ranges::equal(a[i]->v, b[i]->v, [](const auto& v, const auto& w) { return v.p_win == w.p_win; }) ||
          a[i]->front != b[i]->front || a.size() == 1) {
        pair_of(*a[i], *b[i], out);
        break;
      }
    }
  }

  void fragment(std::uint32_t triangle, int x, int y, Stage stage, TextLines& out) const {
    const Records<double>&a = mine_.records, &b = theirs_.records;
    const auto* t = at(a.triangles, triangle);
    if (t == nullptr) return;
    triangle_in(triangle, *t, out);
    const auto found = std::ranges::find_if(
        a.covered, [&](const Covered& c) { return c.triangle == triangle && c.x == x && c.y == y; });
    if (found == a.covered.end()) return;
    const auto i = static_cast<std::size_t>(found - a.covered.begin());
    if (const auto* p = at(a.attributes, i); p != nullptr && stage > Stage::attributes)
      out.push_back(fmt::format("came in: color {}", text(p->color)));
    if (const auto* p = at(a.depth, i); p != nullptr && stage == Stage::visibility)
      out.push_back(fmt::format("came in: depth {}", depth_text(*p)));
    for (const Varying v : kAllVaryings) {
      const auto *p = at(a.varyings[v].fragments, i), *q = at(b.varyings[v].fragments, i);
      if (p == nullptr) continue;
      if (stage > Stage::attributes) out.push_back(fmt::format("came in: {} {}", name_of(v), text(*p)));
      if (stage == Stage::attributes && q != nullptr) out.push_back(in_ulp(name_of(v).data(), *p, *q));
    }
    if (const auto* p = at(a.texels, i); p != nullptr && stage == Stage::shade)
      out.push_back(fmt::format("came in: texel {}, lambda {}", text(p->color), text(p->lod)));
    fragment_out(i, stage, out);
  }

  // Planes of the last stages, at a pixel.
  void pixel(int x, int y, Stage stage, TextLines& out) const {
    const Planes &a = mine_.planes, &b = theirs_.planes;
    const auto inside = [&](const auto& plane) { return x < plane.width() && y < plane.height(); };
    out.push_back(fmt::format("pixel {},{}", x, y));
    if (inside(a.count) && inside(b.count) && stage == Stage::coverage)
      out.push_back(fmt::format("{} fragments, expected {}", a.count(x, y), b.count(x, y)));
    if (inside(a.id) && inside(b.id) && stage == Stage::visibility)
      out.push_back(fmt::format("winner: {}, expected {}", winner(a.id(x, y)), winner(b.id(x, y))));
    if (inside(a.stencil) && inside(b.stencil) && stage == Stage::visibility)
      out.push_back(fmt::format("stencil value {}, expected {}", a.stencil(x, y), b.stencil(x, y)));
    if (stage == Stage::visibility || stage == Stage::merge) arrivals(x, y, out);
    if (inside(a.color) && inside(b.color) && stage >= Stage::merge)
      out.push_back(in_codes("color", Vec4<double>(a.color(x, y)), Vec4<double>(b.color(x, y))));
    if (inside(a.depth) && inside(b.depth) && stage == Stage::merge)
      out.push_back(fmt::format("depth {}, expected {}", depth_text(a.depth(x, y)), depth_text(b.depth(x, y))));
    for (std::size_t pass = 0; pass < mine_.samples.size() && stage == Stage::resolve; ++pass) {
      if (inside(mine_.samples[pass]))  // supersampled: the first of a pixel's block
        out.push_back(fmt::format(
            "came in: pass {} {}", pass,
            text(mine_.samples[pass](x * scene_.frame.antialias.factor, y * scene_.frame.antialias.factor))));
    }
  }

  const Records<double>& records() const { return mine_.records; }

 private:
  std::string primitive_text(std::uint32_t primitive) const {
    const std::size_t d = draws_.of_primitive(primitive).value();
    return fmt::format("primitive {} (the {}. of draw {})", primitive,
                       primitive - draws_.ranges()[d].first_primitive + 1, d);
  }
  std::string winner(std::int32_t id) const {
    return id == kBackground ? "background" : primitive_text(static_cast<std::uint32_t>(id));
  }
  std::string depth_text(double z) const {
    const double scale = depth_scale(scene_.frame.depth);
    return scale == 0 ? text(z) : fmt::format("{:.9g} (code {:.9g})", z, z * scale);
  }

  void came_in(std::size_t i, TextLines& out) const {
    const std::size_t d = draws_.of_vertex(i).value(), k = i - draws_.ranges()[d].first_vertex;
    const Mesh& mesh = scene_.meshes[scene_.draws[d].mesh];
    out.push_back(fmt::format("vertex {} (the {}. of draw {}): p_model {}, normal {}", i, k + 1, d,
                              text(mesh.positions.at(k)), text(mesh.normals.at(k))));
  }
  // The primitive's vertices, as they came into the clipper.
  void corners(std::uint32_t primitive, TextLines& out) const {
    const glm::uvec3 of = draws_.corners(primitive);
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = of[c];
      const auto* v = at(mine_.records.vertices, i);
      const auto* l = at(mine_.records.lit, i);
      if (v != nullptr && l != nullptr)
        out.push_back(fmt::format("its vertex {}: p_clip {}, color {}", i, text(v->p_clip), text(l->color)));
    }
  }
  void polygon_in(std::uint32_t primitive, TextLines& out) const {
    out.push_back(primitive_text(primitive));
    const ClipPolygons<double>& all = mine_.records.polygons;
    const auto p = std::ranges::find(all.polygons, primitive, &ClipPolygon::primitive);
    for (std::uint32_t i = 0; p != all.polygons.end() && i < p->count; ++i) {
      if (const auto* v = at(all.vertices, p->first + i))
        out.push_back(fmt::format("came in: p_clip {}", text(v->p_clip)));
    }
  }
  static std::vector<const WindowTriangle<double>*> triangles_of(const Capture& c, std::uint32_t primitive) {
    std::vector<const WindowTriangle<double>*> out;
    for (const auto& t : c.records.triangles) {
      if (t.primitive == primitive) out.push_back(&t);
    }
    return out;
  }
  static void pair_of(const WindowTriangle<double>& a, const WindowTriangle<double>& b, TextLines& out) {
    for (std::size_t k = 0; k < 3; ++k) {
      const WindowVertex<double>&v = a.v[k], &w = b.v[k];
      out.push_back(fmt::format("corner {}:", k));
      out.push_back("  " + in_ulp("p_win", v.p_win, w.p_win));
      out.push_back(fmt::format("  snapped {}, expected {}: {}/256 pixel apart", text(v.snapped), text(w.snapped),
                                rough(glm::dvec2(v.snapped - w.snapped))));
      out.push_back(fmt::format("  1/w {}, expected {}; color {}, expected {}", text(v.inv_w), text(w.inv_w),
                                text(v.color), text(w.color)));
    }
    if (a.front != b.front)
      out.push_back(
          fmt::format("faces the {}, expected the {}", a.front ? "front" : "back", b.front ? "front" : "back"));
  }
  void triangle_in(std::uint32_t number, const WindowTriangle<double>& t, TextLines& out) const {
    out.push_back(
        fmt::format("triangle {} of {}, {}", number, primitive_text(t.primitive), t.front ? "front" : "back"));
    for (std::size_t k = 0; k < t.corners && k < 3; ++k) {
      out.push_back(fmt::format("its corner {}: p_win {}, 1/w {}, snapped {} (1/256 pixel), color {}", k,
                                text(t.v[k].p_win), text(t.v[k].inv_w), text(t.v[k].snapped), text(t.v[k].color)));
    }
  }
  void fragment_out(std::size_t i, Stage stage, TextLines& out) const {
    const Records<double>&a = mine_.records, &b = theirs_.records;
    const auto both = [&](const auto& mine, const auto& theirs, auto line) {
      if (i < mine.size() && i < theirs.size()) out.push_back(line(mine[i], theirs[i]));
    };
    switch (stage) {
      case Stage::depth:
        return both(a.depth, b.depth, [&](double z, double w) {
          const double scale = depth_scale(scene_.frame.depth);
          const double steps = scale == 0 ? ulps(z, w) : (z - w) * scale;
          return fmt::format("depth {}, expected {}: {:.4g} {} apart", depth_text(z), depth_text(w), steps,
                             scale == 0 ? "ULP" : "steps");
        });
      case Stage::attributes:
        return both(a.attributes, b.attributes, [](const auto& p, const auto& q) {
          return fmt::format("{}, relative {}", in_codes("color", p.color, q.color),
                             rough((p.color - q.color) / glm::max(glm::abs(q.color), Vec4<double>(1e-300))));
        });
      case Stage::texture:
        return both(a.texels, b.texels, [](const auto& p, const auto& q) {
          return fmt::format("{}; lambda {}, expected {}", in_codes("texel", p.color, q.color), text(p.lod),
                             text(q.lod));
        });
      case Stage::shade:
        return both(a.shaded, b.shaded,
                    [](const auto& p, const auto& q) { return in_codes("shaded", p.color, q.color); });
      case Stage::visibility:
        return both(a.drawn, b.drawn, [](const plumbline::Drawn& p, const plumbline::Drawn& q) {
          const auto word = [](const plumbline::Drawn& d) { return d.drawn ? "drawn" : "rejected"; };
          return fmt::format("{}, expected {}", word(p), word(q));
        });
      default: return;
    }
  }
  // Every fragment that reached the pixel, in draw order.
  void arrivals(int x, int y, TextLines& out) const {
    const Records<double>& r = mine_.records;
    for (std::size_t i = 0; i < r.covered.size(); ++i) {
      const Covered& c = r.covered[i];
      if (c.x != x || c.y != y || c.triangle >= r.triangles.size()) continue;
      std::string line = "came in: " + primitive_text(r.triangles[c.triangle].primitive);
      if (const auto* z = at(r.depth, i)) line += ", depth " + depth_text(*z);
      if (const auto* s = at(r.shaded, i)) line += ", shaded " + text(s->color);
      if (const auto* d = at(r.drawn, i)) line += d->drawn ? ", drawn" : ", rejected";
      if (const auto* d = at(theirs_.records.drawn, i)) line += d->drawn ? ", expected drawn" : ", expected rejected";
      out.push_back(std::move(line));
    }
  }

  const Scene& scene_;
  const Capture &mine_, &theirs_;
  DrawIndex draws_;
};

}  // namespace

std::vector<std::string> worst_record(const Evidence& e, const Measurement& m) {
  TextLines out;
  if (!m.mismatch.empty()) return {m.mismatch};
  const Place& place = m.worst.place;
  if (m.max_difference > 0)
    out.push_back(fmt::format("worst: {}: {:.9g}, expected {:.9g}, {:.4g} {} apart, tolerance {:.4g}", to_string(place),
                              m.worst.candidate, m.worst.reference, m.worst.difference, m.unit, m.worst.tolerance));
  const RecordPrinter worded(e);
  const auto record = static_cast<std::size_t>(std::max<std::int64_t>(place.record, 0));
  switch (e.stage) {
    case Stage::matrices:
      if (std::string_view(place.field).starts_with("light")) {
        worded.light_source(record, out);
      } else {
        worded.matrices(record, out);
      }
      break;
    case Stage::vertex: worded.vertex(record, out); break;
    case Stage::light: worded.light(record, out); break;
    case Stage::clip: worded.polygon(static_cast<std::uint32_t>(record), out); break;
    case Stage::window: {
      const bool of_primitive = std::string_view(place.field) == "triangle of primitive";
      const auto* t = at(worded.records().triangles, record);
      if (of_primitive || t != nullptr)
        worded.window(of_primitive ? static_cast<std::uint32_t>(record) : t->primitive, out);
      break;
    }
    case Stage::coverage:
      if (place.x >= 0) worded.pixel(place.x, place.y, e.stage, out);
      if (over_budget(e.candidate) || over_budget(e.expected)) break;  // one side has planes alone
      if (const auto worst = worst_triangle(e)) worded.fragment(worst->triangle, -1, -1, e.stage, out);
      break;
    default:
      if (place.record >= 0 && e.stage < Stage::merge)
        worded.fragment(static_cast<std::uint32_t>(record), place.x, place.y, e.stage, out);
      if (place.x >= 0 && e.stage >= Stage::visibility) worded.pixel(place.x, place.y, e.stage, out);
  }
  return out;
}

}  // namespace plumbline::check
