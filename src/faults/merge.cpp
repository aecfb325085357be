#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "faults/lists.h"
#include "faults/variants.h"
#include "kernels/merge.h"
#include "kernels/visibility.h"

namespace plumbline::faults {

namespace {

// 10. Visibility.

// Depth test by the function other(func), which is another for some `func`.
template <auto other>
bool depth_passes_by(DepthFunc func, float incoming, float stored) {
  return pipeline::compares<float>(other(func), incoming, stored);
}

constexpr auto kEqualToo = [](DepthFunc func) {
  return func == DepthFunc::less ? DepthFunc::less_equal : func == DepthFunc::greater ? DepthFunc::greater_equal : func;
};
// a < b for b < a.
constexpr auto kSidesSwapped = [](CompareFunc func) {
  switch (func) {
    case CompareFunc::less: return CompareFunc::greater;
    case CompareFunc::greater: return CompareFunc::less;
    case CompareFunc::less_equal: return CompareFunc::greater_equal;
    case CompareFunc::greater_equal: return CompareFunc::less_equal;
    default: return func;
  }
};

bool alpha_at_the_reference_kept(const AlphaTest& test, float alpha, float scale) {
  const bool greater = test.func == CompareFunc::greater;
  return pipeline::alpha_passes<float>({greater ? CompareFunc::greater_equal : test.func, test.reference}, alpha,
                                       scale);
}

bool no_alpha_test(const AlphaTest&, float, float) { return true; }

// Stencil test of the face that `change` altered.
template <auto change>
bool stencil_under(const StencilFace& face, bool alive, bool passes_depth, std::uint8_t* at) {
  StencilFace wrong = face;
  change(wrong);
  return pipeline::stencil_test<float>(wrong, alive, passes_depth, at);
}

// Stencil ops on what the test compares: the value held, by the test's mask.
bool stencil_of_masked(const StencilFace& face, bool alive, bool passes_depth, std::uint8_t* at) {
  const auto masked = static_cast<std::uint8_t>(*at & face.mask);
  std::uint8_t held = masked;
  const bool passes = pipeline::stencil_test<float>(face, alive, passes_depth, &held);
  if (held != masked) *at = static_cast<std::uint8_t>((*at & ~face.write_mask) | (held & face.write_mask));
  return passes;
}

constexpr auto kOpsSwapped = [](StencilFace& face) { std::swap(face.pass, face.depth_fail); };
constexpr auto kReferenceOnTheRight = [](StencilFace& face) { face.func = kSidesSwapped(face.func); };
constexpr auto kNoMask = [](StencilFace& face) { face.mask = 0xff; };
constexpr auto kNoWriteMask = [](StencilFace& face) { face.write_mask = 0xff; };
constexpr auto kNoWrap = [](StencilFace& face) {
  for (StencilOp* op : {&face.fail, &face.depth_fail, &face.pass}) {
    if (*op == StencilOp::increment_wrap) *op = StencilOp::increment;
    if (*op == StencilOp::decrement_wrap) *op = StencilOp::decrement;
  }
};

// 11. Merge.

bool where_depth_passes(bool passes_depth, bool) { return passes_depth; }
bool everywhere(bool, bool) { return true; }

// Merge state that `change` altered.
template <auto change>
Merge merge_under(const Merge& of_draw) {
  Merge wrong = of_draw;
  change(wrong);
  return wrong;
}

constexpr auto kFactorsSwapped = [](Merge& merge) {
  if (!merge.blend) return;
  std::swap(merge.blend->rgb.source, merge.blend->rgb.destination);
  std::swap(merge.blend->alpha.source, merge.blend->alpha.destination);
};
constexpr auto kAlphaAsRgb = [](Merge& merge) {
  if (merge.blend) merge.blend->alpha = merge.blend->rgb;
};
constexpr auto kNoColorMask = [](Merge& merge) { merge.color_mask = glm::bvec4(true); };
constexpr auto kNoAlphaMask = [](Merge& merge) { merge.color_mask.a = true; };

Color<float> truncated_color(const Color<float>& color, float scale) {
  if (scale == 0.0f) return color;
  const auto code = [&](float v) { return static_cast<float>(static_cast<int>(pipeline::clamp01(v) * scale)); };
  return {code(color.r), code(color.g), code(color.b), code(color.a)};
}

Color<float> blue_first(const Color<float>& color, float scale) {
  return pipeline::merge<float>({color.b, color.g, color.r, color.a}, scale);
}

Color<float> premultiplied_again(const Blend& state, const Color<float>& source, const Color<float>& stored,
                                 float scale) {
  const float a = source.a;
  return pipeline::blend<float>(state, {source.r * a, source.g * a, source.b * a, a}, stored, scale);
}

// Blended colour before it is clamped and rounded to a code.
Color<float> unrounded_blend(const Blend& state, const Color<float>& source, const Color<float>& stored, float scale) {
  const auto clamped = [](float v) { return pipeline::clamp01(v); };
  return pipeline::blend<float>(state, {clamped(source.r), clamped(source.g), clamped(source.b), clamped(source.a)},
                                {stored.r / scale, stored.g / scale, stored.b / scale, stored.a / scale}, 0.0f);
}

// (s * a + d * (255 - a)) >> 8.
Color<float> shifted_for_divided(const Blend& state, const Color<float>& source, const Color<float>& stored,
                                 float scale) {
  const Color<float> right = pipeline::blend<float>(state, source, stored, scale);
  if (scale == 0.0f) return right;
  const Color<float> sum = unrounded_blend(state, source, stored, scale);
  const auto code = [&](const BlendTerm& term, float v, float as_is) {
    if (term.equation == BlendEquation::min || term.equation == BlendEquation::max) return as_is;
    return std::floor(pipeline::clamp01(v) * scale * scale / (scale + 1));
  };
  return {code(state.rgb, sum.r, right.r), code(state.rgb, sum.g, right.g), code(state.rgb, sum.b, right.b),
          code(state.alpha, sum.a, right.a)};
}

// Sums in integers of the format's bits, which are not clamped: 256 is 0.
Color<float> wrapped_sum(const Blend& state, const Color<float>& source, const Color<float>& stored, float scale) {
  const Color<float> right = pipeline::blend<float>(state, source, stored, scale);
  if (scale == 0.0f) return right;
  const Color<float> sum = unrounded_blend(state, source, stored, scale);
  const auto code = [&](float v, float as_is) {
    const float whole = std::floor(v * scale + 0.5f);
    return whole > scale ? std::fmod(whole, scale + 1) : as_is;
  };
  return {code(sum.r, right.r), code(sum.g, right.g), code(sum.b, right.b), code(sum.a, right.a)};
}

Color<float> sides_of_logic_op_swapped(LogicOp op, const Color<float>& source, const Color<float>& stored,
                                       float scale) {
  const LogicOp wrong = op == LogicOp::and_reverse    ? LogicOp::and_inverted
                        : op == LogicOp::and_inverted ? LogicOp::and_reverse
                                                      : op;
  return pipeline::logic<float>(wrong, source, stored, scale);
}

// 12. Resolve.

using Values = std::span<const float>;
using Samples = std::span<const PixelSample>;

double weighted_sum(Values values, Samples samples) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += static_cast<double>(samples[i].weight) * static_cast<double>(values[i]);
  }
  return sum;
}
double weights(Samples samples) {
  double sum = 0;
  for (const PixelSample& s : samples) sum += s.weight;
  return sum;
}

float truncated_mean(Values values, Samples samples, float scale) {
  if (scale == 0.0f) return pipeline::weighted_mean(values, samples, scale);
  return static_cast<float>(std::floor(weighted_sum(values, samples) / weights(samples)));
}

// Weighted mean with the second and third samples' weights exchanged: neighbours in the table.
float mean_of_swapped(Values values, Samples samples, float scale) {
  std::vector<PixelSample> wrong(samples.begin(), samples.end());
  if (wrong.size() > 2) std::swap(wrong[1].weight, wrong[2].weight);
  return pipeline::weighted_mean(values, wrong, scale);
}

float first_sample(Values values, Samples, float) { return values[0]; }

float first_half(Values values, Samples samples, float scale) {
  const std::size_t half = (values.size() + 1) / 2;
  return pipeline::weighted_mean(values.first(half), samples.first(half), scale);
}

float last_left_out(Values values, Samples samples, float scale) {
  const std::size_t most = std::max<std::size_t>(values.size() - 1, 1);
  const double mean = weighted_sum(values.first(most), samples.first(most)) / weights(samples);
  return static_cast<float>(scale == 0.0f ? mean : std::floor(mean + 0.5));
}

float equal_weights(Values values, Samples samples, float scale) {
  std::vector<PixelSample> wrong(samples.begin(), samples.end());
  for (PixelSample& s : wrong) s.weight = 1;
  return pipeline::weighted_mean(values, wrong, scale);
}

template <pipeline::Resolve resolve>
void put_resolve(Stages& stages) {
  stages.resolve = {resolve, resolve};
}

constexpr std::array kMerge = {
    stage_fault("visibility.less_equal", "an equal depth passes where only a smaller one, or only a greater one, may",
                put<&Stages::depth_passes, depth_passes_by<kEqualToo>>),
    stage_fault("visibility.greater_for_less", "the depth test asks for the farther one",
                put<&Stages::depth_passes, depth_passes_by<kSidesSwapped>>),
    stage_fault("visibility.alpha_at_reference", "an alpha equal to the reference passes where only a greater one may",
                put<&Stages::alpha_passes, alpha_at_the_reference_kept>),
    stage_fault("visibility.no_alpha_test", "the alpha test lets everything pass",
                put<&Stages::alpha_passes, no_alpha_test>),
    stage_fault("visibility.stencil_ops_swapped",
                "the stencil op of a depth that fails is taken for that of one that passes",
                put<&Stages::stencil_test, stencil_under<kOpsSwapped>>),
    stage_fault("visibility.stencil_sides_swapped",
                "the value held is compared with the reference, not the other way round",
                put<&Stages::stencil_test, stencil_under<kReferenceOnTheRight>>),
    stage_fault("visibility.stencil_mask_unused", "stencil values are compared in all bits",
                put<&Stages::stencil_test, stencil_under<kNoMask>>),
    stage_fault("visibility.stencil_ops_of_masked",
                "stencil ops take the value held by the test's mask, and lose its other bits",
                put<&Stages::stencil_test, stencil_of_masked>),
    stage_fault("visibility.stencil_write_mask_unused", "stencil ops change all bits",
                put<&Stages::stencil_test, stencil_under<kNoWriteMask>>),
    stage_fault("visibility.stencil_saturates", "stencil values stop where they should wrap",
                put<&Stages::stencil_test, stencil_under<kNoWrap>>, "RPCS3/rpcs3#1341"),
    stage_fault("merge.depth_of_discarded", "fragments that the alpha or stencil test discards write their depth",
                put<&Stages::writes_depth, where_depth_passes>),
    stage_fault("merge.depth_of_failed", "depths are written where the depth test fails, too",
                put<&Stages::writes_depth, everywhere>),
    stage_fault("merge.truncated", "colours are truncated to codes, not rounded", put<&Stages::merge, truncated_color>),
    stage_fault("merge.blue_first", "red and blue change places", put<&Stages::merge, blue_first>),
    stage_fault("merge.factors_swapped",
                "blending takes the source's factor for the destination's, and the other way round",
                put<&Stages::merge_state, merge_under<kFactorsSwapped>>),
    stage_fault("merge.alpha_as_rgb", "alpha is blended by the factors and equation of rgb",
                put<&Stages::merge_state, merge_under<kAlphaAsRgb>>),
    stage_fault("merge.premultiplied_again", "blended colours are multiplied by their alpha once more",
                put<&Stages::blend, premultiplied_again>, "OpenRA/TiberianDawnHD#28"),
    stage_fault("merge.shifted_for_divided", "blending divides by 256, not 255, and truncates",
                put<&Stages::blend, shifted_for_divided>, "scummvm/scummvm#985"),
    stage_fault("merge.sum_wraps", "blended sums beyond the largest code wrap to small ones",
                put<&Stages::blend, wrapped_sum>),
    stage_fault("merge.logic_op_sides", "a logic op turns the wrong one over: s & ~d for ~s & d",
                put<&Stages::logic, sides_of_logic_op_swapped>),
    stage_fault("merge.color_mask_ignored", "masked channels are written",
                put<&Stages::merge_state, merge_under<kNoColorMask>>),
    stage_fault("merge.alpha_mask_ignored", "alpha is written where it is masked",
                put<&Stages::merge_state, merge_under<kNoAlphaMask>>),
    stage_fault("resolve.truncated", "the mean of a pixel's samples is truncated to a code, not rounded",
                put_resolve<truncated_mean>),
    stage_fault("resolve.first_sample", "a pixel's first sample is taken for all", put_resolve<first_sample>),
    stage_fault("resolve.half_the_samples", "only the first half of the samples count", put_resolve<first_half>,
                "dpjudas/SurrealEngine#341"),
    stage_fault("resolve.last_left_out", "the last sample is not added, but counted: all is too dark",
                put_resolve<last_left_out>, "mrdoob/three.js#8884"),
    stage_fault("resolve.equal_weights", "all six taps count alike",
                put<&pipeline::ResolveStage::weighted, equal_weights>),
    stage_fault("resolve.weights_swapped", "two of the six taps have each other's weight",
                put<&pipeline::ResolveStage::weighted, mean_of_swapped>),
};

}  // namespace

std::span<const Fault> of_merge() { return kMerge; }

}  // namespace plumbline::faults
