// Mesa's other driver draws lines by Bresenham's algorithm, half open, between the pixels that their ends lie in: a
// third rule, whose pixels are known beforehand. ctest gives the suite a process without an llvmpipe context.
#include <cstdlib>

#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "tests/cross/pixels_by_rows.h"
#include "tests/cross/thin_scenes.h"

namespace plumbline::test {
namespace {

// In integers. An exact tie takes the diagonal step (NE).
Pixels bresenham(glm::ivec2 a, glm::ivec2 b) {
  const glm::ivec2 d = glm::abs(b - a), step(b.x < a.x ? -1 : 1, b.y < a.y ? -1 : 1);
  const int major = d.x > d.y ? 0 : 1, minor = 1 - major;
  Pixels pixels;
  glm::ivec2 p = a;
  int error = 2 * d[minor] - d[major];
  for (int i = 0; i < d[major]; ++i) {
    pixels.push_back(p);
    p[major] += step[major];
    if (error >= 0) {
      p[minor] += step[minor];
      error -= 2 * d[major];
    }
    error += 2 * d[minor];
  }
  return pixels;
}

TEST(OsmesaSoftpipeLines, AreBresenhamsOnFlooredEnds) {
  RandomThings random(1);
  std::vector<glm::vec3> ends;
  for (int i = 0; i < 6000; ++i) ends.emplace_back(random.number(1, 47), random.number(1, 47), 0);
  Scene scene = pixel_scene(48, 48);
  add(scene, thin_mesh(Topology::lines, ends));
  const Capture capture =
      make_opengl(MesaDriver::softpipe)->capture(scene, {{Stage::window, Stage::coverage}, false, {}, {}});
  std::vector<Pixels> lines(capture.records.triangles.size());
  ASSERT_EQ(lines.size(), ends.size() / 2);
  for (const Covered& c : capture.records.covered) lines[c.triangle].emplace_back(c.x, c.y);
  int differing = 0, inclusive = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const WindowTriangle<double>& t = capture.records.triangles[i];
    const glm::ivec2 a(glm::floor(glm::dvec2(t.v[0].p_win))), b(glm::floor(glm::dvec2(t.v[1].p_win)));
    Pixels expected = by_rows(bresenham(a, b));
    differing += lines[i] != expected;
    expected.push_back(b);
    inclusive += lines[i] != by_rows(expected);
  }
  EXPECT_EQ(differing, 0);
  EXPECT_EQ(inclusive, 3000);  // with its last pixel it would be wrong on every line
}

}  // namespace
}  // namespace plumbline::test
