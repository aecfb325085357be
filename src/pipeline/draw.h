// Stages 0 to 4 over arrays: every draw of a scene becomes window triangles.
#pragma once

#include <span>
#include <vector>

#include "base/fixed_vector.h"
#include "capture/stages.h"
#include "pipeline/light_equation.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

struct Assembly;

/// The functions of stages 0 to 4; each can be called alone, and a test can put another in the place of one.
struct GeometryStages {
  Matrices<float> (*matrices)(const Scene&, const Draw&);
  FixedVector<LightSource<float>, 8> (*lights)(const Scene&);
  void (*vertex)(const Matrices<float>&, Normals, const Mesh&, std::vector<Vertex<float>>&);
  void (*light)(const Scene&, const Draw&, Lights, std::span<const Vertex<float>>, std::vector<Lit<float>>&);
  void (*carry)(const Scene&, const Draw&, Varying, Lights, std::span<const Vertex<float>>, std::vector<Vec4<float>>&);
  void (*clip)(const Assembly&, ClipPolygons<float>&);
  void (*window)(const Matrices<float>&, const Draw&, const ClipPolygons<float>&, std::span<const ClipPolygon>,
                 std::vector<WindowTriangle<float>>&);
  bool operator==(const GeometryStages&) const = default;
};
/// Those of this folder: matrices.h, vertex.h, light.h, carry.h, clip.h, window.h.
GeometryStages geometry_stages();

/// One of stages 0 to 4, draw by draw. Clip and window run once for the colour and once for each varying that the scene
/// carries: they treat them alike, so that what holds of a colour holds of it.
class GeometryRun {
 public:
  /// Of the scene from here on, in memory that is kept from one to the next.
  void begin(const Scene& scene, const GeometryStages& stages);

  /// Appends the draw's records of the stage to `out`, from those of the stages before in `in`; both may be one. The
  /// scene's lights come with the first draw's matrices; where `in` has none, stage 2 takes the scene's.
  void run(std::size_t draw, Stage stage, const Records<float>& in, Records<float>& out);
  std::size_t draws() const { return scene_->draws.size(); }
  std::size_t bytes() const;

 private:
  void light(std::size_t draw, const Records<float>& in, Records<float>& out) const;
  void clip(std::size_t draw, const Records<float>& in, Records<float>& out);
  void window(std::size_t draw, const Records<float>& in, Records<float>& out);

  const Scene* scene_ = nullptr;
  GeometryStages stages_{};
  std::vector<DrawRange> ranges_;
  std::vector<Varying> carried_;
  // One varying's, in the place of the colour.
  std::vector<Lit<float>> as_lit_;
  ClipPolygons<float> polygons_;
  std::vector<WindowTriangle<float>> triangles_;
};

/// What stages 0 to 4 hand on for a scene (records.covered and after stay empty).
struct Geometry {
  Records<float> records;
  std::vector<std::uint32_t> first_triangle;  ///< draw d has the triangles [first_triangle[d], first_triangle[d + 1])
};

Geometry run_geometry(const Scene& scene, const GeometryStages& stages);
/// Its records, into those of a scene before, whose memory is kept like that of the run.
void run_geometry(const Scene& scene, const GeometryStages& stages, GeometryRun& run, Records<float>& out);

/// The draws' shares of `triangles`, which are in draw order.
std::vector<std::uint32_t> triangles_of_draws(const Scene& scene, std::span<const WindowTriangle<float>> triangles);

}  // namespace plumbline::pipeline
