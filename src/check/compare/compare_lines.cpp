#include "check/compare/compare_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "check/bounds/open_pixels.h"
#include "check/bounds/units.h"
#include "check/compare/compare_records.h"
#include "check/compare/same_winners.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

struct Line {
  const WindowTriangle<double>* window = nullptr;
  std::vector<glm::ivec2> pixels;
};
// Key: primitive, and order among the primitive's lines (the edges of a triangle that is not filled).
using LinesOfPixels = std::map<std::pair<std::uint32_t, std::size_t>, Line>;

LinesOfPixels lines_of(const Records<double>& r) {
  LinesOfPixels lines;
  std::vector<Line*> line_of(r.triangles.size());
  std::size_t order = 0;
  for (std::size_t i = 0; i < r.triangles.size(); ++i) {
    const WindowTriangle<double>& t = r.triangles[i];
    order = i > 0 && r.triangles[i - 1].primitive == t.primitive ? order + 1 : 0;
    if (t.corners != 2) continue;
    line_of[i] = &lines[{t.primitive, order}];
    line_of[i]->window = &t;
  }
  for (const Covered& c : r.covered) {
    if (c.triangle < line_of.size() && line_of[c.triangle] != nullptr) {
      line_of[c.triangle]->pixels.emplace_back(c.x, c.y);
    }
  }
  return lines;
}

// The planes of coverage without the lines.
FragmentSums without(const LinesOfPixels& lines, const Planes& planes) {
  FragmentSums rest{planes.count, planes.id_sum};
  for (const auto& [key, line] : lines) {
    const std::uint32_t primitive = key.first;
    for (const glm::ivec2 p : line.pixels) {
      if (p.x >= rest.count.width() || p.y >= rest.count.height()) continue;
      rest.count(p.x, p.y) -= 1;  // wraps: removing what was never counted shows
      rest.id_sum(p.x, p.y) -= id_weight(primitive);
    }
  }
  return rest;
}

int distance(glm::ivec2 a, glm::ivec2 b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

// Pixels of one column (y-major line: row) that a line covers: the ends and the count.
struct Column {
  int low, high, count;
};
std::map<int, Column> columns_of(const std::vector<glm::ivec2>& pixels, int major) {
  std::map<int, Column> columns;
  for (const glm::ivec2 p : pixels) {
    const int at = p[1 - major];
    Column& c = columns.try_emplace(p[major], Column{at, at, 0}).first->second;
    c = {std::min(c.low, at), std::max(c.high, at), c.count + 1};
  }
  return columns;
}

// Distance [pixels, larger of x and y] of `pixel` from the nearest pixel in `columns`; if there are no columns, from
// the nearer end point of the line.
int deviation(glm::ivec2 pixel, const std::map<int, Column>& columns, const WindowTriangle<double>& line, int major) {
  int nearest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; columns.empty() && i < 2; ++i) {
    const glm::ivec2 end(whole_in_range(line.v[i].p_win.x), whole_in_range(line.v[i].p_win.y));
    nearest = std::min(nearest, distance(end, pixel));
  }
  const int place = pixel[major], across = pixel[1 - major];
  // A column farther than the nearest pixel so far holds no nearer one.
  const auto is_near = [&](int other) { return std::abs(other - place) < nearest; };
  const auto take = [&](const auto& column) {
    const int beside = std::max({column.second.low - across, across - column.second.high, 0});
    nearest = std::min(nearest, std::max(std::abs(column.first - place), beside));
  };
  const auto from = columns.lower_bound(place);
  for (auto at = from; at != columns.end() && is_near(at->first); ++at) take(*at);
  for (auto at = std::make_reverse_iterator(from); at != columns.rend() && is_near(at->first); ++at) take(*at);
  return nearest;
}

int major_axis(glm::dvec2 d) { return std::abs(d.x) >= std::abs(d.y) ? 0 : 1; }

// Pixels from `low` up to, and without, `high`.
struct Box {
  glm::ivec2 low, high;
};

// The pixels of the frame that a primitive's draw may cover.
Box box_of(const DrawIndex& draws, std::uint32_t primitive, glm::ivec2 extent) {
  Box out{glm::ivec2(0), extent};
  const Draw* draw = draws.draw(primitive);
  if (draw == nullptr || !draw->scissor) return out;
  const Scissor& scissor = *draw->scissor;
  out.low = glm::max(out.low, glm::ivec2(scissor.x, scissor.y));
  out.high = glm::min(out.high, glm::ivec2(scissor.x + scissor.width, scissor.y + scissor.height));
  return out;
}

// Properties of a line that both sides share.
struct LineShape {
  std::uint32_t primitive;
  const WindowTriangle<double>* window;  // the candidate's
  Box box;                               // the pixels that the line may cover
  int major = 0, width = 1;
  bool axis_open = false;  // the line is wide, and rounding decides along which axis

  Place at(glm::ivec2 p, const char* field) const {
    return {p.x, p.y, static_cast<std::int64_t>(primitive), field, true};
  }
};

// Holds the columns of one side to those of the other, and to the line's width.
void compare_columns(Meter& meter, const LineShape& line, const Line& of, const std::map<int, Column>& columns,
                     const std::map<int, Column>& others, double factor) {
  const auto off_by = [&](glm::ivec2 p, int off) { meter.value(off, factor, line.at(p, "pixels off"), 0, off); };
  for (const glm::ivec2 p : of.pixels) {
    if (others.contains(p[line.major]) && !line.axis_open) continue;
    const int open = line.axis_open ? line.width : 0;
    off_by(p, std::max(deviation(p, others, *line.window, line.major) - open, 0));
  }
  if (line.axis_open) return;
  const int across = 1 - line.major;
  for (const auto& [place, column] : columns) {
    const glm::ivec2 p = line.major == 0 ? glm::ivec2(place, column.low) : glm::ivec2(column.low, place);
    const bool cut = column.low == line.box.low[across] || column.high == line.box.high[across] - 1;
    const bool whole = column.high - column.low + 1 == column.count && (cut || column.count == line.width);
    meter.value(whole && column.count <= line.width ? 0 : kInfinite, 0, line.at(p, "width in a column"), line.width,
                column.count);
    const auto same = others.find(place);
    if (same == others.end()) continue;
    off_by(p, std::max(std::abs(column.low - same->second.low), std::abs(column.high - same->second.high)));
  }
}

void compare_line(Meter& meter, std::uint32_t primitive, const Line& candidate, const Line& reference, const Box& box,
                  double factor) {
  LineShape line{primitive, candidate.window, box};
  if (candidate.window == nullptr || reference.window == nullptr) {
    return meter.value(kInfinite, 0, line.at({-1, -1}, candidate.window == nullptr ? "line lacking" : "line extra"), 0,
                       0);
  }
  const auto& [a, b, last] = candidate.window->v;
  line.major = major_axis(b.snapped - a.snapped);
  line.width = static_cast<int>(candidate.window->width);
  line.axis_open = line.width > 1 && line.major != major_axis(glm::dvec2(b.p_win) - glm::dvec2(a.p_win));
  const auto columns = columns_of(candidate.pixels, line.major), others = columns_of(reference.pixels, line.major);
  compare_columns(meter, line, reference, others, columns, factor);
  compare_columns(meter, line, candidate, columns, others, factor);
  const auto count = static_cast<double>(columns.size()), wanted = static_cast<double>(others.size());
  if (!line.axis_open) meter.value(std::abs(count - wanted), factor, line.at({-1, -1}, "number"), count, wanted);
  if (candidate.pixels != reference.pixels) meter.ambiguous();
}

}  // namespace

Measurement compare_covered_lines(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor) {
  std::string why;
  const Planes &a = candidate.planes, &b = reference.planes;
  if (!same_size(a.count, b.count, why) || !same_size(a.id_sum, b.id_sum, why) || !same_size(a.count, a.id_sum, why)) {
    return mismatch("pixels", why, a.count.size());
  }
  const LinesOfPixels mine = lines_of(candidate.records), theirs = lines_of(reference.records);
  Meter meter("pixels");
  LinesOfPixels all = mine;
  all.insert(theirs.begin(), theirs.end());
  const glm::ivec2 extent(a.count.width(), a.count.height());
  const DrawIndex draws(scene);
  for (const auto& [key, line] : all) {
    const auto at = [&, wanted = key](const LinesOfPixels& lines) {
      const auto found = lines.find(wanted);
      return found == lines.end() ? Line{} : found->second;
    };
    compare_line(meter, key.first, at(mine), at(theirs), box_of(draws, key.first, extent), factor);
    meter.item();
  }
  const FragmentSums rest_a = without(mine, a), rest_b = without(theirs, b);
  for (int y = 0; y < a.count.height(); ++y) {
    for (int x = 0; x < a.count.width(); ++x) {
      const bool same = rest_a.count(x, y) == rest_b.count(x, y) && rest_a.id_sum(x, y) == rest_b.id_sum(x, y);
      meter.value(same ? 0 : kInfinite, 0, {x, y, -1, "beside the lines"}, rest_a.count(x, y), rest_b.count(x, y));
      meter.item();
    }
  }
  return meter.done();
}

Measurement compare_line_or_point_winners(const Scene& scene, const Capture& candidate, const Capture& reference,
                                          Stencils stencils) {
  const Planes &mine = candidate.planes, &theirs = reference.planes;
  std::string why;
  if (!same_size(mine.id_sum, theirs.id_sum, why) || !same_size(mine.count, theirs.count, why) ||
      !same_size(mine.count, mine.id_sum, why) || !same_size(mine.id, mine.count, why)) {
    return mismatch("pixels", why, mine.id.size());
  }
  if (candidate.records.depth.size() != candidate.records.covered.size()) {
    return mismatch("pixels", "not a depth for each fragment", mine.id.size());
  }
  const LegalWinners legal(scene, candidate.records);
  const OthersCover others_cover(mine, theirs);
  const auto is_open = [&](Meter&, int x, int y, const Winner& a, const Winner& b, bool held) {
    if (others_cover(x, y)) return true;
    const std::vector<LegalAnswer> answers = legal.at(x, y);
    const auto is_legal = [&](const Winner& winner) {
      return std::ranges::any_of(answers, [&](const LegalAnswer& answer) {
        return answer.primitive == winner.primitive && (!held || answer.stencil == winner.stencil);
      });
    };
    return is_legal(a) && is_legal(b);
  };
  return compare_winners_at_pixels(mine, theirs, stencils, is_open);
}

}  // namespace plumbline::check
