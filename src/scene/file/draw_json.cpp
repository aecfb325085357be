#include "scene/file/draw_json.h"

#include <algorithm>

#include <fmt/format.h>

#include "scene/file/fragment_json.h"
#include "scene/file/texture_json.h"
#include "scene/json/scene_values.h"
#include "scene/names.h"

namespace plumbline {
namespace {

Transform read_transform(const JsonNode& node) {
  const std::string_view kind = node.one_of({"translate", "rotate", "scale"});
  const JsonNode what = node[kind];
  if (kind == "translate") return Translate{read_point(what)};
  if (kind == "rotate") {
    what.only({"degrees", "axis"});
    return Rotate{what["degrees"].number(-kLargestCoordinate, kLargestCoordinate), read_direction(what["axis"])};
  }
  const glm::dvec3 by = read_point(what);
  for (int k = 0; k < 3; ++k) {
    if (std::abs(by[k]) < kSmallestLength) what[static_cast<std::size_t>(k)].refuse("a scale that is not zero");
  }
  return Scale{by};
}

std::vector<Transform> read_transforms(const JsonNode& node) {
  constexpr std::size_t kMost = 64;
  std::vector<Transform> transforms;
  double largest = 1, smallest = 1;  // bounds of the product's scale
  for (const JsonNode& n : node.elements(0, kMost)) {
    transforms.push_back(read_transform(n));
    if (const Scale* scale = std::get_if<Scale>(&transforms.back())) {
      const glm::dvec3 by = glm::abs(scale->by);
      largest *= std::max({by.x, by.y, by.z});
      smallest *= std::min({by.x, by.y, by.z});
      if (largest > kLargestCoordinate || smallest < kSmallestLength) {
        n.refuse(fmt::format("scales whose product is from {} to {}", kSmallestLength, kLargestCoordinate),
                 "one beyond");
      }
    }
  }
  return transforms;
}

void read_material(const JsonNode& node, Material& material) {
  node.only({"ambient", "diffuse", "specular", "emission", "shininess"});
  if (const auto n = node.find("ambient")) material.ambient = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("diffuse")) material.diffuse = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("specular")) material.specular = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("emission")) material.emission = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("shininess")) material.shininess = static_cast<float>(n->number(0, 128));
}

Fog read_fog(const JsonNode& node) {
  const std::string_view kind = node.one_of({"linear", "exp", "exp2"});
  const JsonNode of_kind = node[kind];
  Fog fog;
  const auto distance = [&](std::string_view key) {
    return static_cast<float>(of_kind[key].number(-kLargestCoordinate, kLargestCoordinate));
  };
  if (kind == "linear") {
    of_kind.only({"color", "start", "end"});
    fog.mode = Fog::Mode::linear;
    fog.start = distance("start");
    fog.end = distance("end");
    if (fog.start == fog.end) of_kind["end"].refuse("another distance than \"start\"");
  } else {
    of_kind.only({"color", "density"});
    fog.mode = kind == "exp" ? Fog::Mode::exp : Fog::Mode::exp2;
    fog.density = static_cast<float>(of_kind["density"].number(0, kLargestCoordinate));
  }
  if (const auto n = of_kind.find("color")) fog.color = glm::vec3(n->vector<3>(0, 1));
  return fog;
}

PolygonMode read_mode(const JsonNode& node) {
  return node.choice<PolygonMode>(
      {{"fill", PolygonMode::fill}, {"line", PolygonMode::line}, {"point", PolygonMode::point}});
}

constexpr std::string_view kStateKeys[] = {"transforms", "material",   "back_material", "lit",         "color_material",
                                           "normals",    "shading",    "cull",          "front_mode",  "back_mode",
                                           "line_width", "point_size", "depth_func",    "depth_range", "polygon_offset",
                                           "alpha_test", "stencil",    "fog",           "scissor",     "depth_mask",
                                           "blend",      "logic_op",   "color_mask",    "texture"};

/// Overwrites the state of every key in the node.
void read_state(const JsonNode& node, DrawState& state) {
  Draw& draw = state.draw;
  if (const auto n = node.find("transforms")) draw.transforms = read_transforms(*n);
  if (const auto n = node.find("material")) {
    read_material(*n, draw.material);
    state.has_material = true;
  }
  if (const auto n = node.find("back_material")) {
    if (!draw.back_material) draw.back_material.emplace();
    read_material(*n, *draw.back_material);
  }
  if (const auto n = node.find("lit")) draw.lit = n->boolean();
  if (const auto n = node.find("color_material")) {
    draw.color_material = n->choice<ColorMaterial>(kNamesOf<ColorMaterial>);
  }
  if (const auto n = node.find("normals")) {
    draw.normals = n->choice<Normals>(
        {{"normalize", Normals::normalize}, {"rescale", Normals::rescale}, {"as_they_are", Normals::as_they_are}});
  }
  if (const auto n = node.find("shading")) {
    draw.shading = n->choice<Shading>(kNamesOf<Shading>);
  }
  if (const auto n = node.find("cull")) {
    draw.cull = n->choice<Cull>(kNamesOf<Cull>);
  }
  if (const auto n = node.find("front_mode")) draw.front_mode = read_mode(*n);
  if (const auto n = node.find("back_mode")) draw.back_mode = read_mode(*n);
  if (const auto n = node.find("line_width")) draw.line_width = static_cast<int>(n->integer(1, 16));
  if (const auto n = node.find("point_size")) draw.point_size = static_cast<int>(n->integer(1, 64));
  if (const auto n = node.find("fog")) draw.fog = read_fog(*n);
  read_fragment_state(node, draw);
}

DrawState read_keys(const JsonNode& node, std::span<const std::string_view> keys, const DrawState& defaults,
                    const std::vector<Texture>& textures) {
  node.only(keys);
  DrawState state = defaults;
  read_state(node, state);
  if (const auto n = node.find("texture")) state.draw.texture = read_draw_texture(*n, textures, defaults.draw.texture);
  return state;
}

}  // namespace

DrawState read_draw_state(const JsonNode& node, const DrawState& defaults, const std::vector<Texture>& textures) {
  return read_keys(node, kStateKeys, defaults, textures);
}

DrawState read_draw(const JsonNode& node, const DrawState& defaults, const std::vector<Texture>& textures) {
  std::vector<std::string_view> keys{"mesh"};
  keys.insert(keys.end(), std::begin(kStateKeys), std::end(kStateKeys));
  return read_keys(node, keys, defaults, textures);
}

}  // namespace plumbline
