#include "scene/scene_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/json_tree.h"
#include "scene/mesh_file.h"
#include "scene/mesh_json.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr double kFar = kLargestCoordinate;
constexpr double kTiny = 1e-6;  // the shortest vector and the smallest scale: their reciprocals are harmless in float
constexpr double kBrightest = 1e6;

glm::dvec3 read_point(const JsonNode& node) { return node.vector<3>(-kFar, kFar); }

glm::dvec3 read_direction(const JsonNode& node) {
  const glm::dvec3 v = read_point(node);
  if (glm::length(v) < kTiny) node.refuse("a direction that is not zero", fmt::format("[{}, {}, {}]", v.x, v.y, v.z));
  return v;
}

FrameFormat read_frame(const JsonNode& node) {
  constexpr int kLargestFrame = 16384;
  node.only({"width", "height", "color", "depth", "clear_color", "clear_depth"});
  FrameFormat frame;
  if (const auto n = node.find("width")) frame.width = static_cast<int>(n->integer(1, kLargestFrame));
  if (const auto n = node.find("height")) frame.height = static_cast<int>(n->integer(1, kLargestFrame));
  if (const auto n = node.find("color")) {
    frame.color = n->choice<ColorFormat>({{"rgba8", ColorFormat::rgba8}, {"rgba32f", ColorFormat::rgba32f}});
  }
  if (const auto n = node.find("depth")) {
    frame.depth =
        n->choice<DepthFormat>({{"z16", DepthFormat::z16}, {"z24", DepthFormat::z24}, {"z32f", DepthFormat::z32f}});
  }
  if (const auto n = node.find("clear_color")) frame.clear_color = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("clear_depth")) frame.clear_depth = n->number(0, 1);
  return frame;
}

Camera read_camera(const JsonNode& node) {
  node.only({"eye", "center", "up"});
  Camera camera;
  if (const auto n = node.find("eye")) camera.eye = read_point(*n);
  if (const auto n = node.find("center")) camera.center = read_point(*n);
  if (const auto n = node.find("up")) camera.up = read_direction(*n);
  const glm::dvec3 view = camera.center - camera.eye;
  if (glm::length(view) < kTiny) node.refuse("eye and center to differ", "them equal");
  if (glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) < kTiny) {
    node.refuse("up not to be parallel to the view direction", "it parallel");
  }
  return camera;
}

/// Near and far, the one before the other by more than float's rounding.
void read_depths(const JsonNode& node, double least, double& near, double& far) {
  near = node["near"].number(least, kFar);
  far = node["far"].number(least, kFar);
  if (far - near <= kTiny * std::max(std::abs(near), std::abs(far))) {
    node["far"].refuse(fmt::format("a number greater than near, {}", near));
  }
}

/// A view's box; right may be left of left, top below bottom: that mirrors. near is at least `least`.
template <class Box>
Box read_box(const JsonNode& node, double least) {
  node.only({"left", "right", "bottom", "top", "near", "far"});
  Box box{};
  const auto read_side = [&](const char* key) { return node[key].number(-kFar, kFar); };
  box.left = read_side("left");
  box.right = read_side("right");
  box.bottom = read_side("bottom");
  box.top = read_side("top");
  if (std::abs(box.right - box.left) < kTiny) node["right"].refuse("a number other than left");
  if (std::abs(box.top - box.bottom) < kTiny) node["top"].refuse("a number other than bottom");
  read_depths(node, least, box.near, box.far);
  return box;
}

Projection read_projection(const JsonNode& node) {
  const std::string_view kind = node.one_of({"perspective", "orthographic", "frustum"});
  const JsonNode n = node[kind];
  if (kind == "orthographic") return read_box<Orthographic>(n, -kFar);
  if (kind == "frustum") return read_box<Frustum>(n, kTiny);
  n.only({"fov_y", "near", "far"});
  Perspective p{};
  p.fov_y_degrees = n["fov_y"].number(1e-3, 180 - 1e-3);
  read_depths(n, kTiny, p.near, p.far);
  return p;
}

Light read_light(const JsonNode& node) {
  node.only({"directional", "point", "ambient", "diffuse", "specular"});
  const auto directional = node.find("directional"), point = node.find("point");
  if (directional.has_value() == point.has_value()) {
    node.refuse("exactly one of the keys directional, point", point ? "both" : "neither");
  }
  Light light;
  light.kind = point ? Light::Kind::point : Light::Kind::directional;
  light.vector = point ? read_point(*point) : read_direction(*directional);
  if (const auto n = node.find("ambient")) light.ambient = glm::vec3(n->vector<3>(0, kBrightest));
  if (const auto n = node.find("diffuse")) light.diffuse = glm::vec3(n->vector<3>(0, kBrightest));
  if (const auto n = node.find("specular")) light.specular = glm::vec3(n->vector<3>(0, kBrightest));
  return light;
}

Transform read_transform(const JsonNode& node) {
  const std::string_view kind = node.one_of({"translate", "rotate", "scale"});
  const JsonNode what = node[kind];
  if (kind == "translate") return Translate{read_point(what)};
  if (kind == "rotate") {
    what.only({"degrees", "axis"});
    return Rotate{what["degrees"].number(-kFar, kFar), read_direction(what["axis"])};
  }
  const glm::dvec3 by = read_point(what);
  for (int k = 0; k < 3; ++k) {
    if (std::abs(by[k]) < kTiny) what[static_cast<std::size_t>(k)].refuse("a scale that is not zero");
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
      if (largest > kFar || smallest < kTiny) {
        n.refuse(fmt::format("scales whose product is from {} to {}", kTiny, kFar), "one beyond");
      }
    }
  }
  return transforms;
}

Material read_material(const JsonNode& node) {
  node.only({"ambient", "diffuse", "specular", "emission", "shininess"});
  Material material;
  if (const auto n = node.find("ambient")) material.ambient = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("diffuse")) material.diffuse = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("specular")) material.specular = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("emission")) material.emission = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("shininess")) material.shininess = static_cast<float>(n->number(0, 128));
  return material;
}

/// A draw without its mesh.
Draw read_draw(const JsonNode& node) {
  node.only({"mesh", "transforms", "material", "lit", "shading", "cull", "depth_func"});
  Draw draw;
  if (const auto n = node.find("transforms")) draw.transforms = read_transforms(*n);
  if (const auto n = node.find("material")) draw.material = read_material(*n);
  if (const auto n = node.find("lit")) draw.lit = n->boolean();
  if (const auto n = node.find("shading")) {
    draw.shading = n->choice<Shading>({{"flat", Shading::flat}, {"gouraud", Shading::gouraud}});
  }
  if (const auto n = node.find("cull")) {
    draw.cull = n->choice<Cull>({{"none", Cull::none}, {"back", Cull::back}, {"front", Cull::front}});
  }
  if (const auto n = node.find("depth_func")) {
    draw.depth_func = n->choice<DepthFunc>({{"never", DepthFunc::never},
                                            {"less", DepthFunc::less},
                                            {"equal", DepthFunc::equal},
                                            {"less_equal", DepthFunc::less_equal},
                                            {"greater", DepthFunc::greater},
                                            {"not_equal", DepthFunc::not_equal},
                                            {"greater_equal", DepthFunc::greater_equal},
                                            {"always", DepthFunc::always}});
  }
  return draw;
}

void read_draws(const JsonNode& node, std::span<const fs::path> folders, Scene& scene) {
  constexpr std::size_t kMostPrimitives = 1u << 24;  // a primitive's number is exact in float
  std::vector<const JsonValue*> meshes;              // beside scene.meshes
  std::size_t primitives = 0;
  for (const JsonNode& n : node.elements(1, SIZE_MAX)) {
    Draw draw = read_draw(n);
    const JsonNode mesh = n["mesh"];
    const auto same =
        std::find_if(meshes.begin(), meshes.end(), [&](const JsonValue* m) { return *m == mesh.value(); });
    draw.mesh = static_cast<std::uint32_t>(same - meshes.begin());
    if (same == meshes.end()) {
      meshes.push_back(&mesh.value());
      scene.meshes.push_back(read_mesh(mesh, folders));
    }
    primitives += scene.meshes[draw.mesh].triangles.size();
    if (primitives > kMostPrimitives) n.refuse(fmt::format("at most {} triangles in all", kMostPrimitives), "more");
    scene.draws.push_back(std::move(draw));
  }
}

Scene read_scene(const JsonNode& root, std::span<const fs::path> folders) {
  root.only({"description", "dialect", "frame", "camera", "projection", "ambient", "lights", "draws"});
  Scene scene;
  scene.description = root["description"].text();
  if (const auto n = root.find("dialect")) scene.dialect = n->choice<Dialect>({{"gl", Dialect::gl}});
  if (const auto n = root.find("frame")) scene.frame = read_frame(*n);
  if (const auto n = root.find("camera")) scene.camera = read_camera(*n);
  if (const auto n = root.find("projection")) scene.projection = read_projection(*n);
  if (const auto n = root.find("ambient")) scene.ambient = glm::vec3(n->vector<3>(0, kBrightest));
  if (const auto n = root.find("lights")) {
    for (const JsonNode& light : n->elements(0, 8)) scene.lights.push_back(read_light(light));
  }
  read_draws(root["draws"], folders, scene);
  return scene;
}

}  // namespace

Scene load_scene(const fs::path& file, const SceneFileOptions& options) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  std::vector<fs::path> folders = options.asset_folders;
  folders.insert(folders.begin(), whole.parent_path());
  try {
    const JsonFile json(file);
    Scene scene = read_scene(json.root(), folders);
    scene.name = (whole.parent_path().filename() / whole.stem()).generic_string();
    scene.path = file.string();
    return scene;
  } catch (const JsonError& error) {
    throw SceneError(error.what());
  } catch (const fs::filesystem_error& error) {
    throw SceneError(fmt::format("{}: expected files that can be read, found: {}", file.string(), error.what()));
  }
}

std::vector<fs::path> find_scenes(std::span<const fs::path> paths) {
  std::vector<fs::path> scenes;
  for (const fs::path& path : paths) {
    std::vector<fs::path> found;
    try {
      if (!fs::is_directory(path)) {
        if (fs::exists(path)) found.push_back(path);
      } else {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
          if (entry.is_regular_file() && entry.path().extension() == ".json") found.push_back(entry.path());
        }
      }
    } catch (const fs::filesystem_error& error) {
      throw SceneError(fmt::format("{}: expected a folder that can be read, found: {}", path.string(), error.what()));
    }
    if (found.empty()) {
      throw SceneError(
          fmt::format("{}: expected a scene, or a folder with scenes (*.json), found none", path.string()));
    }
    std::sort(found.begin(), found.end());
    scenes.insert(scenes.end(), found.begin(), found.end());
  }
  if (scenes.empty()) throw SceneError("expected at least one scene or folder of scenes, found none");
  return scenes;
}

}  // namespace plumbline
