#include "reference/exact/texels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/exact/input.h"

namespace plumbline::exact {
namespace {

using Real = long double;
using ThreeReals = std::array<Real, 3>;

struct Lambda {
  double lo = 0, hi = 0;
};

/// Legal interval of lambda at a pixel: from the least in its 2 x 2 quad, by a logarithm that is linear between powers
/// of two, to the greatest, with the exact bias or Mesa's; the sampler's limits where the plane reaches the eye within
/// the quad. Renderers take differences of neighbours in place of derivatives: along a row or column the derivative of
/// a perspective mapping has one direction and a monotone length, so that a difference lies between the derivatives at
/// both pixels. Each coordinate in float is a quotient of sums with an error of 3 u of their terms (slopes from the
/// window's origin): 6 u for a difference, relative to its length; a logarithm in float adds some u of its magnitude.
Lambda lambda_interval(const TexturedTriangle& t, glm::dvec2 st, int x, int lower_row, const math::LevelRules& rules) {
  constexpr double kRounding = 1.0 / 16777216.0;
  const TextureLevel& base = t.texture.levels[static_cast<std::size_t>(t.texture.sampler.base_level)];
  const glm::dvec2 size(base.width, base.height);
  Lambda out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 4; ++k) {
    const int qx = (x & ~1) + k % 2, qy = lower_row + k / 2;
    const auto b = t.weights.at(qx, qy);
    Real q = 0;
    for (std::size_t i = 0; i < 3; ++i) q += b[i] * t.triangle.v[i].inv_w;
    const bool ahead = q * t.triangle.v[0].inv_w > 0;
    const TextureGradient g = texture_gradient(t, qx, qy);
    const double rho = std::max(glm::length(size * g.d_dx), glm::length(size * g.d_dy));
    const double terms =
        glm::length(size * (glm::abs(st) + glm::abs(g.d_dx) * (qx + 1.0) + glm::abs(g.d_dy) * (qy + 1.0)));
    const double error = rho > 0 ? kRounding * (6 * terms / rho + 4 * (1 + std::abs(std::log2(rho)))) : 0;
    const double least = std::max(1 - error, 0.0), most = 1 + error;
    out.lo = std::min(out.lo, ahead ? math::smallest_level_of_detail(t.texture, least * g.d_dx, least * g.d_dy, rules)
                                    : static_cast<double>(t.texture.sampler.min_lod));
    out.hi = std::max(out.hi, ahead ? math::largest_level_of_detail(t.texture, most * g.d_dx, most * g.d_dy, rules)
                                    : static_cast<double>(t.texture.sampler.max_lod));
  }
  return out;
}

}  // namespace

TextureGradient texture_gradient(const TexturedTriangle& t, int x, int y) {
  // Weights are affine: their difference over one pixel is their derivative.
  const auto at = t.weights.at(x, y), right = t.weights.at(x + 1, y), above = t.weights.at(x, y + 1);
  const auto over_w = [&](const ThreeReals& b) {
    ThreeReals sum{};  // s/w, t/w, 1/w
    for (std::size_t i = 0; i < 3; ++i) {
      const Real q = b[i] * t.triangle.v[i].inv_w;
      sum[0] += q * t.texcoords[i].s;
      sum[1] += q * t.texcoords[i].t;
      sum[2] += q;
    }
    return sum;
  };
  const auto change = [&](const ThreeReals& to) { return ThreeReals{to[0] - at[0], to[1] - at[1], to[2] - at[2]}; };
  const ThreeReals f = over_w(at), d_dx = over_w(change(right)), d_dy = over_w(change(above));
  const Real s = f[0] / f[2], r = f[1] / f[2];
  const auto quotient = [&](const ThreeReals& d) {
    return glm::dvec2((d[0] - s * d[2]) / f[2], (d[1] - r * d[2]) / f[2]);
  };
  return {quotient(d_dx), quotient(d_dy)};
}

Texel<double> texel_at(const TexturedTriangle& t, glm::dvec2 st, int x, int y, const math::LevelRules& rules) {
  const TextureGradient g = texture_gradient(t, x, y);
  const double lod = math::level_of_detail(t.texture, g.d_dx, g.d_dy);
  return {math::filtered_texel(t.texture, st, lod, rules), lod};
}

void filter_texels(const Scene& scene, const Records<double>& records, const Conventions& conventions, Capture& out) {
  if (!textured(scene)) return;
  const math::LevelRules rules = math::level_rules(conventions);
  const VaryingColumns<double>& st = records.varyings[Varying::texture];
  require_size("records.varyings.texture", st.fragments.size(), records.covered.size());
  require_size("records.varyings.texture", st.triangles.size(), records.triangles.size());
  const bool own_lod = !records.texels.empty();
  const bool judges_interval = own_lod && conventions.level_of_detail != Conventions::LevelOfDetail::per_pixel;
  if (own_lod) require_size("records.texels", records.texels.size(), records.covered.size());
  out.records.texels.resize(records.covered.size());
  out.legal.texels.resize(records.covered.size());
  const DrawOf draw_of(scene);
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const WindowTriangle<double>& triangle = records.triangles[run.triangle];
    const Draw& draw = draw_of(triangle.primitive);
    if (!draw.texture) {
      for (std::size_t i = run.first; i < run.last; ++i) out.legal.texels[i].lo = out.legal.texels[i].hi = {0, 0, 0, 1};
      continue;
    }
    const Barycentric weights(triangle, scene.frame.width, scene.frame.height);
    const Texture& texture = scene.textures.at(draw.texture->texture);
    const TexturedTriangle t{triangle, st.triangles[run.triangle], texture, weights};
    for (std::size_t i = run.first; i < run.last; ++i) {
      const auto [number, x, y] = records.covered[i];
      const glm::dvec2 at(st.fragments[i]);
      Texel<double>& texel = out.records.texels[i];
      texel = texel_at(t, at, x, y, rules);
      if (own_lod && !std::isnan(records.texels[i].lod))
        texel.color = math::filtered_texel(texture, at, records.texels[i].lod, rules);
      Lambda lambda;
      const int lower_row = math::lower_row_of_square(conventions.rows, scene.frame.height, y);
      if (math::depends_on_lambda(texture.sampler) || judges_interval)
        lambda = lambda_interval(t, at, x, lower_row, rules);
      out.legal.texels[i] = math::texel_range(texture, at, lambda.lo, lambda.hi, rules);
    }
  }
}

}  // namespace plumbline::exact
