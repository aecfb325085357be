// The four triangle algorithms of the notes cover the same pixels as exact, bit for bit; one that is wrong in its ties
// or its signs does not.
#include "notes/raster/triangle_algorithms.h"
#include "tests/extent.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/exact/coverage.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/cross/random_scenes.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

using raster::Corners;
using raster::Span;
using raster::Spans;
using CoverFunction = std::function<Spans(const Corners&, int, int)>;

struct Algorithm {
  const char* name;
  CoverFunction cover;
};
const std::vector<Algorithm>& algorithms() {
  static const std::vector<Algorithm> kAll = {{"barycentric", raster::cover_by_barycentric},
                                              {"cross products", raster::cover_by_cross_products},
                                              {"lee", raster::cover_by_lee},
                                              {"scan line", raster::cover_by_scan_line}};
  return kAll;
}

Spans by_exact(const Corners& corners, int width, int height) {
  const exact::CoveredRows rows(corners, width, height);
  Spans out;
  for (int y = rows.y_begin(); y < rows.y_end(); ++y) {
    const exact::Span span = rows.row(y);
    if (span.begin < span.end) out.push_back({y, span.begin, span.end});
  }
  return out;
}

long pixels(const Spans& spans) {
  return std::accumulate(spans.begin(), spans.end(), 0L, [](long n, const Span& s) { return n + s.end - s.begin; });
}

std::string text(const Corners& c) {
  return fmt::format("({}, {}) ({}, {}) ({}, {})", c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y);
}

/// Triangles with corners in 1/256 pixel, of a kind that some algorithm might get wrong.
struct TriangleKind {
  const char* name;
  std::function<Corners(Random&)> corners;
};
constexpr int kWidth = 48, kHeight = 37;

const std::vector<TriangleKind>& triangle_kinds() {
  static const auto kBetween = [](Random& r, int low, int high) { return low + r.below(high - low + 1); };
  static const auto kNear = [](Random& r) {
    return glm::ivec2(kBetween(r, -4096, 256 * kWidth + 4096), kBetween(r, -4096, 256 * kHeight + 4096));
  };
  static const auto kCentre = [](Random& r) {
    return 256 * glm::ivec2(kBetween(r, -4, kWidth + 4), kBetween(r, -4, kHeight + 4));
  };
  static const auto kFar = [](Random& r, int reach) {
    return glm::ivec2(kBetween(r, -reach, reach), kBetween(r, -reach, reach));
  };
  static const std::vector<TriangleKind> kAll = {
      {"anywhere",
       [](Random& r) {
         const glm::ivec2 a = kNear(r), b = kNear(r), c = kNear(r);
         return Corners{a, b, c};
       }},
      {"on centres",
       [](Random& r) {
         const glm::ivec2 a = kCentre(r), b = kCentre(r), c = kCentre(r);
         return Corners{a, b, c};
       }},
      {"sub-pixel",
       [](Random& r) {
         const glm::ivec2 a = kNear(r);
         return Corners{a, a + kFar(r, 300), a + kFar(r, 300)};
       }},
      {"around a centre",
       [](Random& r) {
         const glm::ivec2 a = kCentre(r);
         return Corners{a + kFar(r, 3), a + kFar(r, 3), a + kFar(r, 3)};
       }},
      {"slivers",
       [](Random& r) {
         const glm::ivec2 a = kCentre(r), b = kCentre(r);
         return Corners{a, b, a + (b - a) / kBetween(r, 1, 9) + kFar(r, 2)};
       }},
      {"without area",
       [](Random& r) {
         const glm::ivec2 a = kCentre(r), step = kFar(r, 400);
         return Corners{a, a + kBetween(r, -9, 9) * step, a + kBetween(r, -9, 9) * step};
       }},
      {"huge, by a centre",
       [](Random& r) {
         const glm::ivec2 a = kCentre(r), step = kFar(r, 1 << 20);
         return Corners{a - kBetween(r, 0, 256) * step, a + kBetween(r, 0, 256) * step, kFar(r, 1 << 28)};
       }},
      {"the largest there are",
       [](Random& r) {
         const auto far = [&] {
           glm::ivec2 p = kFar(r, 1 << 29);
           if (r.below(2) == 0) p.x = p.x < 0 ? -(1 << 29) : 1 << 29;
           if (r.below(2) == 0) p.y = p.y < 0 ? -(1 << 29) : 1 << 29;
           return p;
         };
         return Corners{far(), far(), far()};
       }},
  };
  return kAll;
}

/// How many of a kind's triangles a cover has otherwise than exact.
struct Apart {
  int triangles = 0;
  long covered = 0;
  std::string first;
};
Apart apart(const CoverFunction& cover, const TriangleKind& kind, int count) {
  Apart out;
  Random random(7);
  for (int i = 0; i < count; ++i) {
    const Corners corners = kind.corners(random);
    const Spans expected = by_exact(corners, kWidth, kHeight);
    out.covered += pixels(expected);
    if (cover(corners, kWidth, kHeight) == expected) continue;
    if (out.triangles++ == 0) out.first = text(corners);
  }
  return out;
}

TEST(TriangleAlgorithms, EqualExactOn100000RandomTriangles) {
  constexpr int kCount = 12500;
  ASSERT_EQ(kCount * triangle_kinds().size(), 100000u);
  for (const TriangleKind& kind : triangle_kinds()) {
    for (const Algorithm& algorithm : algorithms()) {
      const Apart out = apart(algorithm.cover, kind, kCount);
      EXPECT_EQ(out.triangles, 0) << algorithm.name << ", " << kind.name << ": " << out.first;
      EXPECT_EQ(out.covered == 0, kind.name == std::string("without area")) << kind.name;
    }
  }
}

// Each mistake is made of the algorithm itself: mirrored, it has the other sides' ties.
Corners mirrored(Corners corners, bool in_x) {
  for (glm::ivec2& p : corners) in_x ? p.x = 256 * (kWidth - 1) - p.x : p.y = 256 * (kHeight - 1) - p.y;
  return corners;
}
Spans mirrored(Spans spans, bool in_x) {
  for (Span& s : spans)
    s = in_x ? Span{s.y, kWidth - s.end, kWidth - s.begin} : Span{kHeight - 1 - s.y, s.begin, s.end};
  if (!in_x) std::reverse(spans.begin(), spans.end());
  return spans;
}
CoverFunction mirrored(const CoverFunction& cover, bool in_x) {
  return [=](const Corners& c, int w, int h) { return mirrored(cover(mirrored(c, in_x), w, h), in_x); };
}
bool counter_clockwise(const Corners& c) {
  const glm::i64vec2 a = c[1] - c[0], b = c[2] - c[0];
  return a.x * b.y - a.y * b.x > 0;
}

TEST(TriangleAlgorithms, AMistakeInTiesOrSignsIsSeen) {
  const TriangleKind& on_centres = triangle_kinds()[1];
  for (const Algorithm& algorithm : algorithms()) {
    const CoverFunction& cover = algorithm.cover;
    const CoverFunction opposite = mirrored(mirrored(cover, true), false);
    const std::vector<Algorithm> mistakes = {
        {"large x sides in", mirrored(cover, true)},
        {"large y sides in", mirrored(cover, false)},
        {"large sides in", opposite},
        {"no sides in",
         [&](const Corners& c, int w, int h) {
           Spans both;
           const Spans small = cover(c, w, h), large = opposite(c, w, h);
           for (const Span& s : small) {
             for (const Span& l : large) {
               const Span in{s.y, std::max(s.begin, l.begin), std::min(s.end, l.end)};
               if (s.y == l.y && in.begin < in.end) both.push_back(in);
             }
           }
           return both;
         }},
        {"one winding alone",
         [&](const Corners& c, int w, int h) { return counter_clockwise(c) ? cover(c, w, h) : Spans{}; }},
        {"half a pixel off",
         [&](Corners c, int w, int h) {
           for (glm::ivec2& p : c) p += 128;
           return cover(c, w, h);
         }},
    };
    for (const Algorithm& mistake : mistakes) {
      const Apart out = apart(mistake.cover, on_centres, 500);
      EXPECT_GT(out.triangles, 0) << algorithm.name << ", " << mistake.name;
    }
    EXPECT_EQ(apart(mirrored(mirrored(cover, true), true), on_centres, 500).triangles, 0) << "mirrored twice is itself";
  }
}

// From the smallest frame to the largest, whose 2^28 pixels all four visit in the long form; in a run, its last rows
// and columns alone.
TEST(TriangleAlgorithms, EqualExactInFramesOfAllSizes) {
  constexpr int kFarthest = 1 << 29, kLargest = 16384, kLast = 256 * (kLargest - 8);
  const Corners all{{{-kFarthest, -kFarthest}, {kFarthest, -kFarthest}, {-kFarthest, kFarthest}}};
  const Corners diagonal{{{0, 0}, {256 * kLargest, 256 * kLargest}, {256 * kLargest, 0}}};
  const Corners last_rows{{{-kFarthest, kLast}, {kFarthest, kLast}, {0, kFarthest}}};
  const Corners last_columns{{{kLast, -kFarthest}, {kFarthest, 0}, {kLast, kFarthest}}};
  const auto expect_equal = [](const Corners& corners, int width, int height) {
    const Spans expected = by_exact(corners, width, height);
    for (const Algorithm& algorithm : algorithms()) {
      EXPECT_TRUE(algorithm.cover(corners, width, height) == expected)
          << algorithm.name << " " << width << " x " << height << " " << text(corners);
    }
    return expected.size();
  };
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, kLargest), glm::ivec2(kLargest, 1)}) {
    for (const Corners& corners : {all, diagonal}) expect_equal(corners, size.x, size.y);
  }
  EXPECT_EQ(expect_equal(last_rows, kLargest, kLargest), 8u);
  EXPECT_EQ(expect_equal(last_columns, kLargest, kLargest), static_cast<std::size_t>(kLargest));
  if (one_of(2) != 1) return;
  for (const Corners& corners : {all, diagonal}) expect_equal(corners, kLargest, kLargest);
}

TEST(TriangleAlgorithms, RefuseWhatCouldOverflow) {
  constexpr int kFarthest = 1 << 29;
  const Corners good{{{-kFarthest, 0}, {kFarthest, 0}, {0, kFarthest}}};
  for (const Algorithm& algorithm : algorithms()) {
    EXPECT_NO_THROW(algorithm.cover(good, 4, 4));
    for (std::size_t i = 0; i < 3; ++i) {
      Corners bad = good;
      bad[i].y = -kFarthest - 1;
      EXPECT_THROW(algorithm.cover(bad, 4, 4), std::out_of_range);
    }
    EXPECT_THROW(algorithm.cover(good, 0, 4), std::out_of_range);
    EXPECT_THROW(algorithm.cover(good, 4, 16385), std::out_of_range);
  }
}

TEST(TriangleAlgorithms, EqualExactOnEveryScenesTriangles) {
  constexpr std::size_t kMost = std::size_t{2} << 30;  // a million triangles' records
  long scenes = 0, triangles = 0, covered = 0;
  for (const auto& file : suite_files()) {
    if (++scenes % static_cast<long>(one_of(24)) != 0) continue;
    const Scene scene = load_scene(file, {});
    const Capture capture = pipeline::make_pipeline()->capture(scene, {StageSet{Stage::window}, false, {}, {}, kMost});
    std::array<int, 4> apart{};
    for (const WindowTriangle<double>& t : capture.records.triangles) {
      const Corners corners{t.v[0].snapped, t.v[1].snapped, t.v[2].snapped};
      const Spans expected = by_exact(corners, scene.frame.width, scene.frame.height);
      for (std::size_t i = 0; i < algorithms().size(); ++i) {
        apart[i] += algorithms()[i].cover(corners, scene.frame.width, scene.frame.height) == expected ? 0 : 1;
      }
      covered += pixels(expected);
    }
    for (std::size_t i = 0; i < apart.size(); ++i) EXPECT_EQ(apart[i], 0) << algorithms()[i].name << ", " << scene.name;
    triangles += static_cast<long>(capture.records.triangles.size());
  }
  std::printf("%ld scenes, %ld triangles, %ld covered pixels\n", scenes, triangles, covered);
  EXPECT_GT(scenes, 80);
  EXPECT_GT(covered, 1000000 / static_cast<long>(one_of(24)));
}

}  // namespace
}  // namespace plumbline
