#include "check/judge.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "check/compare_lines.h"
#include "check/compare_planes.h"
#include "check/compare_records.h"
#include "check/compare_texels.h"
#include "check/judge_passes.h"
#include "check/open_pixels.h"
#include "stages/seen_as.h"

namespace plumbline::check {

namespace {

constexpr std::string_view kOnlyShaded = "it hands out the final colour alone; see shade";
constexpr std::string_view kOverBudget = "the fragments do not fit the memory budget";

// One scene's judgement of one candidate, as it grows.
struct Case {
  const Scene& scene;
  const Capture& candidate;
  const Legal& legal;  // an oracle's, or empty
  Renderer* referee;   // runs stages, or null
  std::vector<Comparison>& out;
  std::uint64_t open = 0;  // pixels that the stage at hand leaves out, for the alpha test may go either way there

  void add(const std::string& reference, Stage stage, Measurement m, std::string_view row = "", std::string note = "") {
    m.ambiguous += open;
    out.push_back(judged(scene.name, reference, stage, std::move(m), row, std::move(note)));
  }
  // The row of stage `of` once more, for another stage that the same plane shows.
  void repeat(const std::string& reference, Stage of, Stage stage) {
    const auto same = [&](const Comparison& c) { return c.reference == reference && c.stage == of; };
    const auto row = std::find_if(out.begin(), out.end(), same);
    if (row == out.end()) return;
    Comparison copy = *row;
    copy.stage = stage;
    out.push_back(std::move(copy));
  }
  void skip(const std::string& reference, Stage stage, Outcome outcome, std::string_view note) {
    out.push_back(not_judged(scene.name, reference, stage, outcome, std::string(note)));
  }
};

double factor(std::string_view row) { return tolerance(row).factor; }

// Fragments were drawn, but none are recorded.
bool over_budget(const Capture& c) {
  const std::vector<std::uint32_t>& count = c.planes.count.values();
  return c.records.covered.empty() && std::any_of(count.begin(), count.end(), [](std::uint32_t n) { return n != 0; });
}

// Of two measurements of one stage, the one that tells more: that with the larger share beyond tolerance.
Measurement worse(Measurement a, Measurement b) {
  const bool a_tells = a.differing != b.differing ? a.differing > b.differing : a.max_ratio >= b.max_ratio;
  return a_tells ? std::move(a) : std::move(b);
}

bool draws_thin(const Scene& scene) { return draws(scene, Topology::lines) || draws(scene, Topology::points); }

// The stage of a varying, which is compared as the colour is.
Measurement compare_varying(const Scene& scene, Stage stage, Varying v, const Records<double>& mine,
                            const Records<double>& theirs) {
  if (stage == Stage::light && !is_lit(v)) return compare_carried(v, mine, theirs);
  const Records<double> a = seen_as(mine, v), b = seen_as(theirs, v);
  if (stage == Stage::light) return compare_lit(scene, a, b, factor("exact.light"), {is_back(v), is_secondary(v)});
  if (stage == Stage::clip) return compare_polygons(scene, a, b, factor("exact.clip"), is_lit(v));
  if (stage == Stage::window) return compare_window(a, b, factor("exact.window"));
  return compare_attributes(a, b, factor("exact.attributes"));
}

// That of the colour, or of a varying that tells more.
Measurement with_varyings(const Scene& scene, Stage stage, Measurement color, const Records<double>& mine,
                          const Records<double>& theirs) {
  const bool to_fragments = stage > Stage::clip;
  for (const Varying v : carried(scene)) {
    if (to_fragments && is_back(v)) continue;
    color = worse(std::move(color), compare_varying(scene, stage, v, mine, theirs));
  }
  return color;
}

// The stage as `referee` makes it of the candidate's own records, against the candidate's.
void graft(Case& c, Renderer& referee, Stage stage, const std::string& name) {
  const Records<double>& mine = c.candidate.records;
  if (stage >= Stage::depth && over_budget(c.candidate)) return c.skip(name, stage, Outcome::unsupported, kOverBudget);
  const Capture made = referee.run_stage(c.scene, stage, c.candidate);
  const Records<double>& theirs = made.records;
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
      return c.add(name, stage, varyings(compare_window(mine, theirs, factor("exact.window"))), "exact.window");
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

// The budget of ambiguity: a pixel is open where a snapping bound of an edge reaches its centre, which is predicted
// from the edges' length. Twice the prediction, and a scatter of three standard deviations of such a count.
std::string ambiguity_note(const Legal& legal, std::uint64_t ambiguous) {
  return fmt::format("{} ambiguous, {:.1f} predicted", ambiguous, legal.predicted_ambiguous);
}

// Coverage, depth, colour and visibility against an oracle's legal answers.
void ask_oracle(Case& c, const Legal& legal, Stage stage, const std::string& name) {
  const Planes& planes = c.candidate.planes;
  switch (stage) {
    case Stage::coverage: return c.add(name, stage, compare_legal_count(planes, legal));
    case Stage::depth:
      return c.add(name, stage, compare_legal_depth(c.scene, planes, legal, factor("legal.depth")), "legal.depth");
    case Stage::attributes:
    case Stage::shade:
      return c.add(name, stage, compare_legal_shaded(planes, legal, factor("legal.attributes")), "legal.attributes");
    case Stage::visibility: {
      Measurement m = compare_legal_winner(planes, legal);
      const double budget = 2 * legal.predicted_ambiguous;
      const double scatter = 3 * std::sqrt(budget + 1);
      std::string note = ambiguity_note(legal, m.ambiguous);
      if (!(static_cast<double>(m.ambiguous) <= budget + scatter)) {
        note += ": more than twice as many";
        m.differing = std::max(m.differing, m.ambiguous);
      }
      return c.add(name, stage, std::move(m), "", std::move(note));
    }
    case Stage::merge:
      return c.add(name, stage, compare_legal_merge(c.scene, planes, legal, factor("legal.merge")), "legal.merge");
    default: return;
  }
}

// Whether a reference's coverage contradicts the window triangles that it hands out itself, and the candidate's follows
// from them: exact arithmetic on the reference's own records is the third witness. (llvmpipe culls by the unsnapped
// area as well, once anything in a batch is clipped.)
bool contradicts_itself(Case& c, const Capture& theirs) {
  if (c.referee == nullptr || theirs.records.triangles.empty()) return false;
  try {
    const Capture settled = c.referee->run_stage(c.scene, Stage::coverage, theirs);
    return compare_coverage(c.candidate.planes, settled.planes).differing == 0;
  } catch (const std::exception&) {
    return false;  // nobody settled it; the referee's failure shows under its own name
  }
}

Comparison as_dispute(Comparison comparison, std::string_view why) {
  Measurement& m = comparison.measurement;
  m.disputed = std::exchange(m.differing, 0);
  comparison.outcome = Outcome::dispute;
  comparison.note = why;
  return comparison;
}

constexpr std::string_view kNo8BitDepth = "OpenGL has no 8-bit depth: it draws with 24 bits, other surfaces may win";
constexpr std::string_view kNo16BitsBesideStencil =
    "OpenGL has no 16-bit depth beside stencil values: it draws with 24 bits, other surfaces may win";
std::string_view no_such_depth(const FrameFormat& frame) {
  return frame.depth == DepthFormat::z8 ? kNo8BitDepth : kNo16BitsBesideStencil;
}

// Whether its depths are codes of the scene's format, if that is one that OpenGL lacks.
bool draws_depth_codes(const Scene& scene, const Capture& theirs) {
  const bool stencil = scene.frame.stencil != StencilFormat::none;
  if (scene.frame.depth != DepthFormat::z8 && !(stencil && scene.frame.depth == DepthFormat::z16)) return true;
  return std::ranges::all_of(theirs.planes.depth.values(), [&](double z) {
    const double code = z * depth_scale(scene.frame.depth);
    return std::abs(code - std::round(code)) < 1e-9;  // a double's rounding; a code of 24 bits is 1e-5 away or more
  });
}

// Whether the stage's comparison needs to know which texels are legal, and nobody told.
bool lacks_texels(const Case& c, Stage stage) {
  const bool of_texels = stage == Stage::texture || stage == Stage::shade || stage == Stage::merge;
  return of_texels && textured(c.scene) && c.candidate.legal.texels.empty();
}

// What the reference shows, beside the candidate's.
void side_by_side(Case& c, const Capture& theirs, Stage stage, const std::string& name) {
  const Records<double>& mine = c.candidate.records;
  switch (stage) {
    case Stage::matrices: return c.add(name, stage, compare_matrices_equal(mine, theirs.records));
    case Stage::vertex:
      return c.add(name, stage,
                   compare_vertices(c.scene, mine, theirs.records, 0, factor("osmesa.vertex"), Inversion::in_float),
                   "osmesa.vertex");
    case Stage::light:
      return c.add(name, stage, compare_lit(c.scene, mine, theirs.records, factor("osmesa.light")), "osmesa.light");
    case Stage::clip:
      return c.add(name, stage, compare_polygon_positions(mine, theirs.records, factor("osmesa.clip")), "osmesa.clip");
    case Stage::window: return c.add(name, stage, compare_window_equal(mine, theirs.records), "osmesa.window");
    case Stage::coverage:
      if (!draws(c.scene, Topology::lines)) {
        c.add(name, stage, compare_coverage(c.candidate.planes, theirs.planes));
      } else if (over_budget(c.candidate)) {
        return c.skip(name, stage, Outcome::unsupported, kOverBudget);
      } else {
        c.add(name, stage, compare_covered_lines(c.candidate, theirs, factor("osmesa.lines")), "osmesa.lines");
      }
      if (c.out.back().outcome == Outcome::different && contradicts_itself(c, theirs)) {
        c.out.back() = as_dispute(c.out.back(), "its coverage is not that of its own window triangles, ours is");
      }
      return;
    case Stage::depth:
      if (!draws_depth_codes(c.scene, theirs)) {
        return c.skip(name, stage, Outcome::unsupported, no_such_depth(c.scene.frame));
      }
      return c.add(name, stage, compare_depth_planes(c.scene, c.candidate, theirs, factor("osmesa.depth")),
                   "osmesa.depth");
    case Stage::attributes:
      if (!is_plain(c.scene)) return c.skip(name, stage, Outcome::unsupported, kOnlyShaded);
      return c.add(name, stage, compare_shaded_planes(c.scene, c.candidate, theirs, factor("osmesa.attributes")),
                   "osmesa.attributes");
    case Stage::texture: {
      if (theirs.planes.texel.empty()) {
        return c.skip(name, stage, Outcome::unsupported, "where alpha is tested, its texels are not drawn alone");
      }
      std::string note;
      Measurement m = compare_texel_planes(c.scene, c.candidate, theirs, factor("osmesa.attributes"), note);
      return c.add(name, stage, std::move(m), "osmesa.texture", std::move(note));
    }
    case Stage::shade:
      // Without textures, lights or fog per fragment, both are the one plane of the winners' colours.
      if (is_plain(c.scene)) return c.repeat(name, Stage::attributes, stage);
      if (over_budget(c.candidate)) return c.skip(name, stage, Outcome::unsupported, kOverBudget);
      return c.add(name, stage, compare_shaded_planes(c.scene, c.candidate, theirs, factor("osmesa.attributes")),
                   "osmesa.shade");
    case Stage::visibility:
      if (!draws_depth_codes(c.scene, theirs)) {
        return c.skip(name, stage, Outcome::unsupported, no_such_depth(c.scene.frame));
      }
      return c.add(name, stage,
                   draws_thin(c.scene) ? compare_thin_winners(c.scene, c.candidate, theirs, factor("osmesa.depth"))
                                       : compare_winners(c.candidate.planes, theirs.planes, c.legal));
    case Stage::merge: {
      const bool replaced = colors_replace(c.scene);
      if (!replaced && mine.drawn.empty() && !mine.covered.empty()) {
        return c.skip(name, stage, Outcome::unsupported, "which fragments are blended is not told");
      }
      if (!replaced && over_budget(c.candidate)) return c.skip(name, stage, Outcome::unsupported, kOverBudget);
      switch (c.scene.frame.color) {
        case ColorFormat::rgba8:
        case ColorFormat::rgba16: {
          const bool bytes = c.scene.frame.color == ColorFormat::rgba8;
          const std::string_view row = replaced ? (bytes ? "osmesa.merge.rgba8" : "osmesa.merge.rgba16")
                                                : (bytes ? "osmesa.merge.blend" : "osmesa.merge.blend.rgba16");
          return c.add(name, stage,
                       replaced ? compare_codes(c.scene, c.candidate, theirs, factor(row), factor("osmesa.attributes"))
                                : compare_blended(c.scene, c.candidate, theirs, c.legal, factor(row),
                                                  factor("osmesa.attributes")),
                       row);
        }
        case ColorFormat::rgba12:
          return c.skip(name, stage, Outcome::unsupported,
                        "asked for 12 bits a channel, OpenGL gives 16; attributes are compared");
        case ColorFormat::rgba32f:
          if (!replaced) {
            return c.add(name, stage,
                         compare_blended(c.scene, c.candidate, theirs, c.legal, 0, factor("osmesa.merge.blend.float")),
                         "osmesa.merge.blend.float");
          }
          return c.skip(name, stage, Outcome::unsupported, "rgba32f: the colour of attributes, unrounded");
      }
      return;
    }
    case Stage::resolve: return;
  }
}

// An oracle hands out the final colour, which is the interpolated one where all draws are plain.
StageSet oracle_stages(const Scene& scene) {
  return {Stage::coverage, Stage::depth, is_plain(scene) ? Stage::attributes : Stage::shade, Stage::visibility,
          Stage::merge};
}

bool runs_stages(const RendererInfo& info) {
  return std::any_of(info.stages.begin(), info.stages.end(), [](const Ability& a) { return a.runs; });
}

// The first stage up to `stage` whose records or planes the candidate does not show, or null.
const Ability* first_hidden(const Scene& scene, const RendererInfo& candidate, Stage stage) {
  for (std::size_t i = 0; i <= static_cast<std::size_t>(stage); ++i) {
    if ((static_cast<Stage>(i) != Stage::texture || textured(scene)) && !candidate.stages[i].shows)
      return &candidate.stages[i];
  }
  return nullptr;
}

// What a reference says of the scene: records and planes side by side, coverage to colour by an oracle's answers.
void judge_from_scene(Case& c, const Capture& theirs, const RendererInfo& info, const RendererInfo& candidate) {
  const bool exact = runs_stages(info);
  const std::string name = exact ? info.name + " from scene" : info.name;
  const StageSet of_oracle = oracle_stages(c.scene);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::resolve || (stage == Stage::texture && !textured(c.scene))) continue;
    if (!candidate[stage].shows) {
      c.skip(name, stage, Outcome::unsupported, candidate[stage].reason);
    } else if (info.legal && of_oracle.has(stage) && theirs.legal.empty()) {
      c.skip(name, stage, Outcome::unsupported,
             draws_thin(c.scene) ? "its legal answers are of triangles alone"
                                 : "the legal answers do not fit the memory budget");
    } else if (info.legal && of_oracle.has(stage)) {
      ask_oracle(c, theirs.legal, stage, name);
    } else if (exact && stage == Stage::matrices) {
      c.add(name, stage, compare_matrices(c.candidate.records, theirs.records, factor("exact.matrices")),
            "exact.matrices");
    } else if (exact && stage == Stage::vertex) {
      c.add(name, stage,
            compare_vertices(c.scene, c.candidate.records, theirs.records, factor("exact.vertex.scene"),
                             factor("exact.vertex.scene")),
            "exact.vertex.scene");
    } else if (!info[stage].shows) {
      c.skip(name, stage, Outcome::unsupported, info[stage].reason);
    } else if (stage == Stage::attributes && info.legal && !exact) {
      c.skip(name, stage, Outcome::unsupported, kOnlyShaded);
    } else if (stage == Stage::shade && info.legal && !exact) {
      c.repeat(name, Stage::attributes, stage);
    } else if (!exact && lacks_texels(c, stage)) {
      c.skip(name, stage, Outcome::unsupported,
             over_budget(c.candidate) ? kOverBudget : "which levels of detail are legal, exact says: it is not asked");
    } else if (!exact && stage > Stage::coverage && tests_alpha(c.scene)) {
      if (over_budget(c.candidate)) {
        c.skip(name, stage, Outcome::unsupported, kOverBudget);
        continue;
      }
      Capture settled = theirs;
      c.open = settle_alpha(c.scene, c.candidate, stage, factor("osmesa.attributes"), settled);
      side_by_side(c, settled, stage, name);
      c.open = 0;
    } else if (!exact) {
      side_by_side(c, theirs, stage, name);
    }  // An exact reference judges the other stages from the candidate's own records.
  }
}

// Everything; where the fragments do not fit the budget, everything but them.
Capture capture_all(const Scene& scene, Renderer& renderer) {
  Request request{StageSet::all(), false, {}, {}};
  try {
    return renderer.capture(scene, request);
  } catch (const OverBudget&) {
    request.records = {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window};
    return renderer.capture(scene, request);
  }
}

// What the judgement wants of a reference: an oracle's answers, if they fit the budget, and records of the vertices;
// its fragments are not compared, but those of lines.
Capture capture_reference(const Scene& scene, Renderer& renderer) {
  Request request{
      {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window}, renderer.info().legal, {}, {}};
  if (draws(scene, Topology::lines)) request.records.add(Stage::coverage);  // which line covers what
  try {
    return renderer.capture(scene, request);
  } catch (const OverBudget&) {
    request.legal = false;
    return renderer.capture(scene, request);
  }
}

}  // namespace

std::vector<Comparison> judge_records(const Scene& scene, const Capture& candidate, Renderer& referee,
                                      const RendererInfo* shown) {
  std::vector<Comparison> out;
  const Legal none;
  Case c{scene, candidate, none, &referee, out};
  const RendererInfo info = referee.info();
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    const bool of_none = stage == Stage::matrices || stage == Stage::resolve;
    if (of_none || !info[stage].runs || (stage == Stage::texture && !textured(scene))) continue;
    const std::string name = info.name + " from its records";
    if (const Ability* hidden = shown != nullptr ? first_hidden(scene, *shown, stage) : nullptr) {
      c.skip(name, stage, Outcome::unsupported, hidden->reason);
      continue;
    }
    try {
      graft(c, referee, stage, name);
    } catch (const std::exception& e) {
      c.skip(name, stage, Outcome::failed, e.what());
    }
  }
  return out;
}

SceneVerdict judge(const Scene& scene, Renderer& candidate, std::span<const Reference> references, Drawn* drawn) {
  if (scene.frame.antialias.kind != Antialias::Kind::none) return judge_passes(scene, candidate, references, drawn);
  const auto start = std::chrono::steady_clock::now();
  SceneVerdict verdict{scene.name, scene.path, {}, 0};
  const auto nothing = [&](const std::string& name, Outcome outcome, const std::string& why) {
    verdict.comparisons.push_back(not_judged(scene.name, name, Stage::merge, outcome, why));
  };
  std::optional<Capture> mine;
  try {
    mine = capture_all(scene, candidate);
  } catch (const std::exception& e) {
    nothing(candidate.info().name, Outcome::failed, e.what());
  }
  std::vector<Capture> theirs(references.size());
  std::vector<std::string> failures(references.size());
  std::vector<Outcome> outcomes(references.size(), Outcome::failed);
  const Legal none;
  const Legal* legal = &none;
  Renderer* referee = nullptr;
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (references[i].renderer == nullptr) {
      failures[i] = "not built in";
      outcomes[i] = Outcome::missing;
      continue;
    }
    try {
      theirs[i] = capture_reference(scene, *references[i].renderer);
      if (legal->empty()) legal = &theirs[i].legal;
      if (runs_stages(references[i].renderer->info())) referee = references[i].renderer;
    } catch (const Unsupported& e) {
      failures[i] = e.what();
      outcomes[i] = Outcome::unsupported;
    } catch (const OverBudget& e) {
      failures[i] = e.what();
      outcomes[i] = Outcome::unsupported;
    } catch (const std::exception& e) {
      failures[i] = e.what();
    }
  }
  if (mine && referee != nullptr && textured(scene)) {
    try {
      mine->legal.texels = referee->run_stage(scene, Stage::texture, *mine).legal.texels;
    } catch (const std::exception&) {  // the referee's failure shows under its own name
    }
  }
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (!failures[i].empty()) {
      nothing(references[i].name, outcomes[i], failures[i]);
    } else if (mine) {
      Case c{scene, *mine, *legal, referee, verdict.comparisons};
      try {
        const RendererInfo info = references[i].renderer->info(), mine_info = candidate.info();
        judge_from_scene(c, theirs[i], info, mine_info);
        if (runs_stages(info)) {
          std::ranges::move(judge_records(scene, *mine, *references[i].renderer, &mine_info),
                            std::back_inserter(verdict.comparisons));
        }
      } catch (const std::exception& e) {
        nothing(references[i].name, Outcome::failed, e.what());
      }
    }
  }
  verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (drawn != nullptr) {
    if (mine) drawn->candidate = std::move(*mine);
    drawn->references = std::move(theirs);
  }
  return verdict;
}

}  // namespace plumbline::check
