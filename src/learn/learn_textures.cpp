// Precision of texture filters, and how levels of detail are found.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kTexturedSize = 64;
constexpr int kMostWeightBits = 12;  // finer weights differ from float's by less than the colours' rounding

// A frame filled by a textured rectangle; s and t from `least` to `most`.
Scene textured_frame(const std::string& name, Texture texture, float most, float least = 0) {
  Scene scene = probe_frame(name, kTexturedSize, kTexturedSize);
  scene.textures.push_back(std::move(texture));
  const auto at = [&](double x, double y) {
    const glm::dvec2 share = glm::dvec2(x, y) / static_cast<double>(kTexturedSize);
    return ProbeCorner{{x, y, 0.5}, glm::vec4(1), glm::vec2(least) + (most - least) * glm::vec2(share)};
  };
  add_triangles(scene, quad({at(0, 0), at(kTexturedSize, 0), at(kTexturedSize, kTexturedSize), at(0, kTexturedSize)}))
      .texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  return scene;
}

// Level 0 has the grey codes of code(x, y); each level n above 0 is one grey, of 40 n codes.
Texture texture_of(int size, auto code) {
  Texture out;
  out.format = TextureFormat::rgb;
  out.sampler.wrap_s = out.sampler.wrap_t = Wrap::clamp_to_edge;
  for (int level = 0; size > 0; size /= 2, ++level) {
    TextureLevel& to = out.levels.emplace_back(TextureLevel{size, size, {}});
    for (int i = 0; i < size * size; ++i) {
      const int grey = level == 0 ? code(i % size, i / size) : 40 * level;
      to.texels.emplace_back(glm::vec3(static_cast<float>(grey) / 255), 1);
    }
  }
  return out;
}

// Share of a texture between its first and last texel's centre, where no wrap mode acts: a renderer may lack any mode.
// Weights there are multiples of 2^-13, which no fewer bits hold.
constexpr float kMiddle = 61.0f / 64;
Plane<glm::vec4> middle_of(Prober& prober, const std::string& name, Texture texture) {
  const float side = 1 / static_cast<float>(texture.levels[0].width), least = side / 2;
  const float most = least + (1 - side) * kMiddle;
  texture.sampler.min = MinFilter::linear, texture.sampler.mag = MagFilter::linear;
  try {
    return prober.draw(textured_frame(name, texture, most, least)).color;
  } catch (const Unsupported&) {
    texture.sampler.wrap_s = texture.sampler.wrap_t = Wrap::repeat;
    return prober.draw(textured_frame(name, texture, most, least)).color;
  }
}
// Texels from the first one's centre, of `size` in a row, at a pixel of middle_of().
double texels_at(double pixel, int size) { return (size - 1) * static_cast<double>(kMiddle) * pixel / kTexturedSize; }

// Pixels that may be nobody's: those with samples on a textured frame's diagonal, or on a side of it.
bool may_be_nobodys(int x, int y, const glm::dvec2& sample) {
  const auto is_on_side = [](int at, double offset) {
    return (at == 0 && offset == 0) || (at == kTexturedSize - 1 && offset == 1);
  };
  return x == y || is_on_side(x, sample.x) || is_on_side(y, sample.y);
}

// Errors of the weights between a black texel and a white one, at each column, those of colours in codes included.
struct WeightErrors {
  double least = std::numeric_limits<double>::infinity(), most = -least, mean = 0;
  std::set<long> codes;  // that are drawn
};
WeightErrors weight_errors(Prober& prober) {
  const Plane<glm::vec4> color = middle_of(prober, "texture_ramp", texture_of(2, [](int x, int) { return 255 * x; }));
  const glm::dvec2 sample = prober.learned.conventions.sample;
  WeightErrors out;
  int columns = 0;
  for (int x = 0; x < kTexturedSize; ++x) {
    if (may_be_nobodys(x, kTexturedSize / 2, sample)) continue;
    const auto drawn = static_cast<double>(color(x, kTexturedSize / 2).r);
    const double error = drawn - texels_at(x + sample.x, 2);
    if (std::isfinite(drawn)) out.codes.insert(std::lround(255 * drawn));
    out.least = std::min(out.least, error), out.most = std::max(out.most, error), out.mean += error;
    ++columns;
  }
  out.mean /= columns;
  return out;
}

constexpr double kCode = 1.0 / 255;

// Fraction bits of a step that the weights' largest error does not exceed, beyond the colours' rounding.
int bits_of(const WeightErrors& errors, C::Rounding of_colors) {
  const double below = of_colors == C::Rounding::nearest ? kCode / 2 : of_colors == C::Rounding::down ? kCode : 0;
  const double largest = std::max(-errors.least - below, errors.most - (kCode - below));
  return largest > 0 ? std::max(static_cast<int>(std::floor(-std::log2(largest))), 0) : kMostWeightBits;
}

// Whether the errors are of weights rounded to steps of so many bits (up, down or nearest), not of another curve or of
// a displaced sample. Up to 5 bits, steps are as wide as two columns or more, which then have one code.
bool are_of_rounding(const WeightErrors& errors, int bits) {
  const double step = std::ldexp(1.0, -bits);
  if (bits <= 5 && errors.codes.size() > (std::size_t{1} << bits) + 1) return false;
  return errors.most - errors.least <= 2 * step + 2 * kCode && std::abs(errors.mean) <= step / 2 + kCode;
}

// Greys of a picture's left and right side [codes].
struct Ramp {
  double left = 255, right = 255;
};

// Largest difference of texels that are not filtered, multiplied by greys, from those that the scene asks for [codes].
double texels_off(Prober& prober, const std::string& name, int texels, auto code, Ramp grey = {}) {
  const int pixels = kTexturedSize / texels;  // of a texel
  Texture texture = texture_of(texels, code);
  texture.sampler.min = MinFilter::nearest, texture.sampler.mag = MagFilter::nearest;
  const auto drawn = [&] {
    Scene scene = textured_frame(name, texture, 1);
    if (grey.left < 255) {
      scene.draws[0].texture->environment = TextureEnvironment::modulate;
      Mesh& mesh = scene.meshes[0];
      const auto [left, right] = std::ranges::minmax(mesh.positions, {}, &glm::vec3::x);
      for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
        const double codes = mesh.positions[i].x < (left.x + right.x) / 2 ? grey.left : grey.right;
        mesh.colors[i] = glm::vec4(glm::vec3(static_cast<float>(codes / 255)), 1);
      }
    }
    return prober.draw(scene).color;
  };
  Plane<glm::vec4> color;
  try {
    color = drawn();
  } catch (const Unsupported&) {
    texture.sampler.wrap_s = texture.sampler.wrap_t = Wrap::repeat;  // no wrap mode acts
    color = drawn();
  }
  const auto grey_at = [&](int x) {
    return glm::mix(grey.left, grey.right, (x + prober.learned.conventions.sample.x) / kTexturedSize) / 255;
  };
  const auto is_inside = [&](int at) { return at % pixels != 0 && at % pixels != pixels - 1; };
  double most = 0;
  for (int y = 0; y < kTexturedSize; ++y) {
    for (int x = 0; x < kTexturedSize; ++x) {
      const double exact = grey_at(x) * code(x / pixels, y / pixels);
      // Left out: the diagonal, which may be nobody's, and a texel's outer pixels, whose samples may lie on its border.
      if (x != y && is_inside(x) && is_inside(y))
        most = farther(most, 255 * static_cast<double>(color(x, y).r) - exact);
    }
  }
  return most;
}

// Texture of 4 x 4 unlike codes.
int unlike_code(int x, int y) { return (x * 83 + y * 151 + 11) % 256; }

// Errors of means of its texels [codes].
struct MeanErrors {
  double largest = 0, highest = -std::numeric_limits<double>::infinity();
  double step = 0;  // of the coarsest weights that explain each mean
  int count = 0;
};
MeanErrors mean_errors(Prober& prober) {
  const Plane<glm::vec4> color = middle_of(prober, "texture_weights", texture_of(4, unlike_code));
  const glm::dvec2 sample = prober.learned.conventions.sample;
  MeanErrors out;
  for (int y = 0; y < kTexturedSize; ++y) {
    for (int x = 0; x < kTexturedSize; ++x) {
      if (may_be_nobodys(x, y, sample)) continue;
      const glm::dvec2 at(texels_at(x + sample.x, 4), texels_at(y + sample.y, 4)), low = glm::floor(at);
      const glm::dvec2 share = at - low;
      const auto grey = [&](int dx, int dy) {
        const auto inside = [](double v) { return std::clamp(static_cast<int>(v), 0, 3); };
        return static_cast<double>(unlike_code(inside(low.x + dx), inside(low.y + dy)));
      };
      const double exact =
          glm::mix(glm::mix(grey(0, 0), grey(1, 0), share.x), glm::mix(grey(0, 1), grey(1, 1), share.x), share.y);
      const double off = 255 * static_cast<double>(color(x, y).r) - exact;
      ++out.count;
      out.largest = farther(out.largest, off);
      out.highest = std::max(out.highest, off);
      // Each direction's weight is off by at most a step; three means are rounded to half a step.
      const double along_x = std::max(std::abs(grey(1, 0) - grey(0, 0)), std::abs(grey(1, 1) - grey(0, 1))),
                   along_y = std::max(std::abs(grey(0, 1) - grey(0, 0)), std::abs(grey(1, 1) - grey(1, 0)));
      out.step = std::max(out.step, (std::abs(off) - 0.5) / (along_x + along_y + 1.5 * 255));
    }
  }
  return out;
}

}  // namespace

void learn_weights(Prober& prober) {
  const ConventionWords words = words_of("texture_bits");
  if (prober.open_if_colors_are_not_linear(words) || prober.open_if_any_open(words, {kSampleWords.name})) return;
  const auto [most, highest, step, count] = mean_errors(prober);
  const C& c = prober.learned.conventions;
  const std::string evidence = fmt::format("{} texels, {:.2f} codes off at most", count, most);
  if (!std::isfinite(most)) return prober.fits_none(words, evidence);
  // Coarse weights err towards either neighbour, truncated mixes downwards only.
  if (most > 1.01 && highest <= 0.01) return prober.fits_none(words, evidence + ", all below: each mix is truncated");
  const double rounding = c.color_rounding == C::Rounding::nearest ? 0.51 : 1.01;
  const bool are_float = most <= rounding;
  constexpr double kOtherRounding = 1;  // code by which another rounding of colours may differ
  const auto unfiltered_off = [&] {
    try {
      return texels_off(prober, "texels", 4, unlike_code);
    } catch (const Unsupported&) {
      return 0.0;  // no nearest filter: not seen
    }
  };
  if (const double off = are_float ? 0 : unfiltered_off(); off > rounding + kOtherRounding)
    return prober.fits_none(
        words, fmt::format("{}; texels that are not filtered, {:.2f}: they are kept in fewer bits", evidence, off));
  int bits = C::kFloat;
  if (!are_float) {
    const WeightErrors errors = weight_errors(prober);
    if (!std::isfinite(errors.mean)) return prober.fits_none(words, evidence + "; some are no numbers");
    bits =
        std::min({static_cast<int>(std::floor(-std::log2(step))), bits_of(errors, c.color_rounding), kMostWeightBits});
    // Errors show their form where a step is two codes or more.
    if (constexpr int kMostCoarse = 7; bits <= kMostCoarse && !are_of_rounding(errors, bits))
      return prober.fits_none(
          words, fmt::format("{}; weights are {:+.3f} to {:+.3f} off, {:+.3f} in the mean: no rounding", evidence,
                             errors.least, errors.most, errors.mean));
    if (bits < 4) return prober.fits_none(words, evidence);
  }
  prober.learned.conventions.texture_bits = bits;
  prober.found(words, bits_text(bits), evidence);
}

// Greys of 100 to 110 codes times all codes. In codes, the greys are rounded, too.
void learn_fragment_colors(Prober& prober) {
  const ConventionWords words = words_of("fragment_colors");
  if (prober.open_if_colors_are_not_linear(words)) return;
  if (prober.open_if_any_open(words, {"color_rounding", kSampleWords.name})) return;
  C& c = prober.learned.conventions;
  const auto code = [](int x, int y) { return 16 * y + x; };
  const double most = texels_off(prober, "fragment_colors", 16, code, {100, 110});
  const double rounding = c.color_rounding == C::Rounding::nearest ? 0.51 : 1.01;
  const std::string evidence = fmt::format("256 texels times a colour, {:.2f} codes off at most", most);
  if (!(most <= 2 * rounding)) return prober.fits_none(words, evidence);
  c.fragment_colors = most <= rounding ? C::ColorNumbers::in_float : C::ColorNumbers::in_codes;
  prober.found(words, name_of(c.fragment_colors), evidence);
}

namespace {

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
struct Levels {
  std::size_t pixels = 0, own = 0, of_square = 0, squares = 0, alike = 0;
};
Levels levels_of(const Plane<glm::vec4>& color, glm::dvec2 sample, C::Interpolation interpolation) {
  const auto lambda_at = [&](int x, int y, bool lower) {
    return floor_lambda(glm::dvec2(x, y) + sample, lower, interpolation);
  };
  const auto drawn = [&](int x, int y) { return std::round(255 * static_cast<double>(color(x, y).r) / 40); };
  const auto level = [](double lambda) { return std::clamp(std::ceil(lambda + 0.5) - 1, 0.0, 6.0); };
  Levels out;
  for (int y = 0; y < kTexturedSize; ++y) {
    for (int x = 0; x < kTexturedSize; ++x) {
      if (std::abs(x - y) < 3) continue;
      const int left = x & ~1, low = y & ~1;
      std::array<double, 4> lambdas{};
      std::array<double, 4> found{};
      for (int k = 0; k < 4; ++k) {
        const glm::ivec2 at(left + k % 2, low + k / 2);
        lambdas[static_cast<std::size_t>(k)] = lambda_at(at.x, at.y, x > y);
        found[static_cast<std::size_t>(k)] = drawn(at.x, at.y);
      }
      const auto [least, most] = std::ranges::minmax(lambdas);
      const double is = drawn(x, y);
      ++out.pixels;
      out.own += is == level(lambda_at(x, y, x > y)) ? 1 : 0;
      out.of_square += is >= level(least - 0.05) && is <= level(most + 0.01) ? 1 : 0;
      if (x != left || y != low || level(least) == level(most)) continue;
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
  Levels levels = levels_of(color, c.sample, c.interpolation);
  if (c.interpolation == C::Interpolation::affine) {  // levels may still be those of the surface
    const Levels of_surface = levels_of(color, c.sample, C::Interpolation::perspective);
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

// Texels of 0 and 255 by turns, at a level of detail of 1/4: the linear filter of magnification mixes them, the nearest
// filter of minification does not.
void learn_magnification(Prober& prober) {
  const ConventionWords words = words_of("magnified");
  const float most = std::exp2(0.25f);
  Texture texture = texture_of(64, [](int x, int) { return x % 2 * 255; });
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
