#include "reference/arithmetic/color_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

namespace {

/// |m| |v|: what the sums' terms come to by their absolute values.
glm::dvec3 terms(const glm::dmat3& m, glm::dvec3 v) {
  return glm::abs(m[0] * v.x) + glm::abs(m[1] * v.y) + glm::abs(m[2] * v.z);
}
double place_error(const glm::dmat4& m,
                   glm::dvec3 p) {  // entries 1, product 3, and 2 spare for the matrix' own product
  return 6 * kFloatRounding * glm::length(terms(glm::dmat3(m), p) + glm::abs(glm::dvec3(m[3])));
}

double largest(const glm::dvec4& material, const glm::vec3& light) {
  const glm::dvec3 c = glm::abs(glm::dvec3(material) * glm::dvec3(light));
  return std::max({c.r, c.g, c.b});
}

/// x^s, and its change where x changes by `error`: a power is monotonic, so the interval's ends bound it. A float pow:
/// 32 u. Finite, as in light(): an infinite power times a specular colour of 0 would leave no bound.
struct Power {
  double value, error;
};
Power power(double x, double s, double error) {
  const auto at = [&](double t) { return std::min(std::pow(std::max(t, 0.0), s), 1e100); };
  const double value = at(x);
  return {value, std::max(at(x + error) - value, value - at(x - error)) + 32 * kFloatRounding * at(x + error)};
}

/// Eye space of a world vector (w = 0) or place (w = 1).
Known in_eye_space(const glm::dmat4& view, glm::dvec3 v, double w) {
  const glm::dvec3 eye(view * glm::dvec4(v, w));
  return {eye, w == 1 ? place_error(view, v) : 6 * kFloatRounding * glm::length(terms(glm::dmat3(view), v))};
}

/// A scalar and how far it may be off.
struct Number {
  double value, error;
};
/// The vectors' errors, and 3 u for the sum.
Number dot(const Known& a, const Known& b) {
  const double a_length = glm::length(a.v), b_length = glm::length(b.v);
  return {glm::dot(a.v, b.v),
          a.error * (b_length + b.error) + b.error * a_length + 3 * kFloatRounding * a_length * b_length};
}

/// att_i * spot_i; `open` where the cone's edge may be on either side of the point, and the light come or go.
struct Share {
  double value, error;
  bool open;
};
Share share_of(const Light& light, const glm::dmat4& view, const Known& vp, const Known& to_light) {
  constexpr double u = kFloatRounding;
  Share out{1, 0, false};
  if (light.kind == Light::Kind::directional) return out;
  if (const glm::dvec3 k(light.attenuation); k != glm::dvec3(1, 0, 0)) {
    const double d = glm::length(vp.v), d_error = vp.error + 4 * u * d;
    const auto at = [&](double distance) { return 1 / (k[0] + k[1] * distance + k[2] * distance * distance); };
    out.value = at(d);
    out.error = at(d - d_error) - out.value + 8 * u * out.value;  // it falls ever more slowly: the near end is farther
  }
  if (light.spot) {
    const Number cosine = dot({-to_light.v, to_light.error}, unit(in_eye_space(view, light.spot->direction, 0)));
    const double edge = std::cos(glm::radians(light.spot->cutoff_degrees));
    const Power p = power(cosine.value, light.spot->exponent, cosine.error);
    out.open = std::abs(cosine.value - edge) <= cosine.error + 2 * u && p.value + p.error > 0;
    if (cosine.value < edge) return {0, 0, out.open};
    out.error = out.error * (p.value + p.error) + out.value * p.error;
    out.value *= p.value;
  }
  return out;
}

/// The cosine whose power the highlight is. H = (L + E)/|L + E|: the two errors over |L + E|, and 4 u.
Number highlight(const LightModel& model, const Known& n, const Known& l, const Known& e, const Number& n_dot_l) {
  if (model.specular == LightModel::Specular::half_vector) {
    const double bisector = glm::length(l.v + e.v), error = l.error + e.error;
    if (!(bisector > 4 * error)) return {0, 1};
    return dot(n, {(l.v + e.v) / bisector, 2 * error / bisector + 4 * kFloatRounding});
  }
  const glm::dvec3 r = 2 * n_dot_l.value * n.v - l.v;
  const double n_length = glm::length(n.v);
  const double r_error = 2 * n_dot_l.error * (n_length + n.error) + 2 * std::abs(n_dot_l.value) * n.error + l.error +
                         3 * kFloatRounding * (2 * n_length * n_length + 1);
  return dot({r, r_error}, e);
}

}  // namespace

Known unit(const Known& a) {
  const double length = glm::length(a.v);
  if (!(length > 2 * a.error)) return {{0, 0, 1}, 2};
  return {a.v / length, a.error / length + 4 * kFloatRounding};
}

Known eye_position(const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex) {
  const glm::dvec3 p(mesh.positions[vertex]);
  return {glm::dvec3(m.model_view * glm::dvec4(p, 1)), place_error(m.model_view, p)};
}

// Matrix entries 1 u, sum 3 u of its terms; normalising 3 u, or a divisor of 6 u.
Known eye_normal(const Draw& draw, const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex) {
  const glm::dvec3 normal(mesh.normals[vertex]), scaled = m.normal * normal;
  const glm::dvec3 n = normal_in_eye_space(draw.normals, m.normal, normal);
  const double sum = 4 * glm::length(terms(m.normal, normal)) * glm::length(n) / glm::length(scaled);
  return {n, kFloatRounding * (sum + (draw.normals == Normals::rescale ? 6 : 3) * glm::length(n))};
}

double color_error(const Scene& scene, const Draw& draw, const Matrices<double>& m, const glm::dmat4& view,
                   std::uint32_t vertex, LitPart part) {
  if (!is_lit_per_vertex(draw)) return kFloatRounding;
  const Mesh& mesh = scene.meshes[draw.mesh];
  Known n = eye_normal(draw, mesh, m, vertex);
  if (part.back) n.v = -n.v;
  return light_error(scene, material_at(scene, draw, part, vertex), view, eye_position(mesh, m, vertex), n, 0);
}

// L: the errors of the light's place and the point's over their distance. Where N.L may fall on either side of 0, the
// whole specular term may come or go; where GzRender's N.E may, the diffuse one too. 16 u of the sum for the additions.
double light_error(const Scene& scene, const DoubleMaterial& material, const glm::dmat4& view, const Known& p_eye,
                   const Known& n_eye, double of_color) {
  constexpr double u = kFloatRounding;
  const LightModel& model = scene.light_model;
  const bool flips = model.sides == LightModel::Sides::flip;
  const auto answer = [&](const glm::dvec4& of, const glm::vec3& light) { return largest(of + of_color, light); };
  Known n = n_eye;
  const Known e = model.local_viewer ? unit({-p_eye.v, p_eye.error}) : Known{{0, 0, 1}, 0};
  if (e.error > 1) return 1;
  const Number n_dot_e = dot(n, e);
  if (flips && n_dot_e.value < 0) n.v = -n.v;
  double sum = answer(material.emission, glm::vec3(1)) + answer(material.ambient, model.ambient);
  double error = of_color * (1 + largest(glm::dvec4(1), model.ambient));
  for (const Light& light : scene.lights) {
    const bool at_place = light.kind == Light::Kind::point;
    Known vp = in_eye_space(view, light.vector, at_place ? 1 : 0);
    if (at_place) vp = {vp.v - p_eye.v, vp.error + p_eye.error};
    const Known l = unit(vp);
    if (l.error > 1) return 1;
    const Share share = share_of(light, view, vp, l);
    if (share.open) return std::numeric_limits<double>::infinity();
    if (!(share.value > 0)) continue;
    const Number n_dot_l = dot(n, l), cosine = highlight(model, n, l, e, n_dot_l);
    const double ambient = answer(material.ambient, light.ambient);
    const double diffuse = answer(material.diffuse, light.diffuse);
    const double specular = answer(material.specular, light.specular);
    const Power power_s = power(cosine.value, material.shininess, cosine.error);
    const double gloss = specular * (power_s.value + power_s.error),
                 all = ambient + diffuse * std::max(n_dot_l.value, 0.0) + gloss;
    double of_light = diffuse * n_dot_l.error;
    if (n_dot_l.value > -n_dot_l.error) of_light += specular * power_s.error;
    if (std::abs(n_dot_l.value) <= n_dot_l.error) of_light += gloss;
    if (flips && std::abs(n_dot_e.value) <= n_dot_e.error) {  // either way round
      const Power turned = power(std::abs(cosine.value), material.shininess, cosine.error);
      of_light += diffuse * std::abs(n_dot_l.value) + specular * (turned.value + turned.error);
    }
    of_light += of_color * (largest(glm::dvec4(1), light.ambient) + largest(glm::dvec4(1), light.diffuse) +
                            largest(glm::dvec4(1), light.specular));
    error += of_light * (share.value + share.error) + all * share.error;
    sum += share.value * (ambient + diffuse * glm::length(n.v) + gloss);
  }
  return std::min(1.0, error + 16 * u * sum);
}

}  // namespace plumbline::math
