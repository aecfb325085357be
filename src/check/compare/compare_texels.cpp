#include "check/compare/compare_texels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "check/bounds/fragment_bounds.h"
#include "check/bounds/mean_bounds.h"
#include "check/bounds/texture_bounds.h"
#include "check/bounds/units.h"
#include "reference/arithmetic/texture.h"

namespace plumbline::check {

namespace {

// Lower limit of compared levels of detail: every texture is magnified there.
constexpr double kLeastLod = -16;

// A fragment's texture, and its coordinates in the texture.
struct Textured {
  const Texture* texture = nullptr;  // null: the fragment has none
  std::optional<Vec2<double>> st{};  // nullopt: not shown
};
Textured textured_fragment(const DrawIndex& draws, const Records<double>& records, std::size_t i) {
  const Covered& c = records.covered[i];
  const auto& texcoords = records.varyings[Varying::texture].fragments;
  if (c.triangle >= records.triangles.size()) return {};
  const Draw* draw = draws.draw(records.triangles[c.triangle].primitive);
  if (draw == nullptr || !draw->texture) return {};
  Textured out{&draws.scene().textures.at(draw->texture->texture)};
  if (i < texcoords.size()) out.st = Vec2<double>(texcoords[i]);
  return out;
}

// Rounding error of a level of detail, which shows where texel coordinates hardly change between pixels. A foreign
// candidate's is that of float: 4 u of each term from the window's origin, or of the values of pixels side by side
// (largest seen of a right renderer: 46 u of lambda, texture/cube).
double lod_rounding(const Records<double>& records, const Covered& c, const Texture& texture, bool is_foreign) {
  const auto& texcoords = records.varyings[Varying::texture].triangles;
  if (c.triangle >= texcoords.size()) return 0;
  WindowTriangle<double> t = records.triangles[c.triangle];
  for (std::size_t k = 0; k < 3; ++k) t.v[k].color = texcoords[c.triangle][k];
  const TextureLevel& base = texture.levels[static_cast<std::size_t>(texture.sampler.base_level)];
  const Vec2<double> size(base.width, base.height);
  const PlaneValue plane = color_of_plane(t, c.x, c.y);
  const double rho =
      std::max(glm::length(size * Vec2<double>(plane.d_dx)), glm::length(size * Vec2<double>(plane.d_dy)));
  const SlopeArithmetic in_float{4 * u, 2.0 + c.x + c.y, true};
  const Vec4<double> rounding = slope_rounding(t, c.x, c.y, is_foreign ? in_float : kSlopesInDouble);
  const double error = glm::length(size * Vec2<double>(rounding));
  if (!std::isfinite(error) || !std::isfinite(rho)) return 0;
  if (error < rho) return -std::log2(1 - error / rho);  // down to rho - error; up is less
  // rho is within its rounding error: both levels are at most that of rho + error.
  return std::max(0.0, std::log2(rho + error) + texture.sampler.lod_bias - kLeastLod);
}

// Legal texels of a foreign fragment at its texture coordinates, for levels of detail from `lod_lo` to `lod_hi`, by
// the candidate's conventions.
TexelRange legal_texels(const Textured& of, double lod_lo, double lod_hi, const math::LevelRules& rules) {
  TexelRange none;
  none.lo = none.hi = {0, 0, 0, 1};
  return of.st ? math::texel_range(*of.texture, *of.st, lod_lo, lod_hi, rules) : none;
}

// legal_texels() at texel coordinates in float, 4 u of s and of t off (texture_bounds.h; largest seen of a right
// renderer: the neighbouring texel, texture/borders_at_centres).
TexelRange legal_texels_in_float(const Textured& of, double lod_lo, double lod_hi, const math::LevelRules& rules) {
  TexelRange out = legal_texels(of, lod_lo, lod_hi, rules);
  if (!of.st) return out;
  const Vec2<double> error = 4 * u * glm::abs(*of.st);
  const Vec4<double> slack = out.slope_s * error.s + out.slope_t * error.t;
  for (const Vec2<double>& way : {Vec2<double>(-1, -1), {-1, 1}, {1, -1}, {1, 1}}) {
    const TexelRange beside = math::texel_range(*of.texture, *of.st + way * error, lod_lo, lod_hi, rules);
    out.lo = glm::min(out.lo, beside.lo);
    out.hi = glm::max(out.hi, beside.hi);
  }
  out.lo -= slack;
  out.hi += slack;
  return out;
}

// Whether a level of detail is a legal one, or exact's, clamped to [0, q] (OpenGL 2.1, 3.8.8), the sampler's levels:
// its texel is then judged by the legal one. (Where the filters do not depend on the level, `legal` has none.)
bool is_clamped(const Texture* texture, double lod, const TexelRange& legal, double exact) {
  if (texture == nullptr) return false;
  const int largest = static_cast<int>(texture->levels.size()) - 1;
  const int last = std::min(largest, texture->sampler.max_level) - texture->sampler.base_level;
  return (lod == 0 && std::min(legal.lambda_lo, exact) < 0) || (lod == last && std::max(legal.lambda_hi, exact) > last);
}

// Adds what texels become that are rounded to the frame's codes (Conventions::fragment_colors), beyond [0,1] too: these
// are clamped. Codes stay, but where they are rounded down or up: float may carry them over.
void round_to_codes(const FrameFormat& frame, const Conventions& conventions, TexelRange& range) {
  if (!has_codes_of_fragments(frame, conventions)) return;
  const double scale = color_scale(frame.color);
  const RoundingRange change = range_of(conventions.color_rounding);
  for (int k = 0; k < 4; ++k) {
    double &lo = range.lo[k], &hi = range.hi[k];
    const bool stays = conventions.color_rounding == Conventions::Rounding::nearest && lo == hi && is_code(scale * lo);
    if (!stays) lo += change.least / scale, hi += change.most / scale;
    lo = std::min(lo, 1.0), hi = std::max(hi, 0.0);
  }
}

// Largest distance of a texel's channel from a range.
double distance_from(const Vec4<double>& texel, const TexelRange& range) {
  double most = 0;
  for (int k = 0; k < 4; ++k) most = std::max(most, distance_outside(texel[k], range.lo[k], range.hi[k]));
  return most;
}

}  // namespace

Measurement compare_texels(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, const std::vector<TexelRange>* legal, const Conventions& conventions) {
  const std::size_t count = candidate.covered.size();
  if (candidate.texels.size() != count || reference.texels.size() != count) {
    return mismatch("u", "not a texel for each fragment", std::max(candidate.texels.size(), count));
  }
  const DrawIndex draws(scene);
  std::map<const Texture*, double> magnitudes;
  for (const Texture& texture : scene.textures) magnitudes[&texture] = std::max(1.0, largest_texel(texture));
  magnitudes[nullptr] = 1;
  const math::LevelRules rules = math::level_rules(conventions);
  Meter meter("u");
  const bool is_foreign = legal != nullptr && legal->size() == count;
  const bool is_per_pixel = conventions.level_of_detail == Conventions::LevelOfDetail::per_pixel;
  for (std::size_t i = 0; i < count; ++i) {
    const Covered& c = candidate.covered[i];
    const Texel<double>&a = candidate.texels[i], &b = reference.texels[i];
    const Textured of = textured_fragment(draws, candidate, i);
    const bool lacks_lod = is_foreign && (std::isnan(a.lod) || is_clamped(of.texture, a.lod, (*legal)[i], b.lod));
    const double unit = u * magnitudes.at(of.texture);
    TexelRange range;
    if (is_foreign) {
      const double lo = lacks_lod ? (*legal)[i].lambda_lo : a.lod, hi = lacks_lod ? (*legal)[i].lambda_hi : a.lod;
      range = lacks_lod ? (*legal)[i] : legal_texels(of, lo, hi, rules);
      if (!(distance_from(a.color, range) <= factor * unit)) range = legal_texels_in_float(of, lo, hi, rules);
      round_to_codes(scene.frame, conventions, range);
    }
    for (int k = 0; k < 4; ++k) {
      const double off =
          is_foreign ? distance_outside(a.color[k], range.lo[k], range.hi[k]) : difference(a.color[k], b.color[k]);
      meter.value(off / unit, factor, {c.x, c.y, c.triangle, "texel"}, a.color[k], b.color[k]);
    }
    if (lacks_lod) {
      meter.item();
      continue;
    }
    const double lod = std::max(a.lod, kLeastLod), exact = std::max(b.lod, kLeastLod);
    const double of_lod = u * std::max(1.0, std::abs(exact));
    const double off = is_foreign && !is_per_pixel ? distance_outside(lod, std::max((*legal)[i].lambda_lo, kLeastLod),
                                                                      std::max((*legal)[i].lambda_hi, kLeastLod))
                                                   : difference(lod, exact);
    const bool needed = !(off <= factor * of_lod) && of.texture != nullptr;
    meter.value(off / of_lod, factor, {c.x, c.y, c.triangle, "level of detail"}, a.lod, b.lod,
                needed ? lod_rounding(candidate, c, *of.texture, is_foreign) / of_lod : 0);
    meter.item();
  }
  return meter.done();
}

namespace {

// The winner's texel at a pixel: legal ones, and the share of such pixels whose texel rounding leaves open.
struct WinnersTexel {
  TexelBound bound;
  OpenShare share;
  std::string_view reason;  // the reference's fault; empty: none
};

WinnersTexel winners_texel(const Scene& scene, const Capture& candidate, const FragmentBounds& bounds,
                           const FragmentsByPixel& drawn, int x, int y) {
  WinnersTexel out{};
  out.bound.range.lo = out.bound.range.hi = Vec4<double>(candidate.planes.texel(x, y));
  std::optional<std::size_t> last;
  drawn.each(x, y, [&](std::size_t i) { last = i; });
  if (!last) return out;
  const Records<double>& r = candidate.records;
  const Draw& draw = bounds.draw_of(r.triangles[r.covered[*last].triangle].primitive);
  if (!draw.texture) return out;
  out.bound = bounds.texel(*last);
  out.share = bounds.open_texels(*last);
  out.reason = mesas_other_level(scene.textures.at(draw.texture->texture), out.bound.range);
  return out;
}

bool is_beyond(const Vec4<double>& texel, const TexelBound& bound) {
  return glm::any(glm::lessThan(texel, bound.range.lo - bound.slack)) ||
         glm::any(glm::greaterThan(texel, bound.range.hi + bound.slack));
}

}  // namespace

Measurement compare_texel_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor,
                                 std::string& note) {
  const Planes &a = candidate.planes, &b = reference.planes;
  std::string why;
  if (!same_size(a.id, b.id, why) || !same_size(a.id, a.texel, why)) return mismatch("u", why, a.id.size());
  const FragmentBounds bounds(scene, candidate, reference, factor);
  const FragmentsByPixel drawn = FragmentsByPixel::drawn(scene.frame, candidate.records);
  double area = 0, centres = 0;
  std::uint64_t open = 0;
  Measurement m = compare_planes(a.texel, b.texel, "u", [&](Meter& meter, int x, int y) {
    const std::int32_t id = a.id(x, y);
    if (id != b.id(x, y)) return;
    const Vec4<double> mine(a.texel(x, y)), theirs(b.texel(x, y));
    const Place place{x, y, id, "texel", true};
    if (id == kBackground) {
      for (const Vec4<double>& texel : {mine, theirs}) add_finite_color(meter, texel, place);
      return;
    }
    const auto [bound, share, reason] = winners_texel(scene, candidate, bounds, drawn, x, y);
    area += share.area;
    centres += share.centre ? 1 : 0;
    const bool is_open = !std::isfinite(bound.slack.r);
    open += is_open ? 1 : 0;
    if (!is_open && !is_beyond(mine, bound)) meter.suspect(reason);
    for (int c = 0; c < 4; ++c) {
      const double v = mine[c], w = theirs[c], lo = bound.range.lo[c], hi = bound.range.hi[c];
      if (is_open) {
        add_open_value(meter, v, place, w);
      } else {
        meter.value(std::max(distance_outside(v, lo, hi), distance_outside(w, lo, hi)) / u, bound.slack[c] / u, place,
                    v, w);
      }
    }
  });
  if (open == 0) return m;
  // Four pixels share a level of detail and are open together, so the count's standard deviation is doubled.
  const double predicted = std::max(area, centres), most = 2 * predicted + 6 * std::sqrt(2 * predicted + 1);
  note = fmt::format("{} open, {:.1f} predicted", open, predicted);
  if (static_cast<double>(open) > most) {
    note += ": more than twice as many";
    m.differing = std::max(m.differing, open);
  }
  return m;
}

}  // namespace plumbline::check
