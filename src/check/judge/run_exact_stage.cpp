#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/by_conventions.h"
#include "capture/fragment_outcomes.h"
#include "capture/seen_as.h"
#include "check/bounds/open_pixels.h"
#include "check/bounds/units.h"
#include "check/compare/blending.h"
#include "check/compare/compare_planes.h"
#include "check/compare/compare_records.h"
#include "check/compare/compare_texels.h"
#include "check/judge/foreign_records.h"
#include "check/judge/rounded_colors.h"
#include "check/judge/rows.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/stage_inputs.h"
#include "check/polygons/compare_polygons.h"
#include "scene/antialias.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

// Allowance for a foreign candidate that interpolates in float from the window's origin, as llvmpipe does [u of
// bounds_from_origin()]; 0 for any other candidate.
double from_origin(const SceneJudgement& c, Stage stage) {
  return c.foreign ? tolerance(Profile::opengl, stage).factor : 0;
}

// Width and height of a frame [pixels].
glm::dvec2 size_of(const FrameFormat& frame) { return {frame.width, frame.height}; }

// A stranger's colours at corners may be 4 u off: it may undo a product by 1/w, or hold fixed point of 16 bits.
WindowRules window_rules(const SceneJudgement& c, double factor) {
  if (!c.foreign) return {factor, c.conventions};
  return {factor, c.conventions, 4, FacingArea::either};
}

// Roundings of a stranger's colours that no step of shading changes, u of the colour: c * 255 and c / 255 are one each,
// as in GAMES101's framework, and so are a product by a white light and its sum (largest seen: 1 u).
double copied_colors(const SceneJudgement& c) { return c.foreign ? 4 : 0; }

// Compares clip polygons; a foreign candidate's are first cut at the sides of the view volume, which such a candidate
// may leave to the rasterizer.
Measurement compare_clipped(const SceneJudgement& c, const Records<double>& mine, const Records<double>& theirs,
                            double factor, FlatColors of_flat) {
  if (!c.foreign) return compare_polygons(c.scene, mine, theirs, factor, of_flat);
  return compare_polygons(c.scene, cut_at_sides(c.scene, mine, factor), theirs, factor, of_flat, kCopiedVertices);
}

// Compares a varying in the stage's comparator, in place of the colour.
Measurement compare_varying(const SceneJudgement& c, Stage stage, Varying v, const Records<double>& theirs) {
  const Scene& scene = c.scene;
  const Records<double>& mine = c.candidate.records;
  if (stage == Stage::light && !is_lit(v)) return compare_carried(v, mine, theirs);
  Records<double> a = seen_as(mine, v);
  const Records<double> b = seen_as(theirs, v);
  if (v == Varying::secondary) a.varyings[Varying::back_color] = mine.varyings[Varying::back_secondary];
  const double factor = tolerance(Profile::exact, stage).factor;
  if (stage == Stage::light) return compare_lit(scene, a, b, factor, {is_back(v), is_secondary(v)});
  if (stage == Stage::clip)
    return compare_clipped(c, a, b, factor, is_lit(v) ? FlatColors::provoking : FlatColors::own);
  if (stage == Stage::window) return compare_window(scene, a, b, window_rules(c, factor));
  if (c.foreign && v == Varying::normal) stretch_unit_normals(a.attributes, b.attributes);
  return compare_attributes(a, b, factor, from_origin(c, stage), c.conventions, size_of(c.scene.frame));
}

// Whether a foreign candidate declares conventions, and its tie rule or its grid is not exact's.
bool covers_otherwise(const SceneJudgement& c) {
  const Conventions& d = c.conventions;
  const bool is_dialects = d.tie_rule == Conventions::TieRule::left_bottom && d.subpixel_bits == 8 &&
                           d.subpixel_rounding == Conventions::Rounding::nearest;
  return c.foreign && !(d == undeclared()) && !is_dialects;
}

// Names the field after the varying, which was compared as a colour.
Measurement named(Measurement m, Varying v) {
  if (std::string_view(m.worst.place.field) == "color") m.worst.place.field = name_of(v).data();
  return m;
}

// The worst of the measurements of the colour and of all varyings.
Measurement with_varyings(const SceneJudgement& c, Stage stage, Measurement color, const Records<double>& theirs) {
  const bool to_fragments = stage > Stage::clip;
  for (const Varying v : carried(c.scene)) {
    if (to_fragments && is_back(v)) continue;
    color = worse(std::move(color), named(compare_varying(c, stage, v, theirs), v));
  }
  return color;
}

// Closes open pixels whose winner is not legal by the oracle; all open pixels, where the oracle gave no answers.
void close_illegal(const SceneJudgement& c, Plane<std::uint8_t>& open) {
  const Planes& mine = c.candidate.planes;
  if (mine.id.empty()) return;
  const bool known = mine.id.size() == open.size() && c.legal.certain.size() == open.size() && !c.legal.empty();
  for (int y = 0; y < open.height(); ++y) {
    for (int x = 0; x < open.width(); ++x) {
      if (open(x, y) != 0) open(x, y) = known && answer_of_winner(c.legal, mine, x, y) != nullptr ? 1 : 0;
    }
  }
}

Measurement visible_by_exact(const SceneJudgement& c, const Capture& made) {
  return worse(compare_winners(c.candidate.planes, made.planes, Legal{}, c.stencils()),
               compare_drawn(c.candidate.records, made.records));
}

// Winners and fragments drawn. Of a foreign candidate, pixels are ambiguous where its depth buffer may be of double
// (open_by_double) and the oracle calls the winner legal.
void compare_visible(const SceneJudgement& c, const Capture& made, const JudgeId& name) {
  Measurement m = visible_by_exact(c, made);
  if (c.foreign && m.differing > 0) {
    Plane<std::uint8_t> open = open_by_double(c.scene.frame, c.candidate.records);
    close_illegal(c, open);
    Capture settled;
    settled.planes = made.planes;
    settled.records.drawn = made.records.drawn;
    const std::uint64_t pixels = copy_open_pixels(open, c.candidate.planes, settled.planes);
    copy_open_drawn(open, c.candidate.records, settled.records);
    m = visible_by_exact(c, settled);
    m.ambiguous += pixels;
  }
  c.add(name, Stage::visibility, std::move(m), nullptr, c.note_of_winners());
}

// Values of a cleared depth that a candidate may hold: the codes below and above, where the scene's clear depth lies
// half way between two codes; in a buffer of float, the clear depth itself, and the one rounded in the declared range.
std::array<double, 2> cleared_depths(const FrameFormat& frame, Conventions::DepthRange range) {
  const double scale = depth_scale(frame.depth), code = frame.clear_depth * scale;
  if (scale == 0) return {frame.clear_depth, rounded_in_range(range, frame.clear_depth)};
  const bool is_half = std::abs(code - std::floor(code) - 0.5) < 0x1p-20;
  const double nearest = depth_in_format(frame.depth, frame.clear_depth);
  return is_half ? std::array{std::floor(code) / scale, std::ceil(code) / scale} : std::array{nearest, nearest};
}

// Exact's planes. Where a foreign candidate may hold either of two cleared depths, the background, and what lies
// beneath winners that write no depth, have the one that the candidate took.
Planes with_either_clear_depth(const SceneJudgement& c, const Planes& made) {
  Planes out = made;
  const Planes& mine = c.candidate.planes;
  const auto [a, b] = cleared_depths(c.scene.frame, c.conventions.depth_range);
  const bool fits = mine.id.size() == out.depth.size() && mine.depth.size() == out.depth.size();
  if (!c.foreign || a == b || !fits) return out;
  const DrawIndex draws(c.scene);
  const auto is_either = [a = a, b = b](double z) { return z == a || z == b; };
  std::vector<std::size_t> cleared;  // pixels
  for (std::size_t i = 0; i < mine.id.size(); ++i) {
    const std::int32_t winner = mine.id.values()[i];
    const Draw* draw = winner == kBackground ? nullptr : draws.draw(static_cast<std::uint32_t>(winner));
    const bool writes_none = draw != nullptr && !draw->merge.depth_mask && is_either(out.depth.values()[i]);
    if (winner == kBackground || writes_none) cleared.push_back(i);
  }
  if (cleared.empty()) return out;
  const double z = mine.depth.values()[cleared.front()];  // all are cleared to one
  for (const std::size_t i : cleared) out.depth.values()[i] = is_either(z) ? z : out.depth.values()[i];
  return out;
}

Measurement depths_by_exact(const SceneJudgement& c, const Capture& made, double factor) {
  return compare_depth(c.scene, c.candidate.records, made.records, factor, c.conventions, from_origin(c, Stage::depth));
}

std::uint64_t depths_that_differ(const SceneJudgement& c, const Capture& made) {
  return depths_by_exact(c, made, tolerance(Profile::exact, Stage::depth).factor).differing;
}

void compare_coverage_stage(const SceneJudgement& c, const Capture& made, const JudgeId& name) {
  const Records<double>&mine = c.candidate.records, &theirs = made.records;
  const Stage stage = Stage::coverage;
  const bool are_counted = are_sums_of(mine, c.candidate.planes);
  const glm::dvec2 frame(c.scene.frame.width, c.scene.frame.height);
  if (c.foreign && are_counted && knows_ties(c.scene, c.conventions))
    return c.add(name, stage, compare_covered_by_rule(mine, theirs, c.conventions, c.candidate.snapped_by, frame));
  if (covers_otherwise(c) && are_counted) {
    const glm::dvec2 sample = 0.5 + glm::dvec2(sample_offset(c.scene.frame)) / double{kSubpixel};
    return c.add(name, stage,
                 compare_covered_except_edges(mine, theirs, c.conventions, sample, frame, c.candidate.snapped_by));
  }
  Measurement planes = compare_coverage(c.candidate.planes, made.planes, c.open_coverage());
  if (c.candidate.planes.id_sum.empty())
    return c.add(name, stage, std::move(planes), nullptr, "its counts alone: it shows no planes.id_sum");
  if (lacks_fragment_records(c.candidate))
    return c.add(name, stage, std::move(planes), nullptr, std::string(kOverBudget));
  c.add(name, stage, worse(std::move(planes), compare_open_covered(c.candidate, theirs, c.open_coverage())));
}

void compare_merge_stage(const SceneJudgement& c, const Capture& made, const JudgeId& name) {
  const Planes expected = with_either_clear_depth(c, made.planes);
  const bool is_float = c.scene.frame.color == ColorFormat::rgba32f;
  const bool blends = c.foreign && is_float && !colors_replace(c.scene);
  const Plane<double> roundings = blends ? blending_roundings(c.scene, c.candidate.records) : Plane<double>();
  const Tolerance* row = is_float ? nullptr : &tolerance(Profile::exact, Stage::merge, "codes");
  Measurement m = compare_merge(c.scene, c.candidate.planes, expected, row != nullptr ? row->factor : 1, made.legal,
                                c.conventions, roundings);
  const std::string note = c.candidate.planes.depth.empty() ? "its colour alone: it shows no planes.depth" : "";
  c.add(name, Stage::merge, std::move(m), row, note);
}

}  // namespace

// Where depth_corners is `either`, depths are made from the corners as they are and from the snapped corners, and the
// better fit counts.
void run_exact_stage(const SceneJudgement& c, Renderer& referee, Stage stage, const JudgeId& name) {
  if (stage >= Stage::depth && lacks_fragment_records(c.candidate))
    return c.skip(name, stage, Outcome::unsupported, kOverBudget);
  Conventions by = c.foreign ? c.conventions : Conventions();
  Capture made = c.foreign && stage == Stage::merge ? merge_as_declared(referee, c.scene, c.candidate, by)
                                                    : run_by_conventions(referee, c.scene, stage, c.candidate, by);
  if (stage == Stage::depth && c.foreign && by.depth_corners == Conventions::DepthCorners::either) {
    if (const std::uint64_t apart = depths_that_differ(c, made); apart > 0) {
      by.depth_corners = Conventions::DepthCorners::snapped;
      Capture other = run_by_conventions(referee, c.scene, stage, c.candidate, by);
      if (depths_that_differ(c, other) < apart) made = std::move(other);
    }
  }
  compare_stage(c, made, stage, name);
}

void compare_stage(const SceneJudgement& c, const Capture& made, Stage stage, const JudgeId& name) {
  Records<double> rounded;
  const Records<double>&mine = c.candidate.records, &theirs = with_rounded_colors(c, stage, made.records, rounded);
  const auto add = [&](auto compare, std::string_view part = "") {
    const Tolerance& row = tolerance(Profile::exact, stage, part);
    c.add(name, stage, compare(row.factor), &row);
  };
  const auto varyings = [&](Measurement color) { return with_varyings(c, stage, std::move(color), theirs); };
  Records<double> changed;  // copy of a foreign candidate's records
  switch (stage) {
    case Stage::matrices: break;
    case Stage::vertex:
      return add([&](double f) { return compare_vertices(c.scene, vertex_records(c, changed), theirs, f, f); });
    case Stage::light: return add([&](double f) { return varyings(compare_lit(c.scene, mine, theirs, f)); });
    case Stage::clip:
      return add([&](double f) { return varyings(compare_clipped(c, mine, theirs, f, FlatColors::provoking)); });
    case Stage::window:
      return add([&](double f) { return varyings(compare_window(c.scene, mine, theirs, window_rules(c, f))); });
    case Stage::coverage: return compare_coverage_stage(c, made, name);
    case Stage::depth: return add([&](double f) { return depths_by_exact(c, made, f); });
    case Stage::attributes:
      return add([&](double f) {
        return varyings(
            compare_attributes(mine, theirs, f, from_origin(c, stage), c.conventions, size_of(c.scene.frame)));
      });
    case Stage::texture: {
      const std::vector<TexelRange>* legal = c.foreign ? &made.legal.texels : nullptr;
      return add([&](double f) { return compare_texels(c.scene, mine, theirs, f, legal, c.conventions); });
    }
    case Stage::shade:
      if (is_plain(c.scene)) return c.add(name, stage, compare_shaded(c.scene, mine, theirs, 0, copied_colors(c)));
      return add([&](double f) { return compare_shaded(c.scene, mine, theirs, f, copied_colors(c)); });
    case Stage::visibility: return compare_visible(c, made, name);
    case Stage::merge: return compare_merge_stage(c, made, name);
    case Stage::resolve: break;  // of passes together (judge_passes.h)
  }
}

}  // namespace plumbline::check
