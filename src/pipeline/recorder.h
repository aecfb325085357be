// Recorder of a capture: records of stages 0 to 10, and planes of stages 5 and 7 to 10, of a frame as it is drawn.
#pragma once

#include <span>
#include <vector>

#include "capture/renderer.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// One fragment, as stages 5 to 10 made it.
struct Fragment {
  glm::ivec2 pixel;
  float z;  ///< in the frame's format
  const SurfaceAttributes<float>* attributes;
  Color<float> shaded;
  bool drawn;
};

/// Recorder that widens records to double and keeps those that a request names. Each call adds the records of one step,
/// in the order of render(): lights(); per draw, draw(), vertices(), attributes(); per primitive polygon(), triangle(),
/// fragment().
class Recorder {
 public:
  Recorder() = default;  ///< keeps nothing
  /// Makes the planes in `out`. `bytes`: memory in use that counts against the request's budget; a call that goes
  /// beyond the budget throws OverBudget. Scene, request and `out` must outlive the recorder.
  Recorder(const Scene& scene, const Request& request, std::size_t bytes, Capture& out);

  /// Whether fragment() is to be called for every fragment, hidden ones too.
  bool keeps_fragments() const { return out_ != nullptr; }

  /// Lights of the scene; not kept of a scene without draws.
  void lights(std::span<const LightSource<float>> lights);
  /// The draw whose records come next.
  void draw(const Draw& draw, const Matrices<float>& matrices);
  void vertices(std::span<const Vertex<float>> vertices);
  void attributes(std::span<const Attributes> attributes);
  void polygon(const Polygon& polygon);
  void triangle(const WindowTriangle& triangle, const std::array<Attributes, 3>& attributes);
  /// Next fragment of the last triangle.
  void fragment(const Fragment& fragment);

 private:
  bool keeps(Stage stage) const { return out_ != nullptr && request_->records.has(stage); }
  bool wanted(std::uint32_t primitive) const;
  void count(std::size_t bytes);

  const Scene* scene_ = nullptr;
  const Request* request_ = nullptr;
  Capture* out_ = nullptr;  // null: keeps nothing
  std::size_t bytes_ = 0;
  double depth_scale_ = 0;
  std::size_t fragment_bytes_ = 0;     // of one fragment's records; 0: none is kept
  Plane<std::uint8_t> wanted_pixels_;  // empty: all
  std::vector<Varying> carried_;       // by any draw
  const Draw* draw_ = nullptr;
  std::uint32_t triangles_ = 0;  // of wanted primitives, so far
  std::uint32_t primitive_ = 0;  // of the last triangle
};

}  // namespace plumbline::pipeline
