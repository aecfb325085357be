// The stages of the pipeline as functions, and what they hand to each other. (capture/stages.h is the map: what each
// stage does, and the records that captures hold of it.)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "capture/stages.h"
#include "kernels/attributes.h"
#include "kernels/coverage.h"
#include "kernels/depth.h"
#include "kernels/light_equation.h"
#include "kernels/shade.h"
#include "kernels/texture.h"
#include "pipeline/resolve.h"
#include "scene/fixed_vector.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

inline constexpr std::size_t kAttributes = 1 + kVaryings;  ///< the colour and every Varying

/// Attributes of a vertex: the colour first, then one for each Varying; zero where the draw does not carry it.
struct Attributes : std::array<Vec4<float>, kAttributes> {
  using std::array<Vec4<float>, kAttributes>::operator[];
  Vec4<float>& color() { return front(); }
  const Vec4<float>& color() const { return front(); }
  Vec4<float>& operator[](Varying v) { return (*this)[1 + index_of(v)]; }
  const Vec4<float>& operator[](Varying v) const { return (*this)[1 + index_of(v)]; }
};

/// Vertex of a polygon of stage 3.
struct ClipVertex {
  Vec4<float> p_clip;
  Attributes attributes;
  bool cut = false;  ///< made by a cut, not a vertex of the mesh
};
/// Convex polygon, line (2 corners) or point (1) of stage 3; no corners: nothing is left of the primitive.
struct Polygon {
  static constexpr std::size_t kMostCorners = kMostPolygonVertices;
  std::uint32_t primitive = 0;  ///< numbered over the scene (scene.h, DrawRange)
  FixedVector<ClipVertex, kMostCorners> corners;
};

/// Window triangle, line or point with its corners' attributes.
struct ShadedTriangle : WindowTriangle {
  std::array<Attributes, 3> attributes;
};

/// Per-draw input of stages 3 and 4. `draw` must outlive it.
struct DrawInput {
  const Draw* draw;
  Topology topology;
  bool depth_clamp;  ///< no near and far plane
  bool two_sided;    ///< back faces have colours of their own
  Matrices<float> matrices;
};
inline DrawInput draw_input(const Scene& scene, const Draw& draw, const Matrices<float>& matrices) {
  return {&draw, scene.meshes[draw.mesh].topology, scene.depth_clamp, carries(scene, draw, Varying::back_color),
          matrices};
}

/// Per-draw input of stage 2. All of it must outlive the struct.
struct LightInput {
  const Scene& scene;
  const Draw& draw;
  const Mesh& mesh;                         ///< the draw's
  Lights lights;                            ///< stage 0's
  std::span<const Vertex<float>> vertices;  ///< stage 1's, one per vertex of the mesh
};

/// Offsets from the pixel's centre at which a pass takes coverage, depth and attributes [1/256 pixel].
struct SampleOffsets {
  glm::ivec2 coverage, depth, color;
};

/// Side of the tiles that anchor planes [pixels]. Planes are evaluated from the centre of the lower left pixel of the
/// fragment's tile: from a far anchor, the terms of a sliver's sum would be too large for double. Where
/// PerspectiveSetup::in_blocks is set, q1, q2 and sum go on in float from the lower left pixel of its 4 x 4 block. No
/// other rule of tiles decides bits.
inline constexpr int kTile = 64;

/// Per-triangle input of stages 6 to 8, for the fragments of one tile.
struct TriangleSetup {
  BarycentricPlanes planes;
  DepthSetup depth;
  DepthPlane depth_plane;
  PerspectiveSetup perspective;
  std::array<AttributeSetup, kAttributes> attributes;  ///< the colour's, and those that the surface carries
  GradientSetup gradients;                             ///< of the texture coordinates, where there is a texture
};

/// Colour of a fragment, not yet clamped.
struct Shaded {
  Color<float> color;
  bool discarded = false;  ///< by a user's program
};

/// Stage functions, one or more per stage, none null; functions with `out` append to `out`. Faults, users' programs and
/// tests replace single functions.
struct Stages {
  // 0 matrices
  Matrices<float> (*matrices)(const Scene&, const Draw&);
  FixedVector<LightSource<float>, 8> (*lights)(const Scene&);
  // 1 vertex: one record for each vertex of the mesh
  void (*vertex)(const Matrices<float>&, Normals, const Mesh&, std::vector<Vertex<float>>& out);
  // 2 light: attributes of each vertex
  void (*light)(const LightInput&, std::vector<Attributes>& out);
  // 3 clip: the caller sets the assembled polygon's primitive
  Polygon (*assemble)(const DrawInput&, const glm::uvec3& corners, std::span<const Vertex<float>>,
                      std::span<const Attributes>);
  void (*clip)(const DrawInput&, Polygon&);
  // 4 window
  void (*window)(const DrawInput&, const Polygon&, std::vector<ShadedTriangle>& out);
  // 5 coverage: pixels row by row from the bottom, from left to right; `sample`: Formats::sample
  SampleOffsets (*sample_offsets)(glm::ivec2 sample);
  PixelBounds (*scissor)(const Scissor&, const PixelBounds& frame);
  std::vector<glm::ivec2> (*coverage)(const WindowTriangle& seen_from_sample, const PixelBounds& box);
  // 6 depth, in the frame's format: a code, or window z (z32f)
  DepthSetup (*depth_setup)(const WindowTriangle&, const DepthState&);
  float (*depth)(const TriangleSetup&, const Pixels<float>&);
  // 7 attributes: one attribute at one fragment
  Color<float> (*attributes)(const TriangleSetup&, const AttributeSetup&, const Pixels<float>&);
  // 8 texture
  FilteredTexel<float> (*texture)(const TextureSetup&, const TexCoords<float>&, const Gradients<float>&);
  // 9 shade
  Shaded (*shade)(const Surface&, bool front, const SurfaceAttributes<float>&);
  // 10 visibility; color_scale: the largest colour code, 0 for float
  bool (*depth_passes)(DepthFunc, float incoming, float stored);
  bool (*alpha_passes)(const AlphaTest&, float alpha, float color_scale);
  bool (*stencil_test)(const StencilFace&, bool alive, bool passes_depth, std::uint8_t* held);
  // 11 merge, in the frame's format: codes, or floats
  bool (*writes_depth)(bool passes_depth, bool drawn);  ///< true: the depth is stored, if the depth mask allows
  Merge (*merge_state)(const Merge& of_draw);
  Color<float> (*merge)(const Color<float>&, float color_scale);
  Color<float> (*blend)(const Blend&, const Color<float>& source, const Color<float>& stored, float color_scale);
  Color<float> (*logic)(LogicOp, const Color<float>& source, const Color<float>& stored, float color_scale);
  // 12 resolve
  ResolveStage resolve;

  bool operator==(const Stages&) const = default;
};
/// The pipeline's own stage functions: those of this folder and of the kernels.
Stages production_stages();

}  // namespace plumbline::pipeline
