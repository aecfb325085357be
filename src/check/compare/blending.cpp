#include "check/compare/blending.h"

#include <algorithm>
#include <cmath>

#include "check/bounds/fragment_bounds.h"

namespace plumbline::check {

namespace {

bool reads_frame(const BlendTerm& term) {
  const auto reads = [](BlendFactor f) {
    return f == BlendFactor::destination_color || f == BlendFactor::one_minus_destination_color ||
           f == BlendFactor::destination_alpha || f == BlendFactor::one_minus_destination_alpha ||
           f == BlendFactor::source_alpha_saturate;
  };
  return reads(term.source) || reads(term.destination);
}

}  // namespace

bool factors_read_frame(const Scene& scene) {
  return std::ranges::any_of(scene.draws, [](const Draw& d) {
    return d.merge.blend && (reads_frame(d.merge.blend->rgb) || reads_frame(d.merge.blend->alpha));
  });
}

Plane<double> blending_roundings(const Scene& scene, const Records<double>& records) {
  constexpr double kPerLayer = 4;  // two products, their sum, and a factor of 1 - x
  Plane<double> out(scene.frame.width, scene.frame.height, 0);
  const bool reads = factors_read_frame(scene), shows_colors = records.shaded.size() == records.covered.size();
  const FragmentsByPixel drawn = FragmentsByPixel::drawn(scene.frame, records);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const glm::vec4 clear = glm::abs(scene.frame.clear_color);
      double layers = 0, held = std::max({1.0f, clear.r, clear.g, clear.b, clear.a});
      drawn.each(x, y, [&](std::size_t i) {
        const Vec4<double> color = shows_colors ? glm::abs(records.shaded[i].color) : Vec4<double>(1);
        held += std::max({1.0, color.r, color.g, color.b, color.a});
        ++layers;
      });
      out(x, y) = kPerLayer * (reads ? std::exp2(layers) - 1 : layers) * held;
    }
  }
  return out;
}

}  // namespace plumbline::check
