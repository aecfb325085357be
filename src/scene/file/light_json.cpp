#include "scene/file/light_json.h"

#include "scene/json/scene_values.h"
#include "scene/names.h"

namespace plumbline {
namespace {

constexpr double kBrightest = 1e6;

Spot read_spot(const JsonNode& node) {
  node.only({"direction", "cutoff", "exponent"});
  Spot spot;
  spot.direction = read_direction(node["direction"]);
  spot.cutoff_degrees = node["cutoff"].number(0, 90);
  if (const auto n = node.find("exponent")) spot.exponent = static_cast<float>(n->number(0, 128));
  return spot;
}

glm::vec3 read_attenuation(const JsonNode& node) {
  const glm::vec3 k(node.vector<3>(0, kBrightest));
  if (k == glm::vec3(0)) node.refuse("one number at least that is not 0", "none");
  return k;
}

}  // namespace

glm::vec3 read_light_color(const JsonNode& node) { return glm::vec3(node.vector<3>(0, kBrightest)); }

Light read_light(const JsonNode& node) {
  node.only({"directional", "point", "ambient", "diffuse", "specular", "attenuation", "spot"});
  const auto directional = node.find("directional"), point = node.find("point");
  if (directional.has_value() == point.has_value()) {
    node.refuse("exactly one of the keys directional, point", point ? "both" : "neither");
  }
  Light light;
  light.kind = point ? Light::Kind::point : Light::Kind::directional;
  light.vector = point ? read_point(*point) : read_direction(*directional);
  if (const auto n = node.find("ambient")) light.ambient = read_light_color(*n);
  if (const auto n = node.find("diffuse")) light.diffuse = read_light_color(*n);
  if (const auto n = node.find("specular")) light.specular = read_light_color(*n);
  for (const std::string_view key : {"attenuation", "spot"}) {
    if (const auto n = node.find(key); n && !point) n->refuse("it beside point", "it beside directional");
  }
  if (const auto n = node.find("attenuation")) light.attenuation = read_attenuation(*n);
  if (const auto n = node.find("spot")) light.spot = read_spot(*n);
  return light;
}

LightModel read_light_model(const JsonNode& node) {
  node.only({"local_viewer", "specular", "sides", "separate_specular"});
  LightModel model;
  if (const auto n = node.find("local_viewer")) model.local_viewer = n->boolean();
  if (const auto n = node.find("specular")) {
    model.specular = n->choice<LightModel::Specular>(kNamesOf<LightModel::Specular>);
  }
  if (const auto n = node.find("sides")) {
    model.sides = n->choice<LightModel::Sides>(kNamesOf<LightModel::Sides>);
  }
  if (const auto n = node.find("separate_specular")) model.separate_specular = n->boolean();
  return model;
}

}  // namespace plumbline
