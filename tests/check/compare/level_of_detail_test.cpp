// Levels of detail where texture coordinates hardly change between pixels.
#include "check/compare/compare_texels.h"
#include "scene/texture/texture_images.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// Coordinates that are equal at corners whose w differs 10^8-fold: their slope is rounding alone.
TEST(CompareTexels, BoundsTheLevelOfASlopeThatIsRoundingAlone) {
  const auto differing = [](const glm::dvec3& inv_w, double lod) {
    Scene scene = two_draws();
    set_levels(scene.textures.emplace_back(), make_noise(16, 16, 1));
    scene.draws[0].texture = DrawTexture{};
    Records<double> mine;
    mine.triangles = {triangle_of({{{32, 4.527039, 0.842473}, {32, 2.000042, 0.999998}, {30.999943, 1, 1}}}, inv_w)};
    const Vec4<double> same(100, 100, 0, 1);
    mine.varyings[Varying::texture].triangles = {{same, same, same}};
    mine.covered = {{0, 31, 1}};
    mine.texels = {{{0.5, 0.25, 1, 1}, lod}};
    Records<double> theirs = mine;
    theirs.texels[0].lod = -39;
    return compare_texels(scene, mine, theirs, 3).differing;
  };
  const glm::dvec3 steep(1576.884, 0.0231146, 1e-5), level(1, 1, 1);
  EXPECT_EQ(differing(steep, -7.9), 0u);
  EXPECT_EQ(differing(steep, 8), 1u);
  EXPECT_EQ(differing(level, -7.9), 1u);
}

// Two fragments, the first of which has a legal level of detail and hands out another.
TEST(CompareTexels, ALevelMayBeClampedToTheTexturesLevels) {
  Scene scene = two_draws();
  set_levels(scene.textures.emplace_back(), make_noise(16, 16, 1));
  scene.draws[0].texture = DrawTexture{};
  const double last = static_cast<double>(scene.textures[0].levels.size()) - 1;
  const Vec4<double> texel(0.5, 0.25, 1, 1);
  const auto differing_by = [&](double exact, double handed, double red, double of_legal) {
    Records<double> mine, theirs;
    mine.triangles.resize(1);
    mine.covered = {{0, 1, 2}};
    mine.texels = {{{red, 0.25, 1, 1}, handed}};
    theirs.texels = {{texel, exact}};
    std::vector<TexelRange> legal(1);
    legal[0].lo = legal[0].hi = texel;
    legal[0].lambda_lo = legal[0].lambda_hi = of_legal;
    return compare_texels(scene, mine, theirs, 3, &legal).differing;
  };
  const auto differing = [&](double exact, double handed, double red = 0.5) {
    return differing_by(exact, handed, red, exact);
  };
  EXPECT_EQ(differing(-2.6, 0), 0u);
  EXPECT_EQ(differing(last + 2, last), 0u);
  EXPECT_EQ(differing(-2.6, 0, 0.6), 1u) << "its texel is the legal level's";
  EXPECT_EQ(differing(-2.6, last), 1u);
  EXPECT_EQ(differing(0.25, 0), 1u);
  EXPECT_EQ(differing_by(-2.6, 0, 0.5, 0), 0u) << "no filter depends on the level: no legal one is known";
  EXPECT_EQ(differing_by(0.25, 0, 0.5, 0), 1u);
  scene.textures[0].sampler.base_level = 1, scene.textures[0].sampler.max_level = 3;  // q = 2
  EXPECT_EQ(differing(last + 2, 2), 0u);
  EXPECT_EQ(differing(last + 2, last), 1u) << "a level that the sampler does not reach";
  EXPECT_EQ(differing(last + 2, last - 1), 1u);
}

}  // namespace
}  // namespace plumbline::check
