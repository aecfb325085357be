// Bugs of stages 8 to 12.
#include <algorithm>
#include <array>
#include <cmath>

#include "check/diagnose/hypotheses.h"

namespace plumbline::check {

namespace {

template <class Change>
void each_sampler(Scene& scene, Change change) {
  for (Texture& texture : scene.textures) change(texture.sampler);
}

bool colors_truncated(const Evidence& e) {
  const std::vector<glm::vec4>&mine = e.candidate.planes.color.values(), &theirs = e.expected.planes.color.values();
  const double scale = color_scale(e.scene.frame.color);
  Truncation t;
  const std::vector<std::int32_t>& id = e.candidate.planes.id.values();  // what is cleared does not go this way
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

// One comparison for another, in every draw.
template <DepthFunc from, DepthFunc to>
void depth_func_changed(Scene& s, Capture&) {
  each_draw(s, [](Draw& d) { d.depth_func = d.depth_func == from ? to : d.depth_func; });
}
DepthFunc turned(DepthFunc func) {
  switch (func) {
    case DepthFunc::less: return DepthFunc::greater;
    case DepthFunc::less_equal: return DepthFunc::greater_equal;
    case DepthFunc::greater: return DepthFunc::less;
    case DepthFunc::greater_equal: return DepthFunc::less_equal;
    default: return func;
  }
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
  const std::vector<DrawRange> ranges = draw_ranges(s);
  for (std::size_t i = 0; i < in.records.covered.size(); ++i) {
    const std::uint32_t primitive = in.records.triangles.at(in.records.covered[i].triangle).primitive;
    std::size_t d = 0;
    while (primitive >= ranges[d].first_primitive + ranges[d].primitive_count) ++d;
    if (!s.draws[d].texture) continue;
    const TextureLevel& base = s.textures[s.draws[d].texture->texture].levels.front();
    Vec4<double>& st = in.records.varyings[Varying::texture].fragments.at(i);
    st.s += 0.5 / base.width;
    st.t += 0.5 / base.height;
  }
}

using S = Stage;

constexpr std::array kFragmentHypotheses = {
    given(S::texture, "texture.t_flipped", "textures are upside down: t for 1 - t",
          [](Scene&, Capture& in) {
            for (auto& st : in.records.varyings[Varying::texture].fragments) st.t = 1 - st.t;
          }),
    given(S::texture, "texture.s_t_swapped", "s and t changed places",
          [](Scene&, Capture& in) {
            for (auto& st : in.records.varyings[Varying::texture].fragments) std::swap(st.s, st.t);
          }),
    given(S::texture, "texture.half_texel_off", "half a texel off: texels are taken for points at their corners",
          half_a_texel_off),
    given(S::texture, "texture.clamp_for_repeat", "textures are not repeated, but drawn out from their edges",
          [](Scene& s, Capture&) {
            each_sampler(s, [](Sampler& t) {
              if (t.wrap_s == Wrap::repeat) t.wrap_s = Wrap::clamp_to_edge;
              if (t.wrap_t == Wrap::repeat) t.wrap_t = Wrap::clamp_to_edge;
            });
          }),
    given(S::texture, "texture.repeat_for_clamp", "textures are repeated, not drawn out from their edges",
          [](Scene& s, Capture&) {
            each_sampler(s, [](Sampler& t) {
              if (t.wrap_s == Wrap::clamp_to_edge) t.wrap_s = Wrap::repeat;
              if (t.wrap_t == Wrap::clamp_to_edge) t.wrap_t = Wrap::repeat;
            });
          }),
    given(S::texture, "texture.edge_for_border",
          "textures are drawn out from their edges, where the border's colour is",
          [](Scene& s, Capture&) {
            each_sampler(s, [](Sampler& t) {
              if (t.wrap_s == Wrap::clamp_to_border) t.wrap_s = Wrap::clamp_to_edge;
              if (t.wrap_t == Wrap::clamp_to_border) t.wrap_t = Wrap::clamp_to_edge;
            });
          }),
    given(S::texture, "texture.repeat_for_mirror", "textures are repeated, but not mirrored",
          [](Scene& s, Capture&) {
            each_sampler(s, [](Sampler& t) {
              if (t.wrap_s == Wrap::mirrored_repeat) t.wrap_s = Wrap::repeat;
              if (t.wrap_t == Wrap::mirrored_repeat) t.wrap_t = Wrap::repeat;
            });
          }),
    given(S::texture, "texture.nearest_for_linear", "the nearest texel is taken, where four should be mixed",
          [](Scene& s, Capture&) {
            each_sampler(s, [](Sampler& t) {
              t.mag = MagFilter::nearest;
              t.min = t.min == MinFilter::linear                  ? MinFilter::nearest
                      : t.min == MinFilter::linear_mipmap_nearest ? MinFilter::nearest_mipmap_nearest
                      : t.min == MinFilter::linear_mipmap_linear  ? MinFilter::nearest_mipmap_linear
                                                                  : t.min;
            });
          }),
    given(S::texture, "texture.bias_left_out", "the texture's level-of-detail bias is not added",
          [](Scene& s, Capture&) { each_sampler(s, [](Sampler& t) { t.lod_bias = 0; }); }),
    seen(S::texture, "texture.lod_one_more", "levels of detail are one too high", lod_off_by<1>),
    seen(S::texture, "texture.lod_one_less", "levels of detail are one too low", lod_off_by<-1>),
    made(S::texture, "texture.red_blue_swapped", "red and blue of texels swapped",
         [](const Scene&, const Capture&, Capture& c) { swap_red_and_blue(c.records.texels); }),
    made(S::shade, "shade.red_blue_swapped", "red and blue of shaded fragments swapped",
         [](const Scene&, const Capture&, Capture& c) { swap_red_and_blue(c.records.shaded); }),
    given(S::shade, "shade.fog_ignored", "fog is left out",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.fog.reset(); }); }),
    given(S::shade, "shade.fog_exp_for_exp2", "fog by exp for exp2",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (d.fog && d.fog->mode == Fog::Mode::exp2) d.fog->mode = Fog::Mode::exp;
            });
          }),
    given(S::shade, "shade.replace_for_modulate", "the texture's colour replaces where it should be multiplied in",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (d.texture && d.texture->environment == TextureEnvironment::modulate)
                d.texture->environment = TextureEnvironment::replace;
            });
          }),
    given(S::shade, "shade.no_color_sum", "the separate specular colour is not added",
          [](Scene&, Capture& in) {
            for (auto& four : in.records.varyings[Varying::secondary].fragments) four = Vec4<double>(0);
          }),
    given(S::visibility, "visibility.less_equal", "an equal depth passes where only a smaller one may",
          depth_func_changed<DepthFunc::less, DepthFunc::less_equal>),
    given(S::visibility, "visibility.less", "an equal depth is rejected where it should pass",
          depth_func_changed<DepthFunc::less_equal, DepthFunc::less>),
    given(S::visibility, "visibility.depth_reversed", "the depth test is the other way round: the farther one wins",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.depth_func = turned(d.depth_func); }); }),
    given(S::visibility, "visibility.no_depth_test", "whatever is drawn last wins: depths are not tested",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.depth_func = DepthFunc::always; }); }),
    given(S::visibility, "visibility.depth_mask_ignored", "depths are written that the draw's mask keeps out",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.merge.depth_mask = true; }); }),
    given(S::visibility, "visibility.alpha_at_reference",
          "an alpha equal to the reference passes where only a greater may",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (d.alpha_test && d.alpha_test->func == CompareFunc::greater)
                d.alpha_test->func = CompareFunc::greater_equal;
            });
          }),
    given(S::visibility, "visibility.alpha_test_ignored", "the alpha test rejects nothing",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.alpha_test.reset(); }); }),
    given(S::visibility, "visibility.stencil_ops_swapped",
          "the stencil op of a depth that fails is taken for that of one that passes",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (!d.stencil) return;
              for (StencilFace* face : {&d.stencil->front, &d.stencil->back}) std::swap(face->pass, face->depth_fail);
            });
          }),
    given(S::visibility, "visibility.stencil_ignored", "the stencil test rejects nothing, and nothing is written",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.stencil.reset(); }); }),
    seen(S::merge, "merge.truncated", "colours = expected, truncated to codes, not rounded", colors_truncated),
    made(S::merge, "merge.red_blue_swapped", "red and blue swapped in the frame",
         [](const Scene&, const Capture&, Capture& c) {
           for (glm::vec4& color : c.planes.color.values()) std::swap(color.r, color.b);
         }),
    given(S::merge, "merge.factors_swapped", "blend factors swapped: the source's for the destination's",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (!d.merge.blend) return;
              for (BlendTerm* t : {&d.merge.blend->rgb, &d.merge.blend->alpha}) std::swap(t->source, t->destination);
            });
          }),
    given(S::merge, "merge.not_blended", "colours replace what is there: not blended",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.merge.blend.reset(); }); }),
    given(S::merge, "merge.logic_op_sides", "a logic op turns the wrong one over: s & ~d for ~s & d",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (d.merge.logic_op) d.merge.logic_op = other_side(*d.merge.logic_op);
            });
          }),
    given(S::merge, "merge.color_mask_ignored", "masked channels are written",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.merge.color_mask = glm::bvec4(true); }); }),
    seen(S::resolve, "resolve.truncated", "the mean of a pixel's samples is truncated to a code, not rounded",
         colors_truncated),
};

}  // namespace

std::span<const Hypothesis> fragment_hypotheses() { return kFragmentHypotheses; }

}  // namespace plumbline::check
