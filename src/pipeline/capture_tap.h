// The tap that records: every fragment as it passes, into a capture.
#pragma once

#include <span>
#include <vector>

#include "pipeline/fragment.h"
#include "stages/renderer.h"

namespace plumbline::pipeline {

class CaptureTap {
 public:
  static constexpr bool every_fragment = true;

  /// Planes always; fragments where the request asks for a stage from coverage to visibility. `bytes`: what else counts
  /// against the request's budget; the fragments that go beyond it throw OverBudget.
  CaptureTap(const Scene& scene, const Request& request, std::size_t bytes);

  template <class R>
  void fragments(const TriangleSetup<>& s, const Pixels<R>& p, Mask<R> covered, Mask<R> passes, R z,
                 const Color<R>& attributes, const Color<R>& shaded) {
    for (int i = 0; i < Lanes<R>::width; ++i) {
      if (!lane(covered, i)) continue;
      add({s.triangle,
           s.primitive,
           static_cast<int>(lane(p.x, i)),
           static_cast<int>(lane(p.y, i)),
           lane(z, i),
           {lane(attributes.r, i), lane(attributes.g, i), lane(attributes.b, i), lane(attributes.a, i)},
           {lane(shaded.r, i), lane(shaded.g, i), lane(shaded.b, i), lane(shaded.a, i)},
           lane(passes, i)});
    }
  }

  /// The planes of stages 5, 7, 9 and 10, and the fragments' records that the request names, sorted by triangle, y, x.
  /// Of `triangles`, those of requested primitives count.
  void hand_out(std::span<const WindowTriangle<float>> triangles, Capture& capture);

 private:
  struct Fragment {
    std::uint32_t triangle, primitive;
    int x, y;
    float z;
    glm::vec4 attributes, shaded;
    bool drawn;
  };
  void add(const Fragment& f);
  bool wanted(std::uint32_t primitive) const;
  void keep_budget() const;

  const Scene& scene_;
  const Request& request_;
  std::size_t bytes_;
  bool keep_;  // fragments, not planes alone
  Planes planes_;
  std::vector<Fragment> fragments_;
};

}  // namespace plumbline::pipeline
