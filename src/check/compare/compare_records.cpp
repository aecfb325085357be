#include "check/compare/compare_records.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "check/bounds/shade_bounds.h"
#include "check/bounds/units.h"
#include "reference/arithmetic/light_bounds.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

// Bound on an entry's error before it is rounded to float, in proportion to its column: rounding in double, and entries
// below 1e-12 become 0.
constexpr double kDoubleError = 1e-12;

// Adds the differences of all entries to the meter. The candidate's entries are rounded to float first, because a
// renderer may hold matrices in double.
template <class Matrix, class Unit>
void add_entries(Meter& meter, const Matrix& a, const Matrix& b, Unit unit, double factor, const Place& place,
                 const Matrix& allowance = Matrix(0)) {
  for (int column = 0; column < Matrix::length(); ++column) {
    double largest = 0;  // of the column: a far translation is no excuse for a rotation
    for (int row = 0; row < Matrix::length(); ++row) largest = std::max(largest, std::abs(b[column][row]));
    for (int row = 0; row < Matrix::length(); ++row) {
      const double x = to_float(a[column][row]), y = b[column][row], diff = difference(x, y);
      meter.value(diff == 0 ? 0 : diff / unit(y, largest), factor, place, x, y,
                  allowance[column][row] / unit(y, largest));
    }
  }
}

template <class M>
M absolute(const M& m) {
  M out;
  for (int column = 0; column < M::length(); ++column) out[column] = glm::abs(m[column]);
  return out;
}

// Error of a normal matrix N that is inverted in float.
Mat3<double> inversion_error(const Matrices<double>& m) {
  const Mat3<double> n = absolute(m.normal);
  return 8 * u * (n * glm::transpose(absolute(Mat3<double>(m.model_view))) * n);
}

// `normals`: how the normal matrix may be inverted; none: it is not compared.
Measurement compare_matrices_by(const Records<double>& candidate, const Records<double>& reference,
                                std::optional<Inversion> normals, const std::string& name, double factor,
                                double (*unit)(double, double)) {
  return each("matrices", name, candidate.matrices.size(), reference.matrices.size(), [&](Meter& meter, std::size_t i) {
    const Matrices<double>&a = candidate.matrices[i], &b = reference.matrices[i];
    const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i), field}; };
    add_entries(meter, a.model_view, b.model_view, unit, factor, at("model_view"));
    add_entries(meter, a.projection, b.projection, unit, factor, at("projection"));
    const Mat3<double> error = normals == Inversion::in_float ? inversion_error(b) : Mat3<double>(0);
    if (normals) add_entries(meter, a.normal, b.normal, unit, factor, at("normal"), error);
    const auto units = [&](const Vec3<double>& v) { return Vec3<double>(unit(v.x, 0), unit(v.y, 0), unit(v.z, 0)); };
    const auto rounded = [](const Vec3<double>& v) {
      return Vec3<double>(to_float(v.x), to_float(v.y), to_float(v.z));
    };
    add(meter, rounded(a.win_scale), b.win_scale, units(b.win_scale), factor, at("win_scale"));
    add(meter, rounded(a.win_translate), b.win_translate, units(b.win_translate), factor, at("win_translate"));
  });
}

}  // namespace

Measurement compare_rounded_matrices(const Records<double>& candidate, const Records<double>& reference,
                                     double factor) {
  return compare_matrices_by(candidate, reference, std::nullopt, "1e-12", factor,
                             [](double, double largest) { return kDoubleError * std::max(1.0, largest); });
}

Measurement compare_matrices(const Records<double>& candidate, const Records<double>& reference, double factor,
                             Inversion inversion) {
  return compare_matrices_by(candidate, reference, inversion, "half ULP", factor, [](double value, double largest) {
    return 0.5 * ulp(value) + kDoubleError * std::max(1.0, largest);
  });
}

Measurement compare_lights(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor) {
  const std::size_t recorded = candidate.lights.size();
  if (recorded == 0) return Meter("half ULP").done();
  if (recorded != scene.lights.size()) return mismatch("half ULP", "not one record for each light", recorded);
  return each("lights", "half ULP", recorded, reference.lights.size(), [&](Meter& meter, std::size_t i) {
    const LightSource<double>&a = candidate.lights[i], &b = reference.lights[i];
    const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i), field}; };
    const auto compare = [&](const Vec3<double>& x, const Vec3<double>& y, double columns, const Place& place) {
      Vec3<double> unit;
      for (int c = 0; c < 3; ++c) unit[c] = 0.5 * ulp(y[c]) + kDoubleError * columns;
      add(meter, x, y, unit, factor, place);
    };
    const Light& light = scene.lights[i];
    const double v = glm::length(light.vector), t = glm::length(Vec3<double>(b.p_eye)) + v;
    const bool point = light.kind == Light::Kind::point;
    compare(Vec3<double>(a.p_eye), Vec3<double>(b.p_eye), 2 * v + (point ? std::max(1.0, t) : 0), at("light p_eye"));
    meter.value(difference(a.p_eye.w, b.p_eye.w), 0, at("light p_eye"), a.p_eye.w, b.p_eye.w);
    const double along = light.spot ? glm::length(light.spot->direction) : 0;
    compare(a.spot_eye, b.spot_eye, 2 * along, at("light spot_eye"));
  });
}

namespace {

// Bound on |A p - B p| for two sides' matrices, each rounded to float from its own doubles: |A - B| |p|, and, where
// that is not 0, 8 u of |M| |p| (`magnitude_at_p`), because sums of different entries round differently.
Vec4<double> by_matrices(const Mat4<double>& a, const Mat4<double>& b, const Vec4<double>& p,
                         const Vec4<double>& magnitude_at_p) {
  const Vec4<double> apart = magnitude(a - b, p);
  return glm::mix(apart + 8 * u * magnitude_at_p, Vec4<double>(0), glm::equal(apart, Vec4<double>(0)));
}

}  // namespace

Measurement compare_vertices(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double positions, double normals, Inversion inversion) {
  const DrawIndex draws(scene);
  if (candidate.matrices.size() != scene.draws.size()) {
    return mismatch("u", fmt::format("{} matrices for {} draws", candidate.matrices.size(), scene.draws.size()),
                    std::max(candidate.vertices.size(), reference.vertices.size()));
  }
  if (candidate.vertices.size() == reference.vertices.size() && candidate.vertices.size() != draws.vertices()) {
    return mismatch("u", "not one record for each vertex", candidate.vertices.size());
  }
  return each("vertices", "u", candidate.vertices.size(), reference.vertices.size(), [&](Meter& meter, std::size_t i) {
    const std::size_t d = draws.of_vertex(i).value();
    const Matrices<double>& m = candidate.matrices[d];
    const Mesh& mesh = scene.meshes[scene.draws[d].mesh];
    const Vec4<double> p(mesh.positions[i - draws.ranges()[d].first_vertex], 1.0);
    // Matrix entries below 1e-12 became 0.
    const Vec4<double> eye =
        magnitude(m.model_view, p) + 1e-12 / u * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + 1);
    const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i), field}; };
    const Vertex<double>&a = candidate.vertices[i], &b = reference.vertices[i];
    const bool bit_for_bit = positions == 0 && reference.matrices.size() == candidate.matrices.size();
    const Matrices<double>& other = bit_for_bit ? reference.matrices[d] : m;
    const Vec4<double> clip = magnitude(m.projection, eye),
                       eye_apart = by_matrices(m.model_view, other.model_view, p, eye),
                       clip_apart = by_matrices(m.projection, other.projection, eye, clip);
    add(meter, a.p_eye, b.p_eye, u * eye, positions, at("p_eye"), eye_apart);
    add(meter, a.p_clip, b.p_clip, u * clip, positions, at("p_clip"), magnitude(m.projection, eye_apart) + clip_apart);
    const Vec3<double> normal(mesh.normals[i - draws.ranges()[d].first_vertex]);
    const auto condition = [&](const Vec3<double>& of) {
      return inversion == Inversion::in_float ? inverted_normal_magnitude(m.model_view, m.normal, of)
                                              : normal_magnitude(m.normal, of);
    };
    double n = condition(normal);
    if (scene.draws[d].normals != Normals::normalize) n *= glm::length(b.n_eye);
    // The divisor is the length of the matrix' third column.
    if (scene.draws[d].normals == Normals::rescale) n += glm::length(b.n_eye) * condition(Vec3<double>(0, 0, 1));
    add(meter, a.n_eye, b.n_eye, Vec3<double>(u * n), normals, at("n_eye"));
  });
}

Measurement compare_lit(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                        double factor, LitPart part, const FloatRange& range) {
  const DrawIndex draws(scene);
  if (candidate.vertices.size() != candidate.lit.size()) {
    return mismatch("u", "not a colour for each vertex", std::max(candidate.lit.size(), reference.lit.size()));
  }
  if (candidate.lit.size() == reference.lit.size() && candidate.lit.size() != draws.vertices()) {
    return mismatch("u", "not one record for each vertex", candidate.lit.size());
  }
  return each("colours", "u", candidate.lit.size(), reference.lit.size(), [&](Meter& meter, std::size_t i) {
    const std::size_t d = draws.of_vertex(i).value();
    const Draw& draw = scene.draws[d];
    const Place place{-1, -1, static_cast<std::int64_t>(i), "color"};
    const Vec4<double>&a = candidate.lit[i].color, &b = reference.lit[i].color;
    if (!is_lit_per_vertex(draw)) {
      for (int c = 0; c < 4; ++c) {
        meter.value(difference(a[c], b[c]) / u, 0, place, a[c], b[c], range.underflow / u);
      }
      return;
    }
    const auto of_mesh = static_cast<std::uint32_t>(i - draws.ranges()[d].first_vertex);
    Vertex<double> vertex = candidate.vertices[i];
    if (part.back) vertex.n_eye = -vertex.n_eye;
    const math::LightBounds bounds =
        math::light_bounds(scene, math::material_at(scene, draw, part, of_mesh), vertex, {}, candidate.lights);
    const bool both = reference.vertices.size() == candidate.vertices.size();
    const double turned = both ? glm::distance(candidate.vertices[i].n_eye, reference.vertices[i].n_eye) : 0;
    if (bounds.jump != Vec3<double>(0) || !std::isfinite(bounds.magnitude.x)) meter.ambiguous();
    for (int c = 0; c < 4; ++c) {
      const double magnitude = c < 3 ? bounds.magnitude[c] : 1, jump = c < 3 ? bounds.jump[c] : 0,
                   by_normals = c < 3 ? turned * magnitude : 0;
      meter.suspect(c < 3 && bounds.overflows[c] ? range.overflow : "");
      if (std::isfinite(magnitude)) {
        const double unit = u * magnitude;
        meter.value(difference(a[c], b[c]) / unit, factor, place, a[c], b[c], (jump + by_normals) / unit);
      } else {
        meter.value(a[c] >= 0 && a[c] <= 1 ? 0 : kInfinite, 0, place, a[c], b[c]);
      }
    }
  });
}

}  // namespace plumbline::check
