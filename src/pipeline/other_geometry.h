// What of a scene does not go through stages 0 to 4 in lanes (clipped triangles, for one), as a scene of its own
// through the definition of those stages.
#pragma once

#include <span>
#include <vector>

#include "pipeline/assemble.h"
#include "pipeline/draw.h"

namespace plumbline::pipeline {

std::size_t bytes_of(const Mesh& mesh);

/// Its memory is kept from frame to frame.
class OtherGeometry {
 public:
  /// `draws`: one for each of the scene's. Window triangles, by their primitives' numbers in the scene.
  const Records<float>& run(const Scene& scene, std::span<const AssemblyWork> draws);
  std::size_t bytes() const;

 private:
  void find(const AssemblyWork& draw);

  Scene rest_;
  std::vector<std::uint32_t> of_draw_;     // a mesh's primitives
  std::vector<std::uint32_t> primitives_;  // the rest's, in the scene
  GeometryRun run_;
  Records<float> records_;
};

}  // namespace plumbline::pipeline
