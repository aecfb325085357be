#include "cli/likely/lookalikes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "capture/renderers/replayed_renderer.h"
#include "check/judge/judge_single.h"
#include "cli/likely/known_faults.h"
#include "reference/exact/exact.h"
#include "report/text/conformance.h"
#include "scene/draw_index.h"

namespace plumbline::cli {

namespace {

using KnownFaults = std::vector<const KnownFault*>;

// Faults made together, and the pixels in which their frame still differs from the given one.
struct Lookalike {
  KnownFaults faults;
  Apart apart;
  FramesApart::Legal legal{};
  bool is_blank = true;  // nothing is drawn, wherever polygons are cut
};

// Rank of a fault: pixels that it leaves, then legal pixels that contradict it, then those that it does not draw.
auto rank(const Lookalike& l, Look look) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  return std::tuple(l.apart[look], l.legal.against[look], kMost - l.legal.drawn[look]);
}

bool has_one_color(const Plane<glm::vec4>& plane, const glm::vec4& color) {
  return std::ranges::none_of(plane.values(), [&](const glm::vec4& c) { return colors_apart(color, c, 1.5f); });
}

bool has_clear_depth(const FrameFormat& format, const ColorAndDepth& frame) {
  return std::ranges::all_of(frame.depth.values(), [&](double z) { return is_clear_depth(format, z); });
}

// Draws the scene with faults, and counts the pixels that differ. Where the frame's sides cut polygons, the scene is
// drawn with these cuts and with a guard band (CutAt); the nearer frame counts.
class Trial {
 public:
  Trial(const Scene& scene, const GivenFrame& given, const ColorAndDepth& ours)
      : scene_(scene), conventions_(given.conventions), apart_(scene.frame, given, ours) {
    right_.emplace(CutAt::frame_sides, ours);
    if (cuts(CutAt::frame_sides) != cuts(CutAt::guard_band))
      right_.emplace(CutAt::guard_band, draw_with({}, scene, conventions_, CutAt::guard_band));
  }
  Apart apart(const ColorAndDepth& frame) const { return apart_.from(frame); }
  Lookalike made(KnownFaults faults) const {
    Lookalike out{std::move(faults), {}, {}};
    for (const auto& [cut_at, right] : right_) {
      const ColorAndDepth frame = frame_with(out.faults, cut_at, right);
      out.is_blank &= has_one_color(frame.color, scene_.frame.clear_color) && has_clear_depth(scene_.frame, frame);
      const Lookalike here{{}, apart_.from(frame), apart_.legal(frame)};
      for (std::size_t i = 0; i < kLooks; ++i) {  // the nearer of both cuts
        const auto look = static_cast<Look>(i);
        if (cut_at != CutAt::frame_sides && !(rank(here, look) < rank(out, look))) continue;
        out.apart[look] = here.apart[look];
        out.legal.against[look] = here.legal.against[look];
        out.legal.drawn[look] = here.legal.drawn[look];
      }
    }
    return out;
  }

 private:
  std::ptrdiff_t cuts(CutAt cut_at) const {
    const Request clipped{{Stage::clip}, false, {}, {}, Request().memory_budget, WantedPlanes::none};
    const Capture drawn = make_candidate("", cut_at)->capture(scene_, clipped);
    return std::ranges::count(drawn.records.polygons.vertices, true, &ClipVertex<double>::cut);
  }
  ColorAndDepth frame_with(const KnownFaults& faults, CutAt cut_at, const ColorAndDepth& right) const {
    const auto draws_anew = [](const KnownFault* f) {
      return f->of_scene || !f->of_stages.empty() || !f->lifts.empty();
    };
    if (std::ranges::any_of(faults, draws_anew)) return draw_with(faults, scene_, conventions_, cut_at);
    ColorAndDepth out = right;
    for (const KnownFault* f : faults) f->of_frame(out);
    return out;
  }
  const Scene& scene_;
  const Conventions& conventions_;
  FramesApart apart_;
  std::map<CutAt, ColorAndDepth> right_;  // frames without a fault
};

// "STAGE (fault NAME)", of several in the stages' order.
std::string text_of(KnownFaults faults) {
  const auto stage = [](const KnownFault* f) { return std::ranges::find(kStageNames, f->stage); };
  std::ranges::stable_sort(faults, {}, stage);
  std::vector<std::string> out;
  for (const KnownFault* f : faults) out.push_back(fmt::format("{} (fault {})", f->stage, f->name));
  return fmt::format("{}", fmt::join(out, " and "));
}

std::string line_of(const Lookalike& l, std::size_t left, std::size_t apart) {
  const double explained = 100.0 * static_cast<double>(apart - left) / static_cast<double>(apart);
  std::string names, says;
  for (const KnownFault* f : l.faults) {
    names += (names.empty() ? "" : " and ") + f->name;
    says += (says.empty() ? "" : "; ") + f->says;
  }
  return fmt::format("{:>6.1f} % {:>12}  {:<36} {}\n", explained, left, names, says);
}

// Fills in `likely`, `ties` and `whole`, if a fault explains nine tenths of the pixels, and no more legal pixels
// contradict it than it explains. Where a stage up to coverage is wrong on its own input, or a fault of a wrong stage
// explains as much, only faults of wrong stages count. `all`: the nearest first. Returns the fault named, or null.
const Lookalike* name_nearest(const std::vector<Lookalike>& all, Look look, const StageSet& wrong, Lookalikes& out) {
  const auto left = [&](const Lookalike& l) { return l.apart[look]; };
  const auto explains = [&](const Lookalike& l) {
    return 10 * left(l) <= out.apart && l.legal.against[look] <= out.apart - left(l);
  };
  const auto is_of_wrong = [&](const Lookalike& l) {
    return std::ranges::any_of(l.faults, [&](const KnownFault* f) { return makes_wrong(wrong, *f); });
  };
  // The stages after coverage may be wrong by roundings alone, beside the fault that the frame shows.
  const bool by_wrong =
      std::ranges::any_of(kAllStages, [&](Stage s) { return s <= Stage::coverage && wrong.has(s); }) ||
      std::ranges::any_of(all, [&](const Lookalike& l) { return explains(l) && is_of_wrong(l); });
  const auto counts = [&](const Lookalike& l) { return !by_wrong || is_of_wrong(l); };
  const auto found = std::ranges::find_if(all, counts);
  if (found == all.end() || !explains(*found)) return nullptr;
  const Lookalike& nearest = *found;
  out.whole = left(nearest) == 0 && look != kNearerColor;
  out.likely = text_of(nearest.faults);
  for (const Lookalike& l : all) {
    const std::string text = text_of(l.faults);
    const bool is_equal = rank(l, look) == rank(nearest, look);
    if (is_equal && counts(l) && text != out.likely && std::ranges::count(out.ties, text) == 0)
      out.ties.push_back(text);
  }
  return &nearest;
}

// Ranks the faults whose frames are nearer than ours by this look, the nearest first, and writes their table. Removes
// the others from `all`.
Lookalikes ranked(std::vector<Lookalike>& all, const Apart& ours, Look look, const StageSet& wrong) {
  const auto left = [&](const Lookalike& l) { return l.apart[look]; };
  Lookalikes out;
  out.apart = ours[look];
  if (is_fine(look)) out.codes = 0.5;
  std::erase_if(all, [&](const Lookalike& l) { return left(l) >= out.apart; });
  std::ranges::stable_sort(all, {}, [&](const Lookalike& l) { return rank(l, look); });
  if (all.empty()) {
    out.text = "no known fault draws a frame that is nearer\n";
    return out;
  }
  constexpr std::size_t kShown = 8;
  out.by_nearness = look == kNearerColor;
  if (out.by_nearness)
    out.text = "a pixel is explained where the fault's frame is four times as near as plumbline's, or within 1.5/255\n";
  out.text += "explains  pixels left  fault\n";
  const bool is_whole = left(all.front()) == 0;  // then faults that leave pixels are not shown
  for (const Lookalike& l : std::span(all).first(std::min(all.size(), kShown))) {
    if (!is_whole || left(l) == 0) out.text += line_of(l, left(l), out.apart);
  }
  name_nearest(all, look, wrong, out);
  return out;
}

// Tries the nearest fault together with each other one, where the nearest alone explains a third or more. A pair
// counts only if it leaves fewer pixels than either fault alone. `alone`: all known faults.
void seek_together(const Trial& trial, const std::vector<Lookalike>& alone, const Lookalike& nearest, Look look,
                   const StageSet& wrong, Lookalikes& out) {
  const auto left = [&](const Lookalike& l) { return l.apart[look]; };
  if (3 * left(nearest) > 2 * out.apart) return;
  std::vector<Lookalike> pairs;
  for (const Lookalike& other : alone) {
    if (other.faults.front()->name == nearest.faults.front()->name) continue;
    Lookalike pair = trial.made({nearest.faults.front(), other.faults.front()});
    if (left(pair) < std::min(left(nearest), left(other))) pairs.push_back(std::move(pair));
  }
  if (pairs.empty()) return;
  std::ranges::stable_sort(pairs, {}, [&](const Lookalike& l) { return rank(l, look); });
  const Lookalike* named = name_nearest(pairs, look, wrong, out);
  out.together = named != nullptr;
  if (named != nullptr) out.text += line_of(*named, left(*named), out.apart);
}

// Line for people about a blank frame: one colour in all pixels and, where depth is known, the clear depth within a
// code of 16 bits. Empty for other frames, and for a colour that is not the clear colour where our frame has one
// colour, too.
std::string said_of_blank(const FrameFormat& frame, const ColorAndDepth& given, const ColorAndDepth& right) {
  const glm::vec4 color = given.color.values().front();
  if (!has_one_color(given.color, color) || !has_clear_depth(frame, given)) return "";
  if (!colors_apart(frame.clear_color, color, 1.5f)) return "every pixel has the clear colour: nothing is drawn\n";
  if (has_one_color(right.color, right.color.values().front())) return "";
  return fmt::format(
      "every pixel has the colour {:.3g}, {:.3g}, {:.3g}, and not the clear colour: nothing of the scene "
      "is seen\n",
      color.r, color.g, color.b);
}

bool tells_legality(const check::Comparison& row, Stage stage) {
  return row.stage == stage && judges_legality(row.judge, row.stage) && was_compared(row);
}

// Plane of 1 at pixels that no row that judges legality (with `part`: no such row of that stage) finds wrong. Empty
// where no such row judged stage `part` (without one: merge), where no row finds a pixel wrong, or where a row does not
// list all of its pixels.
Plane<std::uint8_t> legal_pixels(const Planes& planes, const check::SceneVerdict& verdict,
                                 std::optional<Stage> part = {}) {
  const auto tells = [&](const check::Comparison& row) { return tells_legality(row, part.value_or(Stage::merge)); };
  if (std::ranges::none_of(verdict.comparisons, tells)) return {};
  Plane<std::uint8_t> out(planes.color.width(), planes.color.height(), 1);
  bool any_wrong = false;
  for (const check::Comparison& row : verdict.comparisons) {
    if (row.outcome != check::Outcome::different || !judges_legality(row.judge, row.stage)) continue;
    if (row.measurement.differing_at.size() < row.measurement.differing) return {};
    any_wrong = any_wrong || !row.measurement.differing_at.empty();
    if (part && !tells(row)) continue;
    for (const glm::ivec2 p : row.measurement.differing_at) out(p.x, p.y) = 0;
  }
  return any_wrong ? out : Plane<std::uint8_t>();
}

// Whether corners, samples and ties are plumbline's.
bool covers_as_ours(const Conventions& c) {
  const Conventions ours;
  return c.sample == ours.sample && c.subpixel_bits == ours.subpixel_bits &&
         c.subpixel_rounding == ours.subpixel_rounding && c.edge_bits == ours.edge_bits &&
         c.attribute_corners == ours.attribute_corners &&
         (c.tie_rule == ours.tie_rule || c.tie_rule == Conventions::TieRule::left_bottom);
}

// Pixels at which our frame without a fault, drawn by the conventions as far as faults can, is wrong by them. Empty for
// conventions that cover as ours, and where more than a twentieth of the frame is: edges are wrong by no more.
Plane<std::uint8_t> wrong_pixels_of_ours(const Scene& scene, const Conventions& conventions,
                                         const ColorAndDepth& ours) {
  if (covers_as_ours(conventions)) return {};
  Conventions drawn = conventions;
  drawn.rows = Conventions::Rows::from_bottom, drawn.depth_range = Conventions::DepthRange::zero_to_one;
  Capture frame;
  frame.width = scene.frame.width, frame.height = scene.frame.height;
  frame.planes.color = ours.color, frame.planes.depth = ours.depth;
  const Planes planes = frame.planes;
  const auto replayed = make_replayed_renderer(std::move(frame), scene, "plumbline", drawn);
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  Plane<std::uint8_t> out = legal_pixels(planes, check::judge_single(scene, *replayed, references));
  for (std::uint8_t& pixel : out.values()) pixel = pixel == 0 ? 1 : 0;
  const auto wrong = static_cast<std::size_t>(std::ranges::count(out.values(), std::uint8_t{1}));
  return 20 * wrong > out.size() ? Plane<std::uint8_t>() : out;
}

}  // namespace

Lookalikes lookalikes(const Scene& scene, const GivenFrame& frame) {
  GivenFrame given = frame;
  const SceneByConventions seen(scene, given.conventions);
  const ColorAndDepth right = draw_with({}, *seen, given.conventions);
  given.is_wrong_in_ours = wrong_pixels_of_ours(scene, given.conventions, right);
  const Trial trial(*seen, given, right);
  Apart apart = trial.apart(right);
  if (!given.has_alpha) apart[kCoarseByAlpha] = 0;
  const auto differs = std::ranges::find_if(apart, [](std::size_t n) { return n > 0; });
  if (differs == apart.end()) return {};  // no pixel differs
  Lookalikes blank;
  blank.text = said_of_blank(seen->frame, given, right);
  if (!blank.text.empty()) {
    blank.apart = *differs, blank.blank = true;
    return blank;
  }
  const std::vector<KnownFault> known = known_faults(*seen, given);
  std::vector<Lookalike> all;
  for (const KnownFault& f : known) all.push_back(trial.made({&f}));
  const Apart without = trial.made({}).apart;
  std::erase_if(all, [&](const Lookalike& l) {
    return l.apart == without || l.is_blank;  // without effect on this scene; or nothing of it is drawn, and some was
  });
  const auto is_contradicted = [](const Lookalike& l) { return l.faults.front()->is_contradicted; };
  const bool is_explained =
      std::ranges::any_of(all, [&](const Lookalike& l) { return !is_contradicted(l) && l.apart[kCoarse] == 0; });
  std::erase_if(all, [&](const Lookalike& l) { return is_contradicted(l) && (is_explained || l.apart[kCoarse] > 0); });
  const auto seen_by = [&](Look look, bool in_pairs) {
    std::vector<Lookalike> nearest = all;
    // Faults by colour alone must not put depths off that are right.
    if (look == kCoarseColor || look == kNearerColor)
      std::erase_if(nearest, [&](const Lookalike& l) { return 10 * l.apart[kCoarseDepth] > 11 * apart[kCoarseDepth]; });
    Lookalikes out = ranked(nearest, apart, look, given.wrong);
    out.by_color = look == kCoarseColor || look == kNearerColor;
    if (in_pairs && out.likely.empty() && !nearest.empty())
      seek_together(trial, all, nearest.front(), look, given.wrong, out);
    return out;
  };
  std::vector<Lookalikes> found;
  if (given.depth.empty()) apart[kCoarseColor] = 0;  // as kCoarse
  for (const Look look : {kCoarseByAlpha, kCoarse, kCoarseColor, kNearerColor}) {
    if (apart[look] == 0) continue;
    found.push_back(seen_by(look, look == kCoarse));
    if (!found.back().likely.empty()) return found.back();
  }
  if (!found.empty()) return found.front();
  for (const Look look : {kFineColor, kFineDepth}) {  // coarse differences have no fine cause
    if (apart[look] == 0) continue;
    const Lookalikes fine = seen_by(look, false);
    if (!fine.likely.empty()) return fine;
  }
  return {};  // fine differences that no fault explains: other roundings
}

namespace {

// Whether records alone are wrong: rows that judge legality judged the frame's colours, and none finds it wrong.
bool is_wrong_by_records_alone(const check::SceneVerdict& verdict) {
  const auto is_wrong = [](const check::Comparison& row) { return row.outcome == check::Outcome::different; };
  const auto tells_colors = [](const check::Comparison& row) { return tells_legality(row, Stage::merge); };
  const auto is_wrong_frame = [&](const check::Comparison& row) {
    return is_wrong(row) && judges_legality(row.judge, row.stage);
  };
  return std::ranges::any_of(verdict.comparisons, is_wrong) && std::ranges::any_of(verdict.comparisons, tells_colors) &&
         std::ranges::none_of(verdict.comparisons, is_wrong_frame);
}

// Whether the stage made what it should of its own input: where another did not, later differences are consequences.
bool is_right_by_itself(const check::SceneVerdict& verdict, Stage stage) {
  bool holds = false;
  for (const check::Comparison& row : verdict.comparisons) {
    if (row.stage != stage || row.judge.kind != check::Kind::per_stage) continue;
    if (check::is_failure(row.outcome)) return false;
    holds = holds || row.outcome == check::Outcome::equal || row.outcome == check::Outcome::within;
  }
  return holds;
}

}  // namespace

GivenFrame frame_of(const Capture& left, const RendererInfo& renderer, const check::SceneVerdict& verdict) {
  GivenFrame out{{left.planes.color, left.planes.depth},
                 renderer.conventions,
                 legal_pixels(left.planes, verdict),
                 legal_pixels(left.planes, verdict, Stage::merge),
                 legal_pixels(left.planes, verdict, Stage::depth)};
  out.has_alpha = true;
  for (const check::Comparison& row : verdict.comparisons) {
    if (row.judge.kind == check::Kind::per_stage && row.outcome == check::Outcome::different) out.wrong.add(row.stage);
  }
  for (const Stage stage : kAllStages) {
    const bool is_right = stage < Stage::merge && report::is_right(verdict, stage);
    const bool is_consequence = out.wrong.any() && is_right_by_itself(verdict, stage);
    if (renderer[stage].given || is_right || is_consequence) out.right.add(stage);
  }
  return out;
}

std::vector<std::string> likely_of(const Lookalikes& found, const check::SceneVerdict& verdict) {
  std::uint64_t wrong = 0;
  for (const check::Comparison& c : verdict.comparisons) {
    if (c.stage == Stage::merge && c.outcome == check::Outcome::different)
      wrong = std::max(wrong, c.measurement.differing);
  }
  if (found.likely.empty() || 2 * found.apart < wrong || is_wrong_by_records_alone(verdict)) return {};
  std::vector<std::string> out = {found.likely};
  out.insert(out.end(), found.ties.begin(), found.ties.end());
  return out;
}

bool is_small(const Scene& scene) {
  constexpr std::size_t kMostPrimitives = 20'000;
  constexpr int kMostPixels = 200'000;
  return scene.frame.width <= kMostPixels / scene.frame.height && DrawIndex(scene).primitives() <= kMostPrimitives;
}

std::vector<std::string> likely_faults(const Scene& scene, const Capture& left, const RendererInfo& renderer,
                                       const check::SceneVerdict& verdict) {
  const Plane<glm::vec4>& color = left.planes.color;
  if (color.empty() || antialiased(scene) || color.width() != scene.frame.width || color.height() != scene.frame.height)
    return {};
  if (!is_small(scene)) {
    if (is_wrong_by_records_alone(verdict)) return {};
    return {"known faults are not tried: over 20,000 primitives or 200,000 pixels"};
  }
  const Lookalikes found = lookalikes(scene, frame_of(left, renderer, verdict));
  if (found.blank) return {"nothing of the scene is seen"};
  return likely_of(found, verdict);
}

}  // namespace plumbline::cli
