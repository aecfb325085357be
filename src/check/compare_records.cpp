#include "check/compare_records.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "check/compare_words.h"
#include "check/ledger.h"
#include "check/shade_bounds.h"

namespace plumbline::check {

namespace {

double ulp(double value) {
  const auto f = static_cast<float>(std::abs(value));
  return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - static_cast<double>(f);
}

template <class Matrix, class Unit>
void add_entries(Meter& meter, const Matrix& a, const Matrix& b, Unit unit, double factor, const Place& place) {
  for (int column = 0; column < Matrix::length(); ++column) {
    double largest = 0;  // of the column: a far translation is no excuse for a rotation
    for (int row = 0; row < Matrix::length(); ++row) largest = std::max(largest, std::abs(b[column][row]));
    for (int row = 0; row < Matrix::length(); ++row) {
      const double x = a[column][row], y = b[column][row], diff = difference(x, y);
      meter.value(diff == 0 ? 0 : diff / unit(y, largest), factor, place, x, y);
    }
  }
}

// Whether there is one record for each vertex of the scene.
bool one_per_vertex(const std::vector<DrawRange>& ranges, std::size_t records) {
  return records == (ranges.empty() ? 0 : ranges.back().first_vertex + ranges.back().vertex_count);
}

Measurement compare_matrices_by(const Records<double>& candidate, const Records<double>& reference, bool normal,
                                const std::string& name, double factor, double (*unit)(double, double)) {
  return each("matrices", name, candidate.matrices.size(), reference.matrices.size(), [&](Meter& meter, std::size_t i) {
    const Matrices<double>&a = candidate.matrices[i], &b = reference.matrices[i];
    const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i), field}; };
    add_entries(meter, a.model_view, b.model_view, unit, factor, at("model_view"));
    add_entries(meter, a.projection, b.projection, unit, factor, at("projection"));
    if (normal) add_entries(meter, a.normal, b.normal, unit, factor, at("normal"));
    const auto units = [&](const Vec3<double>& v) { return Vec3<double>(unit(v.x, 0), unit(v.y, 0), unit(v.z, 0)); };
    add(meter, a.win_scale, b.win_scale, units(b.win_scale), factor, at("win_scale"));
    add(meter, a.win_translate, b.win_translate, units(b.win_translate), factor, at("win_translate"));
  });
}

}  // namespace

Measurement compare_matrices_equal(const Records<double>& candidate, const Records<double>& reference) {
  return compare_matrices_by(candidate, reference, false, "ULP", 0, [](double value, double) { return ulp(value); });
}

Measurement compare_matrices(const Records<double>& candidate, const Records<double>& reference, double factor) {
  // 1e-12, in proportion to the column, is what rounding in double and setting small entries to 0 may do.
  return compare_matrices_by(candidate, reference, true, "half ULP", factor, [](double value, double largest) {
    return 0.5 * ulp(value) + 1e-12 * std::max(1.0, largest);
  });
}

Measurement compare_vertices(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double positions, double normals, Inversion inversion) {
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  std::size_t d = 0;
  if (candidate.matrices.size() != scene.draws.size()) {
    return mismatch("u", "no matrices", std::max(candidate.vertices.size(), reference.vertices.size()));
  }
  if (candidate.vertices.size() == reference.vertices.size() && !one_per_vertex(ranges, candidate.vertices.size())) {
    return mismatch("u", "not one record for each vertex", candidate.vertices.size());
  }
  return each("vertices", "u", candidate.vertices.size(), reference.vertices.size(), [&](Meter& meter, std::size_t i) {
    while (i >= ranges[d].first_vertex + ranges[d].vertex_count) ++d;
    const Matrices<double>& m = candidate.matrices[d];
    const Mesh& mesh = scene.meshes[scene.draws[d].mesh];
    const Vec4<double> p(mesh.positions[i - ranges[d].first_vertex], 1.0);
    // Matrix entries below 1e-12 became 0.
    const Vec4<double> eye =
        magnitude(m.model_view, p) + 1e-12 / u * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + 1);
    const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i), field}; };
    const Vertex<double>&a = candidate.vertices[i], &b = reference.vertices[i];
    add(meter, a.p_eye, b.p_eye, u * eye, positions, at("p_eye"));
    add(meter, a.p_clip, b.p_clip, u * magnitude(m.projection, eye), positions, at("p_clip"));
    const Vec3<double> normal(mesh.normals[i - ranges[d].first_vertex]);
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
                        double factor, LitPart part) {
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  std::size_t d = 0;
  if (candidate.vertices.size() != candidate.lit.size()) {
    return mismatch("u", "not a colour for each vertex", std::max(candidate.lit.size(), reference.lit.size()));
  }
  if (candidate.lit.size() == reference.lit.size() && !one_per_vertex(ranges, candidate.lit.size())) {
    return mismatch("u", "not one record for each vertex", candidate.lit.size());
  }
  return each("colours", "u", candidate.lit.size(), reference.lit.size(), [&](Meter& meter, std::size_t i) {
    while (i >= ranges[d].first_vertex + ranges[d].vertex_count) ++d;
    const Draw& draw = scene.draws[d];
    const Place place{-1, -1, static_cast<std::int64_t>(i), "color"};
    const Vec4<double>&a = candidate.lit[i].color, &b = reference.lit[i].color;
    if (!is_lit_per_vertex(draw)) {
      add(meter, a, b, Vec4<double>(u), 0, place);
      return;
    }
    const Mesh& mesh = scene.meshes[draw.mesh];
    const glm::vec4* color = mesh.colors.empty() ? nullptr : &mesh.colors[i - ranges[d].first_vertex];
    Vertex<double> vertex = candidate.vertices[i];
    if (part.back) vertex.n_eye = -vertex.n_eye;
    const LightBounds bounds = light_bounds(scene, lit_material(scene, draw, part, color), vertex);
    const bool both = reference.vertices.size() == candidate.vertices.size();
    const double turned = both ? glm::distance(candidate.vertices[i].n_eye, reference.vertices[i].n_eye) : 0;
    if (bounds.jump != Vec3<double>(0) || !std::isfinite(bounds.magnitude.x)) meter.ambiguous();
    for (int c = 0; c < 4; ++c) {
      const double magnitude = c < 3 ? bounds.magnitude[c] : 1, jump = c < 3 ? bounds.jump[c] : 0;
      if (std::isfinite(magnitude)) {
        const double unit = u * magnitude;
        meter.value(difference(a[c], b[c]) / unit, factor, place, a[c], b[c], (jump + turned * magnitude) / unit);
      } else {
        meter.value(a[c] >= 0 && a[c] <= 1 ? 0 : kInfinite, 0, place, a[c], b[c]);
      }
    }
  });
}

namespace {

// Whether snapping may turn a polygon that is not filled, of which a side has the edges or corners `records`: then its
// other face's mode, and culling, are legal too. Each corner snaps at most one unit elsewhere: the area changes by at
// most the perimeter.
bool outline_may_turn(std::span<const WindowTriangle<double>> records) {
  if (records.size() < 3 || records.front().corners == 3) return false;
  double area = 0, perimeter = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const glm::dvec2 p(records[i].v[0].snapped), q(records[(i + 1) % records.size()].v[0].snapped);
    area += p.x * q.y - p.y * q.x;
    perimeter += glm::distance(p, q);
  }
  return std::abs(area) <= 2 * perimeter + 4;
}

}  // namespace

Measurement compare_window(const Records<double>& candidate, const Records<double>& reference, double factor) {
  if (candidate.matrices.empty()) {
    return mismatch("u", "no matrices", std::max(candidate.triangles.size(), reference.triangles.size()));
  }
  Meter meter("u");
  // Each draw may have a depth range of its own: the largest of |p_ndc * scale| + |translate|.
  std::vector<Vec3<double>> translations;
  for (const Matrices<double>& m : candidate.matrices) {
    if (std::ranges::find(translations, m.win_translate) == translations.end()) translations.push_back(m.win_translate);
  }
  // Triangles are matched by primitive, and within one by order where both have the same number.
  std::size_t i = 0, j = 0;
  const auto &a = candidate.triangles, &b = reference.triangles;
  const auto run_end = [](const auto& t, std::size_t from) {
    std::size_t end = from;
    while (end < t.size() && t[end].primitive == t[from].primitive) ++end;
    return end;
  };
  // Each corner snaps at most one unit elsewhere: the area changes by at most the perimeter.
  const auto may_vanish = [](const WindowTriangle<double>& t) {
    if (t.corners < 3) return false;
    const glm::dvec2 p(t.v[0].snapped), q(t.v[1].snapped), r(t.v[2].snapped);
    const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    return std::abs(area) <= 2 * (glm::distance(p, q) + glm::distance(q, r) + glm::distance(r, p)) + 4;
  };
  while (i < a.size() || j < b.size()) {
    const bool only_a = j == b.size() || (i < a.size() && a[i].primitive < b[j].primitive);
    const bool only_b = i == a.size() || (j < b.size() && b[j].primitive < a[i].primitive);
    const std::size_t i_end = only_b ? i : run_end(a, i), j_end = only_a ? j : run_end(b, j);
    if (outline_may_turn(std::span(a).subspan(i, i_end - i)) || outline_may_turn(std::span(b).subspan(j, j_end - j))) {
      meter.ambiguous();
      meter.item();
      i = i_end, j = j_end;
      continue;
    }
    // Of a fan that lacks triangles on one side, those that may vanish are set aside.
    std::vector<std::size_t> from_a, from_b;
    const bool differ = i_end - i != j_end - j;
    const auto keep = [&](const auto& t, std::size_t k, std::vector<std::size_t>& kept) {
      if (!differ || !may_vanish(t[k])) return kept.push_back(k);
      meter.ambiguous();
      meter.item();
    };
    for (; i < i_end; ++i) keep(a, i, from_a);
    for (; j < j_end; ++j) keep(b, j, from_b);
    if (from_a.size() != from_b.size()) {
      const auto& more = from_a.size() > from_b.size() ? from_a : from_b;
      const auto& of = from_a.size() > from_b.size() ? a : b;
      meter.missing(more.size(),
                    {-1, -1, static_cast<std::int64_t>(of[more.front()].primitive), "triangle of primitive"});
      continue;
    }
    for (std::size_t n = 0; n < from_a.size(); ++n) {
      const std::size_t i_now = from_a[n], j_now = from_b[n];
      const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i_now), field}; };
      for (std::size_t k = 0; k < 3; ++k) {
        const WindowVertex<double>&v = a[i_now].v[k], &w = b[j_now].v[k];
        Vec3<double> size(0);
        for (const Vec3<double>& t : translations) size = glm::max(size, glm::abs(w.p_win - t) + glm::abs(t));
        add(meter, v.p_win, w.p_win, u * size, factor, at("p_win"));
        meter.value(difference(v.inv_w, w.inv_w) / (u * std::abs(w.inv_w)), factor, at("inv_w"), v.inv_w, w.inv_w);
        for (int c = 0; c < 2; ++c) {
          const double own = std::nearbyint((v.p_win[c] - 0.5) * kSubpixel);
          meter.value(difference(v.snapped[c], own), 0, at("snapped"), v.snapped[c], own);
        }
        add(meter, v.color, w.color, Vec4<double>(u), 0, at("color"));
      }
      const bool flipped = a[i_now].front != b[j_now].front && !may_vanish(a[i_now]);
      meter.value(flipped ? kInfinite : 0, 0, at("front"), a[i_now].front, b[j_now].front);
      meter.value(a[i_now].corners == b[j_now].corners ? 0 : kInfinite, 0, at("corners"), a[i_now].corners,
                  b[j_now].corners);
      meter.value(difference(a[i_now].width, b[j_now].width), 0, at("width"), a[i_now].width, b[j_now].width);
      meter.item();
    }
  }
  return meter.done();
}

Measurement compare_window_equal(const Records<double>& candidate, const Records<double>& reference) {
  const double inv_w = tolerance("osmesa.window").factor;
  return each("window triangles", "ULP", candidate.triangles.size(), reference.triangles.size(),
              [&](Meter& meter, std::size_t i) {
                const WindowTriangle<double>&a = candidate.triangles[i], &b = reference.triangles[i];
                const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i), field}; };
                meter.value(a.primitive == b.primitive ? 0 : kInfinite, 0, at("primitive"), a.primitive, b.primitive);
                if (a.corners == 3) meter.value(a.front == b.front ? 0 : kInfinite, 0, at("front"), a.front, b.front);
                meter.value(a.corners == b.corners ? 0 : kInfinite, 0, at("corners"), a.corners, b.corners);
                meter.value(difference(a.width, b.width), 0, at("width"), a.width, b.width);
                // A triangle may begin at any of its corners; the turn that fits best counts.
                const auto apart = [&](std::size_t turn) {
                  int n = 0;
                  for (std::size_t k = 0; k < 3; ++k) n += a.v[k].p_win != b.v[(k + turn) % 3].p_win ? 1 : 0;
                  return n;
                };
                const int n[] = {apart(0), apart(1), apart(2)};
                const std::size_t turn = n[0] <= n[1] && n[0] <= n[2] ? 0 : n[1] <= n[2] ? 1 : 2;
                for (std::size_t k = 0; k < 3; ++k) {
                  const WindowVertex<double>&v = a.v[k], &w = b.v[(k + turn) % 3];
                  for (int c = 0; c < 3; ++c) {
                    const double diff = difference(v.p_win[c], w.p_win[c]);
                    meter.value(diff == 0 ? 0 : diff / ulp(w.p_win[c]), 0, at("p_win"), v.p_win[c], w.p_win[c]);
                  }
                  const double diff_w = difference(v.inv_w, w.inv_w);
                  meter.value(diff_w == 0 ? 0 : diff_w / ulp(w.inv_w), inv_w, at("inv_w"), v.inv_w, w.inv_w);
                  for (int c = 0; c < 2; ++c) {
                    const double x = v.snapped[c], y = w.snapped[c];
                    meter.value(difference(x, y), 0, at("snapped"), x, y);
                  }
                }
              });
}

}  // namespace plumbline::check
