// Comparators of textures: what must pass, what must fail, and the bounds that they grant.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "check/bounds/bounds.h"
#include "check/bounds/mean_bounds.h"
#include "check/bounds/texture_bounds.h"
#include "check/compare/compare_texels.h"
#include "check/verdict/ledger.h"
#include "reference/arithmetic/texture.h"
#include "scene/texture/texture_images.h"

namespace plumbline::check {
namespace {

constexpr double u = kFloatRounding;

Texture noise(MinFilter min, int size = 16) {
  Texture texture;
  texture.format = TextureFormat::rgba;
  texture.sampler.min = min;
  texture.sampler.mag = min == MinFilter::nearest ? MagFilter::nearest : MagFilter::linear;
  set_levels(texture, make_noise(size, size, 1));
  return texture;
}

struct Two {
  Scene scene;
  Records<double> mine, theirs;
};

Two equal_texels() {
  Two two;
  two.scene.textures.push_back(noise(MinFilter::linear));
  two.mine.covered = {{0, 1, 2}, {0, 2, 2}};
  two.mine.texels = {{{0.5, 0.25, 1, 1}, 1.5}, {{0, 0, 0, 1}, -0.5}};
  two.theirs = two.mine;
  return two;
}

TEST(CompareTexels, GrantsTheFactorAndNoMore) {
  Two two = equal_texels();
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).max_difference, 0);
  two.mine.texels[0].color.g += 3 * u;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 0u);
  two.mine.texels[0].color.g += 0.1 * u;
  const Measurement m = compare_texels(two.scene, two.mine, two.theirs, 3);
  EXPECT_EQ(m.differing, 1u);
  EXPECT_STREQ(m.worst.place.field, "texel");
  EXPECT_EQ(m.worst.place.x, 1);
}

TEST(CompareTexels, JudgesTheLevelOfDetail) {
  Two two = equal_texels();
  two.mine.texels[0].lod += 4.4 * u;  // 3 u of 1.5
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 0u);
  two.mine.texels[0].lod += 0.2 * u;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 1u);
  two = equal_texels();
  two.mine.texels[1].lod += 4 * u;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 1u) << "the last fragment's, too";
  two = equal_texels();
  two.mine.texels[1].lod = -498;  // the logarithm of next to nothing
  two.theirs.texels[1].lod = -1000;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 0u);
}

TEST(CompareTexels, RefusesWhatIsNoNumberOrLacking) {
  Two two = equal_texels();
  two.mine.texels[1].color.r = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 1u);
  two = equal_texels();
  two.mine.texels.pop_back();
  EXPECT_FALSE(compare_texels(two.scene, two.mine, two.theirs, 3).mismatch.empty());
}

TEST(CompareTexels, WithoutALevelOfDetailAreHeldToAllLegalOnes) {
  Two two = equal_texels();
  std::vector<TexelRange> legal(2);
  for (std::size_t i = 0; i < 2; ++i) legal[i].lo = legal[i].hi = two.theirs.texels[i].color;
  legal[0].hi.g = 0.5;
  two.mine.texels[0] = {{0.5, 0.5, 1, 1}, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3, &legal).differing, 0u);
  two.mine.texels[0].color.g += 4 * u;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3, &legal).differing, 1u);
  two.mine.texels[0].color.g = 0.25;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 1u) << "whoever hands one out has to";
}

TEST(TexelBound, HoldsWhereverThePlaceMayBe) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-2, 2), level(-1, 3), share(-1, 1);
  int open = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto min = static_cast<MinFilter>(round % 6);
    const Texture texture = noise(min);
    // At ten times the error the base level of 16 texels is half a texel off, a level of 4 or 2 is not.
    const glm::dvec2 st(coordinate(random), coordinate(random)),
        error = (round % 5 == 0 ? 12.0 : 1.0) * glm::dvec2(0.003, 0.002);
    const double lo = level(random), hi = lo + 0.2;
    const TexelBound bound =
        texel_bound(texture, math::texel_range(texture, st, lo, hi), st, error, 8 * u * largest_texel(texture));
    open += std::isinf(bound.slack.r) ? 1 : 0;
    for (int i = 0; i < 20; ++i) {
      const glm::dvec2 at = st + error * glm::dvec2{share(random), share(random)};
      const double lambda = lo + 0.1 * (1 + share(random));
      const glm::dvec4 texel = math::filtered_texel(texture, at, lambda);
      for (int c = 0; c < 4; ++c) {
        ASSERT_GE(texel[c], bound.range.lo[c] - bound.slack[c]) << static_cast<int>(min) << " " << lambda;
        ASSERT_LE(texel[c], bound.range.hi[c] + bound.slack[c]) << static_cast<int>(min) << " " << lambda;
      }
    }
  }
  EXPECT_GT(open, 0);
  EXPECT_LT(open, 1600);
}

TEST(TexelBound, OfLinearFiltersIsOpenByTheTexelsOfTheLevelsThatAreFiltered) {
  const Texture texture = noise(MinFilter::linear_mipmap_linear);
  const Vec2<double> st(0.3, 0.4);
  const auto open = [&](double texels, double lambda_lo, double lambda_hi) {
    const TexelRange range = math::texel_range(texture, st, lambda_lo, lambda_hi);
    const Vec2<double> error(texels / 16, 0);
    const PlaneValue plane{{st, 0, 0}, Vec4<double>(0), Vec4<double>(0)};
    const OpenShare share = open_share(texture, range, plane, error);
    const bool opened = std::isinf(texel_bound(texture, range, st, error, 0).slack.r);
    EXPECT_EQ(share.area, opened ? 1 : 0) << "the budget is of what the bound opens";
    EXPECT_EQ(share.centre, opened);
    return opened;
  };
  EXPECT_FALSE(open(0.49, -1, -1));
  EXPECT_TRUE(open(0.51, -1, -1));
  EXPECT_FALSE(open(0.51, 1, 1)) << "a quarter of a texel of level 1";
  EXPECT_TRUE(open(0.51, 0.9, 1.1)) << "level 0 has a share";
  EXPECT_FALSE(open(3.9, 3, 3));
  EXPECT_TRUE(open(4.1, 3, 3));
  EXPECT_TRUE(open(std::numeric_limits<double>::infinity(), 3, 3));
}

TEST(LambdaInterval, HoldsTheBiasAndMesasOfWhole256ths) {
  Texture texture = noise(MinFilter::linear_mipmap_linear);
  const glm::dvec2 d_dx(0.125, 0), d_dy(0, 0.0625);  // rho is 2, where both logarithms are one
  const auto expect = [&](float bias, double least, double most) {
    texture.sampler.lod_bias = bias;
    EXPECT_NEAR(math::smallest_level_of_detail(texture, d_dx, d_dy), 1 + least, 1e-12) << bias;
    EXPECT_NEAR(math::largest_level_of_detail(texture, d_dx, d_dy), 1 + most, 1e-12) << bias;
    EXPECT_NEAR(math::level_of_detail(texture, d_dx, d_dy), 1 + static_cast<double>(bias), 1e-12);
  };
  expect(0.25f, 0.25, 0.25);
  expect(1.9f, 486 / 256.0, static_cast<double>(1.9f));  // 486.4
  expect(0.3f, static_cast<double>(0.3f), 77 / 256.0);   // 76.8
  expect(-0.6f, -154 / 256.0, static_cast<double>(-0.6f));
}

TEST(MesasLevel, IsAnotherWhereMagnificationEndsAtTheWrongLambda) {
  Texture texture = noise(MinFilter::nearest_mipmap_linear);
  const auto reason = [&](double lo, double hi) {
    return mesas_other_level(texture, math::texel_range(texture, {0.3, 0.4}, lo, hi));
  };
  EXPECT_NE(reason(-0.6, 0.3).find("switches"), std::string_view::npos) << "steep: four pixels are a level apart";
  EXPECT_EQ(reason(-0.6, 0), "");
  EXPECT_NE(reason(0.5, 0.9), "");
  EXPECT_EQ(reason(0.51, 0.9), "");
  texture.sampler.mag = MagFilter::nearest;
  EXPECT_EQ(reason(-0.6, 0.3), "");
  texture.sampler.mag = MagFilter::linear;
  texture.sampler.min = MinFilter::linear_mipmap_linear;
  EXPECT_EQ(reason(-0.6, 0.3), "");
}

TEST(MesasLevel, IsAnotherWhereALimitLiesHalfWayToAnEvenLevel) {
  Texture texture = noise(MinFilter::linear_mipmap_nearest);
  const auto reason = [&](double lo, double hi) {
    return mesas_other_level(texture, math::texel_range(texture, {0.3, 0.4}, lo, hi));
  };
  texture.sampler.max_lod = 1.5f;
  EXPECT_NE(reason(1.2, 1.5).find("rounds"), std::string_view::npos);
  EXPECT_EQ(reason(1.2, 1.4), "") << "below the limit";
  texture.sampler.max_lod = 2.5f;
  EXPECT_EQ(reason(2.2, 2.5), "") << "2 is the even one, and the specification's";
  texture.sampler.min_lod = 1.5f;
  EXPECT_NE(reason(1.5, 1.5), "");
  texture.sampler.min = MinFilter::linear_mipmap_linear;
  EXPECT_EQ(reason(1.5, 1.5), "") << "both levels are filtered";
}

TEST(TexelBound, IsTightOnARamp) {
  Texture texture = noise(MinFilter::linear);
  TextureLevel ramp{16, 1, {}};
  for (int i = 0; i < 16; ++i) ramp.texels.emplace_back(static_cast<float>(i) / 16, 0, 0, 1);
  texture.type = TexelType::float32;
  set_levels(texture, ramp);
  const TexelBound bound =
      texel_bound(texture, math::texel_range(texture, {0.5, 0.5}, -1, -1), {0.5, 0.5}, {0.01, 0}, 0);
  EXPECT_NEAR(bound.slack.r, 0.01, 4 * u);  // red is s
  EXPECT_NEAR(bound.slack.g, 0, 1e-12);
}

TEST(EnvironError, HoldsForAllThatMayComeIn) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1), share(-1, 1);
  const auto color = [&](auto& of) { return glm::dvec4{of(random), of(random), of(random), of(random)}; };
  for (int round = 0; round < 20000; ++round) {
    const auto format = static_cast<TextureFormat>(random() % 6);
    const auto environment = static_cast<TextureEnvironment>(random() % 5);
    if (environment == TextureEnvironment::decal && format < TextureFormat::rgb) continue;
    const DrawTexture state{0, environment, glm::vec4(color(unit))};
    const glm::dvec4 f = color(unit), s = glm::dvec4(source_components(format, glm::vec4(color(unit))));
    const glm::dvec4 f_error = 0.1 * color(unit), s_error = 0.1 * color(unit);
    const Environed e = environ_error(format, state, f, f_error, s, s_error, {0});
    const glm::dvec4 middle = math::textured_color(format, state, f, s);
    const glm::dvec4 moved =
        math::textured_color(format, state, f + f_error * color(share), s + s_error * color(share));
    for (int c = 0; c < 4; ++c) {
      ASSERT_NEAR(e.color[c], middle[c], 1e-15);
      ASSERT_LE(std::abs(moved[c] - middle[c]), e.error[c] + 1e-15)
          << static_cast<int>(format) << " " << static_cast<int>(environment);
    }
  }
}

TEST(EnvironError, IsZeroWhereNothingIsOff) {
  const glm::dvec4 c(0.5, 0.25, 0.75, 1), zero(0);
  const DrawTexture state{0, TextureEnvironment::replace, glm::vec4(0)};
  EXPECT_EQ(environ_error(TextureFormat::rgba, state, c, zero, c, zero, {1}).error, zero) << "nothing is computed";
}

TEST(TexelBound, KnowsACoordinateWithoutError) {
  const Texture texture = noise(MinFilter::nearest);
  const auto open = [&](Vec2<double> st, Vec2<double> error) {
    return std::isinf(
        texel_bound(texture, math::texel_range(texture, st, 0, 0), st, error, 8 * u * largest_texel(texture)).slack.r);
  };
  EXPECT_FALSE(open({0.03, 0}, {1e-4, 0})) << "0 everywhere: row 0";
  EXPECT_TRUE(open({0.03, 0}, {1e-4, 1e-9}));
  EXPECT_TRUE(open({0.03, 0.5}, {1e-4, 0})) << "its texel coordinate is a product, and rounded";
}

// Of planes of all slopes, from less than the error over 100 pixels to more than a texel each, the shares sum to what
// is open, which is counted.
TEST(OpenShare, SumsToWhatIsOpen) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1), exponent(-5, 0.5);
  const Texture texture = noise(MinFilter::nearest);
  const Vec2<double> error(4e-4, 3e-4);
  double predicted = 0, centres = 0, counted = 0;
  for (int round = 0; round < 400; ++round) {
    PlaneValue plane{{place(random), place(random), 0, 0}, Vec4<double>(0), Vec4<double>(0)};
    for (int k = 0; k < 2; ++k) {
      plane.d_dx[k] = std::pow(10.0, exponent(random)) / 16;
      plane.d_dy[k] = -std::pow(10.0, exponent(random)) / 16;
    }
    const Vec4<double> corner = plane.value;
    for (int i = 0; i < 900; ++i) {
      plane.value = corner + static_cast<double>(i % 30) * plane.d_dx + static_cast<double>(i / 30) * plane.d_dy;
      const Vec2<double> st(plane.value);
      const TexelRange range = math::texel_range(texture, st, 0, 0);
      const OpenShare share = open_share(texture, range, plane, error);
      predicted += share.area;
      centres += share.centre ? 1 : 0;
      counted += std::isinf(texel_bound(texture, range, st, error, 8 * u * largest_texel(texture)).slack.r) ? 1 : 0;
    }
  }
  EXPECT_GT(counted, 1000);
  EXPECT_EQ(centres, counted) << "for a record that is where its plane is";
  EXPECT_NEAR(predicted / counted, 1, 0.15);
}

TEST(OpenShare, OfACoordinateThatDoesNotMoveIsAllOrNothing) {
  const Texture texture = noise(MinFilter::nearest);
  const auto share = [&](double s) {
    const PlaneValue plane{{s, 0.28, 0, 0}, Vec4<double>(0), Vec4<double>(0)};
    return open_share(texture, math::texel_range(texture, {s, 0.28}, 0, 0), plane, {1e-6, 1e-6});
  };
  EXPECT_EQ(share(0.5).area, 1);
  EXPECT_TRUE(share(0.5).centre);
  EXPECT_EQ(share(0.52).area, 0);
  EXPECT_FALSE(share(0.52).centre);
  const Texture smooth = noise(MinFilter::linear);
  const PlaneValue plane{{0.5, 0.5, 0, 0}, Vec4<double>(0), Vec4<double>(0)};
  EXPECT_EQ(open_share(smooth, math::texel_range(smooth, {0.5, 0.5}, -1, -1), plane, {1e-6, 1e-6}).area, 0);
}

// A frame of one textured triangle, unsmoothed.
struct TexelPlanes : testing::Test {
  static constexpr int kSide = 12;
  TexelPlanes() {
    scene.frame.width = scene.frame.height = kSide;
    scene.textures = {noise(MinFilter::nearest)};
    scene.meshes.resize(1);
    scene.meshes[0].triangles = {{0, 1, 2}};
    scene.meshes[0].positions.resize(3);
    scene.draws.resize(1);
    scene.draws[0].texture = DrawTexture{};
    WindowTriangle<double> triangle{};
    const Vec3<double> corners[] = {{-1, -1, 0.5}, {40, -1, 0.5}, {-1, 40, 0.5}};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.v[i] = {corners[i], 1, glm::ivec2(256.0 * (Vec2<double>(corners[i]) - 0.5)), Vec4<double>(0)};
    }
    triangle.front = true;
    capture.records.triangles = {triangle};
    capture.planes.id = Plane<std::int32_t>(kSide, kSide, 0);
    capture.planes.texel = Plane<glm::vec4>(kSide, kSide);
  }
  // Compares the texel plane of a triangle with these corner coordinates, every fragment at `record` (none:
  // interpolated).
  Measurement of(std::array<Vec2<double>, 3> corners, std::optional<Vec2<double>> record = {}) {
    Records<double>& r = capture.records;
    auto& columns = r.varyings[Varying::texture];
    r.covered.clear(), columns.fragments.clear(), r.texels.clear(), capture.legal.texels.clear();
    std::array<Vec4<double>, 3> sts;
    WindowTriangle<double> as_color = r.triangles[0];
    for (std::size_t i = 0; i < 3; ++i) as_color.v[i].color = sts[i] = Vec4<double>(corners[i], 0, 1);
    columns.triangles = {sts};
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const Vec2<double> st = record.value_or(Vec2<double>(color_of_plane(as_color, x, y).value));
        r.covered.push_back({0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
        columns.fragments.emplace_back(st, 0, 1);
        r.texels.push_back({math::filtered_texel(scene.textures[0], st, 0), 0});
        capture.legal.texels.push_back(math::texel_range(scene.textures[0], st, 0, 0));
        capture.planes.texel(x, y) = glm::vec4(r.texels.back().color);
      }
    }
    r.drawn.assign(r.covered.size(), {true});
    note.clear();
    return compare_texel_planes(scene, capture, capture, 64, note);
  }
  Scene scene;
  Capture capture;
  std::string note;
};

TEST_F(TexelPlanes, OpenPixelsAreAsManyAsTheTrianglesPlanesPredict) {
  const auto still = [](double s, double t) { return std::array<Vec2<double>, 3>{{{s, t}, {s, t}, {s, t}}}; };
  Measurement m = of(still(0.5, 0.5));
  EXPECT_EQ(m.ambiguous, 144u);
  EXPECT_EQ(m.differing, 0u) << note;
  EXPECT_EQ(note, "144 open, 144.0 predicted");
  m = of(still(0.53, 0.53));
  EXPECT_EQ(m.ambiguous, 0u);
  // Two texels to a pixel: borders at all centres, and a quarter of a texel beside them.
  const auto moved = [](double by) {
    const double first = by - 1.0 / 8, last = by + 40.0 / 8;
    return std::array<Vec2<double>, 3>{{{first, 0.03}, {last, 0.03}, {first, 0.03}}};
  };
  m = of(moved(0));
  EXPECT_EQ(m.ambiguous, 144u);
  EXPECT_EQ(m.differing, 0u) << note;
  EXPECT_EQ(of(moved(1.0 / 64)).ambiguous, 0u);
}

TEST_F(TexelPlanes, AnOpenTexelIsANumberOnBothSides) {
  EXPECT_EQ(of({{{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}}).differing, 0u);
  for (int c = 0; c < 4; ++c) {
    Capture other = capture;
    other.planes.texel(3, 4)[c] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(compare_texel_planes(scene, other, capture, 64, note).differing, 1u) << c;
    EXPECT_EQ(compare_texel_planes(scene, capture, other, 64, note).differing, 1u) << c;
  }
}

TEST_F(TexelPlanes, BothSidesAreHeldToTheLegalTexels) {
  const std::array<Vec2<double>, 3> inside = {{{0.53, 0.53}, {0.53, 0.53}, {0.53, 0.53}}};
  EXPECT_EQ(of(inside).max_difference, 0);
  // A texel that is read, not interpolated, is granted the ledger's u; a float below 1 rounds by half of one at most.
  const auto moved = [&](double share) {
    Capture other = capture;
    other.planes.texel(3, 4).g += static_cast<float>(share * tolerance(Profile::opengl, Stage::texture).factor * u);
    return other;
  };
  const Capture near = moved(0.75), far = moved(1.25);
  EXPECT_EQ(compare_texel_planes(scene, near, capture, 64, note).differing, 0u);
  EXPECT_EQ(compare_texel_planes(scene, capture, near, 64, note).differing, 0u);
  for (const Measurement& m :
       {compare_texel_planes(scene, far, capture, 64, note), compare_texel_planes(scene, capture, far, 64, note)}) {
    EXPECT_EQ(m.differing, 1u);
    EXPECT_EQ(to_string(m.worst.place), "pixel 3,4 primitive 0 texel");
  }
  EXPECT_EQ(compare_texel_planes(scene, far, far, 64, note).differing, 1u) << "alike, and both wrong";
}

TEST_F(TexelPlanes, ARecordOnABorderThatItsPlaneIsNotOnIsBeyondTheBudget) {
  const Measurement m = of({{{0.53, 0.53}, {0.53, 0.53}, {0.53, 0.53}}}, Vec2<double>(0.5, 0.5));
  EXPECT_EQ(m.differing, 144u);
  EXPECT_EQ(note, "144 open, 0.0 predicted: more than twice as many");
}

}  // namespace
}  // namespace plumbline::check
