#include <algorithm>
#include <cmath>
#include <iterator>

#include "check/bounds/open_pixels.h"
#include "check/compare/compare_lines.h"
#include "check/compare/compare_planes.h"
#include "check/compare/compare_records.h"
#include "check/compare/compare_texels.h"
#include "check/compare/legal_window.h"
#include "check/judge/foreign_records.h"
#include "check/judge/rows.h"
#include "check/judge/stage_inputs.h"
#include "check/polygons/compare_polygons.h"

namespace plumbline::check {

namespace {

// Whether a reference's coverage contradicts the reference's own window triangles, and the candidate's coverage follows
// from these triangles: exact arithmetic on the reference's records is the third witness. (llvmpipe culls by the
// unsnapped area as well, once anything in a batch is clipped.)
bool contradicts_itself(const SceneJudgement& c, const Capture& mine, const Capture& theirs) {
  if (c.referee == nullptr || theirs.records.triangles.empty()) return false;
  Capture window;
  std::ranges::copy_if(theirs.records.triangles, std::back_inserter(window.records.triangles),
                       [](const WindowTriangle<double>& t) { return t.corners != 0; });  // those that were taken out
  try {
    const Capture settled = c.referee->run_stage(c.scene, Stage::coverage, window);
    return compare_coverage(mine.planes, settled.planes).differing == 0;
  } catch (const std::exception&) {
    return false;  // nobody settled it; the referee's failure shows under its own name
  }
}

constexpr std::string_view kNoNumber = "Mesa's specular power overflows float, and infinity times 0 is NaN";
constexpr FloatRange kOfMesa{kFlushedUnderflow, kNoNumber};
constexpr std::string_view kNo8BitDepth = "OpenGL has no 8-bit depth: it draws with 24 bits, other surfaces may win";
constexpr std::string_view kNo16BitsBesideStencil =
    "OpenGL has no 16-bit depth beside stencil values: it draws with 24 bits, other surfaces may win";
std::string_view no_such_depth(const FrameFormat& frame) {
  return frame.depth == DepthFormat::z8 ? kNo8BitDepth : kNo16BitsBesideStencil;
}

bool has_depth_format(const FrameFormat& frame) {
  const bool stencil = frame.stencil != StencilFormat::none;
  return frame.depth != DepthFormat::z8 && !(stencil && frame.depth == DepthFormat::z16);
}

// Whether the reference's depths are codes of the scene's format. True for formats that OpenGL has.
bool draws_depth_codes(const Scene& scene, const Capture& theirs) {
  if (has_depth_format(scene.frame)) return true;
  return std::ranges::all_of(theirs.planes.depth.values(), [&](double z) {
    const double code = z * depth_scale(scene.frame.depth);
    return std::abs(code - std::round(code)) < 1e-9;  // a double's rounding; a code of 24 bits is 1e-5 away or more
  });
}

void compare_covers(const SceneJudgement& c, const Capture& mine, const Capture& theirs, const JudgeId& name) {
  if (may_draw(c.scene, Topology::lines)) {
    const Tolerance& row = tolerance(c.profile, Stage::coverage, "lines");
    c.add(name, Stage::coverage, compare_covered_lines(c.scene, mine, theirs, row.factor), &row);
  } else {
    c.add(name, Stage::coverage, compare_coverage(mine.planes, theirs.planes, c.open_coverage()));
  }
  if (c.rows.back().outcome == Outcome::different && contradicts_itself(c, mine, theirs)) {
    to_dispute(c.rows.back(), "its coverage is not that of its own window triangles, the candidate's is");
  }
}

void compare_shown_frame(const SceneJudgement& c, const Capture& theirs, const JudgeId& name) {
  const Records<double>& mine = c.candidate.records;
  const auto skip = [&](std::string_view why) { c.skip(name, Stage::merge, Outcome::unsupported, why); };
  const auto add = [&](Measurement m, std::string_view part) {
    c.add(name, Stage::merge, std::move(m), &tolerance(c.profile, Stage::merge, part));
  };
  const bool replaced = colors_replace(c.scene);
  if (!replaced && mine.drawn.empty() && !mine.covered.empty())
    return skip("it does not show which fragments are drawn");
  if (!replaced && lacks_fragment_records(c.candidate)) return skip(kOverBudget);
  const double attributes = tolerance(c.profile, Stage::attributes).factor;
  switch (c.scene.frame.color) {
    case ColorFormat::rgba8:
    case ColorFormat::rgba16: {
      const bool bytes = c.scene.frame.color == ColorFormat::rgba8;
      const std::string_view part = replaced ? (bytes ? "rgba8" : "rgba16") : (bytes ? "blend" : "blend.rgba16");
      const double codes = tolerance(c.profile, Stage::merge, part).factor;
      return add(replaced ? compare_codes(c.scene, c.candidate, theirs, codes, attributes)
                          : compare_blended(c.scene, c.candidate, theirs, c.legal, codes, attributes),
                 part);
    }
    case ColorFormat::rgba12: return skip("asked for 12 bits a channel, OpenGL gives 16; attributes are compared");
    case ColorFormat::rgba32f: {
      constexpr std::string_view kPart = "blend.float";
      if (replaced) return skip("rgba32f: the colour of attributes, unrounded");
      const double factor = tolerance(c.profile, Stage::merge, kPart).factor;
      return add(compare_blended(c.scene, c.candidate, theirs, c.legal, 0, factor), kPart);
    }
  }
}

void compare_shown(const SceneJudgement& c, const Capture& theirs, Stage stage, const JudgeId& name) {
  const Records<double>& mine = c.candidate.records;
  const auto factor_of = [&](Stage of, std::string_view part = "") { return tolerance(c.profile, of, part).factor; };
  const auto skip = [&](std::string_view why) { c.skip(name, stage, Outcome::unsupported, why); };
  const auto add = [&](Measurement m, std::string_view part = "", std::string note = "") {
    c.add(name, stage, std::move(m), &tolerance(c.profile, stage, part), std::move(note));
  };
  Records<double> changed;  // copy of a foreign candidate's records
  switch (stage) {
    case Stage::matrices: return add(compare_rounded_matrices(mine, theirs.records, factor_of(stage)));
    case Stage::vertex:
      return add(compare_vertices(c.scene, vertex_records(c, changed), theirs.records, 0, factor_of(stage),
                                  Inversion::in_float));
    case Stage::light: return add(compare_lit(c.scene, mine, theirs.records, factor_of(stage), {}, kOfMesa));
    case Stage::clip:
      if (c.foreign) changed = cut_at_sides(c.scene, mine, factor_of(stage));
      return add(compare_polygon_positions(c.foreign ? changed : mine, theirs.records, factor_of(stage)));
    case Stage::window:
      return add(
          compare_window_equal(mine, theirs.records, factor_of(stage), turned_outlines(c.scene, mine, theirs.records)));
    case Stage::coverage:
      if (may_draw(c.scene, Topology::lines) && lacks_fragment_records(c.candidate)) return skip(kOverBudget);
      return compare_covers(c, c.candidate, theirs, name);
    case Stage::depth:
      if (!draws_depth_codes(c.scene, theirs)) return skip(no_such_depth(c.scene.frame));
      return add(compare_depth_planes(c.scene, c.candidate, theirs, factor_of(stage)));
    case Stage::attributes:
      if (!is_plain(c.scene)) return skip(kOnlyShaded);
      return add(compare_shaded_planes(c.scene, c.candidate, theirs, factor_of(stage)));
    case Stage::texture: {
      if (c.candidate.planes.texel.empty()) return skip("it shows no planes.texel; exact judges texture.color");
      if (theirs.planes.texel.empty()) return skip("where alpha is tested, its texels are not drawn alone");
      std::string note;
      Measurement m = compare_texel_planes(c.scene, c.candidate, theirs, factor_of(Stage::attributes), note);
      return add(std::move(m), "", std::move(note));
    }
    case Stage::shade:
      // Without textures, lights or fog per fragment, both are the one plane of the winners' colours.
      if (is_plain(c.scene)) return c.repeat(name, Stage::attributes, stage);
      if (lacks_fragment_records(c.candidate)) return skip(kOverBudget);
      return add(compare_shaded_planes(c.scene, c.candidate, theirs, factor_of(Stage::attributes)));
    case Stage::visibility:
      if (!draws_depth_codes(c.scene, theirs)) return skip(no_such_depth(c.scene.frame));
      if (!draws_lines_or_points(c.scene)) {
        return c.add(name, stage, compare_winners(c.candidate.planes, theirs.planes, c.legal, c.stencils()), nullptr,
                     c.note_of_winners());
      }
      if (lacks_fragment_records(c.candidate)) return skip(kOverBudget);
      if (mine.depth.size() != mine.covered.size()) return skip("it shows no depths of fragments");
      return c.add(name, stage, compare_line_or_point_winners(c.scene, c.candidate, theirs, c.stencils()), nullptr,
                   c.note_of_winners());
    case Stage::merge: return compare_shown_frame(c, theirs, name);
    case Stage::resolve: return;
  }
}

// Compares the stage without turned outlines (legal_window.h), primitives that the two sides may draw as different
// faces: coverage leaves these out, later stages treat the pixels that they cover as open. The rows of exact per stage
// judge turned outlines. False: nothing was compared, because the stage comes before coverage, no outline is turned, or
// the coverage of lines is unknown.
bool compare_without_turned(const SceneJudgement& c, const Capture& theirs, Stage stage, const JudgeId& name) {
  const bool lacks_line_coverage = may_draw(c.scene, Topology::lines) && lacks_fragment_records(c.candidate);
  if (stage < Stage::coverage || c.referee == nullptr || lacks_line_coverage) return false;
  const std::vector<std::uint32_t> turned = turned_outlines(c.scene, c.candidate.records, theirs.records);
  if (turned.empty()) return false;
  const WithoutTurned beside = without_turned(c.scene, c.candidate, theirs, turned, *c.referee);
  if (stage == Stage::coverage) {
    compare_covers(c.with_open(turned.size()), beside.candidate, beside.reference, name);
  } else {
    Capture settled = theirs;
    const std::uint64_t open = copy_open_pixels(beside.open, c.candidate.planes, settled.planes);
    compare_shown(c.with_open(open), settled, stage, name);
  }
  return true;
}

}  // namespace

void side_by_side(const SceneJudgement& c, const Capture& theirs, Stage stage, const JudgeId& name) {
  const std::size_t before = c.rows.size();
  if (!compare_without_turned(c, theirs, stage, name)) compare_shown(c, theirs, stage, name);
  if (c.rows.size() == before) return;
  // All depths left in the frame may be codes (such as the clear depth's) although earlier tests compared depths of
  // another format: then a difference is no evidence.
  Comparison& row = c.rows.back();
  const bool by_depth = stage == Stage::visibility || stage == Stage::merge;
  const bool differs = row.outcome == Outcome::different || row.outcome == Outcome::dispute;
  if (by_depth && differs && !has_depth_format(c.scene.frame))
    row = not_judged(c.scene.name, name, stage, Outcome::unsupported, std::string(no_such_depth(c.scene.frame)));
}

}  // namespace plumbline::check
