// Pixel histories of OpenGL and the oracle, beside ours.
#include "check/diagnose/history.h"
#include "reference/embree/embree.h"
#include "reference/osmesa/osmesa.h"
#include "tests/check/judge/fates_scene.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/extent.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

struct All : testing::Test {
  static void SetUpTestSuite() { osmesa = make_opengl().release(); }  // a process can hold one
  History ask(const Scene& scene, glm::ivec2 pixel) {
    const Reference references[] = {{"osmesa", osmesa}, {"embree", embree.get()}, {"exact", exact.get()}};
    return pixel_history(scene, *ours, references, pixel);
  }
  static inline Renderer* osmesa = nullptr;
  std::unique_ptr<Renderer> ours = pipeline::make_pipeline(), embree = embree::make_embree(),
                            exact = exact::make_exact();
};

// As many fragments, of the same fates. Of depths, ours and OSMesa's are rounded to codes (half a step), and go through
// vertices in float, which those in double do not (another step; measured: 0.89). Of colours, in float, a code.
void expect_alike(const History& history, const Scene& scene) {
  for (const SampleHistory& sample : history.samples) {
    const PixelHistory& mine = sample.renderers[0];
    for (const PixelHistory& h : sample.renderers) {
      SCOPED_TRACE(scene.name + ": " + h.renderer);
      EXPECT_EQ(h.absent, "");
      EXPECT_TRUE(h.notes.empty()) << h.notes[0];
      ASSERT_EQ(h.fragments.size(), mine.fragments.size());
      for (std::size_t i = 0; i < h.fragments.size(); ++i) {
        const PixelFragment &a = mine.fragments[i], &b = h.fragments[i];
        EXPECT_EQ(a.primitive, b.primitive);
        EXPECT_EQ(a.front, b.front) << a.primitive;
        EXPECT_EQ(name_of(a.fate), name_of(b.fate)) << a.primitive << ": " << b.why;
        EXPECT_EQ(a.drawn, b.drawn) << a.primitive;
        ASSERT_TRUE(b.depth && b.shaded);
        EXPECT_LE(std::abs(*a.depth - *b.depth), 1.5 * depth_step(scene.frame.depth, *a.depth)) << a.primitive;
        for (int c = 0; c < 4; ++c) EXPECT_LE(std::abs((*a.shaded)[c] - (*b.shaded)[c]), 1 / 255.0) << a.primitive;
      }
    }
  }
}

TEST_F(All, EveryFateByEveryone) {
  const Scene scene = fates_scene();
  const History history = ask(scene, {1, 1});
  expect_alike(history, scene);
  const auto& renderers = history.samples[0].renderers;
  ASSERT_EQ(renderers.size(), 4u);
  for (const PixelHistory& h : renderers) {
    EXPECT_EQ(h.fragments.size(), 7u) << h.renderer;
    EXPECT_EQ(h.fragments[3].why, renderers[0].fragments[3].why) << h.renderer;
    EXPECT_EQ(h.stencil, 7) << h.renderer;
  }
  EXPECT_EQ(renderers[1].lacks.at("color"), renderers[2].lacks.at("color"));
  ASSERT_EQ(renderers[2].legal.size(), 1u);
  EXPECT_EQ(renderers[2].legal[0].primitive, 6);
}

TEST_F(All, OpenglTellsTexelsAndNoLevel) {
  Scene scene = fates_scene();
  Texture& texture = scene.textures.emplace_back();
  texture.format = TextureFormat::rgba;
  set_levels(texture, {16, 16, std::vector<glm::vec4>(256, glm::vec4(1, 0, 0, 1))});
  scene.draws[6].texture = DrawTexture{0, TextureEnvironment::modulate, {}};
  scene.meshes[6].texcoords = {{0, 0}, {1, 0}, {0, 1}};
  const auto renderers = ask(scene, {1, 1}).samples[0].renderers;
  EXPECT_EQ(*renderers[1].fragments[6].texel, glm::dvec4(1, 0, 0, 1));
  EXPECT_EQ(*renderers[1].fragments[6].shaded, glm::dvec4(0, 0, 0, 1));  // of blue
  EXPECT_FALSE(renderers[1].fragments[6].lod);
  EXPECT_EQ(renderers[1].lacks.at("lod"), "it tells no level of detail");
  EXPECT_EQ(renderers[2].lacks.at("texel"), "a ray sees the final colour; see shade");
}

// Pixels at the frame's middle and at two quarters of its diagonal: in a run one of most scenes, else all three.
TEST_F(All, ScenesOfTheSuite) {
  std::size_t next = 0;
  for (const char* name : {"stencil/everything", "stencil/funcs", "depth/interpenetrating", "depth/functions",
                           "cull/both_windings", "cull/closed_mesh", "scissor/windows", "alpha_test/leaves",
                           "blend/layers", "interpolation/w_ratio", "antialias/samples_meeting"}) {
    const Scene scene = suite_scene(name);
    const glm::ivec2 size(scene.frame.width, scene.frame.height);
    for (const glm::ivec2 p : {size / 2, size / 4, 3 * size / 4}) {
      if (next++ % one_of(4) == 0) expect_alike(ask(scene, p), scene);  // 4: now the one, now the other
    }
  }
}

TEST_F(All, OpenglHasNoDepthOf8Bits) {
  Scene scene = fates_scene();
  scene.frame.depth = DepthFormat::z8;
  const History history = ask(scene, {1, 1});
  for (const PixelHistory& h : history.samples[0].renderers) {
    EXPECT_EQ(h.notes.size(), h.renderer == "osmesa" ? 1u : 0u) << h.renderer;
    for (const std::string& note : h.notes) EXPECT_TRUE(note.starts_with("its depths are of another format"));
    EXPECT_EQ(h.fragments[6].fate, Fate::winner) << h.renderer;
  }
}

TEST_F(All, FourSamplesAreToldApart) {
  Scene scene = fates_scene();
  scene.frame.stencil = StencilFormat::none;
  for (Draw& draw : scene.draws) draw.stencil.reset();
  scene.frame.antialias.kind = Antialias::Kind::multisample;
  const glm::ivec2 on_the_edge(3, 4);  // the diagonal goes through its corners: two or three of four samples are in
  const History history = ask(scene, on_the_edge);
  expect_alike(history, scene);
  std::size_t covered = 0;
  for (const SampleHistory& s : history.samples) covered += s.renderers[1].fragments.empty() ? 0 : 1;
  EXPECT_TRUE(covered == 2 || covered == 3) << covered;
  ASSERT_EQ(history.resolved.size(), 4u);
  EXPECT_EQ(history.resolved[0].color, history.resolved[1].color);
}

TEST_F(All, NoRayMeetsALine) {
  Scene scene = fates_scene();
  scene.meshes[0].topology = Topology::lines;
  const auto renderers = ask(scene, {1, 1}).samples[0].renderers;
  EXPECT_EQ(renderers[2].absent, "unsupported: no ray meets a line or a point");
  EXPECT_EQ(renderers[1].absent, "");
}

}  // namespace
}  // namespace plumbline::check
