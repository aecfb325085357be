#include "check/judge/judge_passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "check/bounds/units.h"
#include "check/compare/compare_bits.h"
#include "check/judge/judge_records.h"
#include "check/judge/refusal.h"
#include "check/verdict/ledger.h"
#include "reference/arithmetic/passes.h"
#include "scene/antialias.h"

namespace plumbline::check {

namespace {

// The colours of the samples that a pixel is made of.
class SamplesAt {
 public:
  explicit SamplesAt(const Scene& scene)
      : factor_(scene.frame.antialias.factor), samples_(samples_of(scene.frame.antialias)) {}
  // visit(share, place in a pass, pass)
  template <class Visit>
  void each(int x, int y, Visit visit) const {
    int weights = 0;
    for (const PixelSample& s : samples_) weights += s.weight;
    for (const PixelSample& s : samples_) {
      visit(static_cast<double>(s.weight) / weights, factor_ * glm::ivec2(x, y) + s.offset, s.pass);
    }
  }

 private:
  int factor_;
  PixelSamples samples_;
};

int severity(Outcome outcome) {
  constexpr std::array<int, kOutcomes> kSeverities = {0, 1, 2, 5, 3, 4, 6, 7, 3};  // expected: settled later
  return kSeverities[static_cast<std::size_t>(outcome)];
}

// The worst of two passes' rows, with the items of both.
Comparison joined(Comparison a, Comparison b) {
  const Measurement &m = a.measurement, &n = b.measurement;
  const bool b_tells = severity(b.outcome) != severity(a.outcome) ? severity(b.outcome) > severity(a.outcome)
                                                                  : n.max_ratio > m.max_ratio;
  const Measurement other = b_tells ? a.measurement : b.measurement;
  Comparison out = b_tells ? std::move(b) : std::move(a);
  Measurement& sum = out.measurement;
  sum.items += other.items;
  sum.differing += other.differing;
  sum.ambiguous += other.ambiguous;
  sum.disputed += other.disputed;
  if (other.dispute.difference > sum.dispute.difference) sum.dispute = other.dispute, sum.reason = other.reason;
  std::ranges::copy(other.differing_at, std::back_inserter(sum.differing_at));
  std::ranges::copy(other.disputed_at, std::back_inserter(sum.disputed_at));
  sum.max_difference = std::max(sum.max_difference, other.max_difference);
  for (std::size_t i = 0; i < sum.histogram.size(); ++i) sum.histogram[i] += other.histogram[i];
  return out;
}

// The passes' rows, each reference's stages in their order.
std::vector<Comparison> joined(std::span<const SceneVerdict> passes) {
  std::vector<Comparison> out;
  for (std::size_t pass = 0; pass < passes.size(); ++pass) {
    for (Comparison c : passes[pass].comparisons) {
      const auto same = [&](const Comparison& o) { return o.judge == c.judge && o.stage == c.stage; };
      if (passes.size() > 1 && severity(c.outcome) > 0 && c.outcome != Outcome::unsupported) {
        c.note = fmt::format("pass {}{}{}", pass, c.note.empty() ? "" : ": ", c.note);
      }
      const auto known = std::find_if(out.begin(), out.end(), same);
      if (known == out.end()) {
        out.push_back(std::move(c));
      } else {
        *known = joined(std::move(*known), std::move(c));
      }
    }
  }
  return out;
}

// Disputed pixels of this reference, from the passes' rows.
Disputed disputed_by(const std::string& reference, std::span<const SceneVerdict> passes) {
  Disputed out{std::vector<std::set<std::pair<int, int>>>(passes.size()), ""};
  for (std::size_t pass = 0; pass < passes.size(); ++pass) {
    for (const Comparison& c : passes[pass].comparisons) {
      const Measurement& m = c.measurement;
      if (c.judge.reference != reference || m.disputed_at.empty()) continue;
      for (const glm::ivec2 p : m.disputed_at) out.at[pass].emplace(p.x, p.y);
      out.reason = m.reason;
    }
  }
  return out;
}

}  // namespace

Measurement compare_resolved(const Scene& scene, const Capture& candidate, const Capture& exact, double factor) {
  const Plane<glm::vec4>&a = candidate.planes.color, &b = exact.planes.color;
  const double scale = color_scale(scene.frame.color);
  const SamplesAt samples(scene);
  return compare_planes(a, b, "bound", [&](Meter& meter, int x, int y) {
    Vec4<double> largest(0);
    samples.each(x, y, [&](double, glm::ivec2 at, std::size_t pass) {
      largest = glm::max(largest, Vec4<double>(glm::abs(candidate.samples[pass](at.x, at.y))));
    });
    for (int c = 0; c < 4; ++c) {
      const double v = a(x, y)[c], w = b(x, y)[c], diff = difference(v, w);
      const double bound = 8 * (u * largest[c] + kGradualUnderflow) + (scale > 0 ? 0.5 / scale : 0);
      meter.value(diff == 0 ? 0 : diff / bound, factor, {x, y, -1, "color"}, v, w);
      if (scale == 0) continue;
      const double code = std::round(scale * v);
      meter.value(std::abs(scale * v - code) <= scale * 2 * u ? 0 : HUGE_VAL, 0, {x, y, -1, "no code"}, v, code);
    }
  });
}

Measurement compare_frames(const Scene& scene, const Capture& candidate, const Capture& reference,
                           const Disputed& disputed) {
  const Plane<glm::vec4>&a = candidate.planes.color, &b = reference.planes.color;
  const double scale = color_scale(scene.frame.color);
  const std::string unit = scale > 0 ? fmt::format("1/{}", scale) : "u";
  const SamplesAt samples(scene);
  return compare_planes(a, b, unit, [&](Meter& meter, int x, int y) {
    Vec4<double> apart(0), largest(0), by_fault(0);
    samples.each(x, y, [&](double share, glm::ivec2 at, std::size_t pass) {
      const Vec4<double> mine(candidate.samples[pass](at.x, at.y)), theirs(reference.samples[pass](at.x, at.y));
      const bool fault = pass < disputed.at.size() && disputed.at[pass].contains({at.x, at.y});
      (fault ? by_fault : apart) += share * glm::abs(mine - theirs);
      largest = glm::max(largest, glm::max(glm::abs(mine), glm::abs(theirs)));
    });
    for (int c = 0; c < 4; ++c) {
      const double v = a(x, y)[c], w = b(x, y)[c], one = scale > 0 ? 1 / scale : u;
      const double all = apart[c] + by_fault[c], diff = difference(v, w);
      // Roundings of either side: exact.resolve's 8 u in float; of codes half a code, and 2 u of a product.
      const double in_float = all == 0 ? kFlushedUnderflow : 16 * (u * largest[c] + kFlushedUnderflow);
      const double rounding = scale == 0 ? in_float : all == 0 ? 0 : one + 4 * u;
      const bool explained = diff <= all + rounding;
      meter.suspect(explained ? disputed.reason : "");
      meter.value(diff / one, 0, {x, y, -1, "color"}, v, w, (apart[c] + rounding) / one);
    }
  });
}

Measurement compare_samples(const Scene& scene, const Capture& candidate, std::span<const Plane<glm::vec4>> colors) {
  if (candidate.samples.size() != colors.size()) {
    return mismatch("samples",
                    fmt::format("{} samples, the scene has {} passes", candidate.samples.size(), colors.size()),
                    candidate.planes.color.size());
  }
  std::optional<Measurement> out;
  for (std::size_t pass = 0; pass < colors.size(); ++pass) {
    if (colors[pass].empty()) continue;  // its rows say why
    Measurement m = compare_color_bits(candidate.samples[pass], colors[pass], scene.frame.color);
    out = out ? worse(std::move(*out), std::move(m)) : std::move(m);
  }
  return out.value_or(Measurement());
}

SceneVerdict judge_passes(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn, std::uint64_t most_fragments) {
  std::vector<SceneVerdict> passes;
  std::vector<Plane<glm::vec4>> colors;
  const std::vector<Scene> scenes = math::pass_scenes(scene);
  const bool is_limited = most_fragments != ~std::uint64_t{0};
  for (const Scene& pass : scenes) {
    BothCaptures drawn_pass;
    passes.push_back(judge_single(pass, candidate, references, &drawn_pass,
                                  is_limited ? most_fragments / scenes.size() : most_fragments));
    colors.push_back(std::move(drawn_pass.candidate.planes.color));
  }
  return judge_resolved(scene, passes, colors, candidate, references, drawn);
}

SceneVerdict judge_resolved(const Scene& scene, std::span<const SceneVerdict> passes,
                            std::span<const Plane<glm::vec4>> colors, Renderer& candidate,
                            std::span<const Reference> references, BothCaptures* drawn) {
  SceneVerdict verdict{scene.name, scene.path, joined(passes), 0};
  for (const SceneVerdict& pass : passes) verdict.seconds += pass.seconds;
  verdict.empty_holds = std::ranges::all_of(passes, &SceneVerdict::empty_holds);
  verdict.knows_no_color = std::ranges::all_of(passes, &SceneVerdict::knows_no_color);
  const auto skip = [&](const JudgeId& name, Outcome outcome, const std::string& why) {
    verdict.comparisons.push_back(not_judged(scene.name, name, Stage::resolve, outcome, why));
  };
  std::optional<Capture> mine;  // no reference draws a scene too large to judge
  if (const auto refusal = refusal_within_budget([&] {
        Capture whole = candidate.capture(scene, Request{});
        require_samples(scene, whole.samples);
        mine = std::move(whole);
      })) {
    skip(candidate.info().name, refusal->outcome, refusal->why);
  }
  std::vector<Capture> theirs(references.size());
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (references[i].renderer == nullptr) continue;  // the passes have said so
    Renderer& renderer = *references[i].renderer;
    const RendererInfo info = renderer.info();
    const JudgeId name(info.name, is_referee(info) ? Kind::per_stage : info.legal ? Kind::legal : Kind::side_by_side);
    const std::optional<Refusal> refusal = refusal_of([&] {
      if (is_referee(info) && mine) {
        const Capture made = renderer.run_stage(scene, Stage::resolve, *mine);
        const Tolerance& row = tolerance(Profile::exact, Stage::resolve);
        Measurement m = compare_resolved(scene, *mine, made, row.factor);
        if (!candidate.info().painters.empty()) m = worse(std::move(m), compare_samples(scene, *mine, colors));
        verdict.comparisons.push_back(judged(scene.name, name, Stage::resolve, std::move(m), &row));
      }
      if (!info[Stage::resolve].shows) skip(name, Outcome::unsupported, info[Stage::resolve].reason);
      const bool compared = mine && info[Stage::resolve].shows && !is_referee(info);
      if (!compared) return;
      theirs[i] = renderer.capture(scene, Request{.conventions = candidate.info().conventions});
      require_samples(scene, theirs[i].samples);
      if (scene.frame.color == ColorFormat::rgba12 && !info.legal) {
        return skip(name, Outcome::unsupported, "asked for 12 bits a channel, OpenGL gives 16");
      }
      verdict.comparisons.push_back(judged(scene.name, name, Stage::resolve,
                                           compare_frames(scene, *mine, theirs[i], disputed_by(info.name, passes))));
    });
    if (refusal) skip(name, refusal->outcome, refusal->why);
  }
  if (mine && !candidate.info().painters.empty()) verdict.comparisons.push_back(judge_picture(scene, candidate, *mine));
  if (drawn != nullptr) {
    if (mine) drawn->candidate = std::move(*mine);
    drawn->references = std::move(theirs);
  }
  return verdict;
}

}  // namespace plumbline::check
