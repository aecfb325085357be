// Bugs of stages 5 to 12.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "check/coverage_differences.h"
#include "check/hypotheses.h"

namespace plumbline::check {

namespace {

template <class Change>
void each_draw(Scene& scene, Change change) {
  for (Draw& draw : scene.draws) change(draw);
}
template <class Change>
void each_corner(Capture& c, Change change) {
  for (WindowTriangle<double>& t : c.records.triangles) {
    for (WindowVertex<double>& v : t.v) change(v);
  }
}
// The columns of varyings at the triangles' corners, three fours each.
template <class Change>
void each_triangle_of_varyings(Capture& c, Change change) {
  for (const Varying v : kAllVaryings) {
    for (auto& corners : c.records.varyings[v].triangles) change(corners);
  }
}
template <class Change>
void each_sampler(Scene& scene, Change change) {
  for (Texture& texture : scene.textures) change(texture.sampler);
}

template <int dx, int dy>
void moved_by(Scene&, Capture& in) {  // in 1/256 pixel
  each_corner(in, [](WindowVertex<double>& v) { v.snapped += glm::ivec2(dx, dy); });
}

// Whether the pixels that differ all lie on edges, and are missing, extra, or of both kinds.
enum class Kind { missing, extra, both };
template <Kind kind>
bool all_on_edges(const Evidence& e) {
  bool missing = false, extra = false;
  for (const CoverageDifference& d : coverage_differences(e)) {
    const WindowTriangle<double>& t = e.candidate.records.triangles.at(d.triangle);
    if (t.corners != 3) return false;
    for (const auto* pixels : {&d.missing, &d.extra}) {
      if (!std::ranges::all_of(*pixels, [&](glm::ivec2 p) { return on_an_edge(t, p); })) return false;
    }
    missing = missing || !d.missing.empty();
    extra = extra || !d.extra.empty();
  }
  return missing == (kind != Kind::extra) && extra == (kind != Kind::missing);
}

// Whether each triangle lacks its last column, or row, or both, and nothing else.
bool box_one_short(const Evidence& e) {
  const std::vector<CoverageDifference> all = coverage_differences(e);
  std::size_t inner = 0;
  for (const CoverageDifference& d : all) {
    if (!d.extra.empty()) return false;
    glm::ivec2 last(0);
    for (const auto* pixels : {&d.both, &d.missing}) {
      for (const glm::ivec2 p : *pixels) last = glm::max(last, p);
    }
    if (!std::ranges::all_of(d.missing, [&](glm::ivec2 p) { return p.x == last.x || p.y == last.y; })) return false;
    inner += std::ranges::any_of(
        d.missing, [&](glm::ivec2 p) { return !on_an_edge(e.candidate.records.triangles.at(d.triangle), p); });
  }
  return inner > 0;  // or it may be the tie rule
}

void upside_down_fragments(const Scene& scene, const Capture& in, Capture& made) {
  for (Covered& c : made.records.covered) c.y = static_cast<std::uint16_t>(scene.frame.height - 1 - c.y);
  std::ranges::sort(made.records.covered, {}, [](const Covered& c) { return std::tuple(c.triangle, c.y, c.x); });
  Planes& p = made.planes;
  std::ranges::fill(p.count.values(), 0u);
  std::ranges::fill(p.id_sum.values(), std::uint64_t{0});
  for (const Covered& c : made.records.covered) {
    p.count(c.x, c.y) += 1;
    p.id_sum(c.x, c.y) += id_weight(in.records.triangles[c.triangle].primitive);
  }
}

// z at the eye's straight lines, 1/w for its weights: what interpolates colours does so with depths as well.
bool depth_in_perspective(const Evidence& e) {
  Capture in = e.candidate;
  each_corner(in, [](WindowVertex<double>& v) { v.color = Vec4<double>(v.p_win.z); });
  const auto made = e.referee->run_stage(e.scene, Stage::attributes, in).records.attributes;
  const auto &mine = e.candidate.records.depth, &theirs = e.expected.records.depth;
  const double step = depth_scale(e.scene.frame.depth) == 0 ? 0x1p-22 : 1 / depth_scale(e.scene.frame.depth);
  if (made.size() != mine.size() || theirs.size() != mine.size()) return false;
  std::size_t differ = 0, explained = 0;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    if (std::abs(mine[i] - theirs[i]) <= step) continue;
    ++differ;
    explained += std::abs(mine[i] - std::clamp(made[i].color.x, 0.0, 1.0)) <= 2 * step ? 1 : 0;
  }
  return differ > 0 && (differ - explained) * 50 <= differ;
}

template <class Round>
void codes_by(const Scene& scene, Plane<glm::vec4>& color, Round round) {
  const double scale = color_scale(scene.frame.color);
  for (glm::vec4& v : color.values()) {
    for (int c = 0; c < 4 && scale > 0; ++c) v[c] = static_cast<float>(round(v[c] * scale) / scale);
  }
}
// Up: what float made of a code that is one may lie a rounding below it.
double truncated(double code) { return std::floor(code + 1e-3); }

template <class T>
void red_and_blue_swapped(std::vector<T>& records) {
  for (T& r : records) std::swap(r.color.r, r.color.b);
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

using S = Stage;

constexpr std::array kHypotheses = {
    seen(S::coverage, "coverage.inclusive_edges",
         "covered sets differ only on edges, all of them extra: the tie rule is inclusive", all_on_edges<Kind::extra>),
    seen(S::coverage, "coverage.strict_edges",
         "covered sets differ only on edges, all of them missing: the tie rule is exclusive",
         all_on_edges<Kind::missing>),
    seen(S::coverage, "coverage.wrong_corner",
         "covered sets differ only on edges, missing and extra: the tie rule has another corner",
         all_on_edges<Kind::both>),
    seen(S::coverage, "coverage.box_one_short", "triangles lack their last column or row: the box is one short",
         box_one_short),
    given(S::coverage, "coverage.half_pixel_more", "pixels are sampled half a pixel off: at their lower left corners",
          moved_by<kSubpixel / 2, kSubpixel / 2>),
    given(S::coverage, "coverage.half_pixel_less", "pixels are sampled half a pixel off: at their upper right corners",
          moved_by<-kSubpixel / 2, -kSubpixel / 2>),
    given(S::coverage, "coverage.y_one_more", "every fragment at y+1: window origin flipped or y off by one",
          moved_by<0, kSubpixel>),
    given(S::coverage, "coverage.y_one_less", "every fragment at y-1: window origin flipped or y off by one",
          moved_by<0, -kSubpixel>),
    given(S::coverage, "coverage.x_one_more", "every fragment at x+1: x off by one", moved_by<kSubpixel, 0>),
    given(S::coverage, "coverage.x_one_less", "every fragment at x-1: x off by one", moved_by<-kSubpixel, 0>),
    made(S::coverage, "coverage.y_flipped", "y mirrored: rows are counted from the other side", upside_down_fragments),
    given(S::coverage, "coverage.scissor_ignored", "fragments outside the scissor box are kept",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.scissor.reset(); }); }),
    given(S::coverage, "coverage.scissor_inclusive", "the scissor box has one column and one row too many",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (d.scissor) ++d.scissor->width, ++d.scissor->height;
            });
          }),
    given(S::coverage, "coverage.samples_at_centres", "samples are taken at the pixel's centre, not at their own places",
          [](Scene& s, Capture&) { s.frame.pass.sample.reset(); }),
    made(S::depth, "depth.truncated",
         "all depths one code lower where the fraction is above 1/2: truncated, not rounded",
         [](const Scene& s, const Capture&, Capture& c) {
           const double scale = depth_scale(s.frame.depth);
           for (double& z : c.records.depth) z = scale == 0 ? z : truncated(z * scale) / scale;
         }),
    made(S::depth, "depth.reversed", "depths are 1 - z: near and far changed places",
         [](const Scene&, const Capture&, Capture& c) {
           for (double& z : c.records.depth) z = 1 - z;
         }),
    seen(S::depth, "depth.in_perspective",
         "depths are interpolated with perspective, as attributes are; z/w is affine in the window",
         depth_in_perspective),
    given(S::depth, "depth.of_last_corner", "every triangle has one depth, its last corner's",
          [](Scene&, Capture& in) {
            for (auto& t : in.records.triangles) t.v[0].p_win.z = t.v[1].p_win.z = t.v[2].p_win.z;
          }),
    given(S::depth, "depth.offset_ignored", "polygon offsets are left out",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.polygon_offset = {}; }); }),
    given(S::depth, "depth.offset_without_slope", "a polygon offset is of its units alone: the slope is left out",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.polygon_offset.factor = 0; }); }),
    given(S::depth, "depth.offset_without_units", "a polygon offset is of its slope alone: the units are left out",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.polygon_offset.units = 0; }); }),
    given(S::depth, "depth.offset_negated", "polygon offsets have the other sign",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) { d.polygon_offset = {-d.polygon_offset.factor, -d.polygon_offset.units}; });
          }),
    given(S::depth, "depth.of_centre", "all samples of a pixel have the depth at its centre",
          [](Scene& s, Capture&) { s.frame.pass.sample.reset(); }),
    given(S::attributes, "attributes.affine",
          "error grows with the spread of 1/w in the triangle: affine interpolation, without perspective",
          [](Scene&, Capture& in) { each_corner(in, [](WindowVertex<double>& v) { v.inv_w = 1; }); }),
    given(S::attributes, "attributes.perspective_twice", "the perspective is divided out twice",
          [](Scene&, Capture& in) { each_corner(in, [](WindowVertex<double>& v) { v.inv_w *= v.inv_w; }); }),
    given(S::attributes, "attributes.flat", "every triangle has its last corner's attributes",
          [](Scene&, Capture& in) {
            for (auto& t : in.records.triangles) t.v[0].color = t.v[1].color = t.v[2].color;
            each_triangle_of_varyings(in, [](auto& c) { c[0] = c[1] = c[2]; });
          }),
    given(S::attributes, "attributes.corners_turned", "each corner has the next one's attributes",
          [](Scene&, Capture& in) {
            for (auto& t : in.records.triangles)
              std::tie(t.v[0].color, t.v[1].color, t.v[2].color) = std::tuple(t.v[1].color, t.v[2].color, t.v[0].color);
            each_triangle_of_varyings(in, [](auto& c) { std::ranges::rotate(c, c.begin() + 1); });
          }),
    given(S::attributes, "attributes.corners_turned_back", "each corner has the one's before it",
          [](Scene&, Capture& in) {
            for (auto& t : in.records.triangles)
              std::tie(t.v[0].color, t.v[1].color, t.v[2].color) = std::tuple(t.v[2].color, t.v[0].color, t.v[1].color);
            each_triangle_of_varyings(in, [](auto& c) { std::ranges::rotate(c, c.begin() + 2); });
          }),
    made(S::attributes, "attributes.red_blue_swapped", "red and blue swapped",
         [](const Scene&, const Capture&, Capture& c) { red_and_blue_swapped(c.records.attributes); }),
    given(S::texture, "texture.t_flipped", "textures are upside down: t for 1 - t",
          [](Scene&, Capture& in) {
            for (auto& st : in.records.varyings[Varying::texture].fragments) st.t = 1 - st.t;
          }),
    given(S::texture, "texture.s_t_swapped", "s and t changed places",
          [](Scene&, Capture& in) {
            for (auto& st : in.records.varyings[Varying::texture].fragments) std::swap(st.s, st.t);
          }),
    given(S::texture, "texture.clamp_for_repeat", "textures are not repeated, but drawn out from their edges",
          [](Scene& s, Capture&) {
            each_sampler(s, [](Sampler& t) {
              if (t.wrap_s == Wrap::repeat) t.wrap_s = Wrap::clamp_to_edge;
              if (t.wrap_t == Wrap::repeat) t.wrap_t = Wrap::clamp_to_edge;
            });
          }),
    given(S::texture, "texture.repeat_for_clamp", "textures are repeated, not drawn out from their edges",
          [](Scene& s, Capture&) { each_sampler(s, [](Sampler& t) { t.wrap_s = t.wrap_t = Wrap::repeat; }); }),
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
              t.min = t.min == MinFilter::linear                   ? MinFilter::nearest
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
         [](const Scene&, const Capture&, Capture& c) { red_and_blue_swapped(c.records.texels); }),
    made(S::shade, "shade.red_blue_swapped", "red and blue swapped",
         [](const Scene&, const Capture&, Capture& c) { red_and_blue_swapped(c.records.shaded); }),
    given(S::shade, "shade.fog_ignored", "fog is left out",
          [](Scene& s, Capture&) { each_draw(s, [](Draw& d) { d.fog.reset(); }); }),
    given(S::shade, "shade.fog_exp_for_exp2", "fog by exp for exp2",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (d.fog && d.fog->mode == Fog::Mode::exp2) d.fog->mode = Fog::Mode::exp;
            });
          }),
    given(S::shade, "shade.modulate_for_replace", "the texture's colour is multiplied in where it should replace",
          [](Scene& s, Capture&) {
            each_draw(s, [](Draw& d) {
              if (d.texture && d.texture->environment == TextureEnvironment::replace)
                d.texture->environment = TextureEnvironment::modulate;
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
    given(S::visibility, "visibility.alpha_at_reference", "an alpha equal to the reference passes where only a greater may",
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
    made(S::merge, "merge.truncated", "colours = expected, truncated to codes, not rounded",
         [](const Scene& s, const Capture&, Capture& c) { codes_by(s, c.planes.color, truncated); }),
    made(S::merge, "merge.red_blue_swapped", "red and blue swapped",
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
    made(S::resolve, "resolve.truncated", "the mean of a pixel's samples is truncated to a code, not rounded",
         [](const Scene& s, const Capture&, Capture& c) { codes_by(s, c.planes.color, truncated); }),
};

}  // namespace

std::span<const Hypothesis> fragment_hypotheses() { return kHypotheses; }

bool on_an_edge(const WindowTriangle<double>& t, glm::ivec2 pixel) {
  const auto x = std::int64_t{pixel.x} * kSubpixel, y = std::int64_t{pixel.y} * kSubpixel;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::i64vec2 a(t.v[k].snapped), b(t.v[(k + 1) % 3].snapped);
    if ((b.x - a.x) * (y - a.y) == (b.y - a.y) * (x - a.x)) return true;
  }
  return false;
}

}  // namespace plumbline::check
