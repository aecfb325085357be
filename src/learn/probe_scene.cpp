#include "learn/probe_scene.h"

#include <utility>

namespace plumbline::learn {

Scene probe_frame(std::string name, int width, int height) {
  Scene out;
  out.name = "probe/" + std::move(name);
  out.frame.width = width;
  out.frame.height = height;
  out.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  out.projection = Orthographic{0, static_cast<double>(width), 0, static_cast<double>(height), 0, 1};
  return out;
}

Draw& add_triangles(Scene& scene, std::span<const std::array<ProbeCorner, 3>> triangles) {
  Mesh mesh;
  for (const auto& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const ProbeCorner& corner : triangle) {
      mesh.positions.emplace_back(corner.p.x, corner.p.y, -corner.p.z);
      mesh.normals.emplace_back(0, 0, 1);
      mesh.colors.push_back(corner.color);
      mesh.texcoords.push_back(corner.texcoord);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  Draw draw;
  draw.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  draw.lit = false;
  scene.meshes.push_back(std::move(mesh));
  return scene.draws.emplace_back(std::move(draw));
}

std::array<std::array<ProbeCorner, 3>, 2> rectangle(glm::dvec2 low, glm::dvec2 high, double z, const glm::vec4& color) {
  return quad({{{{low.x, low.y, z}, color},
                {{high.x, low.y, z}, color},
                {{high.x, high.y, z}, color},
                {{low.x, high.y, z}, color}}});
}

std::array<std::array<ProbeCorner, 3>, 2> quad(const std::array<ProbeCorner, 4>& c) {
  return {{{c[0], c[1], c[2]}, {c[0], c[2], c[3]}}};
}

}  // namespace plumbline::learn
