// Scene files of scenes made in memory: all that random_scene.h sets, with floats that read back to the last bit.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/names.h"

namespace plumbline::test {

namespace text {

template <class E>
std::string name(E value) {
  return fmt::format("\"{}\"", name_of(value));
}

inline std::string number(double v) { return fmt::format("{}", v == 0 ? 0 : v); }

template <int N, class T, glm::qualifier Q>
std::string vector(const glm::vec<N, T, Q>& v) {
  std::vector<std::string> parts;
  for (int i = 0; i < N; ++i) parts.push_back(number(static_cast<double>(v[i])));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}
template <class V>
std::string vectors(const std::vector<V>& values) {
  std::vector<std::string> parts;
  for (const V& v : values) parts.push_back(vector(v));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

inline std::string material(const Material& m) {
  return fmt::format(R"({{"ambient": {}, "diffuse": {}, "specular": {}, "emission": {}, "shininess": {}}})",
                     vector(m.ambient), vector(m.diffuse), vector(m.specular), vector(m.emission), m.shininess);
}

inline std::string stencil_face(const StencilFace& f) {
  return fmt::format(
      R"("func": {}, "reference": {}, "mask": {}, "fail": {}, "depth_fail": {}, "pass": {}, "write_mask": {})",
      name(f.func), f.reference, f.mask, name(f.fail), name(f.depth_fail), name(f.pass), f.write_mask);
}

inline std::string blend_term(const BlendTerm& t) {
  return fmt::format(R"("source": {}, "destination": {}, "equation": {})", name(t.source), name(t.destination),
                     name(t.equation));
}

inline std::string transform(const Transform& t) {
  if (const auto* by = std::get_if<Translate>(&t)) return fmt::format(R"({{"translate": {}}})", vector(by->by));
  if (const auto* by = std::get_if<Scale>(&t)) return fmt::format(R"({{"scale": {}}})", vector(by->by));
  const auto& by = std::get<Rotate>(t);
  return fmt::format(R"({{"rotate": {{"degrees": {}, "axis": {}}}}})", by.degrees, vector(by.axis));
}

/// The mesh within the format's limits: coordinates are clamped to 1e6, triangles that repeat a vertex are left out.
/// A triangle of no area stands in where none is left.
inline std::string mesh(const Mesh& m) {
  std::vector<glm::uvec3> triangles;
  for (const glm::uvec3& t : m.triangles) {
    if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);
  }
  std::vector<glm::vec3> positions = m.positions;
  for (glm::vec3& p : positions) p = glm::clamp(p, -1e6f, 1e6f);
  if (triangles.empty()) {
    triangles.emplace_back(0, 1, 2);
    const glm::vec3 corner = positions.at(m.triangles.at(0).x);
    std::fill_n(positions.begin(), 3, corner);
  }
  std::string out = fmt::format(R"("positions": {}, "indices": {}, "normals": {})", vectors(positions),
                                vectors(triangles), vectors(m.normals));
  if (!m.colors.empty()) out += fmt::format(R"(, "colors": {})", vectors(m.colors));
  return fmt::format(R"({{"triangles": {{{}}}}})", out);
}

inline std::string draw(const Draw& d, const Mesh& of) {
  std::vector<std::string> transforms;
  for (const Transform& t : d.transforms) transforms.push_back(transform(t));
  std::string out = fmt::format(
      R"("mesh": {}, "transforms": [{}], "material": {}, "lit": {}, "color_material": {}, "normals": {}, "shading": {}, )"
      R"("cull": {}, "depth_func": {}, "depth_range": [{}, {}], "polygon_offset": {{"factor": {}, "units": {}}}, )"
      R"("depth_mask": {}, "color_mask": [{}, {}, {}, {}])",
      mesh(of), fmt::join(transforms, ", "), material(d.material), d.lit, name(d.color_material), name(d.normals),
      name(d.shading), name(d.cull), name(d.depth_func), d.depth_range.near, d.depth_range.far, d.polygon_offset.factor,
      d.polygon_offset.units, d.merge.depth_mask, d.merge.color_mask.r, d.merge.color_mask.g, d.merge.color_mask.b,
      d.merge.color_mask.a);
  if (d.back_material) out += fmt::format(R"(, "back_material": {})", material(*d.back_material));
  if (d.merge.blend) {
    out += fmt::format(R"(, "blend": {{{}, "alpha": {{{}}}, "color": {}}})", blend_term(d.merge.blend->rgb),
                       blend_term(d.merge.blend->alpha), vector(d.merge.blend->color));
  }
  if (d.merge.logic_op) out += fmt::format(R"(, "logic_op": {})", name(*d.merge.logic_op));
  if (d.scissor) {
    out += fmt::format(R"(, "scissor": [{}, {}, {}, {}])", d.scissor->x, d.scissor->y, d.scissor->width,
                       d.scissor->height);
  }
  if (d.alpha_test) {
    out += fmt::format(R"(, "alpha_test": {{"func": {}, "reference": {}}})", name(d.alpha_test->func),
                       d.alpha_test->reference);
  }
  if (d.stencil) {
    out += fmt::format(R"(, "stencil": {{{}, "back": {{{}}}}})", stencil_face(d.stencil->front),
                       stencil_face(d.stencil->back));
  }
  return "{" + out + "}";
}

inline std::string light(const Light& l) {
  const bool point = l.kind == Light::Kind::point;
  std::string out =
      fmt::format(R"("{}": {}, "ambient": {}, "diffuse": {}, "specular": {})", point ? "point" : "directional",
                  vector(l.vector), vector(l.ambient), vector(l.diffuse), vector(l.specular));
  if (point) out += fmt::format(R"(, "attenuation": {})", vector(l.attenuation));
  if (l.spot) {
    out += fmt::format(R"(, "spot": {{"direction": {}, "cutoff": {}, "exponent": {}}})", vector(l.spot->direction),
                       l.spot->cutoff_degrees, l.spot->exponent);
  }
  return "{" + out + "}";
}

inline std::string projection(const Projection& p) {
  if (const auto* v = std::get_if<Perspective>(&p)) {
    return fmt::format(R"({{"perspective": {{"fov_y": {}, "near": {}, "far": {}}}}})", v->fov_y_degrees, v->near,
                       v->far);
  }
  if (const auto* v = std::get_if<Orthographic>(&p)) {
    return fmt::format(
        R"({{"orthographic": {{"left": {}, "right": {}, "bottom": {}, "top": {}, "near": {}, "far": {}}}}})", v->left,
        v->right, v->bottom, v->top, v->near, v->far);
  }
  if (const auto* v = std::get_if<ViewPlane>(&p)) return fmt::format(R"({{"x_pi": {{"fov": {}}}}})", v->fov_degrees);
  return fmt::format(R"({{"pinhole": {{"c": {}}}}})", std::get<Pinhole>(p).c);
}

}  // namespace text

inline std::string scene_text(const Scene& s, std::string_view description) {
  std::vector<std::string> lights, draws;
  for (const Light& l : s.lights) lights.push_back(text::light(l));
  for (const Draw& d : s.draws) draws.push_back("    " + text::draw(d, s.meshes[d.mesh]));
  const FrameFormat& f = s.frame;
  const std::string frame = fmt::format(
      R"({{"width": {}, "height": {}, "color": {}, "depth": {}, "clear_color": {}, "clear_depth": {}, "stencil": "{}", )"
      R"("clear_stencil": {}}})",
      f.width, f.height, text::name(f.color), text::name(f.depth), text::vector(f.clear_color), f.clear_depth,
      f.stencil == StencilFormat::none ? "none" : "s8", f.clear_stencil);
  const LightModel& m = s.light_model;
  const std::string model =
      fmt::format(R"({{"local_viewer": {}, "specular": {}, "sides": {}, "separate_specular": {}}})", m.local_viewer,
                  text::name(m.specular), text::name(m.sides), m.separate_specular);
  return fmt::format(
      "{{\n  \"description\": \"{}\",\n  \"dialect\": {},\n  \"frame\": {},\n  \"camera\": {{\"eye\": {}, \"center\": "
      "{}, "
      "\"up\": {}}},\n  \"projection\": {},\n  \"ambient\": {},\n  \"light_model\": {},\n  \"lights\": [{}],\n"
      "  \"draws\": [\n{}\n  ]\n}}\n",
      description, text::name(s.dialect), frame, text::vector(s.camera.eye), text::vector(s.camera.center),
      text::vector(s.camera.up), text::projection(s.projection), text::vector(m.ambient), model,
      fmt::join(lights, ", "), fmt::join(draws, ",\n"));
}

}  // namespace plumbline::test
