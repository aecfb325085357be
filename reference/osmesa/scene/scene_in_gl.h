// A scene's meshes in GL's buffers, each draw's uploaded once, and the GL calls that draw them.
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

/// Some of a draw's primitives, by their numbers in the scene.
struct Primitives {
  std::uint32_t first, count;
};

class SceneInGl {
 public:
  /// Keeps a reference to the scene. Throws RendererFailed for meshes whose arrays do not fit each other.
  SceneInGl(const Gl& gl, const Scene& scene);

  const Scene& scene() const { return scene_; }
  const std::vector<DrawRange>& ranges() const { return ranges_; }
  const Matrices<double>& matrices(std::size_t draw) const { return matrices_[draw]; }

  // GL state of the scene and its draws. Call within a PassState.
  void clear(const glm::vec4& color) const;   ///< to a colour and the frame's other clear values
  void set_matrices(std::size_t draw) const;  ///< and the depth range
  void set_surface(std::size_t draw) const;   ///< lit or not, material, flat or smooth, fog
  /// Of that, what colours the vertices: feedback mode runs no fragments, and what they do not read would be lost in
  /// it.
  void set_vertex_light(std::size_t draw) const;
  bool has_vertex_program(std::size_t draw) const;  ///< whether that is a program, not the fixed function
  void set_fragments(std::size_t draw) const;       ///< culling, polygon modes and offset, widths, tests, depth mask
  void set_texture_source(std::size_t draw) const;  ///< its fragments become their filtered texels
  void set_merge(std::size_t draw) const;           ///< blending, logic op and colour mask

  // The draw's mesh, under the state that is set.
  void draw_primitives(std::size_t draw) const;      ///< with normals and colours
  void draw_without_colors(std::size_t draw) const;  ///< with normals, in the colour that is set
  /// As draw_primitives, calling before(its number) before each.
  void draw_one_by_one(std::size_t draw, const std::function<void(std::uint32_t)>& before) const;
  void draw_points(std::size_t draw) const;  ///< each vertex, with normals and colours
  /// Vertices of a draw, each as a point of its own, calling before(its number after the first) before each.
  void draw_points(std::size_t draw, Primitives these, const std::function<void(std::uint32_t)>& before) const;
  void draw_ids(std::size_t draw) const;  ///< each primitive in the colour whose four bytes are its number + 1
  void draw_id(std::size_t draw, std::uint32_t primitive) const;  ///< this one alone
  void draw_weights(std::size_t draw) const;  ///< each primitive in the colour (1, id_weight_part 0, 1, 2)
  // The same of `these` alone.
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
    Buffer corners;   ///< every primitive's corners alone, so that it can have a colour of its own
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
  std::vector<std::optional<Program>> light_programs_;  ///< where the fixed function has no such light
  TexturesInGl textures_;
};

/// GL_TRIANGLES, GL_LINES or GL_POINTS.
GLenum gl_mode(Topology topology);

/// The mesh's colour at a vertex, or white where it has none.
glm::vec4 color_at(const Mesh& mesh, std::uint32_t vertex);

}  // namespace plumbline::osmesa
