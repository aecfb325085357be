// Misread states of the stages matrices to depth.
#include <algorithm>

#include "cli/likely/misread_state.h"

namespace plumbline::cli {

namespace {

bool reset_ambient(Scene& scene) {
  bool changed = reset(scene.light_model.ambient, glm::vec3(0));
  for (Light& light : scene.lights) changed |= reset(light.ambient, glm::vec3(0));
  return changed;
}

template <Normals from, Normals to>
constexpr auto kNormals = [](Draw& d) { return d.lit && d.normals == from && reset(d.normals, to); };

// Shininess times `factor`, in [0, 128].
auto shines_by(float factor) {
  return of_materials([factor](Material& m) {
    return m.specular != glm::vec4(0, 0, 0, m.specular.a) && reset(m.shininess, std::min(m.shininess * factor, 128.0f));
  });
}

bool smooth_as_flat(Scene& scene) {
  return of_draws([&](Draw& d) {
    const bool has_colors = d.lit || (d.mesh < scene.meshes.size() && !scene.meshes[d.mesh].colors.empty());
    return has_colors && d.shading == Shading::gouraud && reset(d.shading, Shading::flat);
  })(scene);
}

// Mesh of several triangles without its last one.
bool loses_last_triangle(Mesh& mesh) {
  if (mesh.topology != Topology::triangles || mesh.triangles.size() < 2) return false;
  mesh.triangles.pop_back();
  return true;
}

// Scissor box of which width and height are taken for its right and its upper side.
bool end_at_size(Draw& d) {
  if (!d.scissor) return false;
  const bool is_narrower = reset(d.scissor->width, std::max(d.scissor->width - d.scissor->x, 0));
  return reset(d.scissor->height, std::max(d.scissor->height - d.scissor->y, 0)) || is_narrower;
}

bool scissor_from_other_side(Scene& scene) {
  return of_draws([height = scene.frame.height](Draw& d) {
    if (!d.scissor) return false;
    const int low = height - d.scissor->y - d.scissor->height;
    const bool is_lower = reset(d.scissor->height, std::max(d.scissor->height + std::min(low, 0), 0));
    return reset(d.scissor->y, std::max(low, 0)) || is_lower;
  })(scene);
}

}  // namespace

std::vector<MisreadState> states_of_geometry() {
  const glm::vec4 black(0, 0, 0, 1);
  return {
      {"matrices", "depth_range_ignored", "depths are mapped to [0, 1], whatever the depth range",
       of_draws([](Draw& d) { return reset(d.depth_range, DepthRange()); })},
      {"matrices", "depth_range_stays", "a draw without a depth range has that of the draw before",
       stays<&Draw::depth_range>()},
      {"matrices", "transforms_ignored", "draws are not moved, turned or scaled",
       of_draws([](Draw& d) { return !std::exchange(d.transforms, {}).empty(); })},
      {"vertex", "normals_normalized", "normals are brought to unit length, though they are to stay as they are",
       of_draws(kNormals<Normals::as_they_are, Normals::normalize>)},
      {"vertex", "rescale_ignored", "normals stay as they are, though they are to be scaled back",
       of_draws(kNormals<Normals::rescale, Normals::as_they_are>)},
      {"light", "lighting_ignored", "draws are not lit", of_draws([](Draw& d) { return reset(d.lit, false); })},
      {"light", "lights_ignored", "no light shines but the ambient one",
       [](Scene& s) { return !std::exchange(s.lights, {}).empty(); }, kOfLightEquation},
      {"light", "ambient_ignored", "no ambient light is added", reset_ambient, kOfLightEquation},
      {"light", "ambient_without_material", "ambient light is not multiplied by the material's ambient colour",
       of_materials([](Material& m) { return reset(m.ambient, glm::vec4(1, 1, 1, m.ambient.a)); }), kOfLightEquation},
      {"light", "colors_ignored", "meshes' colours are not used: the material's diffuse colour is",
       of_each<&Scene::meshes>([](Mesh& m) { return !std::exchange(m.colors, {}).empty(); })},
      {"light", "point_as_direction", "a point light's position is taken for the direction to the light",
       of_lights(
           [](Light& l) { return !l.spot && l.vector != glm::dvec3(0) && reset(l.kind, Light::Kind::directional); })},
      {"light", "specular_ignored", "there are no highlights",
       of_materials([=](Material& m) { return reset(m.specular, black); }), kOfLightEquation},
      {"light", "shininess_doubled", "highlights have twice their shininess", shines_by(2), kOfLightEquation},
      {"light", "shininess_halved", "highlights have half their shininess", shines_by(0.5f), kOfLightEquation},
      {"light", "emission_ignored", "materials do not shine by themselves",
       of_materials([=](Material& m) { return reset(m.emission, black); }), kOfLightEquation},
      {"light", "material_alpha_ignored", "the alpha of materials' diffuse colours is taken for 1",
       of_materials([](Material& m) { return reset(m.diffuse.a, 1.0f); }), kOfLightEquation},
      {"light", "two_sides_ignored", "back faces are lit as front faces",
       [](Scene& s) { return reset(s.light_model.sides, LightModel::Sides::one); }, kOfLightEquation},
      {"light", "phong_shading_ignored", "draws are lit at their vertices, not at their fragments",
       of_draws([](Draw& d) { return d.shading == Shading::phong && reset(d.shading, Shading::gouraud); })},
      {"clip", "last_triangle_lost", "the last triangle of a mesh is not drawn",
       of_each<&Scene::meshes>(loses_last_triangle)},
      {"clip", "smooth_shading_ignored", "triangles have the colour of their last corner", smooth_as_flat},
      {"clip", "flat_shading_ignored", "flat triangles have the colours of all corners",
       of_draws([](Draw& d) { return d.shading == Shading::flat && reset(d.shading, Shading::gouraud); })},
      {"clip", "depth_clamp_ignored", "near and far planes cut, though depths are to be clamped",
       [](Scene& s) { return reset(s.depth_clamp, false); }},
      {"window", "cull_ignored", "no face is culled", of_draws([](Draw& d) { return reset(d.cull, Cull::none); })},
      {"window", "cull_stays", "a draw that culls no face culls as the draw before", stays<&Draw::cull>()},
      {"window", "polygon_mode_ignored", "triangles are filled, whatever their mode", of_draws([](Draw& d) {
         const bool front = reset(d.front_mode, PolygonMode::fill);
         return reset(d.back_mode, PolygonMode::fill) || front;
       })},
      {"window", "line_width_ignored", "lines are one pixel wide",
       of_draws([](Draw& d) { return reset(d.line_width, 1); })},
      {"window", "point_size_ignored", "points are one pixel large",
       of_draws([](Draw& d) { return reset(d.point_size, 1); })},
      {"coverage", "scissor_ignored", "scissor boxes hide nothing", of_draws([](Draw& d) { return reset(d.scissor); })},
      {"coverage", "scissor_by_corners", "a scissor box's width and height are taken for its right and upper side",
       of_draws(end_at_size)},
      {"coverage", "scissor_from_other_side", "scissor boxes are counted from the other side of the frame",
       scissor_from_other_side},
      {"coverage", "scissor_stays", "a draw without a scissor box has that of the draw before",
       stays<&Draw::scissor>()},
      {"depth", "polygon_offset_ignored", "depths are not offset",
       of_draws([](Draw& d) { return reset(d.polygon_offset, PolygonOffset()); })},
      {"depth", "offset_without_units", "depths are offset by their slope alone",
       of_draws([](Draw& d) { return reset(d.polygon_offset.units, 0.0f); })},
      {"depth", "polygon_offset_stays", "a draw without a polygon offset has that of the draw before",
       stays<&Draw::polygon_offset>()},
      {"depth", "of_16_bits", "depths have 16 bits, though 24 are asked for",
       [](Scene& s) { return s.frame.depth == DepthFormat::z24 && reset(s.frame.depth, DepthFormat::z16); }},
  };
}

}  // namespace plumbline::cli
