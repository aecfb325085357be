#include "check/judge/stage_copy.h"

#include <algorithm>
#include <cmath>

namespace plumbline::check {

namespace {

// Volatile: GCC 12 takes a vector's way to float and back for nothing, and leaves it out (-O2, two lanes at a time).
double to_float(double value) {
  const volatile auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}
Vec3<double> to_float(const Vec3<double>& v) { return {to_float(v.x), to_float(v.y), to_float(v.z)}; }
Vec4<double> to_float(const Vec4<double>& v) { return {to_float(v.x), to_float(v.y), to_float(v.z), to_float(v.w)}; }

// Entries below 1e-12 become 0, as stages.h has it.
template <class Matrix>
void round_matrix(Matrix& m) {
  for (int column = 0; column < Matrix::length(); ++column) {
    for (int row = 0; row < Matrix::length(); ++row) {
      double& entry = m[column][row];
      entry = std::abs(entry) < 1e-12 ? 0 : to_float(entry);
    }
  }
}

double to_code(double value, double scale) {
  return scale == 0 ? to_float(value) : std::nearbyint(value * scale) / scale;
}

}  // namespace

void copy_stage(Stage stage, const Capture& from, Capture& to) {
  const Records<double>& r = from.records;
  Records<double>& out = to.records;
  switch (stage) {
    case Stage::matrices:
      out.matrices = r.matrices;
      out.lights = r.lights;
      return;
    case Stage::vertex: out.vertices = r.vertices; return;
    case Stage::light:
      out.lit = r.lit;
      for (const Varying v : kAllVaryings) out.varyings[v].vertices = r.varyings[v].vertices;
      return;
    case Stage::clip:
      out.polygons = r.polygons;
      for (const Varying v : kAllVaryings) out.varyings[v].clipped = r.varyings[v].clipped;
      return;
    case Stage::window:
      out.triangles = r.triangles;
      for (const Varying v : kAllVaryings) out.varyings[v].triangles = r.varyings[v].triangles;
      return;
    case Stage::coverage:
      out.covered = r.covered;
      to.planes.count = from.planes.count;
      to.planes.id_sum = from.planes.id_sum;
      return;
    case Stage::depth: out.depth = r.depth; return;
    case Stage::attributes:
      out.attributes = r.attributes;
      for (const Varying v : kAllVaryings) out.varyings[v].fragments = r.varyings[v].fragments;
      return;
    case Stage::texture:
      out.texels = r.texels;
      to.legal.texels = from.legal.texels;
      return;
    case Stage::shade: out.shaded = r.shaded; return;
    case Stage::visibility:
      out.drawn = r.drawn;
      to.planes.id = from.planes.id;
      to.planes.stencil = from.planes.stencil;
      return;
    case Stage::merge:
      to.planes.color = from.planes.color;
      to.planes.depth = from.planes.depth;
      return;
    case Stage::resolve: to.planes.color = from.planes.color; return;
  }
}

void round_to_formats(const Scene& scene, Stage stage, Capture& capture) {
  Records<double>& r = capture.records;
  const auto fours = [](auto& values) {
    for (Vec4<double>& v : values) v = to_float(v);
  };
  switch (stage) {
    case Stage::matrices:
      for (Matrices<double>& m : r.matrices) {
        round_matrix(m.model_view);
        round_matrix(m.projection);
        round_matrix(m.normal);
        m.win_scale = to_float(m.win_scale);
        m.win_translate = to_float(m.win_translate);
      }
      for (LightSource<double>& l : r.lights) l = {to_float(l.p_eye), to_float(l.spot_eye)};
      return;
    case Stage::vertex:
      for (Vertex<double>& v : r.vertices) v = {to_float(v.p_eye), to_float(v.p_clip), to_float(v.n_eye)};
      return;
    case Stage::light:
      for (Lit<double>& l : r.lit) l.color = to_float(l.color);
      for (const Varying v : kAllVaryings) fours(r.varyings[v].vertices);
      return;
    case Stage::clip:
      for (ClipVertex<double>& v : r.polygons.vertices) v = {to_float(v.p_clip), to_float(v.color), v.cut};
      for (const Varying v : kAllVaryings) fours(r.varyings[v].clipped);
      return;
    case Stage::window:
      for (WindowTriangle<double>& t : r.triangles) {
        for (WindowVertex<double>& v : t.v) v = {to_float(v.p_win), to_float(v.inv_w), v.snapped, to_float(v.color)};
      }
      for (const Varying v : kAllVaryings) {
        for (auto& corners : r.varyings[v].triangles) fours(corners);
      }
      return;
    case Stage::depth:
      for (double& z : r.depth) z = to_code(z, depth_scale(scene.frame.depth));
      return;
    case Stage::attributes:
      for (Attributes<double>& a : r.attributes) a.color = to_float(a.color);
      for (const Varying v : kAllVaryings) fours(r.varyings[v].fragments);
      return;
    case Stage::texture:
      for (Texel<double>& t : r.texels) t = {to_float(t.color), to_float(t.lod)};
      return;
    case Stage::shade:
      for (Shaded<double>& s : r.shaded) s.color = to_float(s.color);
      return;
    case Stage::merge:
    case Stage::resolve:
      for (glm::vec4& color : capture.planes.color.values()) {
        for (int c = 0; c < 4; ++c) color[c] = static_cast<float>(to_code(color[c], color_scale(scene.frame.color)));
      }
      return;
    case Stage::coverage:
    case Stage::visibility: return;  // integers
  }
}

}  // namespace plumbline::check
