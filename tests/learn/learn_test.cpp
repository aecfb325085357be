// Conventions found from pictures and depths: of our renderer, of faults that are conventions, and of nonsense.
#include "learn/learn.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "capture/files/conventions_file.h"
#include "faults/faults.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::learn {
namespace {

using C = Conventions;
using Alter = std::function<void(Capture&)>;

// Another renderer's pictures, altered.
class Altered : public Renderer {
 public:
  Altered(std::unique_ptr<Renderer> renderer, Alter alter) : renderer_(std::move(renderer)), alter_(std::move(alter)) {}
  RendererInfo info() const override { return renderer_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    Capture out = renderer_->capture(scene, request);
    alter_(out);
    return out;
  }

 private:
  std::unique_ptr<Renderer> renderer_;
  Alter alter_;
};

std::unique_ptr<Renderer> faulted(const std::string& name) {
  for (const faults::Fault& fault : faults::all()) {
    if (fault.name == name) return pipeline::make_pipeline(fault.stages());
  }
  throw std::invalid_argument(name);
}

// Plumbline's own.
C ours() {
  C out;
  out.tie_rule = C::TieRule::left_bottom;
  return out;
}

C learned(std::unique_ptr<Renderer> renderer) { return learn(*renderer).conventions; }

TEST(Learn, OurRendererDrawsByTheDialect) {
  const auto renderer = pipeline::make_pipeline();
  const Learned found = learn(*renderer);
  EXPECT_EQ(conventions_text(found.conventions), conventions_text(ours()));
  EXPECT_TRUE(found.contradictions.empty());
  EXPECT_TRUE(mistaken(found.conventions).empty());
  const std::string text = learned_text(found);
  EXPECT_NE(text.find("subpixel_bits      8"), std::string::npos) << text;
  EXPECT_EQ(text.find("mistaken"), std::string::npos) << text;
}

// Each fault is one convention, and alters no other.
TEST(Learn, AFaultThatIsAConventionIsFound) {
  struct Case {
    const char* fault;
    void (*change)(C&);
  };
  const Case cases[] = {
      {"depth.truncated", [](C& c) { c.depth_rounding = C::Rounding::down; }},
      // What is blended, it rounds.
      {"merge.truncated", [](C& c) { c.color_rounding = C::Rounding::down, c.blending = C::Blending::in_codes; }},
      {"attributes.affine", [](C& c) { c.interpolation = C::Interpolation::affine; }},
      {"clip.first_vertex_provokes", [](C& c) { c.provoking_vertex = C::Provoking::first; }},
      {"coverage.inclusive_edges", [](C& c) { c.tie_rule = C::TieRule::inclusive; }},
      {"window.y_flipped", [](C& c) { c.rows = C::Rows::from_top, c.tie_rule = C::TieRule::left_top; }},
      {"window.snap_truncates", [](C& c) { c.subpixel_rounding = C::Rounding::down; }},
  };
  for (const Case& of : cases) {
    C expected = ours();
    of.change(expected);
    EXPECT_EQ(conventions_text(learned(faulted(of.fault))), conventions_text(expected)) << of.fault;
  }
}

TEST(Learn, RowsAndDepthsThatAreLeftOtherwiseAreFound) {
  const auto altered = [](const Alter& alter) {
    return learned(std::make_unique<Altered>(pipeline::make_pipeline(), alter));
  };
  EXPECT_EQ(altered([](Capture& c) {
              c.planes.color = upside_down(c.planes.color);
              c.planes.depth = upside_down(c.planes.depth);
            }).rows,
            C::Rows::from_top);
  EXPECT_EQ(altered([](Capture& c) {
              for (double& z : c.planes.depth.values()) z = 2 * z - 1;
            }).depth_range,
            C::DepthRange::minus_one_to_one);
  EXPECT_EQ(altered([](Capture& c) {
              for (double& z : c.planes.depth.values()) z = 1 - z;
            }).depth_range,
            C::DepthRange::one_to_zero);
  EXPECT_EQ(altered([](Capture& c) {
              for (double& z : c.planes.depth.values()) z = std::nearbyint(z * 65535) / 65535;
            }).depth_format,
            C::Depth::z16);
}

// What is nonsense leaves conventions open, at their defaults.
TEST(Learn, NonsenseIsOpen) {
  const auto of = [](const Alter& alter) {
    Altered renderer(pipeline::make_pipeline(), alter);
    return learn(renderer);
  };
  const Learned none = of([](Capture& c) { c.planes.depth = {}; });
  EXPECT_EQ(none.conventions.depth_rounding, C::Rounding::nearest);
  EXPECT_GE(std::ranges::count(none.rows, "open", &LearnedRow::value), 4);
  const std::string one_colour = "a white rectangle in the lower half of a black picture: every pixel has one colour";
  const Learned black = of([](Capture& c) { std::ranges::fill(c.planes.color.values(), glm::vec4(0, 0, 0, 1)); });
  ASSERT_FALSE(black.contradictions.empty());
  EXPECT_EQ(black.contradictions[0].find(one_colour), 0u) << black.contradictions[0];
  const Learned nan = of([](Capture& c) {
    std::ranges::fill(c.planes.color.values(), glm::vec4(std::numeric_limits<float>::quiet_NaN()));
  });
  ASSERT_FALSE(nan.contradictions.empty());
  EXPECT_EQ(nan.contradictions[0].find(one_colour), 0u) << nan.contradictions[0];
}

// A renderer that contradicts itself is told so, and what it contradicts keeps its default.
TEST(Learn, ContradictionsAreFindings) {
  const auto contradiction_of = [](const Alter& alter) {
    Altered renderer(pipeline::make_pipeline(), alter);
    const Learned found = learn(renderer);
    EXPECT_EQ(found.conventions.sample, glm::dvec2(0.5));
    return found.contradictions.empty() ? std::string() : found.contradictions.front();
  };
  float drift = 0;
  EXPECT_EQ(contradiction_of([&](Capture& c) { c.planes.color(0, 15).x = drift += 0.001f; }),
            "one scene drawn twice differs");
  const std::string shifted = contradiction_of([](Capture& c) {
    const Plane<glm::vec4> drawn = c.planes.color;
    for (int y = 0; y < drawn.height(); ++y) {
      for (int x = 0; x < drawn.width(); ++x) c.planes.color(x, y) = drawn((x + 3) % drawn.width(), y);
    }
  });
  EXPECT_EQ(shifted, "window positions go by one grid in x, by another in y");
  EXPECT_EQ(contradiction_of([](Capture& c) {
              for (glm::vec4& v : c.planes.color.values()) v = glm::vec4(glm::vec3(0), 1);
              c.planes.color(3, 3) = glm::vec4(1);
            }),
            "a rectangle of 128 pixels in the lower half: 1 pixels there, 0 in the upper half");
}

TEST(Learn, ARendererThatDrawsNoRectangleIsRefused) {
  Altered renderer(pipeline::make_pipeline(), [](Capture&) { throw Unsupported("no"); });
  EXPECT_THROW(learn(renderer), Unsupported);
  Altered empty(pipeline::make_pipeline(), [](Capture& c) { c.planes.color = {}; });
  EXPECT_THROW(learn(empty), Unsupported);
}

}  // namespace
}  // namespace plumbline::learn
