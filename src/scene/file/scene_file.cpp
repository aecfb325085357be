#include "scene/file/scene_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/file/draw_json.h"
#include "scene/file/light_json.h"
#include "scene/file/mesh_json.h"
#include "scene/file/scene_json.h"
#include "scene/file/texture_json.h"
#include "scene/json/scene_values.h"
#include "scene/names.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestFrame = 16384;

Antialias read_antialias(const JsonNode& node, const FrameFormat& frame) {
  const std::string_view kind = node.one_of({"samples", "supersample", "taps"});
  const JsonNode n = node[kind];
  if (kind == "samples") {
    n.integer(4, 4);
    return {Antialias::Kind::multisample, 1};
  }
  if (kind == "taps") return {n.choice<Antialias::Kind>({{"gzrender", Antialias::Kind::taps}}), 1};
  const auto factor = static_cast<int>(n.integer(1, 8));
  if (std::max(frame.width, frame.height) * factor > kLargestFrame) {
    n.refuse(fmt::format("a factor that leaves the frame at most {} pixels a side", kLargestFrame));
  }
  return {Antialias::Kind::supersample, factor};
}

// Refuses lines and points in multisampled and supersampled frames. OpenGL multisamples them as rectangles and squares
// (OpenGL 2.1, sections 3.4.4 and 3.3.1), which plumbline does not draw; supersampling would shrink widths and
// sizes, which are pixels of the larger frame.
void require_drawable(const JsonNode& frame, const Scene& scene) {
  const Antialias::Kind kind = scene.frame.antialias.kind;
  if (kind != Antialias::Kind::multisample && kind != Antialias::Kind::supersample) return;
  if (!may_draw(scene, Topology::lines) && !may_draw(scene, Topology::points)) return;
  frame["antialias"].refuse("taps, where a scene has lines or points", "another kind");
}

FrameFormat read_frame(const JsonNode& node, FrameFormat frame) {
  node.only(
      {"width", "height", "color", "depth", "clear_color", "clear_depth", "stencil", "clear_stencil", "antialias"});
  if (const auto n = node.find("width")) frame.width = static_cast<int>(n->integer(1, kLargestFrame));
  if (const auto n = node.find("height")) frame.height = static_cast<int>(n->integer(1, kLargestFrame));
  if (const auto n = node.find("color")) {
    frame.color = n->choice<ColorFormat>(kNamesOf<ColorFormat>);
  }
  if (const auto n = node.find("depth")) {
    frame.depth = n->choice<DepthFormat>(
        {{"z8", DepthFormat::z8}, {"z16", DepthFormat::z16}, {"z24", DepthFormat::z24}, {"z32f", DepthFormat::z32f}});
  }
  if (const auto n = node.find("clear_color")) frame.clear_color = glm::vec4(n->vector<4>(0, 1));
  if (const auto n = node.find("clear_depth")) frame.clear_depth = n->number(0, 1);
  if (const auto n = node.find("stencil")) {
    frame.stencil = n->choice<StencilFormat>(kNamesOf<StencilFormat>);
  }
  if (const auto n = node.find("clear_stencil")) frame.clear_stencil = static_cast<std::uint8_t>(n->integer(0, 255));
  if (const auto n = node.find("antialias")) frame.antialias = read_antialias(*n, frame);
  return frame;
}

Camera read_camera(const JsonNode& node) {
  node.only({"eye", "center", "up"});
  Camera camera;
  if (const auto n = node.find("eye")) camera.eye = read_point(*n);
  if (const auto n = node.find("center")) camera.center = read_point(*n);
  if (const auto n = node.find("up")) camera.up = read_direction(*n);
  const glm::dvec3 view = camera.center - camera.eye;
  if (glm::length(view) < kSmallestLength) node.refuse("eye and center to differ", "them equal");
  if (glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) < kSmallestLength) {
    node.refuse("up not to be parallel to the view direction", "it parallel");
  }
  return camera;
}

/// Meaning of near and far: distances, near < far, or z coordinates, far < near.
enum class Depths { distances, coordinates };
/// Reads near and far, which must differ by more than float's rounding. `limit`: the least distance, or the largest
/// coordinate.
void read_depths(const JsonNode& node, Depths depths, double limit, double& near, double& far) {
  const bool fall = depths == Depths::coordinates;
  const double least = fall ? -kLargestCoordinate : limit, most = fall ? limit : kLargestCoordinate;
  near = node["near"].number(least, most);
  far = node["far"].number(least, most);
  if ((fall ? near - far : far - near) <= kSmallestLength * std::max(std::abs(near), std::abs(far))) {
    node["far"].refuse(fmt::format("a number {} than near, {}", fall ? "less" : "greater", near));
  }
}

/// A view's box. left > right or bottom > top mirrors the picture.
template <class Box>
Box read_box(const JsonNode& node, Depths depths, double limit) {
  node.only({"left", "right", "bottom", "top", "near", "far"});
  Box box{};
  const auto read_side = [&](const char* key) { return node[key].number(-kLargestCoordinate, kLargestCoordinate); };
  box.left = read_side("left");
  box.right = read_side("right");
  box.bottom = read_side("bottom");
  box.top = read_side("top");
  if (std::abs(box.right - box.left) < kSmallestLength) node["right"].refuse("a number other than left");
  if (std::abs(box.top - box.bottom) < kSmallestLength) node["top"].refuse("a number other than bottom");
  read_depths(node, depths, limit, box.near, box.far);
  return box;
}

double read_angle(const JsonNode& node) { return node.number(1e-3, 180 - 1e-3); }

Projection read_gl_projection(const JsonNode& node) {
  const std::string_view kind = node.one_of({"perspective", "orthographic", "frustum"});
  const JsonNode n = node[kind];
  if (kind == "orthographic") return read_box<Orthographic>(n, Depths::distances, -kLargestCoordinate);
  if (kind == "frustum") return read_box<Frustum>(n, Depths::distances, kSmallestLength);
  n.only({"fov_y", "near", "far"});
  Perspective p{};
  p.fov_y_degrees = read_angle(n["fov_y"]);
  read_depths(n, Depths::distances, kSmallestLength, p.near, p.far);
  return p;
}

/// Near and far are coordinates, far the smaller.
Projection read_games101_projection(const JsonNode& node) {
  const std::string_view kind = node.one_of({"perspective", "orthographic"});
  const JsonNode n = node[kind];
  if (kind == "orthographic") return read_box<Orthographic>(n, Depths::coordinates, kLargestCoordinate);
  n.only({"fov_y", "near", "far"});
  Perspective p{};
  p.fov_y_degrees = read_angle(n["fov_y"]);
  read_depths(n, Depths::coordinates, -kSmallestLength, p.near, p.far);
  return p;
}

Projection read_gzrender_projection(const JsonNode& node) {
  node.one_of({"x_pi"});
  const JsonNode n = node["x_pi"];
  n.only({"fov"});
  return ViewPlane{read_angle(n["fov"])};
}

Projection read_tinyrenderer_projection(const JsonNode& node, double eye_distance) {
  node.one_of({"pinhole"});
  const JsonNode n = node["pinhole"];
  n.only({"c"});
  const auto c = n.find("c");
  return Pinhole{c ? c->number(kSmallestLength, kLargestCoordinate) : eye_distance};
}

/// Sets the dialect's defaults of clear depth, depth function and depth clamp.
void set_defaults(Scene& scene, DrawState& state) {
  const bool greater_is_nearer = scene.dialect == Dialect::games101 || scene.dialect == Dialect::tinyrenderer;
  if (greater_is_nearer) {
    scene.frame.clear_depth = 0;
    state.draw.depth_func = DepthFunc::greater;
  }
  scene.depth_clamp = scene.dialect == Dialect::tinyrenderer;
}

Projection read_projection(const JsonNode* node, Dialect dialect, const Camera& camera) {
  const double eye_distance = glm::distance(camera.eye, camera.center);
  switch (dialect) {
    case Dialect::gl: return node ? read_gl_projection(*node) : Perspective{45, 1, 100};
    case Dialect::gzrender: return node ? read_gzrender_projection(*node) : ViewPlane{45};
    case Dialect::games101: return node ? read_games101_projection(*node) : Perspective{45, -1, -100};
    case Dialect::tinyrenderer: return node ? read_tinyrenderer_projection(*node, eye_distance) : Pinhole{eye_distance};
  }
  return Perspective{};
}

/// A mesh in Scene::meshes: consecutive entries, several for a file of several materials.
struct KnownMesh {
  const JsonValue* json;
  std::uint32_t first;                             ///< index into Scene::meshes
  std::vector<std::optional<Material>> materials;  ///< one per entry
};

void read_draws(const JsonNode& node, const DrawState& defaults, const AssetFolders& folders, Scene& scene) {
  constexpr std::size_t kMostDraws = 4096;
  std::vector<KnownMesh> known;
  std::size_t left = kMostPrimitives;
  for (const JsonNode& n : node.elements(1, kMostDraws)) {
    const DrawState state = read_draw(n, defaults, scene.textures);
    if (state.draw.stencil && scene.frame.stencil == StencilFormat::none) {
      n.refuse("a frame with \"stencil\": \"s8\" for its stencil test", "one without");
    }
    const JsonNode mesh = n["mesh"];
    auto same = std::find_if(known.begin(), known.end(), [&](const KnownMesh& k) { return *k.json == mesh.value(); });
    if (same == known.end()) {
      KnownMesh read{&mesh.value(), static_cast<std::uint32_t>(scene.meshes.size()), {}};
      for (MeshPart& part : read_mesh(mesh, folders, left)) {
        scene.meshes.push_back(std::move(part.mesh));
        read.materials.push_back(part.material);
        if (!part.note.empty()) scene.notes.push_back(std::move(part.note));
      }
      same = known.insert(known.end(), std::move(read));
    }
    for (std::uint32_t i = 0; i < same->materials.size(); ++i) {
      Draw draw = state.draw;
      draw.mesh = same->first + i;
      if (!state.has_material && same->materials[i]) draw.material = *same->materials[i];
      const std::size_t triangles = scene.meshes[draw.mesh].triangles.size();
      if (triangles > left) n.refuse(fmt::format("at most {} triangles in all", kMostPrimitives), "more");
      left -= triangles;
      if (draw.texture && scene.meshes[draw.mesh].texcoords.empty()) {
        mesh.refuse("a mesh with texture coordinates, as the draw has a texture", "one without");
      }
      if (draw.texture && !is_filled(draw)) {
        n.refuse("front_mode and back_mode fill, as the draw has a texture", "edges or corners of triangles");
      }
      scene.draws.push_back(std::move(draw));
    }
  }
}

Scene read_scene(const JsonNode& root, const AssetFolders& folders) {
  if (const auto n = root.find("version")) n->integer(1, 1);
  root.only({"$schema", "version", "include", "description", "dialect", "frame", "camera", "projection", "ambient",
             "light_model", "lights", "textures", "defaults", "draws"});
  if (const auto n = root.find("$schema")) n->text();
  Scene scene;
  scene.description = root["description"].text();
  DrawState defaults;
  if (const auto n = root.find("dialect")) {
    scene.dialect = n->choice<Dialect>(kNamesOf<Dialect>);
  }
  set_defaults(scene, defaults);
  const auto frame = root.find("frame");
  if (frame) scene.frame = read_frame(*frame, scene.frame);
  if (const auto n = root.find("camera")) scene.camera = read_camera(*n);
  const auto projection = root.find("projection");
  scene.projection = read_projection(projection ? &*projection : nullptr, scene.dialect, scene.camera);
  if (const auto n = root.find("light_model")) scene.light_model = read_light_model(*n);
  if (const auto n = root.find("ambient")) scene.light_model.ambient = read_light_color(*n);
  if (const auto n = root.find("lights")) {
    for (const JsonNode& light : n->elements(0, 8)) scene.lights.push_back(read_light(light));
  }
  if (const auto n = root.find("textures")) scene.textures = read_textures(*n, folders);
  if (const auto n = root.find("defaults")) defaults = read_draw_state(*n, defaults, scene.textures);
  read_draws(root["draws"], defaults, folders, scene);
  if (frame) require_drawable(*frame, scene);
  return scene;
}

/// True: the file stands beside scenes, and is none: *.schema.json, *.part.json or *.rubric.json.
bool is_beside_scenes(const fs::path& file) {
  const fs::path second = file.stem().extension();
  return file.extension() == ".json" && (second == ".schema" || second == ".part" || second == ".rubric");
}
bool is_scene(const fs::path& file) { return file.extension() == ".json" && !is_beside_scenes(file); }

}  // namespace

Scene load_scene(const fs::path& file, const SceneFileOptions& options) {
  const fs::path whole = fs::absolute(file), named = whole.lexically_normal();  // which drops link/..
  std::vector<fs::path> folders = options.asset_folders;
  folders.insert(folders.begin(), whole.parent_path());
  try {
    const AssetFolders assets(std::move(folders));
    const SceneJson json(file, assets);
    Scene scene = read_scene(json.root(), assets);
    scene.name = (named.parent_path().filename() / named.stem()).generic_string();
    scene.path = file.string();
    scene.files = json.files();
    return scene;
  } catch (const JsonError& error) {
    const bool is_part = file.stem().extension() == ".part";
    throw SceneError(fmt::format("{}{}", error.what(), is_part ? " (*.part.json is a part that scenes include)" : ""));
  } catch (const fs::filesystem_error& error) {
    throw SceneError(fmt::format("{}: expected files that can be read, found: {}", file.string(), error.what()));
  }
}

std::vector<fs::path> find_scenes(std::span<const fs::path> paths) {
  std::vector<fs::path> scenes;
  const bool has_scene = std::ranges::any_of(paths, [](const fs::path& path) { return !is_beside_scenes(path); });
  for (const fs::path& path : paths) {
    if (has_scene && is_beside_scenes(path)) continue;  // a shell's *.json names it, too
    std::vector<fs::path> found;
    try {
      if (!fs::is_directory(path)) {
        if (fs::exists(path)) found.push_back(path);
      } else {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
          if (entry.is_regular_file() && is_scene(entry.path())) found.push_back(entry.path());
        }
      }
    } catch (const fs::filesystem_error& error) {
      throw SceneError(fmt::format("{}: expected a folder that can be read, found: {}", error.path1().string(),
                                   error.code().message()));
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
