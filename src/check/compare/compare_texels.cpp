#include "check/compare/compare_texels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "check/bounds/fragment_bounds.h"
#include "check/bounds/mean_bounds.h"
#include "check/bounds/texture_bounds.h"
#include "check/bounds/units.h"
#include "reference/arithmetic/texture.h"

namespace plumbline::check {

namespace {

// Levels of detail below this one count as it: their texels are those of magnification.
constexpr double kLeastLod = -16;

// Rounding error of a level of detail in double, which shows where texel coordinates hardly change between pixels.
class LodRounding {
 public:
  LodRounding(const Scene& scene, const Records<double>& records) : scene_(scene), records_(records), draws_(scene) {}

  double operator()(const Covered& c) const {
    const auto& texcoords = records_.varyings[Varying::texture].triangles;
    if (c.triangle >= records_.triangles.size() || c.triangle >= texcoords.size()) return 0;
    WindowTriangle<double> t = records_.triangles[c.triangle];
    const Draw* draw = draws_.draw(t.primitive);
    if (draw == nullptr || !draw->texture) return 0;
    for (std::size_t k = 0; k < 3; ++k) t.v[k].color = texcoords[c.triangle][k];
    const Texture& texture = scene_.textures.at(draw->texture->texture);
    const TextureLevel& base = texture.levels[static_cast<std::size_t>(texture.sampler.base_level)];
    const Vec2<double> size(base.width, base.height);
    const PlaneValue plane = color_of_plane(t, c.x, c.y);
    const double rho =
        std::max(glm::length(size * Vec2<double>(plane.d_dx)), glm::length(size * Vec2<double>(plane.d_dy)));
    const double error = glm::length(size * Vec2<double>(slope_rounding(t, c.x, c.y)));
    if (!std::isfinite(error) || !std::isfinite(rho)) return 0;
    if (error < rho) return -std::log2(1 - error / rho);  // down to rho - error; up is less
    // Nothing of rho but its rounding is known: either level is at most that of rho + error.
    return std::max(0.0, std::log2(rho + error) + texture.sampler.lod_bias - kLeastLod);
  }

 private:
  const Scene& scene_;
  const Records<double>& records_;
  DrawIndex draws_;
};

// Legal texels of fragments at their own texture coordinates and levels of detail, by the candidate's conventions.
class TexelsAtLevels {
 public:
  TexelsAtLevels(const Scene& scene, const Records<double>& records, const Conventions& conventions)
      : scene_(scene), records_(records), draws_(scene), rules_(math::level_rules(conventions)) {}

  TexelRange operator()(std::size_t i) const {
    const Covered& c = records_.covered[i];
    const auto& texcoords = records_.varyings[Varying::texture].fragments;
    TexelRange none;
    none.lo = none.hi = {0, 0, 0, 1};
    if (c.triangle >= records_.triangles.size() || i >= texcoords.size()) return none;
    const Draw* draw = draws_.draw(records_.triangles[c.triangle].primitive);
    if (draw == nullptr || !draw->texture) return none;
    const double lod = records_.texels[i].lod;
    return math::texel_range(scene_.textures.at(draw->texture->texture), Vec2<double>(texcoords[i]), lod, lod, rules_);
  }

 private:
  const Scene& scene_;
  const Records<double>& records_;
  DrawIndex draws_;
  math::LevelRules rules_;
};

// Largest component of the texture of each fragment's draw, at least 1; 1 without one.
class TexelMagnitudes {
 public:
  TexelMagnitudes(const Scene& scene, const Records<double>& records) : records_(records), draws_(scene) {
    for (const Texture& texture : scene.textures) of_texture_.push_back(std::max(1.0, largest_texel(texture)));
  }
  double operator()(const Covered& c) const {
    if (c.triangle >= records_.triangles.size()) return 1;
    const Draw* draw = draws_.draw(records_.triangles[c.triangle].primitive);
    return draw != nullptr && draw->texture ? of_texture_.at(draw->texture->texture) : 1;
  }

 private:
  const Records<double>& records_;
  DrawIndex draws_;
  std::vector<double> of_texture_;
};

}  // namespace

Measurement compare_texels(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, const std::vector<TexelRange>* legal, const Conventions& conventions) {
  const std::size_t count = candidate.covered.size();
  if (candidate.texels.size() != count || reference.texels.size() != count) {
    return mismatch("u", "not a texel for each fragment", std::max(candidate.texels.size(), count));
  }
  const TexelMagnitudes magnitudes(scene, candidate);
  const LodRounding rounding(scene, candidate);
  const TexelsAtLevels at_level(scene, candidate, conventions);
  Meter meter("u");
  const bool is_foreign = legal != nullptr && legal->size() == count;
  const bool is_per_pixel = conventions.level_of_detail == Conventions::LevelOfDetail::per_pixel;
  for (std::size_t i = 0; i < count; ++i) {
    const Covered& c = candidate.covered[i];
    const Texel<double>&a = candidate.texels[i], &b = reference.texels[i];
    const bool lacks_lod = is_foreign && std::isnan(a.lod);
    const double magnitude = magnitudes(c);
    const TexelRange range = !is_foreign ? TexelRange{} : lacks_lod ? (*legal)[i] : at_level(i);
    for (int k = 0; k < 4; ++k) {
      const double off =
          is_foreign ? distance_outside(a.color[k], range.lo[k], range.hi[k]) : difference(a.color[k], b.color[k]);
      meter.value(off / (u * magnitude), factor, {c.x, c.y, c.triangle, "texel"}, a.color[k], b.color[k]);
    }
    if (lacks_lod) {
      meter.item();
      continue;
    }
    const double lod = std::max(a.lod, kLeastLod), exact = std::max(b.lod, kLeastLod);
    const double unit = u * std::max(1.0, std::abs(exact));
    const double off = is_foreign && !is_per_pixel ? distance_outside(lod, std::max((*legal)[i].lambda_lo, kLeastLod),
                                                                      std::max((*legal)[i].lambda_hi, kLeastLod))
                                                   : difference(lod, exact);
    meter.value(off / unit, factor, {c.x, c.y, c.triangle, "level of detail"}, a.lod, b.lod,
                off <= factor * unit ? 0 : rounding(c) / unit);
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

class WinnersTexels {
 public:
  WinnersTexels(const Scene& scene, const Capture& candidate, const Capture& reference, double factor)
      : scene_(scene),
        candidate_(candidate),
        bounds_(scene, candidate, reference, factor),
        drawn_(FragmentsByPixel::drawn(scene.frame, candidate.records)) {}

  WinnersTexel at(int x, int y) const {
    WinnersTexel out{};
    out.bound.range.lo = out.bound.range.hi = Vec4<double>(candidate_.planes.texel(x, y));
    std::optional<std::size_t> last;
    drawn_.each(x, y, [&](std::size_t i) { last = i; });
    if (!last) return out;
    const Records<double>& r = candidate_.records;
    const Draw& draw = bounds_.draw_of(r.triangles[r.covered[*last].triangle].primitive);
    if (!draw.texture) return out;
    out.bound = bounds_.texel(*last);
    out.share = bounds_.open_texels(*last);
    out.reason = mesas_other_level(scene_.textures.at(draw.texture->texture), out.bound.range);
    return out;
  }

 private:
  const Scene& scene_;
  const Capture& candidate_;
  FragmentBounds bounds_;
  FragmentsByPixel drawn_;
};

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
  const WinnersTexels texels(scene, candidate, reference, factor);
  double area = 0, centres = 0;
  std::uint64_t open = 0;
  Measurement m = compare_planes(a.texel, b.texel, "u", [&](Meter& meter, int x, int y) {
    const std::int32_t id = a.id(x, y);
    if (id != b.id(x, y)) return;
    const Vec4<double> mine(a.texel(x, y)), theirs(b.texel(x, y));
    const Place place{x, y, id, "texel", true};
    if (id == kBackground) {
      for (const Vec4<double>& texel : {mine, theirs}) {
        for (int c = 0; c < 4; ++c) add_finite_value(meter, texel[c], place);
      }
      return;
    }
    const auto [bound, share, reason] = texels.at(x, y);
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
