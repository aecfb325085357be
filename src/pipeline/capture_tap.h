// The tap that records: every fragment as it passes, into a capture.
#pragma once

#include <span>
#include <vector>

#include "capture/renderer.h"
#include "pipeline/fragment.h"

namespace plumbline::pipeline {

class CaptureTap {
 public:
  static constexpr bool every_fragment = true;

  /// Planes always; fragments where the request asks for a stage from coverage to visibility. `bytes`: what else counts
  /// against the request's budget; the fragments that go beyond it throw OverBudget.
  CaptureTap(const Scene& scene, const Request& request, std::size_t bytes);

  template <class R>
  void fragments(const TriangleSetup<>& s, const Pixels<R>& p, Mask<R> covered, Mask<R> drawn, R z,
                 const Color<R>& attributes, const Color<R>& shaded) {
    each_lane<R>(s, p, covered, drawn, z, attributes, shaded, [](int) {});
  }
  template <class R>
  void fragments(const TriangleSetup<>& s, const Pixels<R>& p, Mask<R> covered, Mask<R> drawn, R z,
                 const SurfaceAttributes<R>& attributes, const Color<R>& shaded) {
    each_lane<R>(s, p, covered, drawn, z, attributes.color, shaded, [&](int i) {
      for (const Varying v : s.surface->surface->carried) {
        next_[static_cast<std::size_t>(v)] = lane_of<R>(attributes[v], i);
      }
      if (s.surface->surface->texture) {
        next_texel_ = {lane_of<R>(attributes.texel.color, i), lane(attributes.texel.lod, i)};
      }
    });
  }

  /// The planes of stages 5, 7, 9 and 10, and the fragments' records that the request names, sorted by triangle, y, x.
  /// Of `triangles`, those of requested primitives count.
  void hand_out(std::span<const WindowTriangle<float>> triangles, Capture& capture);

 private:
  using Fours = std::array<glm::vec4, kVaryings>;
  struct Fragment {
    std::uint32_t triangle, primitive;
    int x, y;
    float z;
    glm::vec4 attributes, shaded;
    bool drawn;
    std::uint32_t fours = 0;  // its place in fours_
  };

  template <class R>
  static glm::vec4 lane_of(const Color<R>& c, int i) {
    return {lane(c.r, i), lane(c.g, i), lane(c.b, i), lane(c.a, i)};
  }
  // `varyings(i)` lays those of lane i ready in next_.
  template <class R>
  void each_lane(const TriangleSetup<>& s, const Pixels<R>& p, Mask<R> covered, Mask<R> drawn, R z,
                 const Color<R>& attributes, const Color<R>& shaded, auto varyings) {
    for (int i = 0; i < Lanes<R>::width; ++i) {
      if (!lane(covered, i)) continue;
      varyings(i);
      add({s.triangle, s.primitive, static_cast<int>(lane(p.x, i)), static_cast<int>(lane(p.y, i)), lane(z, i),
           lane_of<R>(attributes, i), lane_of<R>(shaded, i), lane(drawn, i)});
      next_ = {};
      next_texel_ = {};
    }
  }
  void add(Fragment f);
  bool wanted(std::uint32_t primitive) const;
  void keep_budget() const;

  const Scene& scene_;
  const Request& request_;
  std::size_t bytes_;
  bool keep_;                   // fragments, not planes alone
  Plane<std::uint8_t> pixels_;  // whether their fragments are wanted; empty: all
  Planes planes_;
  std::vector<Fragment> fragments_;
  std::vector<Varying> carried_;  // to the fragments, by any draw
  Fours next_{};                  // of the fragment that comes next
  Texel<float> next_texel_;
  std::vector<Texel<float>> texels_;  // beside fours_; empty where no draw has a texture
  std::vector<Fours> fours_;          // beside fragments_, before they are sorted; empty where nothing is carried
};

}  // namespace plumbline::pipeline
