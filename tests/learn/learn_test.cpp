// Conventions found from pictures and depths: of our renderer, of faults that are conventions, and of nonsense.
#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <fmt/ranges.h>

#include "capture/files/conventions_file.h"
#include "faults/faults.h"
#include "tests/learn/altered_renderers.h"

namespace plumbline::learn {
namespace {

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

TEST(Learn, OurRendererDrawsByTheDialect) {
  const auto renderer = pipeline::make_pipeline();
  const Learned found = learn(*renderer);
  EXPECT_EQ(conventions_text(found.conventions), conventions_text(ours()));
  EXPECT_TRUE(found.conventions.unexplained.empty());
  EXPECT_TRUE(mistaken(found.conventions).empty());
  const std::string text = learned_text(found);
  EXPECT_NE(text.find("subpixel_bits       8"), std::string::npos) << text;
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
      // Blended colours are rounded down, too, twice.
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
    C found = learned(faulted(of.fault));
    found.open.clear();  // one may hide another
    EXPECT_EQ(conventions_text(found), conventions_text(expected)) << of.fault;
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

// A near plane half way to the far one gives our renderer the depths of a view volume of [0,w] in z.
TEST(Learn, DepthsOfAVolumeFromZeroAreRoundedFromTheExactOnes) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    if (auto* volume = std::get_if<Orthographic>(&scene.projection)) volume->near = (volume->near + volume->far) / 2;
    if (auto* volume = std::get_if<Perspective>(&scene.projection))
      volume->near = 2 * volume->near * volume->far / (volume->near + volume->far);  // where z_ndc is 0
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.clip_depth, C::ClipDepth::zero_to_w);
  EXPECT_EQ(found.depth_arithmetic, C::DepthArithmetic::in_double);
  EXPECT_EQ(found.blending, C::Blending::in_float) << "the probes lie behind the near plane";
  EXPECT_TRUE(std::ranges::none_of(found.unexplained, [](const std::string& says) {
    return says.starts_with("depth_") || says.starts_with("blending");
  })) << fmt::format("{}", fmt::join(found.unexplained, "\n"));
}

// Nonsense leaves conventions open, at their defaults.
TEST(Learn, NonsenseIsOpen) {
  const auto of = [](const Alter& alter) {
    Altered renderer(pipeline::make_pipeline(), alter);
    return learn(renderer);
  };
  const Learned none = of([](Capture& c) { c.planes.depth = {}; });
  EXPECT_EQ(none.conventions.depth_rounding, C::Rounding::nearest);
  EXPECT_GE(std::ranges::count(none.rows, "open", &LearnedRow::value), 4);
  const std::string one_colour = "a white rectangle in a quarter of a black picture: every pixel has one colour";
  const Learned black = of([](Capture& c) { std::ranges::fill(c.planes.color.values(), glm::vec4(0, 0, 0, 1)); });
  ASSERT_FALSE(black.conventions.unexplained.empty());
  EXPECT_EQ(black.conventions.unexplained[0].find(one_colour), 0u) << black.conventions.unexplained[0];
  const Learned nan = of([](Capture& c) {
    std::ranges::fill(c.planes.color.values(), glm::vec4(std::numeric_limits<float>::quiet_NaN()));
  });
  ASSERT_FALSE(nan.conventions.unexplained.empty());
  EXPECT_EQ(nan.conventions.unexplained[0].find(one_colour), 0u) << nan.conventions.unexplained[0];
}

// A renderer that contradicts itself is told so, and what it contradicts keeps its default.
TEST(Learn, ContradictionsAreFindings) {
  const auto says = [](const char* finding, const Alter& alter) {
    Altered renderer(pipeline::make_pipeline(), alter);
    const C found = learn(renderer).conventions;
    EXPECT_EQ(found.sample, glm::dvec2(0.5));
    EXPECT_NE(std::ranges::find(found.unexplained, finding), found.unexplained.end())
        << fmt::format("{}", fmt::join(found.unexplained, "\n"));
  };
  float drift = 0;
  says("one scene drawn twice differs",
       [&](Capture& c) { c.planes.color(0, c.planes.color.height() - 1).g = drift += 0.001f; });
  says("edges that are moved in small steps go by no grid: they scatter by 0.501 pixel", [](Capture& c) {
    const Plane<glm::vec4> drawn = c.planes.color;
    for (int y = 0; y < drawn.height(); ++y) {
      for (int x = 0; x < drawn.width(); ++x) c.planes.color(x, y) = drawn((x + 3) % drawn.width(), y);
    }
  });
  says(
      "rows: a rectangle of 64 pixels in the lower left quarter: of 1 white pixels 1 are there, 0 in the lower right, "
      "0 in "
      "the upper left, 0 in the upper right",
      [](Capture& c) {
        for (glm::vec4& v : c.planes.color.values()) v = glm::vec4(glm::vec3(0), 1);
        c.planes.color(3, 3) = glm::vec4(1);
      });
}

// Pictures that no value of a convention explains: the convention is open, and the pictures are a finding.
TEST(Learn, WhatNoValueExplainsIsAFinding) {
  struct Case {
    const char* open;     // its key
    const char* finding;  // begins like this
    Alter alter;
  };
  const auto mirrored = [](Capture& c) {
    const Plane<glm::vec4> drawn = c.planes.color;
    for (int y = 0; y < drawn.height(); ++y) {
      for (int x = 0; x < drawn.width(); ++x) c.planes.color(x, y) = drawn(drawn.width() - 1 - x, y);
    }
  };
  const auto darker = [](Capture& c) {
    for (glm::vec4& v : c.planes.color.values()) v = glm::pow(v, glm::vec4(2.2f));
  };
  const auto no_depths = [](Capture& c) {
    std::ranges::fill(c.planes.depth.values(), std::numeric_limits<double>::quiet_NaN());
  };
  const auto squared = [](Capture& c) {
    for (double& z : c.planes.depth.values()) z = std::floor(z * z * 1e3) / 1e3;
  };
  const auto red_is_affine = [](Capture& c) {  // of a wall that recedes to the right
    const int last = c.planes.color.width() - 1;
    for (int x = 0; x <= last; ++x) {
      for (int y = 0; y < c.planes.color.height(); ++y) {
        glm::vec4& v = c.planes.color(x, y);
        if (v.r > 0 && v.r < 1 && v.r == v.b) v.r = (static_cast<float>(x) + 0.5f) / static_cast<float>(last + 1);
      }
    }
  };
  const auto not_clamped = [](Capture& c) {  // nothing before the near plane is cut off, and depths are as they are
    const int width = c.planes.depth.width();
    for (int y = 0; y < c.planes.depth.height(); ++y) {
      for (int x = 0; x < width / 4; ++x) {
        if (c.planes.color(width / 2, y).r < 0.5f || c.planes.color(width - 1, y).r > 0.5f) continue;
        c.planes.color(x, y) = glm::vec4(1);
        c.planes.depth(x, y) = -0.5 + 2.0 * x / width;
      }
    }
  };
  const auto swapped = [](Capture& c) {
    for (glm::vec4& v : c.planes.color.values()) std::swap(v.r, v.b);
  };
  const Case cases[] = {
      {"sample", "columns are counted from the right: ", mirrored},
      {"color_rounding", "color_rounding: ", darker},
      {"depth_range", "depth_range: ", no_depths},
      {"depth_range", "depth_range: ", squared},
      {"interpolation", "interpolation: ", red_is_affine},
      {"depth_planes", "depth_planes: depths before the near plane are neither cut nor clamped", not_clamped},
      {nullptr, "red, green and blue are left in blue, green and red", swapped},
  };
  for (const Case& of : cases) {
    Altered renderer(pipeline::make_pipeline(), of.alter);
    const Conventions found = learn(renderer).conventions;
    EXPECT_TRUE(
        std::ranges::any_of(found.unexplained, [&](const std::string& line) { return line.starts_with(of.finding); }))
        << of.finding << ": " << fmt::format("{}", fmt::join(found.unexplained, "\n"));
    if (of.open != nullptr)
      EXPECT_NE(std::ranges::find(found.open, of.open), found.open.end()) << of.finding;
    else
      EXPECT_EQ(found.provoking_vertex, C::Provoking::last);
  }
}

// A probe that the renderer refuses leaves its own conventions open, and no other.
TEST(Learn, ARefusedProbeLeavesItsConventionsOpen) {
  for (const auto& [probe, names] : {std::pair("clipping", std::vector<std::string>{"clip_depth", "depth_planes"}),
                                     std::pair("provoking_vertex", std::vector<std::string>{"provoking_vertex"}),
                                     std::pair("offset_unit", std::vector<std::string>{"offset_unit"}),
                                     std::pair("float_offset_unit", std::vector<std::string>{"float_offset_unit"})}) {
    OfAlteredScenes renderer;
    renderer.before = [refused = std::string("probe/") + probe](Scene& scene) {
      if (scene.name == refused) throw Unsupported("not drawn");
    };
    C expected = ours();
    expected.open = names;
    EXPECT_EQ(conventions_text(learn(renderer).conventions), conventions_text(expected)) << probe;
  }
}

// A file of conventions has lines: what a program says on stderr is not among them.
TEST(Learn, AProbeThatFailsIsAFindingOfOneLine) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    if (scene.name == "probe/clipping") throw RendererFailed("mine: exited with status 3\nthe end of its stderr:\nno");
  };
  const std::vector<std::string> expected = {"probe/clipping: mine: exited with status 3"};
  EXPECT_EQ(learn(renderer).conventions.unexplained, expected);
}

// A clipper that handles one corner before the near plane drops triangles of two.
TEST(Learn, AViewVolumeIsThatOfBothTriangles) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    if (scene.name == "probe/clipping") scene.meshes[0].triangles.pop_back();
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.open, (std::vector<std::string>{"clip_depth", "depth_planes"}));
  ASSERT_EQ(found.unexplained.size(), 1u);
  EXPECT_NE(found.unexplained[0].find("; in another triangle none is drawn"), std::string::npos)
      << found.unexplained[0];
}

// One depth a triangle, of a renderer that cuts nothing, looks clamped at the near plane alone.
TEST(Learn, OneDepthATriangleIsNotClamped) {
  pipeline::Stages stages = pipeline::production_stages();
  for (const faults::Fault& fault : faults::all()) {
    if (fault.name == "depth.one_per_triangle" || fault.name == "clip.no_near_plane") fault.apply(stages);
  }
  const C found = learned(pipeline::make_pipeline(stages));
  EXPECT_EQ(std::ranges::count(found.open, "depth_planes"), 1);
  EXPECT_TRUE(std::ranges::any_of(found.unexplained, [](const std::string& line) {
    return line.starts_with("depth_planes: ") && line.find("depths are one along the rectangle") != line.npos;
  }));
}

TEST(Learn, APlaneThatAloneCutsNothingIsAFinding) {
  OfAlteredScenes renderer;
  renderer.after = [](const Scene& scene, Capture& c) {
    if (scene.name != "probe/clipping") return;
    for (int y = 0; y < c.height; ++y) {
      for (int x = c.width / 2; x < c.width; ++x) c.planes.color(x, y) = glm::vec4(1);
    }
  };
  C expected = ours();
  expected.unexplained = {"the near plane cuts, the far plane does not"};
  EXPECT_EQ(conventions_text(learn(renderer).conventions), conventions_text(expected)) << "the suite expects the cut";
}

TEST(Learn, ARendererOfOneDepthFormatLeavesNoDepthsOfTheOther) {
  OfAlteredScenes renderer;
  renderer.after = [](const Scene& scene, Capture& c) {
    if (scene.frame.depth == DepthFormat::z16) c.planes.depth = {};
  };
  EXPECT_EQ(conventions_text(learn(renderer).conventions), conventions_text(ours())) << "a unit of 24 bits is enough";
}

TEST(Learn, TexturesThatNoConventionExplainsAreFindings) {
  const auto finds = [](Renderer& renderer, const std::string& name) {
    const C found = learn(renderer).conventions;
    const auto begins = [&](const std::string& line) { return line.starts_with(name + ": "); };
    return std::ranges::any_of(found.unexplained, begins) && std::ranges::count(found.open, name) == 1;
  };
  OfAlteredScenes no_mipmaps;
  no_mipmaps.before = [](Scene& scene) {
    for (Texture& texture : scene.textures) texture.sampler.min = MinFilter::nearest;
  };
  EXPECT_TRUE(finds(no_mipmaps, "level_of_detail"));
  EXPECT_TRUE(finds(no_mipmaps, "half_way_level"));
  for (const auto& [probe, name] : {std::pair("texture_weights", "texture_bits"), std::pair("blending", "blending"),
                                    std::pair("magnification", "magnified"), std::pair("levels", "level_of_detail"),
                                    std::pair("half_way", "half_way_level")}) {
    OfAlteredScenes nan;
    nan.after = [altered = std::string("probe/") + probe](const Scene& scene, Capture& c) {
      if (scene.name == altered) std::ranges::fill(c.planes.color.values(), glm::vec4(kNotANumber));
    };
    EXPECT_TRUE(finds(nan, name)) << name;
  }
}

TEST(Learn, NothingIsFoundInPicturesOfOneColor) {
  OfAlteredScenes blank;
  blank.after = [](const Scene&, Capture& c) { std::ranges::fill(c.planes.color.values(), glm::vec4(0, 0, 0, 1)); };
  const Learned found = learn(blank);
  EXPECT_EQ(found.pictures.size(), 1u);
  EXPECT_EQ(found.conventions.unexplained.size(), 2u) << "the picture, and its rows";
  const auto is_found = [](const LearnedRow& row) { return row.value != "open" && row.value != "none fits"; };
  EXPECT_TRUE(std::ranges::none_of(found.rows, is_found));
}

// A renderer whose alpha is always blended by the factor one.
TEST(Learn, BlendingShowsByEitherFactorOfAlpha) {
  OfAlteredScenes coverage;
  coverage.before = [](Scene& scene) {
    for (const Draw& draw : scene.draws) {
      if (draw.merge.blend && draw.merge.blend->alpha.source != BlendFactor::one) throw Unsupported("alpha's factor");
    }
  };
  const C found = learn(coverage).conventions;
  EXPECT_EQ(std::ranges::count(found.open, "blending"), 0);
  EXPECT_EQ(found.blending, C::Blending::in_float);
}

// Mixes of texels in codes: truncated each time they are below the exact ones; rounded, they are like few bits'
// weights.
TEST(Learn, MixesThatTruncateAreNoWeightsOfFewBits) {
  const auto found = [](double most_above) {
    OfAlteredScenes coarse;
    coarse.after = [=](const Scene& scene, Capture& c) {
      if (scene.name != "probe/texture_weights") return;
      for (int i = 0; glm::vec4 & color : c.planes.color.values()) {
        const double off = most_above - 0.5 - 0.3 * (i++ % 6);  // codes
        color =
            glm::vec4(glm::vec3(static_cast<float>(std::floor(255.0 * static_cast<double>(color.r) + off) / 255)), 1);
      }
    };
    return learn(coarse).conventions;
  };
  const C truncated = found(0), rounded = found(1.5);
  EXPECT_EQ(std::ranges::count(truncated.open, "texture_bits"), 1);
  EXPECT_TRUE(std::ranges::any_of(truncated.unexplained, [](const std::string& line) {
    return line.starts_with("texture_bits: ") && line.ends_with("all below: each mix is truncated");
  }));
  EXPECT_EQ(std::ranges::count(rounded.open, "texture_bits"), 0);
  EXPECT_LE(rounded.texture_bits, 9);
  EXPECT_GE(rounded.texture_bits, 4);
}

// A renderer of one depth function is drawn with by that one. What lies beyond the far plane then fails the depth test:
// whether it is cut does not show.
TEST(Learn, ADepthFunctionThatIsDrawnIsEnough) {
  for (const DepthFunc only : {DepthFunc::less_equal, DepthFunc::less}) {
    OfAlteredScenes renderer;
    const auto refuse_others = [&](Scene& scene) {
      for (const Draw& draw : scene.draws)
        if (draw.depth_func != only) throw Unsupported("another depth function");
    };
    renderer.before = refuse_others;
    const Learned found = learn(renderer);
    EXPECT_EQ(conventions_text(found.conventions), conventions_text(ours())) << name_of(only);
    const auto row = std::ranges::find(found.rows, "depth_func", &LearnedRow::name);
    ASSERT_NE(row, found.rows.end());
    EXPECT_EQ(row->value, name_of(only));
    renderer.before = [&](Scene& scene) {
      refuse_others(scene);
      scene.depth_clamp = true;
    };
    C clamped = ours();
    clamped.depth_planes = C::DepthPlanes::clamped;
    EXPECT_EQ(conventions_text(learn(renderer).conventions), conventions_text(clamped)) << name_of(only);
  }
}

TEST(Learn, ARendererThatDrawsNoRectangleIsRefused) {
  Altered renderer(pipeline::make_pipeline(), [](Capture&) { throw Unsupported("no"); });
  EXPECT_THROW(learn(renderer), Unsupported);
  Altered empty(pipeline::make_pipeline(), [](Capture& c) { c.planes.color = {}; });
  EXPECT_THROW(learn(empty), Unsupported);
}

}  // namespace
}  // namespace plumbline::learn
