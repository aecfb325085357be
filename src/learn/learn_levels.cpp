// Levels of detail: how they are found, where magnification ends, which is taken half way between two.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"
#include "learn/textured_frame.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

// A floor from near to far, each level of its texture in its own grey: eye-space position and texture coordinates at
// the window's corners. The texture lies askew: a derivative's length differs from its largest component.
constexpr ProbeCorner floor_corner(glm::dvec2 ndc, double w, glm::vec2 st) { return {{ndc * w, w}, glm::vec4(1), st}; }
constexpr std::array<ProbeCorner, 4> kFloor = {floor_corner({-1, -1}, 2, {0, 0}),
                                               floor_corner({1, -1}, 2, {1.1f, 0.9f}),
                                               floor_corner({1, 1}, 12, {-1, 9}), floor_corner({-1, 1}, 12, {-8, 4})};
constexpr int kFloorTexture = 64;

Scene floor_scene() {
  Texture texture = texture_of(kFloorTexture, [](int, int) { return 0; });
  texture.sampler.min = MinFilter::nearest_mipmap_nearest, texture.sampler.mag = MagFilter::nearest;
  texture.sampler.wrap_s = texture.sampler.wrap_t = Wrap::repeat;
  Scene out = probe_frame("levels", kTexturedSize, kTexturedSize);
  out.projection = Perspective{90, 1, 100};
  out.textures.push_back(std::move(texture));
  add_triangles(out, quad(kFloor)).texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  return out;
}

// Texture coordinates at a place of the window [pixels], in the plane of the lower right triangle or of the other.
glm::dvec2 floor_st(glm::dvec2 p_win, bool lower, C::Interpolation interpolation) {
  const glm::dvec2 at = p_win / static_cast<double>(kTexturedSize);
  const double u = at.x, v = at.y;
  const std::array<std::size_t, 3> corners = {0, lower ? 1u : 2u, lower ? 2u : 3u};
  const std::array<double, 3> weights = lower ? std::array{1 - u, u - v, v} : std::array{1 - v, u, v - u};
  glm::dvec2 sum(0);
  double over = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ProbeCorner& corner = kFloor[corners[i]];
    const double q = interpolation == C::Interpolation::affine ? weights[i] : weights[i] / corner.p.z;
    sum += q * glm::dvec2(corner.texcoord), over += q;
  }
  return sum / over;
}

double floor_lambda(glm::dvec2 p_win, bool lower, C::Interpolation interpolation) {
  constexpr double h = 1e-3;  // pixels
  const auto derivative = [&](glm::dvec2 step) {
    const glm::dvec2 over = floor_st(p_win + step, lower, interpolation) - floor_st(p_win - step, lower, interpolation);
    return glm::length(over) * kFloorTexture / (2 * h);
  };
  return std::log2(std::max(derivative({h, 0}), derivative({0, h})));
}

// Counts of pixels off the triangles' common edge: all; with their own level; with a level of their square of 2 x 2.
// Counts of squares whose pixels' own levels differ: all; drawn in one level.
struct LevelCounts {
  std::size_t pixels = 0, own = 0, of_square = 0, squares = 0, alike = 0;
};
LevelCounts level_counts(const Plane<glm::vec4>& color, glm::dvec2 sample, C::Interpolation interpolation) {
  const auto lambda_at = [&](int x, int y, bool lower) {
    return floor_lambda(glm::dvec2(x, y) + sample, lower, interpolation);
  };
  const auto drawn = [&](int x, int y) { return std::round(255 * static_cast<double>(color(x, y).r) / 40); };
  const auto level = [](double lambda) { return std::clamp(std::ceil(lambda + 0.5) - 1, 0.0, 6.0); };
  LevelCounts out;
  for (int y = 0; y < kTexturedSize; ++y) {
    for (int x = 0; x < kTexturedSize; ++x) {
      if (std::abs(x - y) < 3 || may_be_nobodys(x, y, sample)) continue;
      const int left = x & ~1, low = y & ~1;
      std::array<double, 4> lambdas{};
      std::array<double, 4> found{};
      bool is_whole = true;  // of pixels that are someone's
      for (int k = 0; k < 4; ++k) {
        const glm::ivec2 at(left + k % 2, low + k / 2);
        is_whole &= !may_be_nobodys(at.x, at.y, sample);
        lambdas[static_cast<std::size_t>(k)] = lambda_at(at.x, at.y, x > y);
        found[static_cast<std::size_t>(k)] = drawn(at.x, at.y);
      }
      const auto [least, most] = std::ranges::minmax(lambdas);
      const double is = drawn(x, y);
      ++out.pixels;
      out.own += is == level(lambda_at(x, y, x > y)) ? 1 : 0;
      out.of_square += is >= level(least - 0.05) && is <= level(most + 0.01) ? 1 : 0;
      if (!is_whole || x != left || y != low || level(least) == level(most)) continue;
      ++out.squares;
      out.alike += std::ranges::all_of(found, [&](double l) { return l == is; }) ? 1 : 0;
    }
  }
  return out;
}

}  // namespace

void learn_levels(Prober& prober) {
  C& c = prober.learned.conventions;
  const ConventionWords words = words_of("level_of_detail");
  if (prober.open_if_colors_are_not_linear(words) ||
      prober.open_if_any_open(words, {kSampleWords.name, "interpolation"}))
    return;
  const Plane<glm::vec4> color = prober.draw(floor_scene()).color;
  LevelCounts levels = level_counts(color, c.sample, c.interpolation);
  if (c.interpolation == C::Interpolation::affine) {  // levels may still be those of the surface
    const LevelCounts of_surface = level_counts(color, c.sample, C::Interpolation::perspective);
    if (of_surface.of_square > levels.of_square) levels = of_surface;
  }
  using enum C::LevelOfDetail;
  const bool one_each = levels.squares > 0 && levels.alike * 10 >= levels.squares * 9;
  const std::string evidence = fmt::format(
      "{} of {} pixels have a level of their square of 2 x 2, {} their own; "
      "{} of {} squares with several levels are drawn in one",
      levels.of_square, levels.pixels, levels.own, levels.alike, levels.squares);
  if (2 * levels.of_square < levels.pixels) return prober.fits_none(words, evidence);
  c.level_of_detail = levels.of_square < levels.pixels ? approximate : one_each ? per_square : per_pixel;
  prober.found(words, name_of(c.level_of_detail), evidence);
}

// A chequered texture of 0 and 255 at a level of detail of 1/4: the linear filter of magnification mixes texels, also
// one whose weights along s and t change places; the nearest filter of minification does not.
void learn_magnification(Prober& prober) {
  const ConventionWords words = words_of("magnified");
  const float most = std::exp2(0.25f);
  Texture texture = texture_of(64, [](int x, int y) { return (x + y) % 2 * 255; });
  texture.sampler.min = MinFilter::nearest_mipmap_nearest, texture.sampler.mag = MagFilter::linear;
  const Plane<glm::vec4> color = prober.draw(textured_frame("magnification", texture, most)).color;
  std::size_t mixed = 0, unmixed = 0;
  for (int x = 2; x < 48; ++x) {
    const float red = color(x, 56).r;
    mixed += red > 0.05f && red < 0.95f ? 1 : 0;
    unmixed += std::abs(red) <= 0.05f || std::abs(red - 1) <= 0.05f ? 1 : 0;
  }
  const std::string evidence = fmt::format("{} of 46 pixels mix texels at a level of detail of 1/4", mixed);
  if (mixed + unmixed < 46) return prober.fits_none(words, evidence);
  C& c = prober.learned.conventions;
  c.magnified = mixed > 12 ? C::Magnified::up_to_half : C::Magnified::up_to_zero;
  prober.found(words, name_of(c.magnified), evidence);
}

void learn_half_way(Prober& prober) {
  const ConventionWords words = words_of("half_way_level");
  if (prober.open_if_colors_are_not_linear(words)) return;
  std::array<double, 3> levels{};
  for (int i = 0; i < 3; ++i) {
    Texture texture = texture_of(64, [](int, int) { return 0; });
    texture.sampler.min = MinFilter::nearest_mipmap_nearest, texture.sampler.mag = MagFilter::nearest;
    texture.sampler.min_lod = texture.sampler.max_lod = static_cast<float>(i) + 1.5f;
    const Plane<glm::vec4> color = prober.draw(textured_frame("half_way", texture, 1)).color;
    levels[static_cast<std::size_t>(i)] = std::round(255 * static_cast<double>(color(8, 4).r) / 40);
  }
  const std::string evidence =
      fmt::format("1.5, 2.5 and 3.5 take levels {:.0f}, {:.0f} and {:.0f}", levels[0], levels[1], levels[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const double below = static_cast<double>(i) + 1;
    if (levels[i] != below && levels[i] != below + 1) return prober.fits_none(words, evidence);
  }
  const bool down = levels == std::array<double, 3>{1, 2, 3};
  prober.learned.conventions.half_way_level = down ? C::HalfWay::down : C::HalfWay::either;
  prober.found(words, name_of(prober.learned.conventions.half_way_level), evidence);
}

}  // namespace plumbline::learn
