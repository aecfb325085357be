#include "check/compare/compare_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "check/bounds/fragment_bounds.h"
#include "check/bounds/texture_bounds.h"
#include "check/bounds/units.h"

namespace plumbline::check {

Measurement compare_texels(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor) {
  const std::size_t count = candidate.covered.size();
  if (candidate.texels.size() != count || reference.texels.size() != count) {
    return mismatch("u", "not a texel for each fragment", std::max(candidate.texels.size(), count));
  }
  double magnitude = 1;
  for (const Texture& texture : scene.textures) magnitude = std::max(magnitude, largest_texel(texture));
  constexpr double kLeast = -16;
  Meter meter("u");
  for (std::size_t i = 0; i < count; ++i) {
    const Covered& c = candidate.covered[i];
    const Texel<double>&a = candidate.texels[i], &b = reference.texels[i];
    for (int k = 0; k < 4; ++k) {
      meter.value(difference(a.color[k], b.color[k]) / (u * magnitude), factor, {c.x, c.y, c.triangle, "texel"},
                  a.color[k], b.color[k]);
    }
    const double lod = std::max(a.lod, kLeast), exact = std::max(b.lod, kLeast);
    meter.value(difference(lod, exact) / (u * std::max(1.0, std::abs(exact))), factor,
                {c.x, c.y, c.triangle, "level of detail"}, a.lod, b.lod);
    meter.item();
  }
  return meter.done();
}

Measurement compare_texel_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor,
                                 std::string& note) {
  const Planes &a = candidate.planes, &b = reference.planes;
  std::string why;
  if (!same_size(a.id, b.id, why) || !same_size(a.id, a.texel, why)) return mismatch("u", why, a.id.size());
  const FragmentBounds bounds(scene, candidate, reference, factor);
  const DrawnAt drawn(scene.frame, candidate.records);
  double area = 0, centres = 0;
  std::uint64_t open = 0;
  Measurement m = compare_planes(a.texel, b.texel, "u", [&](Meter& meter, int x, int y) {
    const std::int32_t id = a.id(x, y);
    if (id != b.id(x, y)) return;
    std::optional<std::size_t> last;
    drawn.each(x, y, [&](std::size_t i) { last = i; });
    std::string_view reason;
    TexelBound bound;
    bound.range.lo = bound.range.hi = Vec4<double>(a.texel(x, y));
    if (last) {
      const auto& triangle = candidate.records.triangles[candidate.records.covered[*last].triangle];
      const Draw& draw = bounds.draw_of(triangle.primitive);
      if (draw.texture) {
        bound = bounds.texel(*last);
        const OpenShare share = bounds.open_texels(*last);
        area += share.area;
        centres += share.centre ? 1 : 0;
        reason = mesas_other_level(scene.textures.at(draw.texture->texture), bound.range);
      }
    }
    const Place place{x, y, id, "texel", true};
    if (!std::isfinite(bound.slack.r)) {
      ++open;
      meter.ambiguous();
      const bool finite = std::isfinite(b.texel(x, y).r);
      return meter.value(finite ? 0 : std::numeric_limits<double>::infinity(), 0, place, a.texel(x, y).r,
                         b.texel(x, y).r);
    }
    const auto beyond = [&](const glm::vec4& texel) {
      return glm::any(glm::lessThan(Vec4<double>(texel), bound.range.lo - bound.slack)) ||
             glm::any(glm::greaterThan(Vec4<double>(texel), bound.range.hi + bound.slack));
    };
    if (!beyond(a.texel(x, y))) meter.suspect(reason);
    for (int c = 0; c < 4; ++c) {
      const double v = a.texel(x, y)[c], w = b.texel(x, y)[c], lo = bound.range.lo[c], hi = bound.range.hi[c];
      meter.value(std::max(outside(v, lo, hi), outside(w, lo, hi)) / u, bound.slack[c] / u, place, v, w);
    }
  });
  if (open == 0) return m;
  // A level of detail is that of four pixels: they are open together, and such counts scatter twice as far.
  const double predicted = std::max(area, centres), most = 2 * predicted + 6 * std::sqrt(2 * predicted + 1);
  note = fmt::format("{} open, {:.1f} predicted", open, predicted);
  if (static_cast<double>(open) > most) {
    note += ": more than twice as many";
    m.differing = std::max(m.differing, open);
  }
  return m;
}

}  // namespace plumbline::check
