// Misread states of the stages visibility and merge.
#include <algorithm>

#include "cli/likely/misread_state.h"

namespace plumbline::cli {

namespace {

bool reset_equation(Draw& draw) {
  if (!draw.merge.blend) return false;
  const bool rgb = reset(draw.merge.blend->rgb.equation, BlendEquation::add);
  return reset(draw.merge.blend->alpha.equation, BlendEquation::add) || rgb;
}

// Subtraction the other way: source - destination for destination - source.
constexpr auto kSubtractsTheOtherWay = [](Draw& d) {
  using enum BlendEquation;
  if (!d.merge.blend) return false;
  bool changed = false;
  for (BlendTerm* term : {&d.merge.blend->rgb, &d.merge.blend->alpha}) {
    if (term->equation == subtract || term->equation == reverse_subtract)
      changed |= reset(term->equation, term->equation == subtract ? reverse_subtract : subtract);
  }
  return changed;
};

constexpr auto kBlendsByAlpha = [](Draw& d) {
  if (!d.merge.blend) return false;
  bool changed = false;
  for (BlendTerm* term : {&d.merge.blend->rgb, &d.merge.blend->alpha}) {
    changed |= reset(term->source, BlendFactor::source_alpha);
    changed |= reset(term->destination, BlendFactor::one_minus_source_alpha);
  }
  return changed;
};

template <auto factor>
bool becomes_one(Draw& d) {
  if (!d.merge.blend) return false;
  const bool rgb = reset(d.merge.blend->rgb.*factor, BlendFactor::one);
  return reset(d.merge.blend->alpha.*factor, BlendFactor::one) || rgb;
}

// Whether an or-equal test became one that lets nothing equal pass.
template <class Func>
bool leaves_equal_out(Func& func) {
  return func == Func::less_equal      ? reset(func, Func::less)
         : func == Func::greater_equal ? reset(func, Func::greater)
                                       : false;
}

bool wraps_stencil(Draw& d) {
  if (!d.stencil) return false;
  bool changed = false;
  for (StencilFace* face : {&d.stencil->front, &d.stencil->back}) {
    for (StencilOp* op : {&face->fail, &face->depth_fail, &face->pass}) {
      if (*op == StencilOp::increment) changed |= reset(*op, StencilOp::increment_wrap);
      if (*op == StencilOp::decrement) changed |= reset(*op, StencilOp::decrement_wrap);
    }
  }
  return changed;
}

// The stencil op of a depth that fails is that of `other`.
template <StencilOp StencilFace::*other>
bool fails_depth_as(Draw& d) {
  if (!d.stencil) return false;
  const bool front = reset(d.stencil->front.depth_fail, d.stencil->front.*other);
  return reset(d.stencil->back.depth_fail, d.stencil->back.*other) || front;
}

bool saturates_nothing(Draw& d) {
  using enum BlendFactor;
  return d.merge.blend && d.merge.blend->rgb.source == source_alpha_saturate &&
         reset(d.merge.blend->rgb.source, source_alpha);
}

}  // namespace

std::vector<MisreadState> states_of_merge() {
  const glm::vec4 black(0, 0, 0, 1);
  return {
      {"visibility", "depth_func_ignored", "all depth tests are less",
       of_draws([](Draw& d) { return reset(d.depth_func, DepthFunc::less); })},
      {"visibility", "depth_test_ignored", "every depth passes: what is drawn last is seen",
       of_draws([](Draw& d) { return reset(d.depth_func, DepthFunc::always); })},
      {"visibility", "depth_mask_ignored", "depths are written, though they are masked",
       of_draws([](Draw& d) { return reset(d.merge.depth_mask, true); })},
      {"visibility", "depth_not_written", "no depth is written",
       of_draws([](Draw& d) { return reset(d.merge.depth_mask, false); })},
      {"visibility", "equal_depth_left_out", "an equal depth fails where it may pass",
       of_draws([](Draw& d) { return leaves_equal_out(d.depth_func); })},
      {"visibility", "depth_func_stays", "a draw of depth function less has that of the draw before",
       stays<&Draw::depth_func>()},
      {"visibility", "depth_mask_stays", "depth writes stay off after a draw without them",
       stays<&Merge::depth_mask>()},
      {"visibility", "alpha_test_stays", "a draw without an alpha test has that of the draw before",
       stays<&Draw::alpha_test>()},
      {"visibility", "equal_alpha_left_out", "an alpha equal to the reference fails where it may pass",
       of_draws([](Draw& d) { return d.alpha_test && leaves_equal_out(d.alpha_test->func); })},
      {"visibility", "clear_depth_ignored", "the depth is cleared to 1",
       [](Scene& s) { return reset(s.frame.clear_depth, 1.0); }},
      {"visibility", "stencil_ignored", "stencil values hide nothing",
       of_draws([](Draw& d) { return reset(d.stencil); })},
      {"visibility", "stencil_back_ignored", "back faces have the front faces' stencil test",
       of_draws([](Draw& d) { return d.stencil && reset(d.stencil->back, d.stencil->front); })},
      {"visibility", "depth_fail_as_fail", "depth_fail is taken for fail in stencil ops",
       of_draws(fails_depth_as<&StencilFace::fail>)},
      {"visibility", "depth_fail_as_pass", "depth_fail is taken for pass in stencil ops",
       of_draws(fails_depth_as<&StencilFace::pass>)},
      {"visibility", "draws_reversed", "the last draw is drawn first",
       [](Scene& s) { return s.draws.size() > 1 && (std::ranges::reverse(s.draws), true); }},
      {"visibility", "stencil_wraps", "stencil values wrap where they should stop", of_draws(wraps_stencil)},
      {"visibility", "stencil_stays", "a draw without a stencil test has that of the draw before",
       stays<&Draw::stencil>()},
      {"merge", "blend_ignored", "colours replace what is stored, and are not blended with it",
       of_draws([](Draw& d) { return reset(d.merge.blend); })},
      {"merge", "blend_stays", "a draw that does not blend blends as the draw before", stays<&Merge::blend>()},
      {"merge", "logic_op_stays", "a draw without a logic op has that of the draw before", stays<&Merge::logic_op>()},
      {"merge", "color_mask_stays", "a draw that writes all channels writes those of the draw before",
       stays<&Merge::color_mask>()},
      {"merge", "mask_blue_first", "the mask of red is taken for that of blue, and the other way round",
       of_draws([](Draw& d) {
         std::swap(d.merge.color_mask.r, d.merge.color_mask.b);
         return d.merge.color_mask.r != d.merge.color_mask.b;
       })},
      {"merge", "blend_factors_ignored", "blending is by the source's alpha, whatever the factors",
       of_draws(kBlendsByAlpha)},
      {"merge", "source_factor_of_one", "blending adds the source's colour as it is, whatever its factor",
       of_draws(becomes_one<&BlendTerm::source>)},
      {"merge", "destination_factor_of_one", "blending adds to the stored colour as it is, whatever its factor",
       of_draws(becomes_one<&BlendTerm::destination>)},
      {"merge", "blend_equation_ignored", "blended colours are added, whatever the equation", of_draws(reset_equation)},
      {"merge", "subtracted_the_other_way", "blending subtracts the source where it should the stored colour, and back",
       of_draws(kSubtractsTheOtherWay)},
      {"merge", "saturate_ignored", "factor source_alpha_saturate is the source's alpha alone",
       of_draws(saturates_nothing)},
      {"merge", "blend_color_ignored", "blending's constant colour is black, with alpha 0",
       of_draws([](Draw& d) { return d.merge.blend && reset(d.merge.blend->color, glm::vec4(0)); })},
      {"merge", "logic_op_ignored", "logic ops are not applied",
       of_draws([](Draw& d) { return reset(d.merge.logic_op); })},
      {"merge", "clear_color_ignored", "the frame is cleared to black",
       [=](Scene& s) { return reset(s.frame.clear_color, black); }},
  };
}

}  // namespace plumbline::cli
