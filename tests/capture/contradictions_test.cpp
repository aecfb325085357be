// Mistakes of a capture's export are named; what is sound is left alone.
#include "capture/contradictions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/temporary_path.h"
#include "capture/files/capture_folder.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

class Contradictions : public testing::Test {
 protected:
  static Capture of(const std::string& name) {
    Request request;
    request.records = StageSet::all();
    return pipeline::make_pipeline()->capture(suite_scene(name), request);
  }
  // The one line that is found after a change.
  template <class Change>
  std::string after(Change change) const {
    Capture c = sound_;
    change(c);
    const std::vector<std::string> found = contradictions(c);
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? "" : found.front();
  }
  const Capture sound_ = of("clip/crowd");
};

template <class T>
void turn_over(Plane<T>& plane) {
  for (int y = 0; y < plane.height() / 2; ++y) {
    for (int x = 0; x < plane.width(); ++x) std::swap(plane(x, y), plane(x, plane.height() - 1 - y));
  }
}

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(Contradictions, ASoundCaptureHasNone) {
  EXPECT_TRUE(contradictions(sound_).empty());
  EXPECT_TRUE(contradictions(Capture{}).empty());
}

TEST_F(Contradictions, DepthsInMinusOneToOne) {
  EXPECT_HAS(after([](Capture& c) {
               for (double& z : c.planes.depth.values()) z = 2 * z - 1;
             }),
             "still in [-1,1]? z / 2 + 1/2 is expected");
}

TEST_F(Contradictions, DepthsAsCodes) {
  EXPECT_HAS(after([](Capture& c) {
               for (double& z : c.planes.depth.values()) z = std::round(z * 65535);
             }),
             "planes.depth: ");
  EXPECT_HAS(after([](Capture& c) { c.records.depth[3] = NAN; }), "depth.value: 1 of ");
}

TEST_F(Contradictions, ColoursAsCodes) {
  EXPECT_HAS(after([](Capture& c) {
               for (glm::vec4& color : c.planes.color.values()) color = glm::round(color * 255.0f);
             }),
             "codes? code / (2^n - 1) is expected");
}

TEST_F(Contradictions, BrightColoursOfAFloatFrameAreNoCodes) {
  Capture c = of("texture/first_scene");
  for (glm::vec4& color : c.planes.color.values()) color = {2, 2, 2, 1};
  for (const std::string& line : contradictions(c)) EXPECT_EQ(line.find("codes?"), std::string::npos) << line;
}

TEST_F(Contradictions, RowsUpsideDown) {
  const Capture sky = of("texture/first_scene");  // above the floor nothing is drawn
  const auto flipped = [&](auto plane) {
    Capture c = sky;
    turn_over(c.planes.*plane);
    const std::vector<std::string> found = contradictions(c);
    return found.empty() ? "" : found.front();
  };
  EXPECT_HAS(flipped(&Planes::color), "is it, or planes.color, upside down?");
  EXPECT_HAS(flipped(&Planes::count), "is it, or planes.count, upside down?");
  EXPECT_HAS(after([](Capture& c) { c.planes.count(0, 0) += 1; }), "coverage.y: 1 pixels have another number");
}

TEST_F(Contradictions, APictureWithoutTriangles) {
  Capture c;
  c.renderer = "mine", c.version = "1";
  c.without_records = {"window"};
  c.planes.color = Plane<glm::vec4>(4, 2, glm::vec4(0, 0, 0, 1));
  c.planes.id = Plane<std::int32_t>(4, 2, kBackground);
  EXPECT_TRUE(contradictions(c).empty());
  c.planes.color(3, 1) = glm::vec4(1);
  EXPECT_EQ(contradictions_of(c, Stage::window, {}),
            std::vector<std::string>{"window.*: no triangle, and planes.color shows 1 drawn pixels"});
  c.planes.id(3, 1) = 0;
  EXPECT_EQ(contradictions_of(c, Stage::window, {}).size(), 2u);
  EXPECT_TRUE(contradictions_of(c, Stage::visibility, {}).empty());
}

TEST_F(Contradictions, WindowCornersThatAreNotFinite) {
  const auto corner = [](auto change) { return [=](Capture& c) { change(c.records.triangles[1].v[2]); }; };
  EXPECT_HAS(after(corner([](auto& v) { v.p_win.x = NAN; })), "window.p_win: 1 of ");
  EXPECT_HAS(after(corner([](auto& v) { v.p_win.y = INFINITY; })), " corners are not finite");
  EXPECT_HAS(after(corner([](auto& v) { v.inv_w = INFINITY; })), "window.inv_w: 1 of ");
  EXPECT_HAS(after(corner([](auto& v) { v.color.a = NAN; })), "window.color: 1 of ");
}

// Without conventions, positions may be snapped to any grid; else to the declared one alone.
TEST_F(Contradictions, SnappedPositionsThatAreNotTheWindowPositions) {
  const auto moved = [this](int by, const Conventions& conventions) {
    Capture c = sound_;
    c.records.triangles[1].v[2].snapped.y += by;
    return contradictions_of(c, Stage::window, conventions);
  };
  for (const int by : {0, 300, -300}) EXPECT_TRUE(moved(by, undeclared()).empty()) << by;
  ASSERT_EQ(moved(600, undeclared()).size(), 1u);
  EXPECT_HAS(moved(600, undeclared()).front(), "corners are not window.p_win: record 1 at (");
  Conventions declared;
  declared.tie_rule = Conventions::TieRule::left_bottom;
  EXPECT_TRUE(moved(0, declared).empty());
  ASSERT_EQ(moved(1, declared).size(), 1u);
  EXPECT_HAS(moved(-1, declared).front(), "window.p_win, rounded as the conventions declare: record 1 at (");
  Capture beyond = sound_;  // (int)(256 x), where the conventions declare rounding down
  declared.subpixel_rounding = Conventions::Rounding::down;
  beyond.records.triangles.resize(1);
  for (WindowVertex<double>& v : beyond.records.triangles[0].v) v.p_win = {-3.01, 7.25, 0.5}, v.snapped = {-898, 1728};
  EXPECT_TRUE(contradictions_of(beyond, Stage::window, declared).empty());
  for (WindowVertex<double>& v : beyond.records.triangles[0].v) v.snapped.x = -897;
  EXPECT_EQ(contradictions_of(beyond, Stage::window, declared).size(), 1u);
  // (int)((x - 1/2) * 256), before the first pixel's centre.
  for (WindowVertex<double>& v : beyond.records.triangles[0].v) v.p_win.x = 0.251, v.snapped.x = -63;
  EXPECT_TRUE(contradictions_of(beyond, Stage::window, declared).empty());
  for (WindowVertex<double>& v : beyond.records.triangles[0].v) v.p_win.x = 7.251, v.snapped.x = 1729;
  EXPECT_EQ(contradictions_of(beyond, Stage::window, declared).size(), 1u);
  // To the nearest 1/256 pixel, and half up from there to the nearest 1/16.
  declared.subpixel_rounding = Conventions::Rounding::nearest;
  declared.subpixel_bits = 4;
  for (WindowVertex<double>& v : beyond.records.triangles[0].v)
    v.p_win = {10.0308, 7.25, 0.5}, v.snapped = {2448, 1728};
  EXPECT_TRUE(contradictions_of(beyond, Stage::window, declared).empty());
  // Without a grid, of samples at no multiple of 1/256 pixel: moved, and rounded in any way.
  declared.subpixel_bits = Conventions::kFloat;
  declared.sample = glm::dvec2(0.3);
  for (const double own : {4.001, 4.0034, 4.0039}) {
    const double by = 0.2, place = std::floor((own - 0.5) * 256) + std::round(by * 256);
    for (WindowVertex<double>& v : beyond.records.triangles[0].v) {
      v.p_win = {own + by, own + by, 0.5};
      v.snapped = glm::ivec2(static_cast<int>(place));
    }
    EXPECT_TRUE(contradictions_of(beyond, Stage::window, declared).empty()) << own;
  }
  declared.sample = glm::dvec2(0.5);
  EXPECT_TRUE(moved(0, declared).empty());
  EXPECT_EQ(moved(2, declared).size(), 1u);
  declared.open = {"subpixel_bits"};
  EXPECT_TRUE(moved(300, declared).empty());
  Capture left_out = sound_;
  left_out.records.triangles[1].v[2].snapped.y += 600;
  left_out.derived = {"window.snapped"};
  EXPECT_TRUE(contradictions(left_out).empty());
}

TEST_F(Contradictions, ColoursThatAreNotTheWinnersFragments) {
  EXPECT_HAS(after([](Capture& c) {
               for (glm::vec4& color : c.planes.shaded.values()) color = 1.02f * color + 0.013f;
             }),
             "differ from shade.color of the winner's fragment");
  EXPECT_HAS(after([](Capture& c) { turn_over(c.planes.shaded); }), "; none, if its rows are turned over");
  Capture textured = of("texture/globe");
  EXPECT_TRUE(contradictions(textured).empty());
  for (glm::vec4& texel : textured.planes.texel.values()) texel.r *= 0.9f;
  ASSERT_EQ(contradictions(textured).size(), 1u);
  EXPECT_HAS(contradictions(textured)[0], "differ from texture.color of the winner's fragment");
}

// Judges look the primitive of a fragment up by its triangle, which is not there.
TEST_F(Contradictions, AFragmentBesideNoTriangleIsRefusedWhereItIsRead) {
  const TemporaryPath folder(temporary_files(), "contradictions-", TemporaryPath::Kind::folder);
  Capture c;
  c.width = c.height = 2;
  c.renderer = "mine", c.version = "1";
  c.without_records = {"window"};
  c.records.covered = {{0, 1, 1}};
  write_capture(c, folder.path());
  try {
    read_capture(folder.path());
    FAIL() << "read";
  } catch (const CaptureError& e) {
    EXPECT_HAS(std::string(e.what()), "coverage.triangle: element 0: expected a triangle below 0, found 0");
  }
}

TEST_F(Contradictions, TransposedMatrices) {
  EXPECT_HAS(after([](Capture& c) {
               for (auto& m : c.records.matrices) m.projection = glm::transpose(m.projection);
             }),
             "all are, if it is transposed: matrices are column by column");
  EXPECT_HAS(after([](Capture& c) { c.records.vertices[0].p_clip.x += 1; }), "vertex.p_clip: 1 of ");
}

TEST_F(Contradictions, NoSoundCaptureOfTheSuiteHasAny) {
  const auto renderer = pipeline::make_pipeline();
  for (const auto& file : suite_files()) {
    const Scene scene = load_scene(file);
    if (scene.meshes.front().triangles.size() > 20000 || antialiased(scene)) continue;
    Request request;
    request.records = StageSet::all();
    for (const std::string& line : contradictions(renderer->capture(scene, request))) {
      ADD_FAILURE() << scene.name << ": " << line;
    }
  }
}

}  // namespace
}  // namespace plumbline
