#include "reference/osmesa/line_records.h"

#include <algorithm>

#include "reference/osmesa/fragment_state.h"
#include "reference/osmesa/target.h"

namespace plumbline::osmesa {

void read_covered_lines(const Gl& gl, const SceneInGl& scene, Records<double>& records) {
  const FrameFormat& frame = scene.scene().frame;
  const Target target(gl, frame, ColorFormat::rgba8);
  const SavedState state(gl);
  target.bind();
  scene.clear(glm::vec4(0));
  gl.ShadeModel(GL_FLAT);
  gl.Disable(GL_LIGHTING);  // the records before may have left it on
  std::size_t draw = 0;
  for (std::uint32_t i = 0; i < records.triangles.size(); ++i) {
    const WindowTriangle<double>& line = records.triangles[i];
    if (line.corners != 2) continue;
    while (line.primitive >= scene.ranges()[draw].first_primitive + scene.ranges()[draw].primitive_count) ++draw;
    scene.set_matrices(draw);
    scene.set_fragments(draw);
    disable_tests(gl);
    target.bind();
    scene.draw_id(draw, line.primitive);
    // Its number is on no other line, so that what earlier ones left need not be cleared.
    const glm::dvec2 a(line.v[0].p_win), b(line.v[1].p_win), edge(frame.width, frame.height);
    const glm::ivec2 low(glm::clamp(glm::min(a, b) - 3.0, glm::dvec2(0), edge));
    const glm::ivec2 high(glm::clamp(glm::max(a, b) + 3.0, glm::dvec2(0), edge));
    if (low.x >= high.x || low.y >= high.y) continue;
    const Plane<std::uint32_t> codes = target.read_codes(low, high - low);
    for (int y = 0; y < codes.height(); ++y) {
      for (int x = 0; x < codes.width(); ++x) {
        if (codes(x, y) != line.primitive + 1) continue;
        records.covered.push_back({i, static_cast<std::uint16_t>(low.x + x), static_cast<std::uint16_t>(low.y + y)});
      }
    }
  }
  check(gl, "drawing the lines one by one");
}

}  // namespace plumbline::osmesa
