// A scene in GL: the meshes of its draws, uploaded once, and the calls that set a draw's state and draw it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "capture/stages.h"
#include "reference/osmesa/gl/buffer.h"
#include "reference/osmesa/gl/gl.h"
#include "reference/osmesa/gl/program.h"
#include "reference/osmesa/scene/textures_in_gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

/// A range of a draw's primitives, by their numbers in the scene.
struct Primitives {
  std::uint32_t first, count;
};

class SceneInGl {
 public:
  /// Uploads the draws' meshes; keeps references to `gl` and `scene`. Throws RendererFailed for meshes whose arrays do
  /// not fit each other, and where OpenGL's limits do not suffice.
  SceneInGl(const Gl& gl, const Scene& scene);

  const Scene& scene() const { return scene_; }
  const std::vector<DrawRange>& ranges() const { return ranges_; }
  const Matrices<double>& matrices(std::size_t draw) const { return matrices_[draw]; }

  // GL state of the scene and its draws. Call within a PassState.
  void clear(const glm::vec4& color) const;   ///< to `color` and the frame's clear depth and stencil value
  void set_matrices(std::size_t draw) const;  ///< matrices, depth range and depth clamp
  void set_surface(std::size_t draw) const;   ///< light, material, shade model, texture, fog
  /// Sets the part of set_surface() that colours vertices. Feedback mode needs only this: it runs no fragments, and
  /// would lose vertex outputs that the fragments' state does not read.
  void set_vertex_light(std::size_t draw) const;
  bool has_vertex_program(std::size_t draw) const;  ///< whether set_vertex_light() uses a program (light_program.h)
  void set_fragments(std::size_t draw) const;  ///< culling, polygon modes, offset, widths, scissor, tests, depth mask
  void set_texture_source(std::size_t draw) const;  ///< fragments become their filtered texels
  void set_merge(std::size_t draw) const;           ///< blending, logic op and colour mask

  // Draw the draw's mesh under the state that is set.
  void draw_primitives(std::size_t draw) const;      ///< with normals and colours
  void draw_without_colors(std::size_t draw) const;  ///< with normals, in GL's current colour
  /// draw_primitives() with one GL call per primitive, and before(number of the primitive) before each.
  void draw_one_by_one(std::size_t draw, const std::function<void(std::uint32_t)>& before) const;
  void draw_points(std::size_t draw) const;  ///< each vertex as a point, with normals and colours
  /// The draw's vertices `these`, numbered from 0 within the draw, with one GL call per vertex; calls before(k) before
  /// the k-th.
  void draw_points(std::size_t draw, Primitives these, const std::function<void(std::uint32_t)>& before) const;
  void draw_ids(std::size_t draw) const;  ///< each primitive in the colour whose four bytes are its number + 1
  void draw_id(std::size_t draw, std::uint32_t primitive) const;  ///< draw_ids() of one primitive
  void draw_weights(std::size_t draw) const;  ///< each primitive in the colour (1, id_weight_part 0, 1, 2)
  // Overload for `these` alone.
  void draw_primitives(std::size_t draw, Primitives these) const;
  void draw_without_colors(std::size_t draw, Primitives these) const;
  void draw_weights(std::size_t draw, Primitives these) const;

 private:
  void set_fog(std::size_t draw) const;

  struct MeshVertex {
    glm::vec3 position, normal;
    glm::vec4 color;
    glm::vec2 texcoord;
  };
  struct Arrays {
    Buffer vertices;  ///< MeshVertex
    Buffer indices;   ///< the mesh's primitives
    Buffer corners;   ///< the corners of each primitive, not shared, so that each primitive can have its own colour
  };
  static std::vector<MeshVertex> vertices_of(const Mesh& mesh);
  Primitives all(std::size_t draw) const { return {ranges_[draw].first_primitive, ranges_[draw].primitive_count}; }
  void draw_elements(std::size_t draw, Primitives these) const;
  void bind_vertices(std::size_t draw) const;
  void bind_corners(std::size_t draw) const;
  const Mesh& mesh(std::size_t draw) const { return scene_.meshes[scene_.draws[draw].mesh]; }

  const Gl& gl_;
  const Scene& scene_;
  std::vector<DrawRange> ranges_;
  std::vector<Matrices<double>> matrices_;
  std::vector<Arrays> arrays_;
  std::vector<std::optional<Program>> light_programs_;  ///< per draw; set if needs_light_program()
  TexturesInGl textures_;
};

/// GL_TRIANGLES, GL_LINES or GL_POINTS.
GLenum gl_mode(Topology topology);

/// The mesh's colour at a vertex, or white where it has none.
glm::vec4 color_at(const Mesh& mesh, std::uint32_t vertex);

}  // namespace plumbline::osmesa
