// The notes' mistakes as pictures: what each does to a picture is counted, and where it is none, under its own
// dialect's conventions, nothing is said. (That each is caught, and its stage named: test `fault_matrix`.)
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "check/judge/judge.h"
#include "faults/faults.h"
#include "faults/notes.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/suite.h"

namespace plumbline {

namespace {

const std::filesystem::path kFolder = suite_folder() / "notes";

/// The scenes of the notes, by file name without its ending.
const std::map<std::string, Scene>& scenes() {
  static const std::map<std::string, Scene> kScenes = [] {
    const std::filesystem::path folder[] = {kFolder};
    std::map<std::string, Scene> out;
    for (const auto& file : find_scenes(folder)) out.emplace(file.stem(), load_scene(file, {}));
    return out;
  }();
  return kScenes;
}

check::SceneVerdict judged(const Scene& scene, const pipeline::Stages& stages) {
  const auto candidate = pipeline::make_pipeline(stages);
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  return check::judge(scene, *candidate, references);
}

/// A scene with the mistake and without, all stages.
struct DrawnWithFault {
  Capture wrong, right;
  DrawnWithFault(std::string_view fault, const std::string& scene)
      : wrong(pipeline::make_pipeline(faults::named(fault).stages())
                  ->capture(scenes().at(scene), {.records = StageSet::all()})),
        right(pipeline::make_pipeline()->capture(scenes().at(scene), {.records = StageSet::all()})) {}
};

template <class T>
int pixels_apart(const Plane<T>& a, const Plane<T>& b) {
  int apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) apart += a.values()[i] != b.values()[i] ? 1 : 0;
  return apart;
}

int pixels_drawn(const Capture& capture) {
  const auto& id = capture.planes.id.values();
  return static_cast<int>(id.size()) - static_cast<int>(std::count(id.begin(), id.end(), kBackground));
}

/// Numbers of pixels that are covered never, once, and more often; and how often at most.
struct Count {
  int never = 0, once = 0, more = 0, most = 0;
};
Count count_of(const Capture& capture, int begin, int end) {
  Count out;
  for (int y = begin; y < end; ++y) {
    for (int x = begin; x < end; ++x) {
      const int n = static_cast<int>(capture.planes.count(x, y));
      ++(n == 0 ? out.never : n == 1 ? out.once : out.more);
      out.most = std::max(out.most, n);
    }
  }
  return out;
}

// Measured; the tests below derive what can be derived.
TEST(NotesPictures, PixelsOfAnotherColour) {
  struct Row {
    std::string_view fault;
    std::string scene;
    int apart;
  };
  for (const Row& row : {
           Row{"notes.000.v_is_w_cross_v", "gzrender_solids", 10353},
           Row{"notes.000.v_is_w_cross_v", "gzrender_meeting", 546},
           Row{"notes.000.no_clamp_of_n_l", "gzrender_backlit", 1146},
           Row{"notes.000.flipped_normals", "gzrender_backlit", 553},
           Row{"notes.000.strict_edges", "gzrender_on_centres", 88},
           Row{"notes.000.box", "gzrender_on_centres", 255},
           Row{"notes.000.box", "gzrender_solids", 9847},
           Row{"notes.000.affine_color", "gzrender_receding", 577},
           Row{"notes.002.lookat", "gl_solids", 11137},
           Row{"notes.002.sum_z_over_sum_w", "tinyrenderer_receding", 118},
           Row{"notes.002.eight_bit_depth", "tinyrenderer_meeting", 3},
           Row{"notes.002.eight_bit_depth", "tinyrenderer_fights", 2191},
           Row{"notes.002.affine_color", "tinyrenderer_receding", 1690},
           Row{"notes.004.eye_at_c", "gzrender_solids", 12528},
           Row{"notes.004.whole_centres", "gl_solids", 3600},
           Row{"notes.004.whole_centres", "gl_on_centres", 63},
           Row{"notes.004.delete_behind_view_plane", "gzrender_cut", 3302},
           Row{"notes.004.incremental_line", "gl_long_lines", 96},
           Row{"notes.004.lee_sign", "gzrender_on_centres", 119},
           Row{"notes.004.left_edges", "gzrender_on_centres", 32},
           Row{"notes.004.left_right_edges", "gzrender_on_centres", 70},
           Row{"notes.004.all_edges_in", "gzrender_on_centres", 72},
           Row{"notes.004.z_in_camera_space", "gzrender_receding", 63},
       }) {
    const DrawnWithFault drawn(row.fault, row.scene);
    EXPECT_EQ(pixels_apart(drawn.wrong.planes.color, drawn.right.planes.color), row.apart)
        << row.fault << " of " << drawn.right.planes.color.size() << " of " << row.scene;
  }
}

// Each in the conventions that make it right, or in a scene that does not ask.
TEST(NotesPictures, WhatIsNoMistakeChangesNothing) {
  struct Row {
    std::string_view fault;
    std::vector<std::string> scenes;
  };
  for (const Row& row : {
           Row{"notes.002.lookat", {"tinyrenderer_solids", "tinyrenderer_other_c", "gzrender_solids"}},
           Row{"notes.002.eight_bit_depth", {"tinyrenderer_eight_bits"}},
           Row{"notes.002.sum_z_over_sum_w", {"games101_both_depths", "gl_on_centres"}},  // orthographic: w is 1
           Row{"notes.002.affine_color", {"games101_both_depths", "gl_on_centres"}},
           Row{"notes.004.whole_centres", {"gzrender_solids", "tinyrenderer_solids"}},
           Row{"notes.004.eye_at_c", {"gl_solids", "games101_solids", "tinyrenderer_solids"}},
           Row{"notes.004.delete_behind_view_plane", {"gzrender_solids", "tinyrenderer_cut"}},
           Row{"notes.004.incremental_line", {"gl_solids"}},
           Row{"notes.004.left_right_edges", {"gzrender_solids"}},  // no centre is on an edge
           Row{"notes.000.strict_edges", {"gzrender_solids"}},
           Row{"notes.000.v_is_w_cross_v", {"gl_solids", "games101_solids", "tinyrenderer_solids"}},
       }) {
    for (const std::string& scene : row.scenes) {
      const check::SceneVerdict verdict = judged(scenes().at(scene), faults::named(row.fault).stages());
      EXPECT_EQ(check::first_different(verdict), nullptr) << row.fault << ", " << scene;
      const DrawnWithFault drawn(row.fault, scene);
      EXPECT_EQ(pixels_apart(drawn.wrong.planes.color, drawn.right.planes.color), 0) << row.fault << ", " << scene;
      EXPECT_EQ(pixels_apart(drawn.wrong.planes.depth, drawn.right.planes.depth), 0) << row.fault << ", " << scene;
    }
  }
}

// The fan: a square of corners (8, 8) and (24, 24) around the hub (16, 16), of 8 triangles. Within, 15 x 15 centres; of
// these the 8 spokes hold 7 each, and the hub is on all.
constexpr int kWithin = 15 * 15, kOnSpokes = 8 * 7;

TEST(NotesPictures, TheTieRulePaintsEachPixelOfTheFanOnce) {
  const DrawnWithFault drawn("notes.004.lee_sign", "gzrender_on_centres");
  for (const Capture* capture : {&drawn.right, &drawn.wrong}) {
    const Count within = count_of(*capture, 9, 24);
    EXPECT_EQ(within.once, kWithin);
    EXPECT_EQ(pixels_drawn(*capture), 16 * 16);
  }
  // With left taken for right each still belongs to one, but to the neighbour; and the square lies a pixel off.
  EXPECT_EQ(count_of(drawn.right, 8, 24).once, 16 * 16);
  EXPECT_EQ(count_of(drawn.wrong, 9, 25).once, 16 * 16);
}

TEST(NotesPictures, StrictEdgesLeaveGapsOnTheSpokes) {
  const DrawnWithFault drawn("notes.000.strict_edges", "gzrender_on_centres");
  const Count within = count_of(drawn.wrong, 9, 24);
  EXPECT_EQ(within.never, kOnSpokes + 1);
  EXPECT_EQ(within.once, kWithin - kOnSpokes - 1);
  EXPECT_EQ(within.more, 0);
  EXPECT_EQ(pixels_drawn(drawn.wrong), within.once) << "nor is the square's own border drawn";
}

TEST(NotesPictures, EdgesInArePaintedTwice) {
  const Count all = count_of(DrawnWithFault("notes.004.all_edges_in", "gzrender_on_centres").wrong, 9, 24);
  EXPECT_EQ(all.never, 0);
  EXPECT_EQ(all.more, kOnSpokes + 1);
  EXPECT_EQ(all.most, 8) << "at the hub";
  // Two spokes are horizontal: their pixels are nobody's, but for the hub, which four triangles have on other edges.
  const Count left_right = count_of(DrawnWithFault("notes.004.left_right_edges", "gzrender_on_centres").wrong, 9, 24);
  EXPECT_EQ(left_right.never, 2 * 7);
  EXPECT_EQ(left_right.more, kOnSpokes - 2 * 7 + 1);
  EXPECT_EQ(left_right.most, 4);
  // As a tie rule, each pixel is nobody's or one's.
  const Capture left = DrawnWithFault("notes.004.left_edges", "gzrender_on_centres").wrong;
  EXPECT_EQ(count_of(left, 9, 24).never, 2 * 7 + 1) << "of the hub's triangles, none has it on two left edges";
  EXPECT_EQ(count_of(left, 9, 24).more, 0);
  EXPECT_EQ(pixels_drawn(left), 16 * 16 - 16 - 16) << "a row of the border, and a row through the hub";
}

TEST(NotesPictures, TheBoxOfTheHubIsOnePixel) {
  EXPECT_EQ(pixels_drawn(DrawnWithFault("notes.000.box", "gzrender_on_centres").wrong), 1);
  const DrawnWithFault solids("notes.000.box", "gzrender_solids");
  std::map<std::uint32_t, int> pixels;
  for (const Covered& c : solids.wrong.records.covered) ++pixels[c.triangle];
  for (const auto& [triangle, n] : pixels) EXPECT_LE(n, 4) << triangle;
}

TEST(NotesPictures, WithAWrongVThePictureIsALine) {
  const DrawnWithFault drawn("notes.000.v_is_w_cross_v", "gzrender_solids");
  EXPECT_EQ(pixels_drawn(drawn.right), 10352);
  EXPECT_EQ(pixels_drawn(drawn.wrong), 4) << "slivers that rounding leaves";
  EXPECT_EQ(pixels_drawn(DrawnWithFault("notes.000.v_is_w_cross_v", "gzrender_meeting").wrong), 0);
  // y = -|t x w| x in eye space. Each is rounded four times at most, and the entries once, all terms below 8.
  const glm::dvec3 w = glm::normalize(glm::dvec3(-1.2, -1.5, -4));
  const double slope = -std::sqrt(1 - w.y * w.y);
  for (const Vertex<double>& v : drawn.wrong.records.vertices) {
    ASSERT_NEAR(v.p_eye.y, slope * v.p_eye.x, 2 * 5 * 8 * 0x1p-24);
  }
}

// Along the view: by d, 1 at 90 degrees, and by |eye - center|, 3. A vertex is rounded four times, its terms below 16.
TEST(NotesPictures, TheEyeIsElsewhere) {
  for (const auto& [fault, scene, nearer] : {std::tuple{"notes.004.eye_at_c", "gzrender_receding", 1.0},
                                             std::tuple{"notes.002.lookat", "gl_meeting", 3.0}}) {
    const DrawnWithFault drawn(fault, scene);
    const auto &right = drawn.right.records.vertices, &wrong = drawn.wrong.records.vertices;
    ASSERT_FALSE(right.empty());
    for (std::size_t i = 0; i < right.size(); ++i) {
      EXPECT_NEAR(wrong[i].p_eye.z - right[i].p_eye.z, nearer, 2 * 4 * 16 * 0x1p-24) << fault;
      EXPECT_EQ(wrong[i].p_eye.x, right[i].p_eye.x) << fault;
    }
  }
}

// The floor of the receding scenes: w of its near and of its far side.
struct Floor {
  double near, far;
};
constexpr double kNear = 0.28 * 0.58 + 0.96 * 0.66, kFar = 0.28 * 0.58 + 0.96 * 8.96;  // along the view, from `eye`
constexpr Floor kTiny{kNear, kFar}, kGz{1 + kNear, 1 + kFar};                          // d = 1 behind it

// At t of the way on the screen the far side's weight is t / (t + r (1 - t)), r = far / near, and not t: by at most
// (sqrt r - 1) / (sqrt r + 1), where t = sqrt r / (sqrt r + 1). Of that, the colours' largest difference, 0.9.
TEST(NotesPictures, AffineColour) {
  for (const auto& [fault, scene, floor] : {std::tuple{"notes.002.affine_color", "tinyrenderer_receding", kTiny},
                                            std::tuple{"notes.000.affine_color", "gzrender_receding", kGz}}) {
    const DrawnWithFault drawn(fault, scene);
    float largest = 0;
    for (std::size_t i = 0; i < drawn.right.planes.shaded.size(); ++i) {
      const glm::vec4 apart = glm::abs(drawn.right.planes.shaded.values()[i] - drawn.wrong.planes.shaded.values()[i]);
      largest = std::max({largest, apart.r, apart.g, apart.b});
    }
    const double root = std::sqrt(floor.far / floor.near), bound = 0.9 * (root - 1) / (root + 1);
    EXPECT_LE(largest, bound) << scene;
    EXPECT_GT(largest, 0.9 * bound) << scene << ": " << largest;
  }
}

// z = A + B / w, with w interpolated on the screen: at most B (sqrt far - sqrt near)^2 / (far near) away, where w is
// sqrt(far near). B is c/2 = 1/2 of TinyRenderer's, 1 of GzRender's.
TEST(NotesPictures, TheDepthOfALinearZHidesTheWrongSurface) {
  for (const auto& [fault, scene, floor, b, hidden] :
       {std::tuple{"notes.002.sum_z_over_sum_w", "tinyrenderer_receding", kTiny, 0.5, 118},
        std::tuple{"notes.004.z_in_camera_space", "gzrender_receding", kGz, 1.0, 63}}) {
    const DrawnWithFault drawn(fault, scene);
    double largest = 0;
    for (std::size_t i = 0; i < drawn.right.records.depth.size(); ++i) {
      largest = std::max(largest, std::abs(drawn.right.records.depth[i] - drawn.wrong.records.depth[i]));
    }
    const double bound = b * std::pow(std::sqrt(floor.far) - std::sqrt(floor.near), 2) / (floor.far * floor.near);
    EXPECT_LE(largest, bound + 0x1p-24) << scene;  // a step
    EXPECT_GT(largest, 0.99 * bound) << scene;
    EXPECT_EQ(pixels_apart(drawn.right.planes.id, drawn.wrong.planes.id), hidden) << scene;
  }
}

// Of two walls half a code apart, 0.51 of one by 127.5 / (1 - z/c)^2 a unit of z, the hidden one shows where both have
// one code: on 0.49 of the light one.
TEST(NotesPictures, EightBitsOfDepthLoseFights) {
  const DrawnWithFault fights("notes.002.eight_bit_depth", "tinyrenderer_fights");
  EXPECT_EQ(pixels_drawn(fights.right), 4458);
  EXPECT_EQ(pixels_apart(fights.right.planes.id, fights.wrong.planes.id), 2191);  // 0.491
  const auto depths = [](const Capture& c) {
    return std::set<double>(c.records.depth.begin(), c.records.depth.end()).size();
  };
  const DrawnWithFault meeting("notes.002.eight_bit_depth", "tinyrenderer_meeting");
  EXPECT_EQ(depths(meeting.right), 3961);
  EXPECT_EQ(depths(meeting.wrong), 150);
  // The same picture as with a buffer of 8 bits.
  const DrawnWithFault own("notes.002.eight_bit_depth", "tinyrenderer_eight_bits");
  EXPECT_EQ(pixels_apart(meeting.wrong.planes.id, own.right.planes.id), 0);
}

TEST(NotesPictures, WholeCentresAreHalfAPixelOff) {
  const DrawnWithFault drawn("notes.004.whole_centres", "gl_on_centres");
  const auto &right = drawn.right.records.triangles, &wrong = drawn.wrong.records.triangles;
  ASSERT_EQ(right.size(), 8);
  ASSERT_EQ(wrong.size(), 8);
  for (std::size_t i = 0; i < right.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      EXPECT_EQ(wrong[i].v[corner].snapped - right[i].v[corner].snapped, glm::ivec2(128, -128)) << "right and down";
    }
  }
}

// No line passes half way between two pixels, so that no tie is among them.
TEST(NotesPictures, TheIncrementalLineDriftsWithItsLength) {
  const DrawnWithFault drawn("notes.004.incremental_line", "gl_long_lines");
  const auto pixels = [](const Capture& capture) {
    std::map<std::pair<std::uint32_t, int>, int> out;  // y of each line at each x
    for (const Covered& c : capture.records.covered) out[{c.triangle, c.x}] = c.y;
    return out;
  };
  const auto right = pixels(drawn.right), wrong = pixels(drawn.wrong);
  ASSERT_EQ(right.size(), wrong.size());
  std::map<int, int> apart;  // by 1000 pixels
  for (const auto& [at, y] : right) {
    const int off = std::abs(wrong.at(at) - y);
    EXPECT_LE(off, 1);
    apart[at.second / 1000] += off;
  }
  std::vector<int> by_thousands;
  for (const auto& [thousand, n] : apart) by_thousands.push_back(n);
  EXPECT_EQ(by_thousands, (std::vector<int>{0, 3, 3, 1, 9, 11, 9, 13, 0}));  // the last is of 100 pixels
}

// The floor (0 and 1), the triangle on it (2) and three of the strewn ones.
TEST(NotesPictures, WhatCrossesTheViewPlaneIsGone) {
  const DrawnWithFault drawn("notes.004.delete_behind_view_plane", "gzrender_cut");
  const auto primitives = [](const Capture& capture) {
    std::set<std::uint32_t> out;
    for (const ClipPolygon& polygon : capture.records.polygons.polygons) out.insert(polygon.primitive);
    return out;
  };
  const std::set<std::uint32_t> right = primitives(drawn.right), wrong = primitives(drawn.wrong);
  std::vector<std::uint32_t> gone;
  std::set_difference(right.begin(), right.end(), wrong.begin(), wrong.end(), std::back_inserter(gone));
  EXPECT_EQ(right.size(), 42);
  EXPECT_EQ(gone, (std::vector<std::uint32_t>{0, 1, 2, 8, 19, 38}));
  EXPECT_TRUE(std::includes(right.begin(), right.end(), wrong.begin(), wrong.end()));
}

// The plate: N = (0, 0, -1), 0.9 of the light, and 0.02 of all directions.
TEST(NotesPictures, ThePlateWithItsBackToTheLight) {
  const glm::dvec3 blue(0.1, 0.3, 0.8), warm(0.9, 0.6, 0.3);
  const double n_dot_blue = 1 / std::sqrt(0.25 + 0.09 + 1), n_dot_warm = -1.5 / std::sqrt(1 + 1 + 2.25);
  const auto expect_near = [](const Capture& capture, const glm::dvec3& color) {
    const Vec4<double>& is = capture.records.lit.back().color;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(is[i], std::max(color[i], 0.0), 2e-7) << i;  // a few ULP of float
  };
  const DrawnWithFault unclamped("notes.000.no_clamp_of_n_l", "gzrender_backlit");
  expect_near(unclamped.right, 0.02 + 0.9 * n_dot_blue * blue);
  expect_near(unclamped.wrong, 0.02 + 0.9 * (n_dot_blue * blue + n_dot_warm * warm));
  expect_near(DrawnWithFault("notes.000.flipped_normals", "gzrender_backlit").wrong, 0.02 - 0.9 * n_dot_warm * warm);
}

}  // namespace
}  // namespace plumbline
