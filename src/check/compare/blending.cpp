#include "check/compare/blending.h"

#include <algorithm>
#include <cmath>

#include "check/bounds/fragment_bounds.h"
#include "reference/arithmetic/frame_color.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

double largest(const Vec4<double>& color) {
  return std::max({std::abs(color.r), std::abs(color.g), std::abs(color.b), std::abs(color.a)});
}

/// Largest |c| and |1 - c| of a colour's channels, and those of its alpha. Default: bounds for an unknown colour in
/// [0,1].
struct Operand {
  double color = 1, less_color = 1, alpha = 1, less_alpha = 1;
  Operand() = default;
  explicit Operand(const Vec4<double>& c)
      : color(largest(c)), less_color(largest(1.0 - c)), alpha(std::abs(c.a)), less_alpha(std::abs(1 - c.a)) {}
};

/// Bounds of a blend factor.
struct Factor {
  double most = 0;      ///< of its absolute value
  double per_held = 0;  ///< its change by a change of the held colour
};
Factor factor(BlendFactor f, const Operand& source, const Operand& constant, double held) {
  switch (f) {
    case BlendFactor::zero: return {0, 0};
    case BlendFactor::one: return {1, 0};
    case BlendFactor::source_color: return {source.color, 0};
    case BlendFactor::one_minus_source_color: return {source.less_color, 0};
    case BlendFactor::source_alpha: return {source.alpha, 0};
    case BlendFactor::one_minus_source_alpha: return {source.less_alpha, 0};
    case BlendFactor::destination_color:
    case BlendFactor::destination_alpha: return {held, 1};
    case BlendFactor::one_minus_destination_color:
    case BlendFactor::one_minus_destination_alpha: return {1 + held, 1};
    case BlendFactor::constant_color: return {constant.color, 0};
    case BlendFactor::one_minus_constant_color: return {constant.less_color, 0};
    case BlendFactor::constant_alpha: return {constant.alpha, 0};
    case BlendFactor::one_minus_constant_alpha: return {constant.less_alpha, 0};
    case BlendFactor::source_alpha_saturate: return {std::max({1.0, source.alpha, 1 + held}), 1};
  }
  return {};
}

bool reads_frame(const BlendTerm& term) {
  const auto reads = [](BlendFactor f) { return factor(f, Operand(), Operand(), 1).per_held > 0; };
  return reads(term.source) || reads(term.destination);
}

/// Largest absolute value that a pixel may hold, and the rounding error of what it holds [u].
struct Held {
  double most, error = 0;
  void blend(const BlendTerm& term, const Operand& source, const Operand& constant) {
    constexpr double kPerLayer = 4;  // a factor of 1 - x, two products, their sum
    const double was = most;
    if (term.equation == BlendEquation::min || term.equation == BlendEquation::max) {
      most = std::max(was, source.color);
      return;
    }
    const Factor s = factor(term.source, source, constant, was), d = factor(term.destination, source, constant, was);
    most = source.color * s.most + was * d.most;
    // A renderer may have s a + d (1 - a) as d + a (s - d).
    const bool may_be_mix = math::are_complements(term.source, term.destination);
    const double rounded = may_be_mix ? std::max({1.0, s.most, d.most}) * (source.color + was) : most;
    error = error * (source.color * s.per_held + d.most + was * d.per_held) + kPerLayer * rounded;
  }
};

Held larger(const Held& a, const Held& b) { return {std::max(a.most, b.most), std::max(a.error, b.error)}; }

}  // namespace

bool factors_read_frame(const Scene& scene) {
  return std::ranges::any_of(scene.draws, [](const Draw& d) {
    return d.merge.blend && (reads_frame(d.merge.blend->rgb) || reads_frame(d.merge.blend->alpha));
  });
}

Plane<double> blending_roundings(const Scene& scene, const Records<double>& records) {
  Plane<double> out(scene.frame.width, scene.frame.height, 0);
  const bool shows_colors = records.shaded.size() == records.covered.size();
  const FragmentsByPixel drawn = FragmentsByPixel::drawn(scene.frame, records);
  const DrawIndex draws(scene);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      Held held{largest(Vec4<double>(scene.frame.clear_color))};
      drawn.each(x, y, [&](std::size_t i) {
        const Draw* draw = draws.draw(records.triangles[records.covered[i].triangle].primitive);
        const Operand source = shows_colors ? Operand(records.shaded[i].color) : Operand();
        const bool replaces_all = draw != nullptr && draw->merge.color_mask == glm::bvec4(true);
        if (draw == nullptr || !draw->merge.blend || draw->merge.logic_op) {  // float frames have no logic op
          held = replaces_all ? Held{source.color} : larger(held, {source.color});
          return;
        }
        const Blend& blend = *draw->merge.blend;
        const Operand constant{Vec4<double>(blend.color)};
        const Held was = held;
        Held rgb = held, alpha = held;
        rgb.blend(blend.rgb, source, constant), alpha.blend(blend.alpha, source, constant);
        held = larger(rgb, alpha);
        if (!replaces_all) held = larger(held, was);
      });
      out(x, y) = held.error;
    }
  }
  return out;
}

}  // namespace plumbline::check
