// Precision of texture filters, and of colours that are multiplied by texels.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"
#include "learn/textured_frame.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kMostWeightBits = 12;  // finer weights differ from float's by less than the colours' rounding

// Picture draw(texture) of a texture on which no wrap mode acts, by the mode repeat where its own is unsupported.
Plane<glm::vec4> drawn_by_either_wrap(Texture texture, auto draw) {
  try {
    return draw(texture);
  } catch (const Unsupported&) {
    texture.sampler.wrap_s = texture.sampler.wrap_t = Wrap::repeat;
    return draw(texture);
  }
}

// Share that a frame shows of the distance from the first texel's centre to the last one's, where no wrap mode acts. A
// filter's weights there are odd multiples of 2^-13, which fewer than 13 bits do not hold.
constexpr float kMiddle = 61.0f / 64;
Plane<glm::vec4> middle_of(Prober& prober, const std::string& name, Texture texture) {
  const float side = 1 / static_cast<float>(texture.levels[0].width), least = side / 2;
  const float most = least + (1 - side) * kMiddle;
  texture.sampler.min = MinFilter::linear, texture.sampler.mag = MagFilter::linear;
  return drawn_by_either_wrap(
      texture, [&](const Texture& of) { return prober.draw(textured_frame(name, of, most, least)).color; });
}
// Texels from the first one's centre, of `size` in a row, at a pixel of middle_of().
double texels_at(double pixel, int size) { return (size - 1) * static_cast<double>(kMiddle) * pixel / kTexturedSize; }

// Errors of a filter's weights between a black and a white texel over all columns, the rounding to codes included.
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

// Fraction bits of the finest step that is at least the weights' largest error less the colours' rounding.
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
  const auto drawn = [&](const Texture& of) {
    Scene scene = textured_frame(name, of, 1);
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
  const Plane<glm::vec4> color = drawn_by_either_wrap(texture, drawn);
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

constexpr double kOfFourBits = 16;  // codes by which texels of four bits are off at most, truncated or replicated
constexpr const char* kOtherTexels = ": others are taken, such as those of another row";

// Texture of 4 x 4 unlike codes.
int unlike_code(int x, int y) { return (x * 83 + y * 151 + 11) % 256; }

// Errors of filtered texels of the texture of unlike codes [codes].
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
    return prober.fits_none(words, fmt::format("{}; texels that are not filtered, {:.2f}{}", evidence, off,
                                               off <= kOfFourBits ? ": they are kept in fewer bits" : kOtherTexels));
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
  if (most > kOfFourBits) return prober.fits_none(words, evidence + kOtherTexels);
  if (!(most <= 2 * rounding)) return prober.fits_none(words, evidence);
  c.fragment_colors = most <= rounding ? C::ColorNumbers::in_float : C::ColorNumbers::in_codes;
  prober.found(words, name_of(c.fragment_colors), evidence);
}

}  // namespace plumbline::learn
