// Precision of texture filters, and how levels of detail are found.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "learn/probe_scene.h"
#include "learn/prober.h"

namespace plumbline::learn {

namespace {

using C = Conventions;

constexpr int kTexturedSize = 64;

// A frame filled by a textured rectangle; (s, t) from 0 to `most`.
Scene textured_frame(const std::string& name, Texture texture, float most) {
  Scene scene = probe_frame(name, kTexturedSize, kTexturedSize);
  scene.textures.push_back(std::move(texture));
  const auto at = [&](double x, double y) {
    const glm::dvec2 share = glm::dvec2(x, y) / static_cast<double>(kTexturedSize);
    return ProbeCorner{{x, y, 0.5}, glm::vec4(1), most * glm::vec2(share)};
  };
  add_triangles(scene, quad({at(0, 0), at(kTexturedSize, 0), at(kTexturedSize, kTexturedSize), at(0, kTexturedSize)}))
      .texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  return scene;
}

// One level of grey codes, and those below it all of the number's own grey: 40 codes more each.
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

void learn_weights(Prober& prober) {
  const ConventionWords words = words_of("texture_bits");
  const auto code = [](int x, int y) { return (x * 83 + y * 151 + 11) % 256; };
  Texture texture = texture_of(4, code);
  texture.sampler.min = MinFilter::linear, texture.sampler.mag = MagFilter::linear;
  const Plane<glm::vec4> color = prober.draw(textured_frame("texture_weights", texture, 1)).color;
  double most = 0;
  const C& c = prober.learned.conventions;
  for (int y = 0; y < kTexturedSize; ++y) {
    for (int x = 0; x < kTexturedSize; ++x) {
      const glm::dvec2 at = 4.0 * (glm::dvec2(x, y) + c.sample) / static_cast<double>(kTexturedSize) - 0.5,
                       low = glm::floor(at);
      const glm::dvec2 share = at - low;
      const auto grey = [&](int dx, int dy) {
        const auto inside = [](double v) { return std::clamp(static_cast<int>(v), 0, 3); };
        return static_cast<double>(code(inside(low.x + dx), inside(low.y + dy)));
      };
      const double exact =
          glm::mix(glm::mix(grey(0, 0), grey(1, 0), share.x), glm::mix(grey(0, 1), grey(1, 1), share.x), share.y);
      most = std::max(most, std::abs(255 * static_cast<double>(color(x, y).r) - exact));
    }
  }
  const std::string evidence = fmt::format("{} texels, {:.2f} codes off at most", kTexturedSize * kTexturedSize, most);
  int bits = c.color_rounding == C::Rounding::down && most <= 1.01 ? C::kFloat : most <= 0.51 ? C::kFloat : 12;
  // A weight is off by a step, of neighbours up to 255 codes apart in each direction; three means round.
  while (bits > 0 && most > 0.5 + std::ldexp(255.0, -bits) * (1 + 1.5)) --bits;
  if (bits == 0 || (bits > 0 && bits < 4)) return prober.open(words, evidence);
  prober.learned.conventions.texture_bits = bits;
  prober.found(words, bits_text(bits), evidence);
}

// A floor that reaches from near to far, each level of its texture in its own grey. Its texture lies askew: the length
// of a derivative is another than its largest component.
void learn_levels(Prober& prober) {
  const ConventionWords words = words_of("level_of_detail");
  Texture texture = texture_of(64, [](int, int) { return 0; });
  texture.sampler.min = MinFilter::nearest_mipmap_nearest, texture.sampler.mag = MagFilter::nearest;
  Scene scene = textured_frame("levels", texture, 1);
  scene.projection = Perspective{90, 1, 100};
  // Window x, y and w of its corners; texture coordinates go by the place on the floor.
  const auto corner = [](double x, double y, double w, float s, float t) {
    return ProbeCorner{{x * w, y * w, w}, glm::vec4(1), {s, t}};
  };
  Mesh& mesh = scene.meshes[0];
  const std::array<ProbeCorner, 4> c = {
      {corner(-1, -1, 2, 0, 0), corner(1, -1, 2, 1.1f, 0.9f), corner(1, 1, 12, -1, 9), corner(-1, 1, 12, -8, 4)}};
  const std::array<int, 6> order = {0, 1, 2, 0, 2, 3};
  for (std::size_t i = 0; i < 6; ++i) {
    const ProbeCorner& from = c[static_cast<std::size_t>(order[i])];
    mesh.positions[i] = {from.p.x, from.p.y, -from.p.z};
    mesh.texcoords[i] = from.texcoord;
  }
  scene.textures[0].sampler.wrap_s = scene.textures[0].sampler.wrap_t = Wrap::repeat;
  const Plane<glm::vec4> color = prober.draw(scene).color;
  // (s, t) at a place of the window, perspective-correct, in the triangle that holds it.
  const glm::dvec2 sample = prober.learned.conventions.sample;
  const auto st = [&](double px, double py, bool lower) {
    const glm::dvec2 at = (glm::dvec2(px, py) + sample) * 2.0 / static_cast<double>(kTexturedSize) - 1.0;
    const std::size_t k[3] = {0, lower ? 1u : 2u, lower ? 2u : 3u};
    const glm::dvec2 a(-1, -1), b = lower ? glm::dvec2(1, -1) : glm::dvec2(1, 1),
                                d = lower ? glm::dvec2(1, 1) : glm::dvec2(-1, 1);
    const double area = (b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x);
    const double w1 = ((at.x - a.x) * (d.y - a.y) - (at.y - a.y) * (d.x - a.x)) / area,
                 w2 = ((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)) / area;
    const double weights[3] = {1 - w1 - w2, w1, w2};
    glm::dvec2 sum(0);
    double over = 0;
    for (int i = 0; i < 3; ++i) {
      const double q = weights[i] / c[k[i]].p.z;
      sum += q * glm::dvec2(c[k[i]].texcoord), over += q;
    }
    return sum / over;
  };
  std::size_t all = 0, exact = 0, in_squares = 0, alike = 0, squares = 0;
  const auto level_at = [&](int x, int y) { return std::round(255 * static_cast<double>(color(x, y).r) / 40); };
  for (int y = 0; y < kTexturedSize; ++y) {
    for (int x = 0; x < kTexturedSize; ++x) {
      const int sx = x & ~1, sy = y & ~1;
      if (std::abs(x - y) < 3) continue;  // the triangles' common edge
      const bool lower = x > y;
      const auto lambda = [&](double px, double py) {
        const double h = 1e-3;
        const glm::dvec2 d_dx = (st(px + h, py, lower) - st(px - h, py, lower)) * 64.0 / (2 * h),
                         d_dy = (st(px, py + h, lower) - st(px, py - h, lower)) * 64.0 / (2 * h);
        return std::log2(std::max(glm::length(d_dx), glm::length(d_dy)));
      };
      const auto level = [](double l) { return std::clamp(std::ceil(l + 0.5) - 1, 0.0, 6.0); };
      const double own = lambda(x, y);
      double least = own, most = own;
      for (int k = 0; k < 4; ++k) {
        const double l = lambda(sx + k % 2, sy + k / 2);
        least = std::min(least, l), most = std::max(most, l);
      }
      const double is = level_at(x, y);
      ++all;
      exact += is == level(own) ? 1 : 0;
      in_squares += is >= level(least - 0.05) && is <= level(most + 0.01) ? 1 : 0;
      if (level(least) != level(most) && x == sx && y == sy) {
        ++squares;
        alike += level_at(x, y) == level_at(x + 1, y) && level_at(x, y) == level_at(x, y + 1) &&
                         level_at(x, y) == level_at(x + 1, y + 1)
                     ? 1
                     : 0;
      }
    }
  }
  using enum C::LevelOfDetail;
  C& conventions = prober.learned.conventions;
  const bool per_square_alike = squares > 0 && alike * 10 >= squares * 9;
  const std::string evidence =
      fmt::format("{} of {} levels are the pixel's own, {} its square's; {} of {} squares have one level", exact, all,
                  in_squares, alike, squares);
  conventions.level_of_detail = in_squares < all ? approximate : per_square_alike ? per_square : per_pixel;
  prober.found(words, name_of(conventions.level_of_detail), evidence);
}

// Texels of 0 and 255 by turns, at a level of detail of 1/4: mixed where it is magnified, and by a linear filter.
void learn_magnification(Prober& prober) {
  const ConventionWords words = words_of("magnified");
  const float most = std::exp2(0.25f);
  Texture texture = texture_of(64, [](int x, int) { return x % 2 * 255; });
  texture.sampler.min = MinFilter::nearest_mipmap_nearest, texture.sampler.mag = MagFilter::linear;
  const Plane<glm::vec4> color = prober.draw(textured_frame("magnification", texture, most)).color;
  std::size_t mixed = 0;
  for (int x = 2; x < 48; ++x) mixed += color(x, 8).r > 0.05f && color(x, 8).r < 0.95f ? 1 : 0;
  C& c = prober.learned.conventions;
  c.magnified = mixed > 12 ? C::Magnified::up_to_half : C::Magnified::up_to_zero;
  prober.found(words, name_of(c.magnified),
               fmt::format("{} of 46 texels are mixed at a level of detail of 1/4", mixed));
}

void learn_half_way(Prober& prober) {
  const ConventionWords words = words_of("half_way_level");
  std::array<double, 3> levels{};
  for (int i = 0; i < 3; ++i) {
    Texture texture = texture_of(64, [](int, int) { return 0; });
    texture.sampler.min = MinFilter::nearest_mipmap_nearest, texture.sampler.mag = MagFilter::nearest;
    texture.sampler.min_lod = texture.sampler.max_lod = static_cast<float>(i) + 1.5f;
    const Plane<glm::vec4> color = prober.draw(textured_frame("half_way", texture, 1)).color;
    levels[static_cast<std::size_t>(i)] = std::round(255 * static_cast<double>(color(8, 8).r) / 40);
  }
  const bool down = levels == std::array<double, 3>{1, 2, 3};
  prober.learned.conventions.half_way_level = down ? C::HalfWay::down : C::HalfWay::either;
  prober.found(words, name_of(prober.learned.conventions.half_way_level),
               fmt::format("1.5, 2.5 and 3.5 take levels {:.0f}, {:.0f} and {:.0f}", levels[0], levels[1], levels[2]));
}

}  // namespace

void learn_textures(Prober& prober) {
  const std::array<std::pair<const char*, void (*)(Prober&)>, 4> parts = {{{"texture_bits", learn_weights},
                                                                           {"level_of_detail", learn_levels},
                                                                           {"magnified", learn_magnification},
                                                                           {"half_way_level", learn_half_way}}};
  for (const auto& [name, part] : parts) {
    try {
      part(prober);
    } catch (const Unsupported& e) {
      prober.open(words_of(name), e.what());
    }
  }
}

}  // namespace plumbline::learn
