#include "reference/osmesa/scene/scene_in_gl.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "reference/arithmetic/draw_ranges.h"
#include "reference/arithmetic/matrices.h"
#include "reference/osmesa/scene/fragment_state.h"
#include "reference/osmesa/scene/light_program.h"
#include "reference/osmesa/scene/light_state.h"

namespace plumbline::osmesa {
namespace {

struct Corner {
  glm::vec3 position;
  std::uint32_t id;  // GL reads its bytes as a colour
  glm::vec4 weight;
};

// An offset into the bound buffer [bytes], as the pointer that GL takes.
const void* offset(std::uintptr_t bytes) { return reinterpret_cast<const void*>(bytes); }

// Checks that a mesh's arrays and indices fit each other: else OpenGL would read past the arrays' ends.
void require_whole(const Scene& scene, const Draw& draw) {
  const Mesh& mesh = scene.meshes.at(draw.mesh);
  const std::size_t vertices = mesh.positions.size();
  const auto fail = [&](const std::string& what) {
    throw RendererFailed(fmt::format("{}: mesh {}: {}", scene.name, draw.mesh, what));
  };
  if (mesh.normals.size() != vertices) fail(fmt::format("{} positions, but {} normals", vertices, mesh.normals.size()));
  if (!mesh.colors.empty() && mesh.colors.size() != vertices) {
    fail(fmt::format("{} positions, but {} colours", vertices, mesh.colors.size()));
  }
  if (!mesh.texcoords.empty() && mesh.texcoords.size() != vertices) {
    fail(fmt::format("{} positions, but {} texture coordinates", vertices, mesh.texcoords.size()));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    if (std::max({t.x, t.y, t.z}) >= vertices) {
      fail(fmt::format("triangle {} ({}, {}, {}) has a vertex beyond the {} that there are", i, t.x, t.y, t.z,
                       vertices));
    }
  }
}

std::vector<Corner> corners_of(const Mesh& mesh, std::uint32_t primitive) {
  std::vector<Corner> corners;
  const auto count = static_cast<int>(corner_count(mesh.topology));
  corners.reserve(static_cast<std::size_t>(count) * mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    const auto part = [&](int i) { return static_cast<float>(id_weight_part(primitive, i)); };
    const glm::vec4 weight(1, part(0), part(1), part(2));
    for (int i = 0; i < count; ++i) corners.push_back({mesh.positions[triangle[i]], primitive + 1, weight});
    ++primitive;
  }
  return corners;
}

std::vector<std::uint32_t> indices_of(const Mesh& mesh) {
  std::vector<std::uint32_t> indices;
  const auto count = static_cast<int>(corner_count(mesh.topology));
  for (const glm::uvec3& primitive : mesh.triangles) {
    for (int i = 0; i < count; ++i) indices.push_back(primitive[i]);
  }
  return indices;
}

GLenum gl_polygon_mode(PolygonMode mode) {
  return mode == PolygonMode::fill ? GL_FILL : mode == PolygonMode::line ? GL_LINE : GL_POINT;
}

GLenum gl_factor(BlendFactor factor) {
  switch (factor) {
    case BlendFactor::zero: return GL_ZERO;
    case BlendFactor::one: return GL_ONE;
    case BlendFactor::source_color: return GL_SRC_COLOR;
    case BlendFactor::one_minus_source_color: return GL_ONE_MINUS_SRC_COLOR;
    case BlendFactor::destination_color: return GL_DST_COLOR;
    case BlendFactor::one_minus_destination_color: return GL_ONE_MINUS_DST_COLOR;
    case BlendFactor::source_alpha: return GL_SRC_ALPHA;
    case BlendFactor::one_minus_source_alpha: return GL_ONE_MINUS_SRC_ALPHA;
    case BlendFactor::destination_alpha: return GL_DST_ALPHA;
    case BlendFactor::one_minus_destination_alpha: return GL_ONE_MINUS_DST_ALPHA;
    case BlendFactor::constant_color: return GL_CONSTANT_COLOR;
    case BlendFactor::one_minus_constant_color: return GL_ONE_MINUS_CONSTANT_COLOR;
    case BlendFactor::constant_alpha: return GL_CONSTANT_ALPHA;
    case BlendFactor::one_minus_constant_alpha: return GL_ONE_MINUS_CONSTANT_ALPHA;
    case BlendFactor::source_alpha_saturate: return GL_SRC_ALPHA_SATURATE;
  }
  return GL_ONE;
}

GLenum gl_equation(BlendEquation equation) {
  switch (equation) {
    case BlendEquation::add: return GL_FUNC_ADD;
    case BlendEquation::subtract: return GL_FUNC_SUBTRACT;
    case BlendEquation::reverse_subtract: return GL_FUNC_REVERSE_SUBTRACT;
    case BlendEquation::min: return GL_MIN;
    case BlendEquation::max: return GL_MAX;
  }
  return GL_FUNC_ADD;
}

}  // namespace

GLenum gl_mode(Topology topology) {
  return topology == Topology::triangles ? GL_TRIANGLES : topology == Topology::lines ? GL_LINES : GL_POINTS;
}

glm::vec4 color_at(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.colors.empty() ? glm::vec4(1) : mesh.colors[vertex];
}

std::vector<SceneInGl::MeshVertex> SceneInGl::vertices_of(const Mesh& mesh) {
  std::vector<MeshVertex> vertices;
  vertices.reserve(mesh.positions.size());
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec2 texcoord = mesh.texcoords.empty() ? glm::vec2(0) : mesh.texcoords[i];
    vertices.push_back({mesh.positions[i], mesh.normals[i], color_at(mesh, i), texcoord});
  }
  return vertices;
}

SceneInGl::SceneInGl(const Gl& gl, const Scene& scene) : gl_(gl), scene_(scene), textures_(gl, scene) {
  if (const int most = limit(gl, GL_MAX_LIGHTS); scene.lights.size() > static_cast<std::size_t>(most)) {
    throw RendererFailed(fmt::format("{}: {} lights; OpenGL has {}", scene.name, scene.lights.size(), most));
  }
  for (const Draw& draw : scene.draws) require_whole(scene, draw);
  ranges_ = math::ranges_of_draws(scene);
  for (std::size_t i = 0; i < scene.draws.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.draws[i].mesh];
    matrices_.push_back(math::float_matrices(scene, scene.draws[i]));
    std::optional<Program>& program = light_programs_.emplace_back();
    if (needs_light_program(scene, scene.draws[i])) {
      program.emplace(gl, light_vertex_shader(scene, scene.draws[i]), light_fragment_shader(scene, scene.draws[i]));
    }
    arrays_.push_back({Buffer(gl, std::span<const MeshVertex>(vertices_of(mesh))),
                       Buffer(gl, std::span<const std::uint32_t>(indices_of(mesh))),
                       Buffer(gl, std::span<const Corner>(corners_of(mesh, ranges_[i].first_primitive)))});
  }
  check(gl, "uploading the meshes");
}

void SceneInGl::clear(const glm::vec4& color) const {
  gl_.ClearColor(color.r, color.g, color.b, color.a);
  gl_.ClearDepth(scene_.frame.clear_depth);
  gl_.ClearStencil(scene_.frame.clear_stencil);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void SceneInGl::set_matrices(std::size_t draw) const {
  if (scene_.depth_clamp) {
    gl_.Enable(GL_DEPTH_CLAMP);
  } else {
    gl_.Disable(GL_DEPTH_CLAMP);
  }
  const DepthRange& range = scene_.draws[draw].depth_range;
  gl_.DepthRange(range.near, range.far);
  gl_.MatrixMode(GL_PROJECTION);
  gl_.LoadMatrixf(glm::value_ptr(glm::mat4(matrices_[draw].projection)));
  gl_.MatrixMode(GL_MODELVIEW);
  gl_.LoadMatrixf(glm::value_ptr(glm::mat4(matrices_[draw].model_view)));
}

void SceneInGl::set_fog(std::size_t draw) const {
  const std::optional<Fog>& fog = scene_.draws[draw].fog;
  if (!fog) return gl_.Disable(GL_FOG);
  gl_.Enable(GL_FOG);
  gl_.Fogi(GL_FOG_MODE, fog->mode == Fog::Mode::linear ? GL_LINEAR : fog->mode == Fog::Mode::exp ? GL_EXP : GL_EXP2);
  gl_.Fogfv(GL_FOG_COLOR, glm::value_ptr(glm::vec4(fog->color, 1)));
  gl_.Fogf(GL_FOG_DENSITY, fog->density);
  gl_.Fogf(GL_FOG_START, fog->start);
  gl_.Fogf(GL_FOG_END, fog->end);
}

void SceneInGl::set_vertex_light(std::size_t draw) const {
  const Draw& d = scene_.draws[draw];
  gl_.ShadeModel(d.shading == Shading::flat ? GL_FLAT : GL_SMOOTH);
  gl_.UseProgram(0);
  if (!is_lit_per_vertex(d)) {
    gl_.Disable(GL_LIGHTING);
    gl_.Color4fv(glm::value_ptr(d.material.diffuse));  // where the mesh has no colours
    return;
  }
  gl_.Enable(GL_LIGHTING);
  set_material(gl_, scene_, d);
  if (!has_vertex_program(draw)) return;
  gl_.UseProgram(light_programs_[draw]->name());
  // With a vertex shader, the light model has no effect on two sides and colour sum, which have switches of their own.
  if (scene_.light_model.sides == LightModel::Sides::two) gl_.Enable(GL_VERTEX_PROGRAM_TWO_SIDE);
  if (scene_.light_model.separate_specular) gl_.Enable(GL_COLOR_SUM);
}

bool SceneInGl::has_vertex_program(std::size_t draw) const {
  return is_lit_per_vertex(scene_.draws[draw]) && light_programs_[draw];
}

void SceneInGl::set_texture_source(std::size_t draw) const {
  textures_.set_source(scene_.draws[draw]);
  gl_.Disable(GL_LIGHTING);
  gl_.Disable(GL_FOG);
  gl_.ClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FIXED_ONLY);  // a texel is no sum of colours
  gl_.UseProgram(0);
  gl_.Color4f(0, 0, 0, 1);
}

void SceneInGl::set_surface(std::size_t draw) const {
  const Draw& d = scene_.draws[draw];
  textures_.set(d);
  set_fog(draw);
  // The colour sum of a lit draw is clamped (OpenGL 2.1, section 3.9); in a float frame GL would not clamp it by
  // default.
  const bool clamped = d.lit && scene_.light_model.separate_specular;
  gl_.ClampColor(GL_CLAMP_FRAGMENT_COLOR, clamped ? GL_TRUE : GL_FIXED_ONLY);
  set_vertex_light(draw);
  if (!is_lit_per_fragment(d)) return;
  set_material(gl_, scene_, d);
  gl_.UseProgram(light_programs_[draw]->name());
}

void SceneInGl::set_fragments(std::size_t draw) const {
  const Draw& d = scene_.draws[draw];
  gl_.PolygonMode(GL_FRONT, gl_polygon_mode(d.front_mode));
  gl_.PolygonMode(GL_BACK, gl_polygon_mode(d.back_mode));
  gl_.LineWidth(static_cast<GLfloat>(d.line_width));
  gl_.PointSize(static_cast<GLfloat>(d.point_size));
  gl_.Disable(GL_DITHER);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(gl_compare(d.depth_func));
  if (d.scissor) {
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(d.scissor->x, d.scissor->y, d.scissor->width, d.scissor->height);
  } else {
    gl_.Disable(GL_SCISSOR_TEST);
  }
  set_fragment_tests(gl_, d);
  gl_.DepthMask(d.merge.depth_mask ? GL_TRUE : GL_FALSE);
  if (d.cull == Cull::none) {
    gl_.Disable(GL_CULL_FACE);
  } else {
    gl_.Enable(GL_CULL_FACE);
    gl_.CullFace(d.cull == Cull::back ? GL_BACK : GL_FRONT);
  }
}

void SceneInGl::set_merge(std::size_t draw) const {
  const Merge& merge = scene_.draws[draw].merge;
  const auto gl_bool = [](bool on) -> GLboolean { return on ? GL_TRUE : GL_FALSE; };
  const glm::bvec4& mask = merge.color_mask;
  gl_.ColorMask(gl_bool(mask.r), gl_bool(mask.g), gl_bool(mask.b), gl_bool(mask.a));
  set_logic_op(gl_, merge.logic_op);
  if (!merge.blend) return gl_.Disable(GL_BLEND);
  const Blend& blend = *merge.blend;
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(gl_factor(blend.rgb.source), gl_factor(blend.rgb.destination), gl_factor(blend.alpha.source),
                        gl_factor(blend.alpha.destination));
  gl_.BlendEquationSeparate(gl_equation(blend.rgb.equation), gl_equation(blend.alpha.equation));
  gl_.BlendColor(blend.color.r, blend.color.g, blend.color.b, blend.color.a);
}

void SceneInGl::bind_vertices(std::size_t draw) const {
  gl_.BindBuffer(GL_ARRAY_BUFFER, arrays_[draw].vertices.name());
  gl_.VertexPointer(3, GL_FLOAT, sizeof(MeshVertex), offset(offsetof(MeshVertex, position)));
  gl_.NormalPointer(GL_FLOAT, sizeof(MeshVertex), offset(offsetof(MeshVertex, normal)));
  gl_.ColorPointer(4, GL_FLOAT, sizeof(MeshVertex), offset(offsetof(MeshVertex, color)));
  gl_.EnableClientState(GL_VERTEX_ARRAY);
  gl_.EnableClientState(GL_NORMAL_ARRAY);
  if (!mesh(draw).colors.empty()) gl_.EnableClientState(GL_COLOR_ARRAY);
  if (mesh(draw).texcoords.empty()) return;
  gl_.TexCoordPointer(2, GL_FLOAT, sizeof(MeshVertex), offset(offsetof(MeshVertex, texcoord)));
  gl_.EnableClientState(GL_TEXTURE_COORD_ARRAY);
}

void SceneInGl::bind_corners(std::size_t draw) const {
  gl_.BindBuffer(GL_ARRAY_BUFFER, arrays_[draw].corners.name());
  gl_.VertexPointer(3, GL_FLOAT, sizeof(Corner), offset(offsetof(Corner, position)));
  gl_.EnableClientState(GL_VERTEX_ARRAY);
  gl_.EnableClientState(GL_COLOR_ARRAY);
}

void SceneInGl::draw_primitives(std::size_t draw) const { draw_primitives(draw, all(draw)); }
void SceneInGl::draw_without_colors(std::size_t draw) const { draw_without_colors(draw, all(draw)); }
void SceneInGl::draw_weights(std::size_t draw) const { draw_weights(draw, all(draw)); }

void SceneInGl::draw_primitives(std::size_t draw, Primitives these) const {
  const SavedArrays arrays(gl_);
  bind_vertices(draw);
  draw_elements(draw, these);
}

void SceneInGl::draw_without_colors(std::size_t draw, Primitives these) const {
  const SavedArrays arrays(gl_);
  bind_vertices(draw);
  gl_.DisableClientState(GL_COLOR_ARRAY);
  draw_elements(draw, these);
}

void SceneInGl::draw_elements(std::size_t draw, Primitives these) const {
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, arrays_[draw].indices.name());
  const Topology topology = mesh(draw).topology;
  const std::uint32_t corners = corner_count(topology), first = these.first - ranges_[draw].first_primitive;
  gl_.DrawElements(gl_mode(topology), static_cast<GLsizei>(corners * these.count), GL_UNSIGNED_INT,
                   offset(std::uintptr_t{first} * corners * sizeof(std::uint32_t)));
}

void SceneInGl::draw_one_by_one(std::size_t draw, const std::function<void(std::uint32_t)>& before) const {
  const SavedArrays arrays(gl_);
  bind_vertices(draw);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, arrays_[draw].indices.name());
  const Topology topology = mesh(draw).topology;
  const std::uint32_t corners = corner_count(topology);
  for (std::uint32_t i = 0; i < ranges_[draw].primitive_count; ++i) {
    before(ranges_[draw].first_primitive + i);
    gl_.DrawElements(gl_mode(topology), static_cast<GLsizei>(corners), GL_UNSIGNED_INT,
                     offset(std::uintptr_t{i} * corners * sizeof(std::uint32_t)));
  }
}

void SceneInGl::draw_points(std::size_t draw) const {
  const SavedArrays arrays(gl_);
  bind_vertices(draw);
  gl_.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(ranges_[draw].vertex_count));
}

void SceneInGl::draw_points(std::size_t draw, Primitives these,
                            const std::function<void(std::uint32_t)>& before) const {
  const SavedArrays arrays(gl_);
  bind_vertices(draw);
  for (std::uint32_t k = 0; k < these.count; ++k) {
    before(k);
    gl_.DrawArrays(GL_POINTS, static_cast<GLint>(these.first + k), 1);
  }
}

void SceneInGl::draw_ids(std::size_t draw) const {
  const SavedArrays arrays(gl_);
  bind_corners(draw);
  gl_.ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Corner), offset(offsetof(Corner, id)));
  const Topology topology = mesh(draw).topology;
  gl_.DrawArrays(gl_mode(topology), 0, static_cast<GLsizei>(corner_count(topology) * ranges_[draw].primitive_count));
}

void SceneInGl::draw_id(std::size_t draw, std::uint32_t primitive) const {
  const SavedArrays arrays(gl_);
  bind_corners(draw);
  gl_.ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Corner), offset(offsetof(Corner, id)));
  const Topology topology = mesh(draw).topology;
  const auto count = static_cast<GLsizei>(corner_count(topology));
  const auto first = static_cast<GLint>(corner_count(topology) * (primitive - ranges_[draw].first_primitive));
  gl_.DrawArrays(gl_mode(topology), first, count);
}

void SceneInGl::draw_weights(std::size_t draw, Primitives these) const {
  const SavedArrays arrays(gl_);
  bind_corners(draw);
  gl_.ColorPointer(4, GL_FLOAT, sizeof(Corner), offset(offsetof(Corner, weight)));
  const Topology topology = mesh(draw).topology;
  const std::uint32_t corners = corner_count(topology), first = these.first - ranges_[draw].first_primitive;
  gl_.DrawArrays(gl_mode(topology), static_cast<GLint>(corners * first), static_cast<GLsizei>(corners * these.count));
}

}  // namespace plumbline::osmesa
