// Conventions that plumb learn finds in renderers of courses: GAMES101's, CSCI-580's GzRender.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "capture/files/conventions_file.h"
#include "tests/learn/altered_renderers.h"

namespace plumbline::learn {
namespace {

bool is_said(const C& conventions, const std::string& text) {
  return std::ranges::any_of(conventions.unexplained,
                             [&](const std::string& says) { return says.find(text) != says.npos; });
}

// Floats that lie between codes of 24 bits, off by less than half of one.
TEST(LearnCourses, DepthsThatAreKeptAsFloatsAreFloats) {
  const C found = learned(std::make_unique<Altered>(pipeline::make_pipeline(), [](Capture& c) {
    for (double& z : c.planes.depth.values()) z += 0.4 / 16777215;
  }));
  EXPECT_EQ(found.depth_format, C::Depth::z32f);
  EXPECT_EQ(std::ranges::count(found.open, "depth_arithmetic"), 0);
}

// Codes of 24 bits, left as floats, as glReadPixels() gives them.
TEST(LearnCourses, CodesThatAreLeftAsFloatsAreCodes) {
  const auto altered = [](double (*left)(double)) {
    return learned(std::make_unique<Altered>(pipeline::make_pipeline(), [left](Capture& c) {
      for (double& z : c.planes.depth.values()) z = left(z);
    }));
  };
  const auto in_float = [](double z) { return static_cast<double>(static_cast<float>(z)); };
  EXPECT_EQ(altered(in_float).depth_format, C::Depth::as_asked);
  EXPECT_EQ(altered([](double z) { return static_cast<double>(static_cast<float>(2 * z - 1)); }).depth_format,
            C::Depth::as_asked);
  EXPECT_EQ(altered([](double z) { return static_cast<double>(static_cast<float>(1 - z)); }).depth_format,
            C::Depth::as_asked);
  const auto to_floats = [](Scene& scene) { scene.frame.depth = DepthFormat::z32f; };
  OfAlteredScenes floats;
  floats.before = to_floats;
  EXPECT_EQ(learn(floats).conventions.depth_format, C::Depth::z32f);
  floats.after = [](const Scene&, Capture& out) {
    for (double& z : out.planes.depth.values()) z = 2 * z - 1;
  };
  EXPECT_EQ(learn(floats).conventions.depth_format, C::Depth::z32f);
}

// Pixels of a picture whose rows count from the top, sampled at whole numbers: at their upper left corners.
TEST(LearnCourses, ASampleMayLieAtThePixelsUpperBorder) {
  for (const glm::dvec2 sample : {glm::dvec2(1, 0.5), glm::dvec2(0.5, 1)}) {
    OfAlteredScenes renderer;
    renderer.before = [=](Scene& scene) { scene.frame.pass.shift += 0.5 - sample; };
    const C found = learn(renderer).conventions;
    EXPECT_EQ(found.sample, sample) << conventions_text(found);
    EXPECT_FALSE(is_said(found, "shifted"));
  }
  OfAlteredScenes farther;  // by a whole pixel more
  farther.before = [](Scene& scene) { scene.frame.pass.shift.y -= 0.5; };
  farther.after = [](const Scene& scene, Capture& c) {
    if (scene.name != "probe/shift") return;
    for (int y = 1; y < c.planes.color.height(); ++y) {
      for (int x = 0; x < c.planes.color.width(); ++x) c.planes.color(x, y - 1) = c.planes.color(x, y);
    }
  };
  EXPECT_TRUE(is_said(learn(farther).conventions, "shifted by 0, -2 pixels"));
}

TEST(LearnCourses, AStrayPixelMovesNoPicture) {
  OfAlteredScenes renderer;
  renderer.after = [](const Scene& scene, Capture& c) {
    if (scene.name == "probe/shift") c.planes.color(0, 1) = glm::vec4(1);
  };
  EXPECT_FALSE(is_said(learn(renderer).conventions, "shifted"));
}

// Conventions learned of a renderer that makes codes of linear colours in its own way.
C learned_of_codes(double (*code_of)(double)) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) { scene.frame.color = ColorFormat::rgba32f; };
  renderer.after = [=](const Scene&, Capture& capture) {
    for (glm::vec4& color : capture.planes.color.values()) {
      for (int k = 0; k < 4; ++k) color[k] = static_cast<float>(code_of(static_cast<double>(color[k])) / 255);
    }
  };
  return learn(renderer).conventions;
}

TEST(LearnCourses, CodesOf12BitsAndOf256AreNamed) {
  const C of_12_bits = learned_of_codes([](double c) { return std::floor(std::floor(4095 * c) / 16); });
  const C of_256 = learned_of_codes([](double c) { return std::min(255.0, std::floor(256 * c)); });
  EXPECT_TRUE(is_said(of_12_bits, "4095 c in 12 bits"));
  EXPECT_TRUE(is_said(of_256, "256 c, truncated"));
  EXPECT_EQ(std::ranges::count(of_256.open, "texture_bits"), 0) << "a code off, the rest still shows";
  EXPECT_FALSE(is_said(learned_of_codes([](double c) { return std::round(255 * c); }), "color_rounding"));
}

// Colours that are not rounded, encoded by a gamma besides, or of 10 bits say nothing of blending, nor of texels.
TEST(LearnCourses, NumbersThatAreNoCodesAreOneFinding) {
  for (const auto code_of : {+[](double c) { return 255 * c; }, +[](double c) { return 255 * std::pow(c, 1 / 2.2); },
                             +[](double c) { return 255 * std::round(1023 * c) / 1023; }}) {
    const C found = learned_of_codes(code_of);
    EXPECT_TRUE(is_said(found, "numbers are no codes of 8 bits"));
    for (const char* name : {"color_rounding", "blending", "texture_bits", "fragment_colors"}) {
      EXPECT_EQ(std::ranges::count(found.open, name), 1) << name;
      EXPECT_EQ(is_said(found, name), std::string_view(name) == "color_rounding");
    }
  }
}

TEST(LearnCourses, AGammaIsNamedAndNothingElseMistakenForIt) {
  const C gamma = learned_of_codes([](double c) { return std::round(255 * std::pow(c, 1 / 2.2)); });
  EXPECT_TRUE(is_said(gamma, "c to the power 1/2.2, a gamma"));
  EXPECT_EQ(gamma.unexplained.size(), 1u) << fmt::format("{}", fmt::join(gamma.unexplained, "\n"));
  for (const char* name : {"blending", "texture_bits", "level_of_detail", "half_way_level"})
    EXPECT_EQ(std::ranges::count(gamma.open, name), 1) << name;
}

// Fails on the probes of these names.
struct Failing : OfAlteredScenes {
  explicit Failing(std::vector<std::string> names) {
    before = [names](Scene& scene) {
      if (std::ranges::count(names, scene.name) > 0) throw RendererFailed("signal 11");
    };
  }
};

TEST(LearnCourses, AProbeThatFailsIsAFindingAndTheOthersGoOn) {
  Failing one({"probe/colours"});
  const C found = learn(one).conventions;
  EXPECT_TRUE(is_said(found, "probe/colours: signal 11"));
  EXPECT_EQ(std::ranges::count(found.open, "color_rounding"), 1);
  EXPECT_EQ(found.tie_rule, C::TieRule::left_bottom);
  Failing first({"probe/rows"}), three({"probe/colours", "probe/provoking_vertex", "probe/alpha_test"});
  EXPECT_THROW(learn(first), RendererFailed);
  const C rest_open = learn(three).conventions;
  EXPECT_EQ(rest_open.tie_rule, C::TieRule::left_bottom) << "found before the third failure";
  for (const char* name : {"color_rounding", "provoking_vertex", "alpha_test", "half_way_level"})
    EXPECT_EQ(std::ranges::count(rest_open.open, name), 1) << name;
}

// Alphas and references in codes that are rounded up or down are told from floats.
TEST(LearnCourses, AlphasInTruncatedCodesAreAFinding) {
  const auto learned_of = [](float (*kept)(float)) {
    OfAlteredScenes renderer;
    renderer.before = [=](Scene& scene) {
      for (Draw& draw : scene.draws) {
        if (!draw.alpha_test) continue;
        draw.alpha_test->reference = kept(255 * draw.alpha_test->reference) / 255;
        for (glm::vec4& color : scene.meshes[draw.mesh].colors) color.a = kept(255 * color.a) / 255;
      }
    };
    return learn(renderer).conventions;
  };
  EXPECT_TRUE(is_said(learned_of(std::floor), "codes are not rounded to nearest"));
  EXPECT_TRUE(is_said(learned_of(std::ceil), "codes are not rounded to nearest"));
  EXPECT_EQ(learned_of(std::round).alpha_test, C::AlphaTest::in_codes);
  OfAlteredScenes of_references;
  of_references.before = [](Scene& scene) {
    for (Draw& draw : scene.draws) {
      if (draw.alpha_test) draw.alpha_test->reference = std::floor(255 * draw.alpha_test->reference) / 255;
    }
    scene.frame.color = scene.draws[0].alpha_test ? ColorFormat::rgba32f : scene.frame.color;  // alphas as they are
  };
  EXPECT_TRUE(is_said(learn(of_references).conventions, "one of two is a code"));
}

}  // namespace
}  // namespace plumbline::learn
