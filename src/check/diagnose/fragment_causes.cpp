// Known causes of stages 8 to 12.
#include <algorithm>
#include <array>
#include <cmath>

#include "check/diagnose/known_causes.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

std::vector<Vec4<double>>& coordinates(Capture& c) { return c.records.varyings[Varying::texture].fragments; }

bool colors_truncated(const Evidence& e) {
  if (e.conventions.color_rounding == Conventions::Rounding::down) return false;  // declared
  const auto &mine = e.candidate.planes.color.values(), &theirs = e.expected.planes.color.values();
  const double scale = color_scale(e.scene.frame.color);
  Truncation t;
  const auto& id = e.candidate.planes.id.values();  // the clear colour may be rounded otherwise
  for (std::size_t i = 0; i < std::min(mine.size(), theirs.size()); ++i) {
    if (i < id.size() && id[i] == kBackground) continue;
    for (int c = 0; c < 4; ++c) t.add(std::nearbyint(mine[i][c] * scale), theirs[i][c] * scale);
  }
  return scale > 0 && t.shows();
}

template <int by>
bool lod_off_by(const Evidence& e) {
  const auto &mine = e.candidate.records.texels, &theirs = e.expected.records.texels;
  if (mine.size() != theirs.size()) return false;
  std::size_t off = 0, equal = 0;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const double d = mine[i].lod - theirs[i].lod;
    off += std::abs(d - by) < 1e-3 ? 1 : 0;
    equal += std::abs(d) < 1e-3 ? 1 : 0;
  }
  return off > 0 && (mine.size() - off - equal) * 50 <= off;
}

template <DepthFunc from, DepthFunc to>
void compared_otherwise(Draw& d) {
  d.depth_func = d.depth_func == from ? to : d.depth_func;
}
template <Wrap from, Wrap to>
void wrapped_otherwise(Sampler& t) {
  if (t.wrap_s == from) t.wrap_s = to;
  if (t.wrap_t == from) t.wrap_t = to;
}
void unfiltered(Sampler& t) {
  t.mag = MagFilter::nearest;
  t.min = t.min == MinFilter::linear                  ? MinFilter::nearest
          : t.min == MinFilter::linear_mipmap_nearest ? MinFilter::nearest_mipmap_nearest
          : t.min == MinFilter::linear_mipmap_linear  ? MinFilter::nearest_mipmap_linear
                                                      : t.min;
}
DepthFunc turned(DepthFunc func) {
  using enum DepthFunc;
  constexpr std::array kTurned = {never, greater, equal, greater_equal, less, not_equal, less_equal, always};
  return kTurned[static_cast<std::size_t>(func)];
}

LogicOp other_side(LogicOp op) {
  switch (op) {
    case LogicOp::and_reverse: return LogicOp::and_inverted;
    case LogicOp::and_inverted: return LogicOp::and_reverse;
    case LogicOp::or_reverse: return LogicOp::or_inverted;
    case LogicOp::or_inverted: return LogicOp::or_reverse;
    default: return op;
  }
}

// Texels taken for points at their lower left corners: half a texel of the base level.
void half_a_texel_off(Scene& s, Capture& in) {
  const DrawIndex draws(s);
  for (std::size_t i = 0; i < in.records.covered.size(); ++i) {
    const Draw* draw = draws.draw(in.records.triangles.at(in.records.covered[i].triangle).primitive);
    if (draw == nullptr || !draw->texture) continue;
    const Texture& texture = s.textures[draw->texture->texture];
    const TextureLevel& base = texture.levels.at(static_cast<std::size_t>(texture.sampler.base_level));
    Vec4<double>& st = coordinates(in).at(i);
    st.s += 0.5 / base.width;
    st.t += 0.5 / base.height;
  }
}

using S = Stage;

constexpr std::array kFragmentCauses = {
    given<[](Capture& in) { change_all(coordinates(in), [](auto& st) { st.t = 1 - st.t; }); }>(
        S::texture, "texture.t_flipped", "textures are upside down: t for 1 - t"),
    given<[](Capture& in) { change_all(coordinates(in), [](auto& st) { std::swap(st.s, st.t); }); }>(
        S::texture, "texture.s_t_swapped", "s and t changed places"),
    given<half_a_texel_off>(S::texture, "texture.half_texel_off",
                            "half a texel off: texels are taken for points at their corners"),
    given<wrapped_otherwise<Wrap::repeat, Wrap::clamp_to_edge>>(
        S::texture, "texture.clamp_for_repeat", "textures are not repeated, but drawn out from their edges"),
    given<wrapped_otherwise<Wrap::clamp_to_edge, Wrap::repeat>>(
        S::texture, "texture.repeat_for_clamp", "textures are repeated, not drawn out from their edges"),
    given<wrapped_otherwise<Wrap::clamp_to_border, Wrap::clamp_to_edge>>(
        S::texture, "texture.edge_for_border", "textures are drawn out from their edges, where the border's colour is"),
    given<wrapped_otherwise<Wrap::mirrored_repeat, Wrap::repeat>>(S::texture, "texture.repeat_for_mirror",
                                                                  "textures are repeated, but not mirrored"),
    given<unfiltered>(S::texture, "texture.nearest_for_linear",
                      "the nearest texel is taken, where four should be mixed"),
    given<[](Sampler& t) { t.lod_bias = 0; }>(S::texture, "texture.bias_left_out",
                                              "the texture's level-of-detail bias is not added"),
    seen(S::texture, "texture.lod_one_more", "levels of detail are one too high", lod_off_by<1>),
    seen(S::texture, "texture.lod_one_less", "levels of detail are one too low", lod_off_by<-1>),
    made<[](Capture& c) { swap_red_and_blue(c.records.texels); }>(S::texture, "texture.red_blue_swapped",
                                                                  "red and blue of texels swapped"),
    made<[](Capture& c) { swap_red_and_blue(c.records.shaded); }>(S::shade, "shade.red_blue_swapped",
                                                                  "red and blue of shaded fragments swapped"),
    given<[](Draw& d) { d.fog.reset(); }>(S::shade, "shade.fog_ignored", "fog is left out"),
    given<[](Draw& d) {
      if (d.fog && d.fog->mode == Fog::Mode::exp2) d.fog->mode = Fog::Mode::exp;
    }>(S::shade, "shade.fog_exp_for_exp2", "fog by exp for exp2"),
    given<[](Draw& d) {
      using enum TextureEnvironment;
      if (d.texture && d.texture->environment == modulate) d.texture->environment = replace;
    }>(S::shade, "shade.replace_for_modulate", "the texture's colour replaces where it should be multiplied in"),
    given<[](Capture& in) {
      change_all(in.records.varyings[Varying::secondary].fragments, [](auto& four) { four = Vec4<double>(0); });
    }>(S::shade, "shade.no_color_sum", "the separate specular colour is not added"),
    given<compared_otherwise<DepthFunc::less, DepthFunc::less_equal>>(
        S::visibility, "visibility.less_equal", "an equal depth passes where only a smaller one may"),
    given<compared_otherwise<DepthFunc::less_equal, DepthFunc::less>>(
        S::visibility, "visibility.less", "an equal depth is rejected where it should pass"),
    given<[](Scene& s) { s.frame.clear_depth = 1; }>(S::visibility, "visibility.clear_depth_ignored",
                                                     "depths are cleared to 1, whatever the clear depth"),
    given<[](Draw& d) { d.depth_func = turned(d.depth_func); }>(
        S::visibility, "visibility.depth_reversed", "the depth test is the other way round: the farther one wins"),
    given<[](Scene& s) {
      s.frame.clear_depth = 1 - s.frame.clear_depth;
      change_all(s.draws, [](Draw& d) { d.depth_func = turned(d.depth_func); });
    }>(S::visibility, "visibility.reversed_with_clear",
       "the depth test is the other way round, and so is the value that depths are cleared to"),
    given<[](Draw& d) { d.merge.depth_mask = true; }>(S::visibility, "visibility.depth_mask_ignored",
                                                      "depths are written that the draw's mask keeps out"),
    given<[](Draw& d) { d.depth_func = DepthFunc::always; }>(S::visibility, "visibility.no_depth_test",
                                                             "whatever is drawn last wins: depths are not tested"),
    given<[](Draw& d) {
      if (d.alpha_test && d.alpha_test->func == CompareFunc::greater) d.alpha_test->func = CompareFunc::greater_equal;
    }>(S::visibility, "visibility.alpha_at_reference",
       "an alpha equal to the reference passes where only a greater may"),
    given<[](Draw& d) { d.alpha_test.reset(); }>(S::visibility, "visibility.alpha_test_ignored",
                                                 "the alpha test rejects nothing"),
    given<[](Draw& d) {
      if (!d.stencil) return;
      for (StencilFace* face : {&d.stencil->front, &d.stencil->back}) std::swap(face->pass, face->depth_fail);
    }>(S::visibility, "visibility.stencil_ops_swapped",
       "the stencil op of a depth that fails is taken for that of one that passes"),
    given<[](Draw& d) { d.stencil.reset(); }>(S::visibility, "visibility.stencil_ignored",
                                              "the stencil test rejects nothing, and nothing is written"),
    seen(S::merge, "merge.truncated", "colours = expected, truncated to codes, not rounded", colors_truncated),
    made<[](Capture& c) {
      for (glm::vec4& color : c.planes.color.values()) std::swap(color.r, color.b);
    }>(S::merge, "merge.red_blue_swapped", "red and blue swapped in the frame"),
    given<[](Draw& d) {
      if (!d.merge.blend) return;
      for (BlendTerm* t : {&d.merge.blend->rgb, &d.merge.blend->alpha}) std::swap(t->source, t->destination);
    }>(S::merge, "merge.factors_swapped", "blend factors swapped: the source's for the destination's"),
    given<[](Draw& d) { d.merge.blend.reset(); }>(S::merge, "merge.not_blended",
                                                  "colours replace what is there: not blended"),
    given<[](Draw& d) {
      if (d.merge.logic_op) d.merge.logic_op = other_side(*d.merge.logic_op);
    }>(S::merge, "merge.logic_op_sides", "a logic op turns the wrong one over: s & ~d for ~s & d"),
    given<[](Draw& d) { d.merge.color_mask = glm::bvec4(true); }>(S::merge, "merge.color_mask_ignored",
                                                                  "masked channels are written"),
    seen(S::resolve, "resolve.truncated", "the mean of a pixel's samples is truncated to a code, not rounded",
         colors_truncated),
};

}  // namespace

std::span<const KnownCause> fragment_causes() { return kFragmentCauses; }

}  // namespace plumbline::check
