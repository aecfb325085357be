// Hidden surfaces in image order (rays) and in object order (the pipeline's z-buffer) are the same, but where the rules
// leave a pixel open; there both are among the legal answers.
#include "image_order/image_order.h"
#include "tests/extent.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/oracle/oracle.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/cross/embree_scenes.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

using image_order::make_image_order;

constexpr std::size_t kBudget = std::size_t{2} << 30;  // a million triangles

Legal legal_answers(const Scene& scene) {
  Request request;
  request.memory_budget = kBudget;
  return math::legal_by_boxes(scene, request);
}

struct Agreement {
  long pixels = 0, covered = 0, ambiguous = 0;
  long apart = 0;          ///< the two orders show different triangles
  long unambiguously = 0;  ///< of these, where one answer alone is legal
  long illegal = 0;        ///< either order's answer is none of the legal ones
  long depth = 0;          ///< image order's depth is not its answer's, by more than a step of the format
  std::string first;
};

const LegalAnswer* find(std::span<const LegalAnswer> answers, std::int32_t id) {
  const auto at = std::find_if(answers.begin(), answers.end(), [&](const LegalAnswer& a) { return a.primitive == id; });
  return at == answers.end() ? nullptr : &*at;
}

/// A legal answer's depths are all that a renderer of float corners, snapped or not, may give it; image order's,
/// through the corners themselves, lies within, but for the rounding to the format.
void add(const Scene& scene, const Planes& image, const Planes& object, const Legal& legal, Agreement& out) {
  for (int y = 0; y < scene.frame.height; ++y) {
    for (int x = 0; x < scene.frame.width; ++x) {
      const auto answers = legal.at(x, y);
      const std::int32_t id = image.id(x, y), other = object.id(x, y);
      const LegalAnswer* mine = find(answers, id);
      const double z = image.depth(x, y), step = depth_step(scene.frame.depth, z);
      const bool legally = mine != nullptr && find(answers, other) != nullptr;
      const bool depth_right = mine == nullptr || (z >= mine->z_lo - step && z <= mine->z_hi + step);
      const bool open = answers.size() > 1;
      ++out.pixels;
      out.covered += id == kBackground ? 0 : 1;
      out.ambiguous += open ? 1 : 0;
      out.apart += id == other ? 0 : 1;
      out.unambiguously += id == other || open ? 0 : 1;
      out.illegal += legally ? 0 : 1;
      out.depth += depth_right ? 0 : 1;
      if (!out.first.empty() || (legally && depth_right && (id == other || open))) continue;
      out.first = fmt::format("{}: pixel {}, {}: image order {} at {}, object order {} at {}, legal:", scene.name, x, y,
                              id, z, other, object.depth(x, y));
      for (const LegalAnswer& a : answers) out.first += fmt::format(" {} [{}, {}]", a.primitive, a.z_lo, a.z_hi);
    }
  }
}

Planes drawn(Renderer& renderer, const Scene& scene) {
  Request request;
  request.memory_budget = kBudget;
  return renderer.capture(scene, request).planes;
}
void add(const Scene& scene, Agreement& out) {
  add(scene, drawn(*make_image_order(), scene), drawn(*pipeline::make_pipeline(), scene), legal_answers(scene), out);
}
void expect_agreed(const Agreement& a) {
  EXPECT_EQ(a.unambiguously, 0) << a.first;
  EXPECT_EQ(a.illegal, 0) << a.first;
  EXPECT_EQ(a.depth, 0) << a.first;
}

// Some of the suite's, but for those that it refuses.
std::vector<Scene> some_scenes() {
  const std::vector<std::filesystem::path> files = suite_files();
  std::vector<Scene> out;
  for (std::size_t i = 0; i < files.size(); i += one_of(12)) out.push_back(load_scene(files[i], {}));
  std::erase_if(out, [](const Scene& s) {
    return antialiased(s) || may_draw(s, Topology::lines) || may_draw(s, Topology::points) ||
           std::any_of(s.draws.begin(), s.draws.end(),
                       [](const Draw& d) { return d.alpha_test || d.stencil || d.polygon_offset != PolygonOffset{}; });
  });
  return out;
}

TEST(ImageOrder, EqualsObjectOrderOnEverySceneOutsideAmbiguousPixels) {
  Agreement all;
  const std::vector<Scene> scenes = some_scenes();
  for (const Scene& scene : scenes) add(scene, all);
  std::printf("%zu scenes: %ld pixels, %ld covered, %ld ambiguous; apart on %ld of these\n", scenes.size(), all.pixels,
              all.covered, all.ambiguous, all.apart);
  expect_agreed(all);
  EXPECT_GT(scenes.size(), 160u / one_of(12));
  EXPECT_GT(all.covered, 800000 / static_cast<long>(one_of(12)));
  EXPECT_LT(all.apart, all.ambiguous);
}

class RandomScenes : public ::testing::TestWithParam<int> {};

TEST_P(RandomScenes, EqualObjectOrderOutsideAmbiguousPixels) {
  Agreement all;
  for (std::size_t seed = 1; seed <= 25; seed += one_of(8))
    add(test::small_scene(GetParam(), static_cast<unsigned>(seed)), all);
  std::printf("kind %d: %ld pixels, %ld covered, %ld ambiguous; apart on %ld of these\n", GetParam(), all.pixels,
              all.covered, all.ambiguous, all.apart);
  expect_agreed(all);
  EXPECT_GT(all.covered, all.pixels / 100);
}
INSTANTIATE_TEST_SUITE_P(Kinds, RandomScenes, ::testing::Range(0, test::kSceneKinds));

/// The same window, moved by parts of a pixel: what wrong rays see.
Scene with_rays_moved(Scene scene, glm::dvec2 pixels) {
  const auto moved = [&](auto p) {
    const double dx = pixels.x * (p.right - p.left) / scene.frame.width;
    const double dy = pixels.y * (p.top - p.bottom) / scene.frame.height;
    p.left += dx, p.right += dx, p.bottom += dy, p.top += dy;
    return p;
  };
  if (const auto* o = std::get_if<Orthographic>(&scene.projection)) {
    scene.projection = moved(*o);
  } else if (const auto* f = std::get_if<Frustum>(&scene.projection)) {
    scene.projection = moved(*f);
  } else {
    const auto p = std::get<Perspective>(scene.projection);
    const double top = p.near * std::tan(glm::radians(p.fov_y_degrees) / 2);
    const double right = top * scene.frame.width / scene.frame.height;
    scene.projection = moved(Frustum{-right, right, -top, top, p.near, p.far});
  }
  return scene;
}

// Unseen where nothing is drawn, one triangle fills the frame, or every pixel is open.
TEST(ImageOrder, RaysHalfAPixelOffAreSeen) {
  int scenes = 0, seen_in_x = 0, seen_in_y = 0, not_moved = 0;
  for (const Scene& scene : some_scenes()) {
    if (scene.dialect != Dialect::gl || scene.frame.width * scene.frame.height > 100000) continue;
    const Legal legal = legal_answers(scene);
    const Planes object = drawn(*pipeline::make_pipeline(), scene);
    const auto wrong = [&](glm::dvec2 by) {
      Agreement a;
      add(scene, drawn(*make_image_order(), with_rays_moved(scene, by)), object, legal, a);
      return a.unambiguously + a.illegal + a.depth > 0 ? 1 : 0;
    };
    ++scenes;
    seen_in_x += wrong({0.5, 0});
    seen_in_y += wrong({0, -0.5});
    not_moved += wrong({0, 0});
  }
  std::printf("%d scenes: half a pixel to the right seen in %d, down in %d\n", scenes, seen_in_x, seen_in_y);
  EXPECT_GT(scenes, 10);
  EXPECT_EQ(not_moved, 0);
  EXPECT_GT(seen_in_x, scenes * 8 / 10);
  EXPECT_GT(seen_in_y, scenes * 8 / 10);
}

TEST(ImageOrder, AWrongDepthIsSeen) {
  const Scene scene = test::sphere_scene(64, 64, 9, 12, Cull::back);
  const Legal legal = legal_answers(scene);
  Scene wrong = scene;
  std::get<Perspective>(wrong.projection).near *=
      1 + 1e-3;  // window z by 1e-3 / 3, ten times what snapping may do on half of the sphere
  Agreement a;
  add(scene, drawn(*make_image_order(), wrong), drawn(*pipeline::make_pipeline(), scene), legal, a);
  EXPECT_EQ(a.unambiguously, 0) << a.first;
  EXPECT_GT(a.depth, a.covered / 2);
}

/// Draws of one triangle that holds the frame, at window depths z, under depth functions: in a frame of 2 x 2 pixels.
struct Layer {
  double z;
  DepthFunc func;
};
Planes drawn(const std::vector<Layer>& layers, DepthFormat format = DepthFormat::z24, double clear_depth = 1) {
  Scene scene = test::frame_of(2, 2);
  scene.frame.depth = format;
  scene.frame.clear_depth = clear_depth;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, 2, 0, 2, 0, 1};  // window z is -z
  for (const Layer& layer : layers) {
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(-9, -9), glm::vec2(20, -9), glm::vec2(-9, 20)}) {
      test::add_vertex(mesh, {p, -layer.z}, {0, 0, 1}, {1, 1, 1, 1});
    }
    mesh.triangles = {{0, 1, 2}};
    scene.draws.push_back(test::unlit(static_cast<std::uint32_t>(scene.meshes.size()), Cull::none, layer.func));
    scene.meshes.push_back(mesh);
  }
  return drawn(*make_image_order(), scene);
}

TEST(ImageOrder, EqualDepthsAreSettledInDrawOrder) {
  const std::vector<Layer> first(20, Layer{0.5, DepthFunc::less}), last(20, Layer{0.5, DepthFunc::less_equal});
  EXPECT_EQ(drawn(first).id(0, 1), 0);
  EXPECT_EQ(drawn(last).id(0, 1), 19);
  std::vector<Layer> mixed = first;
  mixed[3].func = mixed[7].func = DepthFunc::less_equal;
  EXPECT_EQ(drawn(mixed).id(1, 0), 7);
  mixed[5].z = 0.25;
  EXPECT_EQ(drawn(mixed).id(1, 0), 5);
  EXPECT_EQ(drawn({{0.5, DepthFunc::less}, {0.5 + 1e-6, DepthFunc::less_equal}}, DepthFormat::z16).id(0, 0), 1)
      << "equal in 16 bits";
  EXPECT_EQ(drawn({{0.5, DepthFunc::less}, {0.5 + 1e-6, DepthFunc::less_equal}}).id(0, 0), 0);
}

TEST(ImageOrder, EveryDepthFunctionAgainstTheClearDepth) {
  const auto passes = [](DepthFunc func) {
    std::string out;
    for (const double z : {0.25, 0.5, 0.75})
      out += drawn({{z, func}}, DepthFormat::z32f, 0.5).id(0, 0) == 0 ? '1' : '0';
    return out;
  };
  EXPECT_EQ(passes(DepthFunc::never), "000");
  EXPECT_EQ(passes(DepthFunc::less), "100");
  EXPECT_EQ(passes(DepthFunc::equal), "010");
  EXPECT_EQ(passes(DepthFunc::less_equal), "110");
  EXPECT_EQ(passes(DepthFunc::greater), "001");
  EXPECT_EQ(passes(DepthFunc::not_equal), "101");
  EXPECT_EQ(passes(DepthFunc::greater_equal), "011");
  EXPECT_EQ(passes(DepthFunc::always), "111");
}

TEST(ImageOrder, DepthsAreRoundedToTheNearestCode) {
  for (const double code : {0.0, 1.0, 1000.0, 65534.0, 65535.0}) {
    for (const double off : {-0.49, -0.2, 0.0, 0.3, 0.49}) {
      const double z = std::clamp((code + off) / 65535, 0.0, 1.0);
      EXPECT_EQ(drawn({{z, DepthFunc::less_equal}}, DepthFormat::z16).depth(0, 0), code / 65535) << code << " " << off;
    }
  }
  EXPECT_EQ(drawn({}, DepthFormat::z16, 0.30001).depth(1, 1), std::round(0.30001 * 65535) / 65535)
      << "the clear depth as well";
  EXPECT_EQ(drawn({}, DepthFormat::z32f, 0.3).depth(1, 1), static_cast<double>(0.3f));
}

// The scene in a dialect whose depths fall as the distance grows.
Scene in_games101(Scene scene) {
  scene.dialect = Dialect::games101;
  const auto negate = [](auto& projection) {
    if constexpr (requires { projection.near; }) {
      projection.near = -projection.near;
      projection.far = -projection.far;
    }
  };
  std::visit(negate, scene.projection);
  return scene;
}

// A draw that never passes changes nothing, but that triangles behind others are no longer left out.
TEST(ImageOrder, WhatIsLeftOutBehindOthersIsNotMissed) {
  for (int kind = 0; kind < 2 * test::kSceneKinds; ++kind) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      Scene scene = test::small_scene(kind / 2, seed);
      if (kind % 2 != 0) scene = in_games101(scene);
      for (Draw& draw : scene.draws) draw.depth_func = seed % 2 == 0 ? DepthFunc::less : DepthFunc::less_equal;
      Scene with_never = scene;
      with_never.draws.push_back(scene.draws.back());
      with_never.draws.back().depth_func = DepthFunc::never;
      const Planes a = drawn(*make_image_order(), scene), b = drawn(*make_image_order(), with_never);
      EXPECT_EQ(a.id.values(), b.id.values()) << scene.name;
      EXPECT_EQ(a.depth.values(), b.depth.values()) << scene.name;
    }
  }
}

TEST(ImageOrder, SaysWhatItShows) {
  const auto renderer = make_image_order();
  const RendererInfo info = renderer->info();
  EXPECT_EQ(info.name, "image_order");
  EXPECT_FALSE(info.legal);
  for (std::size_t s = 0; s < kStageNames.size(); ++s) {
    EXPECT_EQ(info.stages[s].shows, static_cast<Stage>(s) == Stage::visibility) << kStageNames[s];
    EXPECT_NE(info.stages[s].shows, !info.stages[s].reason.empty()) << kStageNames[s];
    EXPECT_FALSE(info.stages[s].runs) << kStageNames[s];
  }
  const Scene scene = test::sphere_scene(8, 8, 4, 6, Cull::none);
  EXPECT_THROW(renderer->run_stage(scene, Stage::visibility, {}), Unsupported);
  Request request;
  request.memory_budget = 1000;
  EXPECT_THROW(renderer->capture(scene, request), OverBudget);
  const Planes planes = renderer->capture(scene, {}).planes;
  EXPECT_EQ(planes.id.size(), 64u);
  EXPECT_EQ(planes.depth.size(), 64u);
  EXPECT_TRUE(planes.color.empty() && planes.count.empty() && planes.id_sum.empty() && planes.shaded.empty());
}

}  // namespace
}  // namespace plumbline
