#include "export/state_json.h"

#include "scene/antialias.h"
#include "scene/names.h"

namespace plumbline {

namespace {

template <int N, class T, glm::qualifier Q>
Json vector(const glm::vec<N, T, Q>& v) {
  Json out = Json::array();
  for (int i = 0; i < N; ++i) out.push_back(v[i]);
  return out;
}

// The value as JSON, or null.
template <class T, class ToJson>
Json optional(const std::optional<T>& value, const ToJson& to_json) {
  return value ? to_json(*value) : Json();
}

Json material_json(const Material& m) {
  return {{"ambient", vector(m.ambient)},
          {"diffuse", vector(m.diffuse)},
          {"specular", vector(m.specular)},
          {"emission", vector(m.emission)},
          {"shininess", m.shininess}};
}

Json stencil_face_json(const StencilFace& f) {
  return {{"func", name_of(f.func)},
          {"reference", f.reference},
          {"mask", f.mask},
          {"fail", name_of(f.fail)},
          {"depth_fail", name_of(f.depth_fail)},
          {"pass", name_of(f.pass)},
          {"write_mask", f.write_mask}};
}

Json blend_term_json(const BlendTerm& t) {
  return {{"source", name_of(t.source)}, {"destination", name_of(t.destination)}, {"equation", name_of(t.equation)}};
}

Json fog_json(const Fog& f) {
  return {{"mode", name_of(f.mode)},
          {"color", vector(f.color)},
          {"density", f.density},
          {"start", f.start},
          {"end", f.end}};
}

Json spot_json(const Spot& spot, const LightSource<double>& in_eye_space) {
  return {{"spot_eye", vector(in_eye_space.spot_eye)}, {"cutoff", spot.cutoff_degrees}, {"exponent", spot.exponent}};
}

}  // namespace

Json frame_json(const Scene& scene) {
  const FrameFormat& f = scene.frame;
  return {{"width", f.width},
          {"height", f.height},
          {"color", name_of(f.color)},
          {"depth", name_of(f.depth)},
          {"stencil", name_of(f.stencil)},
          {"clear_color", vector(f.clear_color)},
          {"clear_depth", f.clear_depth},
          {"clear_stencil", f.clear_stencil},
          {"rows_from_top", rows_from_top(scene.dialect)},
          {"depth_clamp", scene.depth_clamp},
          {"sample", vector(sample_offset(f))}};
}

Json light_model_json(const LightModel& model) {
  return {{"ambient", vector(model.ambient)},
          {"local_viewer", model.local_viewer},
          {"specular", name_of(model.specular)},
          {"sides", name_of(model.sides)},
          {"separate_specular", model.separate_specular}};
}

Json light_json(const Light& light, const LightSource<double>& in_eye_space) {
  return {{"p_eye", vector(in_eye_space.p_eye)},
          {"ambient", vector(light.ambient)},
          {"diffuse", vector(light.diffuse)},
          {"specular", vector(light.specular)},
          {"attenuation", vector(light.attenuation)},
          {"spot", optional(light.spot, [&](const Spot& spot) { return spot_json(spot, in_eye_space); })}};
}

Json texture_json(const Texture& texture) {
  const Sampler& s = texture.sampler;
  Json levels = Json::array();
  for (const TextureLevel& level : texture.levels) levels.push_back({level.width, level.height});
  return {{"name", texture.name},
          {"format", name_of(texture.format)},
          {"texels", name_of(texture.type)},
          {"min", name_of(s.min)},
          {"mag", name_of(s.mag)},
          {"wrap_s", name_of(s.wrap_s)},
          {"wrap_t", name_of(s.wrap_t)},
          {"border", vector(source_components(texture.format, s.border))},
          {"lod_bias", s.lod_bias},
          {"min_lod", s.min_lod},
          {"max_lod", s.max_lod},
          {"base_level", s.base_level},
          {"max_level", s.max_level},
          {"levels", levels}};
}

Json draw_json(const Draw& d) {
  const auto alpha_test = [](const AlphaTest& t) {
    return Json{{"func", name_of(t.func)}, {"reference", t.reference}};
  };
  const auto stencil = [](const Stencil& s) {
    return Json{{"front", stencil_face_json(s.front)}, {"back", stencil_face_json(s.back)}};
  };
  const auto blend = [](const Blend& b) {
    return Json{{"rgb", blend_term_json(b.rgb)}, {"alpha", blend_term_json(b.alpha)}, {"color", vector(b.color)}};
  };
  const auto texture = [](const DrawTexture& t) {
    return Json{{"texture", t.texture}, {"environment", name_of(t.environment)}, {"color", vector(t.color)}};
  };
  const auto scissor = [](const Scissor& s) { return Json{s.x, s.y, s.width, s.height}; };
  return {{"mesh", d.mesh},
          {"material", material_json(d.material)},
          {"back_material", optional(d.back_material, material_json)},
          {"lit", d.lit},
          {"color_material", name_of(d.color_material)},
          {"normals", name_of(d.normals)},
          {"shading", name_of(d.shading)},
          {"cull", name_of(d.cull)},
          {"front_mode", name_of(d.front_mode)},
          {"back_mode", name_of(d.back_mode)},
          {"line_width", d.line_width},
          {"point_size", d.point_size},
          {"depth_func", name_of(d.depth_func)},
          {"depth_range", {d.depth_range.near, d.depth_range.far}},
          {"polygon_offset", {{"factor", d.polygon_offset.factor}, {"units", d.polygon_offset.units}}},
          {"alpha_test", optional(d.alpha_test, alpha_test)},
          {"stencil", optional(d.stencil, stencil)},
          {"fog", optional(d.fog, fog_json)},
          {"scissor", optional(d.scissor, scissor)},
          {"depth_mask", d.merge.depth_mask},
          {"color_mask", vector(d.merge.color_mask)},
          {"blend", optional(d.merge.blend, blend)},
          {"logic_op", optional(d.merge.logic_op, [](LogicOp op) { return Json(name_of(op)); })},
          {"texture", optional(d.texture, texture)}};
}

}  // namespace plumbline
