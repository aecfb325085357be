#include "check/compare_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>

#include "check/bounds.h"

namespace plumbline::check {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Line {
  const WindowTriangle<double>* window = nullptr;
  std::vector<glm::ivec2> pixels;
};
using Lines = std::map<std::uint32_t, Line>;  // by primitive

Lines lines_of(const Records<double>& r) {
  Lines lines;
  for (const WindowTriangle<double>& t : r.triangles) {
    if (t.corners == 2) lines[t.primitive].window = &t;
  }
  for (const Covered& c : r.covered) {
    if (c.triangle >= r.triangles.size() || r.triangles[c.triangle].corners != 2) continue;
    lines[r.triangles[c.triangle].primitive].pixels.emplace_back(c.x, c.y);
  }
  return lines;
}

// The planes of coverage without the lines.
struct Rest {
  Plane<std::uint32_t> count;
  Plane<std::uint64_t> id_sum;
};
Rest without(const Lines& lines, const Planes& planes) {
  Rest rest{planes.count, planes.id_sum};
  for (const auto& [primitive, line] : lines) {
    for (const glm::ivec2 p : line.pixels) {
      if (p.x >= rest.count.width() || p.y >= rest.count.height()) continue;
      rest.count(p.x, p.y) -= 1;  // modulo 2^32, as the sum is modulo 2^64: what was never there shows
      rest.id_sum(p.x, p.y) -= id_weight(primitive);
    }
  }
  return rest;
}

int distance(glm::ivec2 a, glm::ivec2 b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

// How far a pixel lies from the one of `pixels` that corresponds to it; of none, from those that the line ends in.
int deviation(glm::ivec2 pixel, const std::vector<glm::ivec2>& pixels, const WindowTriangle<double>& line, int major) {
  std::vector<glm::ivec2> ends;
  if (pixels.empty()) ends = {glm::ivec2(glm::floor(line.v[0].p_win)), glm::ivec2(glm::floor(line.v[1].p_win))};
  int nearest = std::numeric_limits<int>::max();
  for (const glm::ivec2 p : pixels.empty() ? ends : pixels) {
    if (p[major] == pixel[major]) return distance(p, pixel);
    nearest = std::min(nearest, distance(p, pixel));
  }
  return nearest;
}

void compare_line(Meter& meter, std::uint32_t primitive, const Line& mine, const Line& theirs, double factor) {
  const auto at = [&](glm::ivec2 p, const char* field) {
    return Place{p.x, p.y, static_cast<std::int64_t>(primitive), field};
  };
  if (mine.window == nullptr || theirs.window == nullptr) {
    return meter.value(kInfinite, 0, at({-1, -1}, mine.window == nullptr ? "line lacking" : "line extra"), 0, 0);
  }
  const glm::dvec2 d = glm::abs(glm::dvec2(mine.window->v[1].p_win) - glm::dvec2(mine.window->v[0].p_win));
  const int major = d.x >= d.y ? 0 : 1;
  std::set<int> columns;
  for (const glm::ivec2 p : theirs.pixels) {
    const int off = deviation(p, mine.pixels, *mine.window, major);
    meter.value(off, factor, at(p, "pixels off"), 0, off);
    meter.value(columns.insert(p[major]).second ? 0 : kInfinite, 0, at(p, "twice in one column"), 0, 0);
  }
  const auto mine_count = static_cast<double>(mine.pixels.size()), count = static_cast<double>(theirs.pixels.size());
  meter.value(std::abs(mine_count - count), factor, at({-1, -1}, "number of pixels"), mine_count, count);
  if (mine.pixels != theirs.pixels) meter.ambiguous();
}

}  // namespace

Measurement compare_covered_lines(const Capture& candidate, const Capture& reference, double factor) {
  std::string why;
  const Planes &a = candidate.planes, &b = reference.planes;
  if (!same_size(a.count, b.count, why) || !same_size(a.id_sum, b.id_sum, why) || !same_size(a.count, a.id_sum, why)) {
    return mismatch("pixels", why, a.count.size());
  }
  const Lines mine = lines_of(candidate.records), theirs = lines_of(reference.records);
  Meter meter("pixels");
  Lines all = mine;
  all.insert(theirs.begin(), theirs.end());
  for (const auto& [primitive, line] : all) {
    const auto at = [&, number = primitive](const Lines& lines) {
      const auto found = lines.find(number);
      return found == lines.end() ? Line{} : found->second;
    };
    compare_line(meter, primitive, at(mine), at(theirs), factor);
    meter.item();
  }
  const Rest rest_a = without(mine, a), rest_b = without(theirs, b);
  for (int y = 0; y < a.count.height(); ++y) {
    for (int x = 0; x < a.count.width(); ++x) {
      const bool same = rest_a.count(x, y) == rest_b.count(x, y) && rest_a.id_sum(x, y) == rest_b.id_sum(x, y);
      meter.value(same ? 0 : kInfinite, 0, {x, y, -1, "beside the lines"}, rest_a.count(x, y), rest_b.count(x, y));
      meter.item();
    }
  }
  return meter.done();
}

Measurement compare_thin_winners(const Scene& scene, const Capture& candidate, const Capture& reference,
                                 double factor) {
  const Planes &mine = candidate.planes, &theirs = reference.planes;
  std::string why;
  if (!same_size(mine.id_sum, theirs.id_sum, why) || !same_size(mine.count, theirs.count, why) ||
      !same_size(mine.depth, theirs.depth, why) || !same_size(mine.count, mine.id_sum, why) ||
      !same_size(mine.depth, mine.count, why) || !same_size(mine.id, mine.count, why)) {
    return mismatch("pixels", why, mine.id.size());
  }
  const OffsetErrors offsets(scene);
  return compare_planes(mine.id, theirs.id, "pixels", [&](Meter& meter, int x, int y) {
    const std::int32_t a = mine.id(x, y), b = theirs.id(x, y);
    const bool held = !mine.stencil.empty() && mine.stencil.size() == theirs.stencil.size();
    const int stencil_a = held ? mine.stencil(x, y) : 0, stencil_b = held ? theirs.stencil(x, y) : 0;
    if (a == b && stencil_a == stencil_b) return;
    const bool alike = mine.id_sum(x, y) == theirs.id_sum(x, y) && mine.count(x, y) == theirs.count(x, y);
    if (!alike) return meter.ambiguous();
    if (a == b) return meter.value(1, 0, {x, y, -1, "stencil"}, stencil_a, stencil_b);
    // Each side's winner is the other's loser: their depths are apart by no more than one of them may be off.
    double off = 0;
    for (const std::int32_t primitive : {a, b}) {
      if (primitive == kBackground) continue;
      const PlaneBounds bounds = primitive_bounds(candidate.records, primitive, x, y);
      const double offset = offsets.of(candidate.records, primitive);
      off = std::max(off, factor * kUnitRoundoff * (bounds.depth + offset) + std::abs(bounds.along_depth));
    }
    const double z = theirs.depth(x, y);
    if (std::abs(mine.depth(x, y) - z) <= off + depth_step(scene.frame.depth, z)) return meter.ambiguous();
    meter.value(1, 0, {x, y, -1, "primitive"}, a, b);
  });
}

}  // namespace plumbline::check
