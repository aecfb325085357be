#include "reference/oracle/repeated.h"

#include <cmath>
#include <cstring>

namespace plumbline::math {

bool Repeated::same(std::uint32_t a, std::uint32_t b) const {
  const Triangle &of_a = projected_.triangles[a], &of_b = projected_.triangles[b];
  if (of_a.draw != of_b.draw && !placed_alike(scene_.draws[of_a.draw], scene_.draws[of_b.draw])) return false;
  const auto position = [&](const Triangle& t, std::size_t k) -> const glm::vec3& {
    return scene_.meshes[scene_.draws[t.draw].mesh].positions[t.corner[k] - ranges_[t.draw].first_vertex];
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::memcmp(&position(of_a, k), &position(of_b, k), sizeof(glm::vec3)) != 0) return false;
  }
  return true;
}

void Repeated::set_surfaces(std::span<PixelHit> hits) const {
  for (std::size_t i = 1; i < hits.size(); ++i) {
    Hit& hit = hits[i].hit;
    // A cut triangle's pieces may have a plane each.
    if (projected_.triangles[hit.primitive].cut || !std::isfinite(hits[i].win.half)) continue;
    for (std::size_t j = i; j-- > 0;) {
      Hit& earlier = hits[j].hit;
      if (earlier.z_lo != hit.z_lo || earlier.z_hi != hit.z_hi || !same(earlier.primitive, hit.primitive)) continue;
      if (earlier.surface == kNoSurface) earlier.surface = static_cast<std::int32_t>(earlier.primitive);
      hit.surface = earlier.surface;
      break;
    }
  }
}

}  // namespace plumbline::math
