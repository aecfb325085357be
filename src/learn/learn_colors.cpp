// Rounding and encoding of colours, alpha tests and blending.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "capture/same_bits.h"
#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;
using Triangles = std::vector<std::array<ProbeCorner, 3>>;

constexpr int kInRow = 16, kAll = kInRow * kInRow;
constexpr std::size_t kColors = 3 * kAll;

// Rectangle number i of 256, 4 x 4 pixels each.
auto tile(int i, double z, const glm::vec4& color) {
  const glm::dvec2 low(4.0 * (i % kInRow), 4.0 * (i / kInRow));
  return rectangle(low, low + 4.0, z, color);
}
// The colour of rectangle i, at a pixel inside one of its two triangles.
const glm::vec4& pixel_of(const Plane<glm::vec4>& color, int i) {
  return color(4 * (i % kInRow) + 1, 4 * (i / kInRow) + 2);
}

// Adds a draw of all 256 rectangles, nearer than those of the scene's draws before.
Draw& add_tiles(Scene& scene, auto color_of) {
  Triangles triangles;
  const double z = kFlatDepth - 0.0625 * static_cast<double>(scene.draws.size());
  for (int i = 0; i < kAll; ++i) {
    for (const auto& t : tile(i, z, color_of(i))) triangles.push_back(t);
  }
  return add_triangles(scene, triangles);
}

// Code i plus 1/16, 3/16, ... or 15/16 code, another in each channel.
glm::vec4 between_codes(int i) {
  const auto above = [&](int channel) { return static_cast<float>((3 * i + 2 * channel) % 8 * 2 + 1) / 16; };
  const auto code = static_cast<float>(std::min(i, 254));
  return {(code + above(0)) / 255, (code + above(1)) / 255, (code + above(2)) / 255, 1};
}

// Encoding and rounding that explain most colours. The renderer leaves channel k of the given colours in order[k].
struct Fit {
  std::size_t most = 0;
  C::Encoding encoding = C::Encoding::linear;
  C::Rounding rounding = C::Rounding::nearest;
  std::array<int, 3> order;
  bool explains() const { return most * 50 >= kColors * 49; }
};
Fit fit_of(const Plane<glm::vec4>& color, std::array<int, 3> order) {
  Fit out{.order = order};
  for (const C::Encoding e : {C::Encoding::linear, C::Encoding::srgb}) {
    for (const C::Rounding r : {C::Rounding::nearest, C::Rounding::down, C::Rounding::up}) {
      std::size_t fits = 0;
      for (int i = 0; i < kAll; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto v = static_cast<double>(between_codes(i)[static_cast<int>(k)]);
          const double code = rounded(r, 255 * (e == C::Encoding::srgb ? srgb_encoded(v) : v));
          fits += std::round(255 * static_cast<double>(pixel_of(color, i)[order[k]])) == code ? 1 : 0;
        }
      }
      if (fits > out.most) out.most = fits, out.encoding = e, out.rounding = r;
    }
  }
  return out;
}
Fit best_fit(const Plane<glm::vec4>& color) {
  std::array<int, 3> order = {0, 1, 2};
  Fit best = fit_of(color, order);
  while (!best.explains() && std::ranges::next_permutation(order).found) {
    if (const Fit fit = fit_of(color, order); fit.most > best.most) best = fit;
  }
  return best;
}

// Name of a well-known wrong way to make codes that explains the colours; empty: none does.
std::string said_of_other_codes(const Plane<glm::vec4>& color) {
  const std::pair<const char*, double (*)(double)> kRules[] = {
      {"256 c, truncated, and at most 255", [](double c) { return std::min(255.0, std::floor(256 * c)); }},
      {"4095 c in 12 bits, truncated, whose last 4 bits are dropped (c * 4095 >> 4); 255 c + 0.5, truncated, is right",
       [](double c) { return std::floor(std::floor(4095 * c) / 16); }},
      {"of c to the power 1/2.2, a gamma; OpenGL's colours are linear",
       [](double c) { return std::nearbyint(255 * std::pow(c, 1 / 2.2)); }}};
  for (const auto& [says, code_of] : kRules) {
    std::size_t fits = 0;
    for (int i = 0; i < kAll; ++i) {
      for (int k = 0; k < 3; ++k)
        fits += std::round(255 * static_cast<double>(pixel_of(color, i)[k])) == code_of(between_codes(i)[k]) ? 1 : 0;
    }
    if (fits * 50 >= kColors * 49) return fmt::format("; {} are {}", fits, says);
  }
  return "";
}

// Largest difference of the colours from linear ones [codes].
double largest_error(const Plane<glm::vec4>& color) {
  double most = 0;
  for (int i = 0; i < kAll; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double is = pixel_of(color, i)[k], expected = between_codes(i)[k];
      most = farther(most, 255 * (is - expected));
    }
  }
  return most;
}
constexpr double kFewCodes = 4;

// Number of colours' numbers that are more than 1/1000 from a code, as judges have it (check/bounds/units.h).
std::size_t numbers_between_codes(const Plane<glm::vec4>& color) {
  std::size_t out = 0;
  for (int i = 0; i < kAll; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double codes = 255 * static_cast<double>(pixel_of(color, i)[k]);
      out += std::abs(codes - std::round(codes)) > 0.001 ? 1 : 0;
    }
  }
  return out;
}

}  // namespace

void learn_colors(Prober& prober) {
  const ConventionWords rounding = words_of("color_rounding"), encoding = words_of("color_encoding");
  Scene scene = probe_frame("colours", 4 * kInRow, 4 * kInRow);
  add_tiles(scene, between_codes);
  const Plane<glm::vec4> color = prober.draw(scene).color;
  if (!have_same_bits(prober.draw(scene).color, color)) prober.unexplained("one scene drawn twice differs");
  if (const std::size_t between = numbers_between_codes(color); 2 * between > kColors) {
    prober.not_linear = "colours are no codes of 8 bits";
    prober.fits_none(rounding, fmt::format("{} of {} numbers are no codes of 8 bits", between, kColors));
    return prober.open(encoding, "the rounding is open");
  }
  const Fit fit = best_fit(color);
  const std::string evidence = fmt::format("{} of {} colours", fit.most, kColors);
  if (!fit.explains()) {
    prober.fits_none(rounding,
                     evidence + " at most are explained by one rounding and encoding" + said_of_other_codes(color));
    if (!(largest_error(color) < kFewCodes)) prober.not_linear = "colours are encoded in no known way";
    return prober.open(encoding, "the rounding is open");
  }
  if (fit.order != std::array{0, 1, 2}) {
    constexpr std::array<const char*, 3> kNames = {"red", "green", "blue"};
    const auto name = [&](int k) { return kNames[static_cast<std::size_t>(fit.order[static_cast<std::size_t>(k)])]; };
    prober.unexplained(fmt::format("red, green and blue are left in {}, {} and {}", name(0), name(1), name(2)));
  }
  C& c = prober.learned.conventions;
  c.color_encoding = fit.encoding, c.color_rounding = fit.rounding;
  if (fit.encoding == C::Encoding::srgb) prober.not_linear = "colours are encoded";
  prober.found(rounding, name_of(c.color_rounding), evidence);
  prober.found(encoding, name_of(c.color_encoding), evidence);
}

// Ramps from left to right, in each channel another one over three codes, which begin and end between two codes.
void learn_vertex_colors(Prober& prober) {
  const ConventionWords words = words_of("vertex_colors");
  if (prober.open_if_colors_are_not_linear(words) ||
      prober.open_if_any_open(words, {"color_rounding", kSampleWords.name}))
    return;
  constexpr int kWidth = 128, kHeight = 8;
  constexpr std::array<double, 3> kLeft = {40.4, 90.6, 140.4}, kRight = {43.6, 93.6, 143.4};  // [codes]
  C& c = prober.learned.conventions;
  const auto color = [](const std::array<double, 3>& codes) {
    return glm::vec4(glm::dvec3(codes[0], codes[1], codes[2]) / 255.0, 1);
  };
  Scene scene = probe_frame("vertex_colors", kWidth, kHeight);
  add_triangles(scene, quad({{{{0, 0, kFlatDepth}, color(kLeft)},
                              {{kWidth, 0, kFlatDepth}, color(kRight)},
                              {{kWidth, kHeight, kFlatDepth}, color(kRight)},
                              {{0, kHeight, kFlatDepth}, color(kLeft)}}}));
  const Plane<glm::vec4> left = prober.draw(scene).color;
  // Colours of one vertex show the rounding of vertices; where these are codes, ramps show that of fragments.
  constexpr std::array kRoundings = {C::Rounding::nearest, C::Rounding::down, C::Rounding::up};
  std::array<int, kRoundings.size()> in_codes{};
  int in_float = 0, all = 0;
  for (int x = 0; x < kWidth; ++x) {
    const double share = (x + c.sample.x) / kWidth;
    for (std::size_t k = 0; k < 3; ++k) {
      const double of_floats = glm::mix(kLeft[k], kRight[k], share),
                   of_codes = glm::mix(std::round(kLeft[k]), std::round(kRight[k]), share);
      const double code = std::round(255 * static_cast<double>(left(x, 1)[static_cast<glm::length_t>(k)]));
      ++all, in_float += code == rounded(c.color_rounding, of_floats) ? 1 : 0;
      for (std::size_t r = 0; r < kRoundings.size(); ++r)
        in_codes[r] += code == rounded(kRoundings[r], of_codes) ? 1 : 0;
    }
  }
  const bool may_differ = c.color_rounding == C::Rounding::nearest;  // vertices are rounded to the nearest
  const auto declared = in_codes.begin() + (std::ranges::find(kRoundings, c.color_rounding) - kRoundings.begin()),
             best = may_differ ? std::ranges::max_element(in_codes) : declared;
  const int most = std::max(in_float, *best);
  const std::string evidence = fmt::format("{} of {} colours of ramps", most, all);
  if (20 * most < 19 * all) return prober.fits_none(words, evidence + " at most are explained");
  c.vertex_colors = *best > in_float ? C::ColorNumbers::in_codes : C::ColorNumbers::in_float;
  if (*best > in_float && best != declared) {
    c.color_rounding = kRoundings[static_cast<std::size_t>(best - in_codes.begin())];
    prober.found(words_of("color_rounding"), name_of(c.color_rounding), evidence + ", between vertices in codes");
  }
  prober.found(words, name_of(c.vertex_colors), evidence);
}

// Two rectangles beside each other, of alphas 1/4 and 3/4, which may be encoded as colours are. A frame without alpha
// holds one number for both.
void learn_alpha(Prober& prober) {
  constexpr double kAlike = 1.5 / 255, kApart = 0.25;
  const ConventionWords words = words_of("alpha");
  Scene scene = probe_frame("alpha", 16, 16);
  add_triangles(scene, rectangle({0, 0}, {8, 16}, kFlatDepth, {1, 1, 1, 0.25f}));
  add_triangles(scene, rectangle({8, 0}, {16, 16}, kFlatDepth, {1, 1, 1, 0.75f}));
  const Plane<glm::vec4> color = prober.draw(scene).color;
  const double first = color(5, 4).a, second = color(12, 4).a;  // not on the diagonals
  const std::string evidence = fmt::format("alphas of 1/4 and 3/4 are left as {:.4g} and {:.4g}", first, second);
  const bool are_stored = second - first >= kApart;
  if (!are_stored && !(std::abs(first - second) <= kAlike)) return prober.fits_none(words, evidence);
  prober.learned.conventions.alpha = are_stored ? C::Alpha::stored : C::Alpha::none;
  prober.found(words, name_of(prober.learned.conventions.alpha), evidence);
}

// Alphas of 128.2 codes against 127.8, and of 128.4 against 128.1: greater as floats, equal as nearest codes. Codes
// rounded down or up differ in the first pair alone. 128.1 passes against 128.4 if the reference alone is truncated.
void learn_alpha_test(Prober& prober) {
  const ConventionWords words = words_of("alpha_test");
  const auto passes = [&](float alpha, float reference) {
    Scene scene = probe_frame("alpha_test", 16, 16);
    add_triangles(scene, rectangle({0, 0}, {16, 16}, kFlatDepth, {1, 1, 1, alpha / 255})).alpha_test =
        AlphaTest{CompareFunc::greater, reference / 255};
    return prober.draw(scene).color(8, 4).r > 0.5f;  // not on the diagonal
  };
  const bool first = passes(128.2f, 127.8f), second = passes(128.4f, 128.1f), third = passes(128.1f, 128.4f);
  const auto said = [](bool is_greater) { return is_greater ? "passes as greater than" : "is equal to"; };
  const std::string evidence = fmt::format("128.2 / 255 {} 127.8 / 255", said(first));
  if (third) return prober.fits_none(words, "128.1 / 255 passes as greater than 128.4 / 255: one of two is a code");
  if (first != second)
    return prober.fits_none(words, fmt::format("{}, 128.4 / 255 {} 128.1 / 255: codes are not rounded to nearest, or "
                                               "one of two is no code",
                                               evidence, said(second)));
  prober.learned.conventions.alpha_test = first ? C::AlphaTest::in_float : C::AlphaTest::in_codes;
  prober.found(words, name_of(prober.learned.conventions.alpha_test), evidence);
}

// Blends two layers over a colour. A renderer that blends in float and rounds each result once is within one rounding
// of the exact blend over the codes that the first layer left.
void learn_blending(Prober& prober) {
  const ConventionWords words = words_of("blending");
  if (prober.open_if_colors_are_not_linear(words)) return;
  const auto code_under = [](int i) { return (i * 37) % 255; };
  const auto under = [&](int i) { return (static_cast<float>(code_under(i)) + 0.3f) / 255; };  // no code
  const auto over = [](int i) { return static_cast<float>((i * 91 + 40) % 256) / 255; };
  const auto alpha = [](int i) { return (static_cast<float>((i * 53 + 7) % 255) + 0.4f) / 255; };
  const auto drawn = [&](BlendFactor of_alpha) {
    Scene scene = probe_frame("blending", 4 * kInRow, 4 * kInRow);
    add_tiles(scene, [&](int i) { return glm::vec4(glm::vec3(under(i)), 1); });
    const BlendFactor rest = BlendFactor::one_minus_source_alpha;
    const BlendTerm term{BlendFactor::source_alpha, rest, BlendEquation::add};
    for (int layer = 0; layer < 2; ++layer) {
      add_tiles(scene, [&](int i) { return glm::vec4(glm::vec3(over(i)), alpha(i)); }).merge.blend =
          Blend{term, {of_alpha, rest, BlendEquation::add}, glm::vec4(0)};
    }
    return prober.draw(scene).color;
  };
  const auto drawn_either_way = [&] {
    try {
      return drawn(BlendFactor::source_alpha);
    } catch (const Unsupported&) {
      return drawn(BlendFactor::one);  // alpha as coverage; it is not compared
    }
  };
  const C::Rounding rounding = prober.learned.conventions.color_rounding;
  const Plane<glm::vec4> color = drawn_either_way();
  const C& c = prober.learned.conventions;
  const bool of_vertices = c.vertex_colors == C::ColorNumbers::in_codes;  // rounded to the nearest before all else
  const auto alpha_of_fragment = [&](double given) {
    if (of_vertices) return std::round(255 * given) / 255;
    return c.fragment_colors == C::ColorNumbers::in_codes ? rounded(rounding, 255 * given) / 255 : given;
  };
  const auto left_under = [&](int i) {
    return of_vertices ? static_cast<double>(code_under(i)) : rounded(rounding, code_under(i) + 0.3);
  };
  double most = 0, least = 0, largest = 0, sum = 0;  // of the differences [codes]
  for (int i = 0; i < kAll; ++i) {
    const double a = alpha_of_fragment(static_cast<double>(alpha(i)));
    const double first = a * 255 * over(i) + (1 - a) * left_under(i);
    const double exact = a * 255 * over(i) + (1 - a) * rounded(rounding, first);
    const double off = 255 * static_cast<double>(pixel_of(color, i).r) - exact;
    most = farther(most, off);
    least = std::min(least, off), largest = std::max(largest, off), sum += off;
  }
  const double once = rounding == C::Rounding::nearest ? 0.501 : 1.001;
  const std::string evidence = fmt::format("{} blends in two layers, {:.2f} codes off at most", kAll, most);
  // Products that are rounded down: four of the two layers, half a code too small in the mean, a code at most.
  const bool is_down = rounding != C::Rounding::down && sum < -0.75 * kAll && largest < 1.5 && least > -4.5;
  if (most > once + 4) return prober.fits_none(words, evidence);
  prober.learned.conventions.blending = most <= once ? C::Blending::in_float
                                        : is_down    ? C::Blending::in_codes_down
                                                     : C::Blending::in_codes;
  prober.found(words, name_of(prober.learned.conventions.blending), evidence);
}

}  // namespace plumbline::learn
