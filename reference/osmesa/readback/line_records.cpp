#include "reference/osmesa/readback/line_records.h"

#include <algorithm>
#include <array>

#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/fragment_state.h"
#include "reference/osmesa/scene/target.h"

namespace plumbline::osmesa {
namespace {

// Offset of edges' colour codes, beyond all primitives' numbers.
constexpr std::uint32_t kEdge = 1u << 31;

// Draws only the edge of a triangle that ends in this corner. A corner's edge flag says whether the edge from it to the
// next corner is a boundary.
void draw_edge(const Gl& gl, const Mesh& mesh, const glm::uvec3& triangle, std::uint32_t corner, std::uint32_t code) {
  const SavedArrays arrays(gl);
  const std::array<GLboolean, 3> flags = {corner == 1, corner == 2, corner == 0};
  const std::array<glm::vec3, 3> positions = {mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                                              mesh.positions[triangle[2]]};
  const std::array<std::uint32_t, 3> codes = {code, code, code};
  gl.VertexPointer(3, GL_FLOAT, 0, positions.data());
  gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, codes.data());
  gl.EdgeFlagPointer(0, flags.data());
  gl.EnableClientState(GL_VERTEX_ARRAY);
  gl.EnableClientState(GL_COLOR_ARRAY);
  gl.EnableClientState(GL_EDGE_FLAG_ARRAY);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace

void read_covered_lines(const Gl& gl, const SceneInGl& scene, Records<double>& records) {
  const FrameFormat& frame = scene.scene().frame;
  const Target target(gl, frame, ColorFormat::rgba8);
  const PassState state(gl);
  target.bind();
  scene.clear(glm::vec4(0));
  gl.ShadeModel(GL_FLAT);
  gl.Disable(GL_LIGHTING);  // earlier records may have left it on
  std::size_t draw = 0;
  std::uint32_t edge = 0;  // number of the line in its triangle
  for (std::uint32_t i = 0; i < records.triangles.size(); ++i) {
    const WindowTriangle<double>& line = records.triangles[i];
    edge = i > 0 && records.triangles[i - 1].primitive == line.primitive ? edge + 1 : 0;
    if (line.corners != 2) continue;
    while (line.primitive >= scene.ranges()[draw].first_primitive + scene.ranges()[draw].primitive_count) ++draw;
    scene.set_matrices(draw);
    scene.set_fragments(draw);
    disable_tests(gl);
    target.bind();
    const Mesh& mesh = scene.scene().meshes[scene.scene().draws[draw].mesh];
    const bool of_triangle = mesh.topology == Topology::triangles;
    const std::uint32_t code = of_triangle ? kEdge + i : line.primitive + 1;
    if (of_triangle) {
      draw_edge(gl, mesh, mesh.triangles[line.primitive - scene.ranges()[draw].first_primitive], edge, code);
    } else {
      scene.draw_id(draw, line.primitive);
    }
    // The line's code is unique, so that earlier lines need not be cleared.
    const glm::dvec2 a(line.v[0].p_win), b(line.v[1].p_win), size(frame.width, frame.height);
    const double reach = 2.0 + line.width;
    const glm::ivec2 low(glm::clamp(glm::min(a, b) - reach, glm::dvec2(0), size));
    const glm::ivec2 high(glm::clamp(glm::max(a, b) + reach, glm::dvec2(0), size));
    if (low.x >= high.x || low.y >= high.y) continue;
    const Plane<std::uint32_t> codes = target.read_codes(low, high - low);
    for (int y = 0; y < codes.height(); ++y) {
      for (int x = 0; x < codes.width(); ++x) {
        if (codes(x, y) != code) continue;
        records.covered.push_back({i, static_cast<std::uint16_t>(low.x + x), static_cast<std::uint16_t>(low.y + y)});
      }
    }
  }
  check(gl, "drawing the lines one by one");
}

}  // namespace plumbline::osmesa
