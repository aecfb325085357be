#include <string_view>

#include "capture/seen_as.h"
#include "check/compare/compare_planes.h"
#include "check/compare/compare_records.h"
#include "check/compare/compare_texels.h"
#include "check/judge/scene_case.h"

namespace plumbline::check {

namespace {

// The stage of a varying, which is compared as the colour is.
Measurement compare_varying(const Scene& scene, Stage stage, Varying v, const Records<double>& mine,
                            const Records<double>& theirs) {
  if (stage == Stage::light && !is_lit(v)) return compare_carried(v, mine, theirs);
  Records<double> a = seen_as(mine, v);
  const Records<double> b = seen_as(theirs, v);
  if (v == Varying::secondary) a.varyings[Varying::back_color] = mine.varyings[Varying::back_secondary];
  if (stage == Stage::light) return compare_lit(scene, a, b, factor("exact.light"), {is_back(v), is_secondary(v)});
  if (stage == Stage::clip) return compare_polygons(scene, a, b, factor("exact.clip"), is_lit(v));
  if (stage == Stage::window) return compare_window(scene, a, b, factor("exact.window"));
  return compare_attributes(a, b, factor("exact.attributes"));
}

// It is told by its own name, not by that of the colour which it was compared as.
Measurement named(Measurement m, Varying v) {
  if (std::string_view(m.worst.place.field) == "color") m.worst.place.field = name_of(v).data();
  return m;
}

// That of the colour, or of a varying that tells more.
Measurement with_varyings(const Scene& scene, Stage stage, Measurement color, const Records<double>& mine,
                          const Records<double>& theirs) {
  const bool to_fragments = stage > Stage::clip;
  for (const Varying v : carried(scene)) {
    if (to_fragments && is_back(v)) continue;
    color = worse(std::move(color), named(compare_varying(scene, stage, v, mine, theirs), v));
  }
  return color;
}

}  // namespace

void run_exact_stage(Case& c, Renderer& referee, Stage stage, const std::string& name) {
  if (stage >= Stage::depth && over_budget(c.candidate)) return c.skip(name, stage, Outcome::unsupported, kOverBudget);
  compare_stage(c, referee.run_stage(c.scene, stage, c.candidate), stage, name);
}

void compare_stage(Case& c, const Capture& made, Stage stage, const std::string& name) {
  const Records<double>&mine = c.candidate.records, &theirs = made.records;
  const auto varyings = [&](Measurement color) {
    return with_varyings(c.scene, stage, std::move(color), mine, theirs);
  };
  switch (stage) {
    case Stage::matrices: break;
    case Stage::vertex:
      return c.add(name, stage, compare_vertices(c.scene, mine, theirs, factor("exact.vertex"), factor("exact.vertex")),
                   "exact.vertex");
    case Stage::light:
      return c.add(name, stage, varyings(compare_lit(c.scene, mine, theirs, factor("exact.light"))), "exact.light");
    case Stage::clip:
      return c.add(name, stage, varyings(compare_polygons(c.scene, mine, theirs, factor("exact.clip"))), "exact.clip");
    case Stage::window:
      return c.add(name, stage, varyings(compare_window(c.scene, mine, theirs, factor("exact.window"))),
                   "exact.window");
    case Stage::coverage: {
      Measurement planes = compare_coverage(c.candidate.planes, made.planes);
      if (over_budget(c.candidate)) return c.add(name, stage, std::move(planes), "", std::string(kOverBudget));
      return c.add(name, stage, worse(std::move(planes), compare_covered(mine, theirs)));
    }
    case Stage::depth:
      return c.add(name, stage, compare_depth(c.scene, mine, theirs, factor("exact.depth")), "exact.depth");
    case Stage::attributes:
      return c.add(name, stage, varyings(compare_attributes(mine, theirs, factor("exact.attributes"))),
                   "exact.attributes");
    case Stage::texture:
      return c.add(name, stage, compare_texels(c.scene, mine, theirs, factor("exact.texture")), "exact.texture");
    case Stage::shade:
      return c.add(name, stage, compare_shaded(c.scene, mine, theirs, factor("exact.shade")),
                   is_plain(c.scene) ? "" : "exact.shade");
    case Stage::visibility:
      return c.add(name, stage,
                   worse(compare_winners(c.candidate.planes, made.planes, Legal{}), compare_drawn(mine, theirs)));
    case Stage::merge: {
      const bool codes = c.scene.frame.color != ColorFormat::rgba32f;
      return c.add(name, stage,
                   compare_merge(c.scene, c.candidate.planes, made.planes, factor("exact.merge.codes"), made.legal),
                   codes ? "exact.merge.codes" : "");
    }
    case Stage::resolve: break;  // of passes together (judge_passes.h)
  }
}

}  // namespace plumbline::check
