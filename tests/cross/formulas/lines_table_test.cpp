// The line algorithms of class notes (004) 2.2 beside their formulas, in the notes' own octant, in 128 bits: the table
// goes on (transforms_table_test.cpp). All are integers, and equal. The incremental line is not here: its float k adds
// up to another number, by how much notes/raster/line_test.cpp tabulates.
#include "notes/raster/line.h"
#include "reference/exact/wide.h"
#include "tests/cross/transforms_table.h"

namespace plumbline::test {
namespace {

using exact::Int128;

/// From p to r, 0 <= slope <= 1, and what the notes call a, b and c.
struct Line {
  glm::ivec2 p, r;
  Int128 a() const { return r.y - p.y; }
  Int128 b() const { return -(r.x - p.x); }
  Int128 c() const { return Int128(r.x) * p.y - Int128(p.x) * r.y; }
};

Line line(Inputs& r) {
  const double reach = r.between(0, 1) < 0.002 ? 32767 : 63;  // few are long
  const auto whole = [&](double most) { return static_cast<int>(std::floor(r.between(0, most + 1))); };
  const int x0 = whole(reach), n = 1 + whole(reach - 1), y0 = whole(reach);
  return {{x0, y0}, {x0 + n, y0 + whole(n)}};
}

using DrawLine = std::vector<raster::LinePixel> (*)(const raster::LinePixel&, const raster::LinePixel&, glm::ivec2);

/// The y of each x, where `is_ne` says whether the next pixel is NE, or else E.
Row line_row(const char* formula, const char* ours, DrawLine draw, const char* reference,
             bool (*is_ne)(const Line&, Int128 x, Int128 y)) {
  return row(formula, ours, reference, 0, [=](Inputs& r) {
    const Line l = line(r);
    const auto pixels = draw({l.p, 0, glm::vec4(0)}, {l.r, 0, glm::vec4(0)}, {1 << 17, 1 << 17});
    Entries out = number(static_cast<double>(pixels.size()), l.r.x - l.p.x + 1);
    int x = l.p.x, y = l.p.y;
    for (const raster::LinePixel& pixel : pixels) {
      out.push_back({static_cast<double>(pixel.pixel.x), static_cast<Wide>(x), 1});
      out.push_back({static_cast<double>(pixel.pixel.y), static_cast<Wide>(y), 1});
      if (is_ne(l, x, y)) ++y;
      ++x;
    }
    return out;
  });
}

/// The middle M = (x + 1, y + 1/2) is below the line: a (x + 1) + b (y + 1/2) + c > 0.
bool by_f_of_m(const Line& l, Int128 x, Int128 y) { return 2 * l.a() * (x + 1) + l.b() * (2 * y + 1) + 2 * l.c() > 0; }

/// k (x + 1) + d, over dx, is farther from y than from y + 1.
bool by_k_and_d(const Line& l, Int128 x, Int128 y) {
  const Int128 dx = l.r.x - l.p.x, dy = l.r.y - l.p.y, d = l.p.y * dx - dy * l.p.x, at = dy * (x + 1) + d;
  return at - y * dx > (y + 1) * dx - at;
}

std::vector<Row> line_rows() {
  return {
      line_row("y = ROUND(k x + d) (004 2.2)", "brute_force_line", raster::brute_force_line,
               "the nearer of two, ties to E, 128 bits", by_k_and_d),
      line_row("f(M) = a (x+1) + b (y+1/2) + c", "midpoint_line", raster::midpoint_line, "its sign, 128 bits",
               by_f_of_m),
      line_row("f(Former) + a, f(Former) + a + b", "midpoint_line", raster::midpoint_line,
               "the nearer of two, ties to E, 128 bits", by_k_and_d),
  };
}

TEST(LinesTable, Of004) { expect_table(line_rows()); }

// The other way: ties to NE, and half of an odd b rounded down (b is negative: rounded to 0, the decisions are the
// same).
TEST(LinesTable, NamesASlip) {
  EXPECT_FALSE(holds(line_row("", "", raster::midpoint_line, "", [](const Line& l, Int128 x, Int128 y) {
    return 2 * l.a() * (x + 1) + l.b() * (2 * y + 1) + 2 * l.c() >= 0;
  })));
  EXPECT_FALSE(holds(line_row("", "", raster::midpoint_line, "", [](const Line& l, Int128 x, Int128 y) {
    return l.a() * (x + 1) + l.b() * y + (l.b() - 1) / 2 + l.c() > 0;
  })));
}

}  // namespace
}  // namespace plumbline::test
