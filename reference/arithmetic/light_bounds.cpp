#include "reference/arithmetic/light_bounds.h"

#include <algorithm>
#include <cmath>

#include "reference/arithmetic/bounded.h"

namespace plumbline::math {

namespace {

constexpr double kError = 16 * kFloatRounding;  // error of N.L, and unit of the whole equation's (ledger, exact.light)

// Direction and distance from the vertex to a light, and the direction's condition (LightBounds, k).
struct Ray {
  Vec3<double> to_light;  // unit length
  double distance, condition;
};

Ray ray(const Light& light, const LightSource<double>& source, const Vec3<double>& p_eye) {
  const bool point = light.kind == Light::Kind::point;
  const Vec3<double> l_eye(source.p_eye);
  const Vec3<double> to_light = point ? l_eye - p_eye : l_eye;
  // Direction to a point light: a difference of two rounded positions, ill-conditioned where the light is near.
  const double distance = glm::length(to_light);
  return {to_light / distance, distance, point ? 1 + (glm::length(l_eye) + glm::length(p_eye)) / distance : 1};
}

// Power x^s, and its error where x is off by `error`, from the steepest slope in that range [units of kError].
struct Power {
  double value, slope;
};
Power power(double x, double s, double error) {
  const auto at = [&](double t) { return std::min(std::pow(std::max(t, 0.0), s), 1e30); };
  if (s < 1) return {at(x), (at(x + error) - at(x - error)) / kError};
  return {at(x), s * std::min(std::pow(std::max(x + error, 1.0), s - 1), 1e30) * error / kError};
}

// Largest change of x^s where x changes by up to `error`.
double moved_power(double x, double s, double error) {
  if (error == 0) return 0;
  const auto at = [&](double t) { return std::min(std::pow(std::max(t, 0.0), s), 1e30); };
  return std::max(at(x + error) - at(x), at(x) - at(x - error));
}

// Attenuation times spot factor of a light: its value, its error [units of kError], `beyond` (the value where rounding
// may put the vertex on either side of the cone's border, else 0), and the effect of the inputs' errors (`inherited`).
struct Share {
  double value = 1, error = 0, beyond = 0;
  double inherited = 0;
};
Share share_of(const Light& light, const LightSource<double>& source, const Ray& r, double off) {
  Share out;
  if (light.kind == Light::Kind::directional) return out;
  if (const Vec3<double> k(light.attenuation); k != Vec3<double>(1, 0, 0)) {
    const auto at = [&](double d) { return 1 / (k[0] + k[1] * d + k[2] * d * d); };
    out.value = at(r.distance);
    out.inherited = at(std::max(r.distance - off, 0.0)) - out.value;
    out.error = 2 * r.condition * out.value;  // at most the square of the distance
  }
  if (!light.spot) return out;
  const double cosine = -glm::dot(r.to_light, glm::normalize(source.spot_eye));
  const double edge = std::cos(glm::radians(light.spot->cutoff_degrees)), error = (r.condition + 1) * kError;
  const Power p = power(cosine, light.spot->exponent, error);
  const double turned = chord(off / r.distance);
  const bool open = std::abs(cosine - edge) <= error + turned;
  if (cosine < edge && !open) return {0, 0, 0, 0};
  if (open) out.beyond = out.value * p.value;
  const double moved = moved_power(cosine, light.spot->exponent, turned);
  return {out.value * p.value, out.error * p.value + out.value * p.slope, out.beyond,
          out.inherited * (p.value + moved) + out.value * moved};
}

// Base of the specular power: a cosine, and its error [units of kError].
struct Highlight {
  double cosine, error;
};
Highlight highlight(const LightModel& model, const Vec3<double>& n, const Ray& r, const Vec3<double>& e,
                    double length) {
  if (model.specular == LightModel::Specular::half_vector) {
    const Vec3<double> half = r.to_light + e;
    const double half_length = std::max(glm::length(half), 1e-6), of_eye = model.local_viewer ? 1 / half_length : 0;
    return {glm::dot(n, half) / half_length, length * (r.condition * (1 + 1 / half_length) + of_eye)};
  }
  const double n_dot_l = glm::dot(n, r.to_light);
  return {glm::dot(2 * n_dot_l * n - r.to_light, e), 4 * length * length * (r.condition + 1)};
}

// Lower bound of a sum of colours, by the parts that are certain.
class LeastLight {
 public:
  // A part that may be below 0: its material colour may follow a vertex colour extrapolated beyond its triangle.
  void add(const Vec3<double>& color) { sum_ += glm::min(color, Vec3<double>(0)); }
  void add_certain(const Vec3<double>& color) { sum_ += color; }
  bool is_saturated(glm::length_t channel) const { return sum_[channel] >= 1; }

 private:
  Vec3<double> sum_{0};
};

}  // namespace

LightBounds light_bounds(const Scene& scene, const DoubleMaterial& m, const Vertex<double>& vertex,
                         const LightInputs& errors, Lights lights) {
  const LightModel& model = scene.light_model;
  const bool flips = model.sides == LightModel::Sides::flip;
  const Vec3<double> p_eye(vertex.p_eye);
  const std::vector<LightSource<double>> own =
      lights.size() < scene.lights.size() ? light_sources(scene) : std::vector<LightSource<double>>();
  LightBounds out;
  const auto anything = [&] {
    out.magnitude = Vec3<double>(kInfinity);
    return out;
  };
  if (model.local_viewer && !(glm::length(p_eye) > 2 * errors.p_eye)) return anything();
  const double e_moved = model.local_viewer ? 2 * errors.p_eye / glm::length(p_eye) : 0;
  const Vec3<double> e = model.local_viewer ? -glm::normalize(p_eye) : Vec3<double>(0, 0, 1);
  const double n_dot_e = glm::dot(vertex.n_eye, e);
  const Vec3<double> n = flips && n_dot_e < 0 ? -vertex.n_eye : vertex.n_eye;
  const double length = std::max(glm::length(n), 1.0);
  // Extrapolated beyond its triangle, a colour may be negative, and so may a material colour that follows it.
  out.magnitude = glm::abs(Vec3<double>(m.emission)) + glm::abs(Vec3<double>(m.ambient) * Vec3<double>(model.ambient));
  out.inherited = errors.color * (Vec3<double>(1) + Vec3<double>(model.ambient));
  LeastLight least;
  least.add(Vec3<double>(m.emission) - errors.color);
  least.add((Vec3<double>(m.ambient) - errors.color) * Vec3<double>(model.ambient));
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const LightSource<double>& source = i < lights.size() ? lights[i] : own[i];
    const Ray r = ray(light, source, p_eye);
    const double off_light = i < errors.lights.size() ? errors.lights[i] : 0;
    const double off = off_light + (light.kind == Light::Kind::point ? errors.p_eye : 0);
    if (!(r.condition * kError < 1 && r.distance > 2 * off)) return anything();
    const Share share = share_of(light, source, r, off);
    const Highlight h = highlight(model, n, r, e, length);
    const Power p = power(h.cosine, m.shininess, h.error * kError);
    const Vec3<double> ambient = glm::abs(Vec3<double>(light.ambient) * Vec3<double>(m.ambient));
    const Vec3<double> diffuse = glm::abs(Vec3<double>(light.diffuse) * Vec3<double>(m.diffuse));
    const Vec3<double> specular = glm::abs(Vec3<double>(light.specular) * Vec3<double>(m.specular));
    if (std::pow(std::max(h.cosine + h.error * kError, 0.0), m.shininess) >= 0x1p127) {
      for (int c = 0; c < 3; ++c) out.overflows[c] = out.overflows[c] || share.value * specular[c] == 0;
    }
    const double n_dot_l = glm::dot(n, r.to_light);
    const Vec3<double> all = ambient + std::max(n_dot_l, 0.0) * diffuse + p.value * specular;
    out.magnitude += share.value * (ambient + r.condition * length * diffuse +
                                    (r.condition * std::max(p.value, 1.0) + p.slope) * specular) +
                     share.error * all;
    out.jump += share.beyond * all;
    // Change of N.L and of the specular power's base by the inputs' errors.
    const double l_moved = 2 * off / r.distance, n_l_moved = errors.n_eye + length * l_moved;
    const double half_length = std::max(glm::length(r.to_light + e), 1e-6);
    const double h_moved =
        model.specular == LightModel::Specular::half_vector
            ? errors.n_eye + length * 2 * (l_moved + e_moved) / half_length
            : 2 * length * n_l_moved + 2 * length * (errors.n_eye + length * e_moved) + l_moved + e_moved;
    const Vec3<double> white = Vec3<double>(light.ambient) + std::max(n_dot_l, 0.0) * Vec3<double>(light.diffuse) +
                               p.value * Vec3<double>(light.specular);
    out.inherited +=
        (share.value + share.inherited) *
            (n_l_moved * diffuse + moved_power(h.cosine, m.shininess, h_moved) * specular + errors.color * white) +
        share.inherited * all;
    const double edge = kError * r.condition * length + n_l_moved;  // of N.L
    if (std::abs(n_dot_l) <= edge) out.jump += share.value * p.value * specular;
    const double most_share = share.value + share.error * kError + share.inherited,
                 least_share = 2 * share.value - most_share - share.beyond;
    least.add(most_share * (Vec3<double>(m.ambient) - errors.color) * Vec3<double>(light.ambient));
    least.add(most_share * (std::max(n_dot_l, 0.0) + edge) * (Vec3<double>(m.diffuse) - errors.color) *
              Vec3<double>(light.diffuse));
    const Vec3<double> shine = (Vec3<double>(m.specular) - errors.color) * Vec3<double>(light.specular);
    if (n_dot_l > edge && least_share > 0 && !flips) {
      const double power_least = power(h.cosine - h.error * kError - h_moved, m.shininess, 0).value;
      least.add_certain(least_share * power_least * glm::max(shine, Vec3<double>(0)));
    }
    least.add(most_share * 1e30 * shine);
    if (flips && std::abs(n_dot_e) <= 2 * kError * length + errors.n_eye + length * e_moved) {  // either way round
      const double gloss = power(std::abs(h.cosine), m.shininess, h.error * kError).value;
      out.jump += share.value * (std::abs(n_dot_l) * diffuse + gloss * specular);
    }
  }
  out.magnitude = glm::max(out.magnitude, Vec3<double>(1));
  for (int c = 0; c < 3; ++c) {
    if (least.is_saturated(c)) out.magnitude[c] = 1, out.inherited[c] = out.jump[c] = 0;
  }
  return out;
}

double light_error(const Scene& scene, const DoubleMaterial& material, const Vertex<double>& vertex,
                   const LightInputs& errors, Lights lights) {
  const LightBounds b = light_bounds(scene, material, vertex, errors, lights);
  const Vec3<double> error = kError * b.magnitude + b.inherited + b.jump;
  const double largest = std::max({error.r, error.g, error.b});
  return std::isfinite(largest) ? std::min(1.0, largest) : 1;
}

}  // namespace plumbline::math
