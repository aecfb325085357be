#include "tests/export/drawn_from_export.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/geometry.h"
#include "pipeline/render.h"
#include "scene/antialias.h"
#include "scene/names.h"

namespace plumbline::test {

namespace {

using nlohmann::json;

template <class T>
std::vector<T> array(const std::filesystem::path& folder, const std::string& name) {
  std::ifstream in(folder / (name + ".bin"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::vector<T> out(bytes.size() / sizeof(T));
  std::copy_n(bytes.data(), out.size() * sizeof(T), reinterpret_cast<char*>(out.data()));
  return out;
}

template <class E>
E value(const json& name) {
  const auto found = std::ranges::find(kNamesOf<E>, name.get<std::string>());
  if (found == kNamesOf<E>.end()) throw std::runtime_error("no such name: " + name.dump());
  return static_cast<E>(found - kNamesOf<E>.begin());
}

template <class V>
V vector(const json& numbers) {
  V out;
  for (int i = 0; i < V::length(); ++i) out[i] = numbers.at(static_cast<std::size_t>(i)).get<typename V::value_type>();
  return out;
}

FrameFormat frame_of(const json& j) {
  FrameFormat f;
  f.width = j["width"];
  f.height = j["height"];
  f.color = value<ColorFormat>(j["color"]);
  f.depth = value<DepthFormat>(j["depth"]);
  f.stencil = value<StencilFormat>(j["stencil"]);
  f.clear_color = vector<glm::vec4>(j["clear_color"]);
  f.clear_depth = j["clear_depth"];
  f.clear_stencil = j["clear_stencil"];
  const auto sample = std::ranges::find(kSamples, vector<glm::ivec2>(j["sample"]));
  if (sample != kSamples.end()) f.pass.sample = static_cast<int>(sample - kSamples.begin());
  return f;
}

Light light_of(const json& j) {
  Light l;
  l.kind = j["p_eye"][3] == 1 ? Light::Kind::point : Light::Kind::directional;
  l.ambient = vector<glm::vec3>(j["ambient"]);
  l.diffuse = vector<glm::vec3>(j["diffuse"]);
  l.specular = vector<glm::vec3>(j["specular"]);
  l.attenuation = vector<glm::vec3>(j["attenuation"]);
  if (!j["spot"].is_null()) {
    l.spot.emplace();
    l.spot->cutoff_degrees = j["spot"]["cutoff"];
    l.spot->exponent = j["spot"]["exponent"];
  }
  return l;
}

LightSource<float> source_of(const json& j) {
  const json& spot = j["spot"];
  return {vector<glm::vec4>(j["p_eye"]), spot.is_null() ? glm::vec3(0) : vector<glm::vec3>(spot["spot_eye"])};
}

Texture texture_of(const json& j, const std::filesystem::path& folder, std::size_t number) {
  Texture t;
  t.format = value<TextureFormat>(j["format"]);
  t.type = value<TexelType>(j["texels"]);
  t.sampler = {value<MinFilter>(j["min"]),
               value<MagFilter>(j["mag"]),
               value<Wrap>(j["wrap_s"]),
               value<Wrap>(j["wrap_t"]),
               vector<glm::vec4>(j["border"]),
               j["lod_bias"],
               j["min_lod"],
               j["max_lod"],
               j["base_level"],
               j["max_level"]};
  for (std::size_t level = 0; level < j["levels"].size(); ++level) {
    t.levels.push_back({j["levels"][level][0], j["levels"][level][1],
                        array<glm::vec4>(folder, fmt::format("textures.{}.{}", number, level))});
  }
  return t;
}

Material material_of(const json& j) {
  return {vector<glm::vec4>(j["ambient"]), vector<glm::vec4>(j["diffuse"]), vector<glm::vec4>(j["specular"]),
          vector<glm::vec4>(j["emission"]), j["shininess"]};
}

StencilFace face_of(const json& j) {
  return {value<CompareFunc>(j["func"]),
          j["reference"],
          j["mask"],
          value<StencilOp>(j["fail"]),
          value<StencilOp>(j["depth_fail"]),
          value<StencilOp>(j["pass"]),
          j["write_mask"]};
}

BlendTerm term_of(const json& j) {
  return {value<BlendFactor>(j["source"]), value<BlendFactor>(j["destination"]), value<BlendEquation>(j["equation"])};
}

Draw draw_of(const json& j) {
  Draw d;
  const auto has = [&](const char* key) { return !j.at(key).is_null(); };
  d.mesh = j["mesh"];
  d.material = material_of(j["material"]);
  if (has("back_material")) d.back_material = material_of(j["back_material"]);
  d.lit = j["lit"];
  d.color_material = value<ColorMaterial>(j["color_material"]);
  d.normals = value<Normals>(j["normals"]);
  d.shading = value<Shading>(j["shading"]);
  d.cull = value<Cull>(j["cull"]);
  d.front_mode = value<PolygonMode>(j["front_mode"]);
  d.back_mode = value<PolygonMode>(j["back_mode"]);
  d.line_width = j["line_width"];
  d.point_size = j["point_size"];
  d.depth_func = value<DepthFunc>(j["depth_func"]);
  d.depth_range = {j["depth_range"][0], j["depth_range"][1]};
  d.polygon_offset = {j["polygon_offset"]["factor"], j["polygon_offset"]["units"]};
  if (has("alpha_test")) d.alpha_test = {value<CompareFunc>(j["alpha_test"]["func"]), j["alpha_test"]["reference"]};
  if (has("stencil")) d.stencil = {face_of(j["stencil"]["front"]), face_of(j["stencil"]["back"])};
  if (has("fog")) {
    const json& fog = j["fog"];
    d.fog = {value<Fog::Mode>(fog["mode"]), vector<glm::vec3>(fog["color"]), fog["density"], fog["start"], fog["end"]};
  }
  if (has("scissor")) d.scissor = {j["scissor"][0], j["scissor"][1], j["scissor"][2], j["scissor"][3]};
  d.merge.depth_mask = j["depth_mask"];
  d.merge.color_mask = vector<glm::bvec4>(j["color_mask"]);
  if (has("blend")) {
    const json& blend = j["blend"];
    d.merge.blend = {term_of(blend["rgb"]), term_of(blend["alpha"]), vector<glm::vec4>(blend["color"])};
  }
  if (has("logic_op")) d.merge.logic_op = value<LogicOp>(j["logic_op"]);
  if (has("texture")) {
    const json& texture = j["texture"];
    d.texture = {texture["texture"], value<TextureEnvironment>(texture["environment"]),
                 vector<glm::vec4>(texture["color"])};
  }
  return d;
}

Mesh mesh_of(const std::filesystem::path& folder, std::size_t number) {
  const auto name = [&](const char* what) { return fmt::format("meshes.{}.{}", number, what); };
  Mesh mesh;
  mesh.positions = array<glm::vec3>(folder, name("positions"));
  mesh.normals = array<glm::vec3>(folder, name("normals"));
  mesh.colors = array<glm::vec4>(folder, name("colors"));
  mesh.texcoords = array<glm::vec2>(folder, name("texcoords"));
  mesh.triangles = array<glm::uvec3>(folder, name("indices"));
  return mesh;
}

}  // namespace

pipeline::Frame drawn_from_export(const std::filesystem::path& folder) {
  std::ifstream in(folder / "manifest.json");
  const json manifest = json::parse(in);
  Scene scene;
  scene.frame = frame_of(manifest["frame"]);
  scene.depth_clamp = manifest["frame"]["depth_clamp"];
  const json& model = manifest["light_model"];
  scene.light_model = {vector<glm::vec3>(model["ambient"]), model["local_viewer"],
                       value<LightModel::Specular>(model["specular"]), value<LightModel::Sides>(model["sides"]),
                       model["separate_specular"]};
  std::vector<LightSource<float>> lights;
  for (const json& light : manifest["lights"]) {
    scene.lights.push_back(light_of(light));
    lights.push_back(source_of(light));
  }
  for (const json& t : manifest["textures"]) scene.textures.push_back(texture_of(t, folder, scene.textures.size()));
  for (const json& draw : manifest["draws"]) scene.draws.push_back(draw_of(draw));
  std::uint32_t meshes = 0;
  for (const Draw& draw : scene.draws) meshes = std::max(meshes, draw.mesh + 1);
  for (std::uint32_t i = 0; i < meshes; ++i) scene.meshes.push_back(mesh_of(folder, i));
  const auto model_view = array<glm::mat4>(folder, "matrices.model_view");
  const auto projection = array<glm::mat4>(folder, "matrices.projection");
  const auto normal = array<glm::mat3>(folder, "matrices.normal");
  const auto scale = array<glm::vec3>(folder, "matrices.win_scale");
  const auto translate = array<glm::vec3>(folder, "matrices.win_translate");

  pipeline::FrameBuffer frame(scene.frame);
  const pipeline::Stages stages = pipeline::production_stages();
  pipeline::Recorder nobody;
  for (std::size_t i = 0; i < scene.draws.size(); ++i) {
    const json& of = manifest["draws"][i];
    const Draw& draw = scene.draws[i];
    Mesh& mesh = scene.meshes[draw.mesh];
    mesh.topology = value<Topology>(of["topology"]);
    const Matrices<float> matrices{model_view[i], projection[i], normal[i], scale[i], translate[i]};
    std::vector<Vertex<float>> vertices;
    stages.vertex(matrices, draw.normals, mesh, vertices);
    std::vector<pipeline::Attributes> attributes;
    stages.light({scene, draw, mesh, lights, vertices}, attributes);
    pipeline::draw_primitives({pipeline::draw_input(scene, draw, matrices), mesh.triangles, vertices, attributes,
                               of["first_primitive"], pipeline::surface_of(scene, draw, lights)},
                              scene.frame, stages, frame, nobody);
  }
  return finished(scene.frame, frame);
}

}  // namespace plumbline::test
