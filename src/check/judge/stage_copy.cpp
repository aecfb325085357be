#include "check/judge/stage_copy.h"

#include <array>
#include <cmath>

#include "check/bounds/units.h"

namespace plumbline::check {

namespace {

// Calls visit(array of each capture...) for every array of records and every plane that the stage hands on.
template <class Visit, class... Captures>
void visit_stage(Stage stage, Visit visit, Captures&... c) {
  using Columns = VaryingColumns<double>;
  const auto varyings = [&](auto column) {
    for (const Varying v : kAllVaryings) visit(c.records.varyings[v].*column...);
  };
  switch (stage) {
    case Stage::matrices: return visit(c.records.matrices...), visit(c.records.lights...);
    case Stage::vertex: return visit(c.records.vertices...);
    case Stage::light: return visit(c.records.lit...), varyings(&Columns::vertices);
    case Stage::clip:
      return visit(c.records.polygons.vertices...), visit(c.records.polygons.polygons...), varyings(&Columns::clipped);
    case Stage::window: return visit(c.records.triangles...), varyings(&Columns::triangles);
    case Stage::coverage: return visit(c.records.covered...), visit(c.planes.count...), visit(c.planes.id_sum...);
    case Stage::depth: return visit(c.records.depth...);
    case Stage::attributes: return visit(c.records.attributes...), varyings(&Columns::fragments);
    case Stage::texture: return visit(c.records.texels...), visit(c.legal.texels...);
    case Stage::shade: return visit(c.records.shaded...);
    case Stage::visibility: return visit(c.records.drawn...), visit(c.planes.id...), visit(c.planes.stencil...);
    case Stage::merge: return visit(c.planes.color...), visit(c.planes.depth...);
    case Stage::resolve: return visit(c.planes.color...);
  }
}

// A record's real numbers are rounded to float; integers, and answers that are no records, stay.
void round_record(ClipPolygon&) {}
void round_record(Covered&) {}
void round_record(Drawn&) {}
void round_record(TexelRange&) {}
void round_record(double& value) { value = to_float(value); }
void round_record(Vec3<double>& v) { v = {to_float(v.x), to_float(v.y), to_float(v.z)}; }
void round_record(Vec4<double>& v) { v = {to_float(v.x), to_float(v.y), to_float(v.z), to_float(v.w)}; }
template <class T, std::size_t n>
void round_record(std::array<T, n>& items) {
  for (T& item : items) round_record(item);
}
// Entries below 1e-12 become 0, as stages.h has it.
template <glm::length_t n>
void round_record(glm::mat<n, n, double>& m) {
  for (glm::length_t column = 0; column < n; ++column) {
    for (glm::length_t row = 0; row < n; ++row) {
      double& entry = m[column][row];
      entry = std::abs(entry) < 1e-12 ? 0 : to_float(entry);
    }
  }
}
void round_record(Matrices<double>& m) {
  round_record(m.model_view), round_record(m.projection), round_record(m.normal);
  round_record(m.win_scale), round_record(m.win_translate);
}
void round_record(LightSource<double>& l) { round_record(l.p_eye), round_record(l.spot_eye); }
void round_record(Vertex<double>& v) { round_record(v.p_eye), round_record(v.p_clip), round_record(v.n_eye); }
void round_record(Lit<double>& l) { round_record(l.color); }
void round_record(ClipVertex<double>& v) { round_record(v.p_clip), round_record(v.color); }
void round_record(WindowVertex<double>& v) {
  round_record(v.p_win), round_record(v.color);
  round_record(v.inv_w);
}
void round_record(WindowTriangle<double>& t) {
  for (WindowVertex<double>& v : t.v) round_record(v);
}
void round_record(Attributes<double>& a) { round_record(a.color); }
void round_record(Texel<double>& t) {
  round_record(t.color);
  round_record(t.lod);
}
void round_record(Shaded<double>& s) { round_record(s.color); }

double to_code(double value, double scale) {
  return scale == 0 ? to_float(value) : std::nearbyint(value * scale) / scale;
}

}  // namespace

void copy_stage(Stage stage, const Capture& from, Capture& to) {
  visit_stage(
      stage, [](const auto& source, auto& target) { target = source; }, from, to);
}

void round_to_formats(const Scene& scene, Stage stage, Capture& capture) {
  if (stage == Stage::depth) {
    for (double& z : capture.records.depth) z = to_code(z, depth_scale(scene.frame.depth));
  } else if (stage >= Stage::merge) {
    for (glm::vec4& color : capture.planes.color.values()) {
      for (int c = 0; c < 4; ++c) color[c] = static_cast<float>(to_code(color[c], color_scale(scene.frame.color)));
    }
  } else {
    const auto round_all = [](auto& items) {
      if constexpr (requires { items.begin(); }) {
        for (auto& item : items) round_record(item);
      }
    };
    visit_stage(stage, round_all, capture);
  }
}

}  // namespace plumbline::check
