// Known causes of stages 5 to 7.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "check/bounds/bounds.h"
#include "check/compare/compare_records.h"
#include "check/diagnose/coverage_differences.h"
#include "check/diagnose/known_causes.h"
#include "scene/antialias.h"

namespace plumbline::check {

namespace {

template <int dx, int dy>
void sampled_off_by(WindowVertex<double>& v) {  // in 1/256 pixel
  v.snapped += glm::ivec2(dx, dy);
}

// Each triangle's corners have the colour and varyings of these corners.
template <std::size_t... corners>
void attributes_of(Capture& in) {
  for (WindowTriangle<double>& t : in.records.triangles) {
    const std::array<Vec4<double>, 3> colors = {t.v[corners].color...};
    for (std::size_t k = 0; k < 3; ++k) t.v[k].color = colors[k];
  }
  for (const Varying v : kAllVaryings) {
    change_all(in.records.varyings[v].triangles, [](auto& fours) { fours = std::array{fours[corners]...}; });
  }
}

// Corners of the mesh's triangle in the records of a window triangle that is not cut: the hub of a fan comes last.
enum Corner : std::size_t { second, last, first };

// Two corners have each other's barycentric coordinates.
template <Corner a, Corner b>
void weights_swapped(Capture& in) {
  constexpr auto other = [](std::size_t corner) { return corner == a ? b : corner == b ? a : corner; };
  attributes_of<other(0), other(1), other(2)>(in);
  change_all(in.records.triangles, [](auto& t) { std::swap(t.v[a].inv_w, t.v[b].inv_w); });
}

template <Corner corner>
void depth_of(WindowTriangle<double>& t) {
  for (WindowVertex<double>& v : t.v) v.p_win.z = t.v[corner].p_win.z;
}

// Whether a missing pixel, and an extra one, is among pixels that differ and all lie on edges; nullopt: others differ.
struct EdgeDifferences {
  bool missing = false, extra = false;
  bool operator==(const EdgeDifferences&) const = default;
};
std::optional<EdgeDifferences> on_edges_alone(const Evidence& e) {
  EdgeDifferences out;
  for (const CoverageDifference& d : coverage_differences(e)) {
    const WindowTriangle<double>& t = e.candidate.records.triangles.at(d.triangle);
    if (t.corners != 3) return std::nullopt;
    for (const auto* pixels : {&d.missing, &d.extra}) {
      if (!std::ranges::all_of(*pixels, [&](glm::ivec2 p) { return on_an_edge(t, p, sample_offset(e.scene.frame)); }))
        return std::nullopt;
    }
    out.missing = out.missing || !d.missing.empty();
    out.extra = out.extra || !d.extra.empty();
  }
  return out;
}

// Rule that gives samples on edges to all triangles, or to none; exact's own rule gives them to one.
bool gives_to_all_or_none(Conventions::TieRule rule) {
  return rule == Conventions::TieRule::inclusive || rule == Conventions::TieRule::exclusive;
}

template <bool missing, bool extra>
bool by_tie_rule(const Evidence& e) {
  return !gives_to_all_or_none(e.conventions.tie_rule) && on_edges_alone(e) == EdgeDifferences{missing, extra};
}

// Missing pixels are a crack where the declared rule has all samples on edges; extra ones overlap where it has none.
bool unlike_declared_rule(const Evidence& e) {
  if (!gives_to_all_or_none(e.conventions.tie_rule)) return false;
  const std::optional<EdgeDifferences> found = on_edges_alone(e);
  return found && (e.conventions.tie_rule == Conventions::TieRule::inclusive ? found->missing : found->extra);
}

// True: triangles that differ lack pixels of their last column or row alone. (One such pixel must lie off all edges,
// and one such triangle must cover other pixels.)
bool box_one_short(const Evidence& e) {
  const std::vector<CoverageDifference> all = coverage_differences(e);
  std::size_t inner = 0;
  bool has_other_pixels = false;  // else triangles are lost, not their last pixels
  for (const CoverageDifference& d : all) {
    if (!d.extra.empty()) return false;
    has_other_pixels = has_other_pixels || !d.both.empty();
    glm::ivec2 last(0);
    for (const auto* pixels : {&d.both, &d.missing}) {
      for (const glm::ivec2 p : *pixels) last = glm::max(last, p);
    }
    if (!std::ranges::all_of(d.missing, [&](glm::ivec2 p) { return p.x == last.x || p.y == last.y; })) return false;
    inner += std::ranges::any_of(d.missing, [&](glm::ivec2 p) {
      return !on_an_edge(e.candidate.records.triangles.at(d.triangle), p, sample_offset(e.scene.frame));
    });
  }
  return inner > 0 && has_other_pixels;  // if all pixels lie on edges, the tie rule may be the cause
}

// Whether the area of a triangle, unsnapped or snapped, is below half a pixel.
bool is_small(const WindowTriangle<double>& t) {
  return t.corners == 3 &&
         (std::abs(twice_area(t, kUnsnapped)) < 1 || std::abs(twice_area(t, kSnapped)) < kSubpixel * kSubpixel);
}

// Whether no triangle of less than half a pixel's area covers anything, and others differ only on edges.
bool small_dropped(const Evidence& e) {
  const std::vector<WindowTriangle<double>>& triangles = e.candidate.records.triangles;
  const auto is_of_small = [&](const Covered& c) {
    return c.triangle < triangles.size() && is_small(triangles[c.triangle]);
  };
  if (std::ranges::any_of(e.candidate.records.covered, is_of_small)) return false;
  std::size_t dropped = 0;
  for (const CoverageDifference& d : coverage_differences(e)) {
    const WindowTriangle<double>& t = triangles.at(d.triangle);
    const auto is_tie = [&](glm::ivec2 p) { return on_an_edge(t, p, sample_offset(e.scene.frame)); };
    if (is_small(t) && d.both.empty() && d.extra.empty()) {
      ++dropped;
    } else if (!std::ranges::all_of(d.missing, is_tie) || !std::ranges::all_of(d.extra, is_tie)) {
      return false;
    }
  }
  return dropped > 0;
}

void upside_down_fragments(const Scene& scene, const Capture& in, Capture& made) {
  for (Covered& c : made.records.covered) c.y = static_cast<std::uint16_t>(scene.frame.height - 1 - c.y);
  std::ranges::sort(made.records.covered, {}, draw_order);
  FragmentSums sums = fragment_sums(made.records.covered, in.records.triangles, scene.frame.width, scene.frame.height);
  made.planes.count = std::move(sums.count);
  made.planes.id_sum = std::move(sums.id_sum);
}

// Whether depths are interpolated with perspective: stage attributes run on colours that hold the corners' depths.
bool depth_in_perspective(const Evidence& e) {
  const auto has_offset = [](const Draw& d) { return d.polygon_offset != PolygonOffset{}; };
  if (std::ranges::any_of(e.scene.draws, has_offset)) return false;  // colours have none
  Capture in = e.candidate;
  change_records(e.scene, in, [](WindowVertex<double>& v) { v.color = Vec4<double>(v.p_win.z); });
  const auto made = e.referee->run_stage(e.scene, Stage::attributes, in).records.attributes;
  const auto &mine = e.candidate.records.depth, &theirs = e.expected.records.depth;
  const double step = depth_scale(e.scene.frame.depth) == 0 ? 0x1p-22 : 1 / depth_scale(e.scene.frame.depth);
  if (made.size() != mine.size() || theirs.size() != mine.size()) return false;
  std::size_t differ = 0, explained = 0;
  bool matters = false;  // where all 1/w are equal, perspective changes nothing
  for (std::size_t i = 0; i < mine.size(); ++i) {
    if (std::abs(mine[i] - theirs[i]) <= step) continue;
    const double bent = std::clamp(made[i].color.x, 0.0, 1.0);
    ++differ;
    explained += std::abs(mine[i] - bent) <= 2 * step ? 1 : 0;
    matters |= std::abs(theirs[i] - bent) > 4 * step;
  }
  return matters && (differ - explained) * 50 <= differ;
}

bool depths_truncated(const Evidence& e) {
  if (e.conventions.depth_rounding == Conventions::Rounding::down) return false;  // declared
  const std::vector<double>&mine = e.candidate.records.depth, &theirs = e.expected.records.depth;
  const double scale = depth_scale(e.scene.frame.depth);
  Truncation t;
  for (std::size_t i = 0; i < std::min(mine.size(), theirs.size()); ++i)
    t.add(std::nearbyint(mine[i] * scale), theirs[i] * scale);
  return scale > 0 && t.shows();
}

void negate_offset(Draw& d) { d.polygon_offset = {-d.polygon_offset.factor, -d.polygon_offset.units}; }

using S = Stage;

constexpr std::array kRasterCauses = {
    seen(S::coverage, "coverage.inclusive_edges",
         "covered sets differ only on edges, all of them extra: the tie rule is inclusive", by_tie_rule<false, true>),
    seen(S::coverage, "coverage.strict_edges",
         "covered sets differ only on edges, all of them missing: the tie rule is exclusive", by_tie_rule<true, false>),
    seen(S::coverage, "coverage.wrong_corner",
         "covered sets differ only on edges, missing and extra: the tie rule has another corner",
         by_tie_rule<true, true>),
    seen(S::coverage, "coverage.unlike_declared_rule",
         "covered sets differ only on edges, and not as declared: a crack by tie rule inclusive, an overlap by "
         "exclusive",
         unlike_declared_rule),
    seen(S::coverage, "coverage.box_one_short", "triangles lack their last column or row: the box is one short",
         box_one_short),
    seen(S::coverage, "coverage.small_dropped",
         "triangles of less than half a pixel's area cover nothing: they are dropped (det < 1)", small_dropped),
    given<sampled_off_by<kSubpixel / 2, kSubpixel / 2>>(
        S::coverage, "coverage.half_pixel_more", "pixels are sampled half a pixel off: at their lower left corners"),
    given<sampled_off_by<-kSubpixel / 2, -kSubpixel / 2>>(
        S::coverage, "coverage.half_pixel_less", "pixels are sampled half a pixel off: at their upper right corners"),
    given<sampled_off_by<0, kSubpixel>>(S::coverage, "coverage.y_one_more",
                                        "every fragment at y+1: window origin flipped or y off by one"),
    given<sampled_off_by<0, -kSubpixel>>(S::coverage, "coverage.y_one_less",
                                         "every fragment at y-1: window origin flipped or y off by one"),
    given<sampled_off_by<kSubpixel, 0>>(S::coverage, "coverage.x_one_more", "every fragment at x+1: x off by one"),
    given<sampled_off_by<-kSubpixel, 0>>(S::coverage, "coverage.x_one_less", "every fragment at x-1: x off by one"),
    made<upside_down_fragments>(S::coverage, "coverage.y_flipped", "y mirrored: rows are counted from the other side"),
    given<[](Draw& d) { d.scissor.reset(); }>(S::coverage, "coverage.scissor_ignored",
                                              "fragments outside the scissor box are kept"),
    given<[](Draw& d) {
      if (d.scissor) ++d.scissor->width, ++d.scissor->height;
    }>(S::coverage, "coverage.scissor_inclusive", "the scissor box has one column and one row too many"),
    given<[](Scene& s) { s.frame.pass.sample.reset(); }>(
        S::coverage, "coverage.samples_at_centres", "samples are taken at the pixel's centre, not at their own places"),
    seen(S::depth, "depth.truncated",
         "all depths one code lower where the fraction is above 1/2: truncated, not rounded", depths_truncated),
    made<[](Capture& c) { change_all(c.records.depth, [](double& z) { z = 1 - z; }); }>(
        S::depth, "depth.reversed", "depths are 1 - z: near and far changed places"),
    seen(S::depth, "depth.in_perspective",
         "depths are interpolated with perspective, as attributes are; z/w is affine in the window",
         depth_in_perspective),
    given<depth_of<first>>(S::depth, "depth.of_first_corner", "every triangle has one depth, its first corner's"),
    given<depth_of<second>>(S::depth, "depth.of_second_corner", "every triangle has one depth, its second corner's"),
    given<depth_of<last>>(S::depth, "depth.of_last_corner", "every triangle has one depth, its last corner's"),
    given<[](Draw& d) { d.polygon_offset = {}; }>(S::depth, "depth.offset_ignored", "polygon offsets are left out"),
    given<[](Draw& d) { d.polygon_offset.factor = 0; }>(
        S::depth, "depth.offset_without_slope", "a polygon offset is of its units alone: the slope is left out"),
    given<[](Draw& d) { d.polygon_offset.units = 0; }>(
        S::depth, "depth.offset_without_units", "a polygon offset is of its slope alone: the units are left out"),
    given<negate_offset>(S::depth, "depth.offset_negated", "polygon offsets have the other sign"),
    given<[](Scene& s) { s.frame.pass.sample.reset(); }>(S::depth, "depth.of_centre",
                                                         "all samples of a pixel have the depth at its centre"),
    given<[](WindowVertex<double>& v) { v.inv_w = 1; }>(
        S::attributes, "attributes.affine",
        "error grows with the spread of 1/w in the triangle: affine interpolation, without perspective"),
    given<[](WindowVertex<double>& v) { v.inv_w *= v.inv_w; }>(S::attributes, "attributes.perspective_twice",
                                                               "the perspective is divided out twice"),
    given<attributes_of<first, first, first>>(S::attributes, "attributes.of_first_corner",
                                              "every triangle has its first corner's attributes"),
    given<attributes_of<second, second, second>>(S::attributes, "attributes.of_second_corner",
                                                 "every triangle has its second corner's attributes"),
    given<attributes_of<last, last, last>>(S::attributes, "attributes.of_last_corner",
                                           "every triangle has its last corner's attributes"),
    given<weights_swapped<first, last>>(S::attributes, "attributes.outer_corners_swapped",
                                        "the first and last corner have each other's barycentric coordinates"),
    given<weights_swapped<first, second>>(S::attributes, "attributes.first_corners_swapped",
                                          "the first two corners have each other's barycentric coordinates"),
    given<weights_swapped<second, last>>(S::attributes, "attributes.last_corners_swapped",
                                         "the last two corners have each other's barycentric coordinates"),
    given<attributes_of<1, 2, 0>>(S::attributes, "attributes.corners_turned",
                                  "each corner has the next one's attributes"),
    given<attributes_of<2, 0, 1>>(S::attributes, "attributes.corners_turned_back",
                                  "each corner has the one's before it"),
    made<[](Capture& c) { swap_red_and_blue(c.records.attributes); }>(S::attributes, "attributes.red_blue_swapped",
                                                                      "red and blue of interpolated colours swapped"),
};

}  // namespace

std::span<const KnownCause> raster_causes() { return kRasterCauses; }

bool on_an_edge(const WindowTriangle<double>& t, glm::ivec2 pixel, glm::ivec2 place) {
  const glm::i64vec2 p = glm::i64vec2(pixel) * std::int64_t{kSubpixel} + glm::i64vec2(place);
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::i64vec2 a(t.v[k].snapped), b(t.v[(k + 1) % 3].snapped);
    if (a != b && (b.x - a.x) * (p.y - a.y) == (b.y - a.y) * (p.x - a.x)) return true;
  }
  return false;
}

}  // namespace plumbline::check
