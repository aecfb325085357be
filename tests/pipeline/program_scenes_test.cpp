// Scenes of the fixed function, drawn by programs: the same pictures, bit for bit; the notes' Gouraud shader.
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "pipeline/geometry.h"
#include "pipeline/render.h"
#include "scene/file/scene_file.h"
#include "tests/pipeline/programs.h"
#include "tests/suite.h"

namespace plumbline::pipeline {
namespace {

using testing_words::bits_apart;

/// The fixed function as a program: stages 1 and 2 were run before, their colours are passed through.
struct PassThrough {
  struct Varyings {
    glm::vec4 color;
  };
  std::vector<Vertex<float>> vertices;
  std::vector<Attributes> lit;
  std::vector<glm::uvec3> triangles;

  explicit PassThrough(const Scene& scene) {
    for (const Draw& draw : scene.draws) {
      const Mesh& mesh = scene.meshes[draw.mesh];
      const auto first = static_cast<std::uint32_t>(vertices.size());
      transform(matrices(scene, draw), draw.normals, mesh, vertices);
      production_stages().light(
          {scene, draw, scene.meshes[draw.mesh], light_sources(scene), std::span(vertices).subspan(first)}, lit);
      for (const glm::uvec3& t : mesh.triangles) triangles.push_back(t + first);
    }
  }
  glm::vec4 vertex(std::size_t triangle, int corner, Varyings& out) const {
    const std::uint32_t i = triangles[triangle][corner];
    out.color = lit[i].color();
    return vertices[i].p_clip;
  }
  bool fragment(const Varyings& in, glm::vec4& color) const {
    color = in.color;
    return false;
  }
};

/// The state that all draws of the scene share; none: they differ, or a program cannot draw the scene.
std::optional<ProgramState> common_state(const Scene& scene) {
  // Programs have triangles, one colour and no blending.
  if (scene.draws.empty() || !carried(scene).empty() || !colors_replace(scene) || may_draw(scene, Topology::lines) ||
      may_draw(scene, Topology::points)) {
    return std::nullopt;
  }
  const Draw& first = scene.draws.front();
  for (const Draw& d : scene.draws) {
    if (d.shading != first.shading || d.cull != first.cull || d.depth_func != first.depth_func) return std::nullopt;
  }
  return ProgramState{first.shading, first.cull, first.depth_func};
}

TEST(ProgramScenes, DrawsTheFixedFunctionsScenesBitForBit) {
  const std::filesystem::path root = suite_folder();
  const std::filesystem::path folders[] = {root / "interpolation", root / "clip",  root / "light",
                                           root / "frame",         root / "depth", root / "coverage"};
  int compared = 0, flat = 0, culled = 0;
  for (const auto& file : find_scenes(folders)) {
    const Scene scene = load_scene(file, {});
    const std::optional<ProgramState> state = common_state(scene);
    if (!state) continue;
    const PassThrough program(scene);
    EXPECT_EQ(bits_apart(draw_program(program, program.triangles.size(), scene.frame, *state), render(scene)), 0u)
        << scene.name;
    ++compared;
    flat += state->shading == Shading::flat;
    culled += state->cull != Cull::none;
  }
  EXPECT_GT(compared, 40);
  EXPECT_GT(flat, 0);
  EXPECT_GT(culled, 0);
}

/// Note 002, "Gouraud Shader As Example", to the letter but for two things: a clip position is handed on, the viewport
/// is the pipeline's; and the interpolation is not `varying_intensity * bar`, which is affine (program_test.cpp).
struct GouraudShader {
  struct Varyings {
    float varying_intensity;
  };
  const Mesh& model;
  std::vector<Vertex<float>> transformed;  // Projection * ModelView * gl_Vertex, and the normals
  glm::vec3 light_dir;                     // eye space, unit length

  GouraudShader(const Scene& scene, glm::vec3 light) : model(scene.meshes[scene.draws[0].mesh]), light_dir(light) {
    transform(matrices(scene, scene.draws[0]), Normals::normalize, model, transformed);
  }
  glm::vec4 vertex(std::size_t iface, int nthvert, Varyings& out) const {
    const Vertex<float>& v = transformed[model.triangles[iface][nthvert]];
    out.varying_intensity = std::max(0.0f, glm::dot(v.n_eye, light_dir));
    return v.p_clip;
  }
  bool fragment(const Varyings& in, glm::vec4& color) const {
    color = glm::vec4(glm::vec3(255, 255, 255) / 255.0f * in.varying_intensity, 1);
    return false;
  }
};

// No tolerance: a white material under one white light comes to max(0, N.L) * 1 + 0, which rounds nowhere.
TEST(ProgramScenes, TheNotesGouraudShaderIsTheFixedFunctionsDiffuseLight) {
  for (const ColorFormat color : {ColorFormat::rgba8, ColorFormat::rgba32f}) {
    Scene scene = suite_scene("light/sphere_gouraud");
    scene.frame.color = color;
    scene.light_model.ambient = glm::vec3(0);
    scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}};  // eye space has the world's axes
    scene.lights = {{Light::Kind::directional, {0.6, 0.48, 0.64}, glm::vec3(0), glm::vec3(1), glm::vec3(0)}};
    scene.draws.resize(1);
    scene.draws[0].lit = true;
    scene.draws[0].material = {glm::vec4(0, 0, 0, 1), glm::vec4(1), glm::vec4(0, 0, 0, 1), glm::vec4(0, 0, 0, 1), 0};
    const glm::vec3 light(scene.lights[0].vector);
    const GouraudShader program(scene, light / std::sqrt((light.x * light.x + light.y * light.y) + light.z * light.z));
    const ProgramState state = *common_state(scene);
    const Frame is = draw_program(program, program.model.triangles.size(), scene.frame, state);
    const Frame expected = render(scene);
    EXPECT_EQ(bits_apart(is, expected), 0u);
    const FrameFormat& f = scene.frame;
    EXPECT_NE(bits_apart(is, Frame(f)), 0u);
    if (color == ColorFormat::rgba8) {
      int lit = 0, dark = 0;
      for (const glm::u8vec4& c : is.color_rgba8.values()) {
        lit += c.r > 200;
        dark += c.r == 0;
      }
      EXPECT_GT(lit, 100) << "it is a picture";
      EXPECT_GT(dark, 100);
    }
  }
}

}  // namespace
}  // namespace plumbline::pipeline
