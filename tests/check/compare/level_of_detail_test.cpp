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

}  // namespace
}  // namespace plumbline::check
