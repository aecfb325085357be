#include "reference/oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "capture/by_conventions.h"
#include "capture/fragment_outcomes.h"
#include "reference/arithmetic/depth_format.h"
#include "reference/arithmetic/frame_color.h"
#include "reference/oracle/ambiguity.h"
#include "reference/oracle/pixel_hit.h"
#include "reference/oracle/repeated.h"

namespace plumbline::math {

namespace {

glm::vec4 to_format(ColorFormat format, const glm::dvec4& color, Conventions::Rounding rounding) {
  if (format == ColorFormat::rgba32f) return glm::vec4(color);
  const double scale = color_scale(format);
  glm::vec4 out;
  for (int c = 0; c < 4; ++c)
    out[c] = static_cast<float>(to_whole(rounding, std::clamp(color[c], 0.0, 1.0) * scale) / scale);
  return out;
}

/// The candidates' primitives by pixel; at() sorts a pixel's in ascending order and removes duplicates.
class ByPixel {
 public:
  ByPixel(const Candidates& candidates, std::size_t pixels) : first_(pixels + 1, 0) {
    for (const Candidate& c : candidates.all()) ++first_[c.pixel + 1];
    for (std::size_t i = 0; i < pixels; ++i) first_[i + 1] += first_[i];
    primitives_.resize(candidates.all().size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Candidate& c : candidates.all()) primitives_[next[c.pixel]++] = c.primitive;
  }
  std::span<const std::uint32_t> at(std::size_t pixel) {
    const auto begin = primitives_.begin() + first_[pixel], end = primitives_.begin() + first_[pixel + 1];
    std::sort(begin, end);
    return {begin, std::unique(begin, end)};
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> primitives_;
};

Planes empty_planes(const FrameFormat& frame) {
  Planes planes;
  planes.count = {frame.width, frame.height, 0};
  planes.id_sum = {frame.width, frame.height, 0};
  planes.id = {frame.width, frame.height, kBackground};
  planes.shaded = {frame.width, frame.height, frame.clear_color};
  planes.color = {frame.width, frame.height, to_format(frame.color, glm::dvec4(frame.clear_color), {})};
  planes.depth = {frame.width, frame.height, in_format(frame.depth, frame.clear_depth)};
  if (frame.stencil != StencilFormat::none) planes.stencil = {frame.width, frame.height, frame.clear_stencil};
  return planes;
}

/// Upper bound of the number of fragments that the hits make at the pixel.
///
/// A group (groups.cpp) of triangles neither cut nor turned over makes as many fragments as its winding number, at
/// least one. The winding number, constant within delta of the pixel, is counted at one point beside the centre, which
/// is unlikely to be on an edge. An inclusive rule puts a sample on an edge in both triangles.
std::uint32_t most_fragments(const Projected& projected, std::span<const PixelHit> hits, std::size_t groups, int x,
                             int y) {
  const auto beside = [&](double delta) { return projected.ray(x, y) + delta * glm::dvec3(0.37, 0.21, 0); };
  struct Group {
    bool known = true;
    double delta = 0;  // the members' largest
    std::uint32_t members = 0, winding = 0;
  };
  std::vector<Group> of_group(groups);
  for (const PixelHit& h : hits) {
    if (h.hit.group < 0) continue;
    double& delta = of_group[static_cast<std::size_t>(h.hit.group)].delta;
    delta = std::max(delta, h.delta);
  }
  std::uint32_t most = 0;
  for (const PixelHit& h : hits) {
    const Triangle& t = projected.triangles[h.hit.primitive];
    if (h.hit.group < 0) {
      most += h.hit.pieces;
      continue;
    }
    Group& group = of_group[static_cast<std::size_t>(h.hit.group)];
    group.known = group.known && !t.cut && !t.thin && projected.conventions.tie_rule != Conventions::TieRule::inclusive;
    const glm::dvec3 d = beside(group.delta);
    const auto is_inner = [&](const glm::dvec3& n) { return t.sign * glm::dot(n, d) > 0; };
    group.members += h.hit.pieces, group.winding += std::ranges::all_of(t.n, is_inner) ? 1 : 0;
  }
  for (const Group& group : of_group) most += group.known ? std::max(group.winding, 1u) : group.members;
  return most;
}

/// Settles coverage at the pixel by the declared tie rule, and sets the least and the largest number of fragments that
/// legal renderers make there (Legal::certain, possible), and Legal::shared.
void settle_pixel(const Projected& projected, std::vector<PixelHit>& hits, int x, int y, Legal& legal) {
  using enum Conventions::TieRule;
  const Conventions::TieRule rule = projected.conventions.tie_rule;
  const auto groups = static_cast<std::size_t>(form_groups(projected, hits, x, y));
  const std::uint32_t most = most_fragments(projected, hits, groups, x, y);
  settle_coverage(rule, hits);
  std::uint32_t settled_most = 0, certain = 0;
  std::vector<bool> has(groups, false);
  for (const PixelHit& h : hits) {
    settled_most += h.hit.pieces;
    certain += h.hit.certain ? 1 : 0;
    if (h.hit.group >= 0) has[static_cast<std::size_t>(h.hit.group)] = true;
  }
  legal.certain(x, y) = certain + static_cast<std::uint32_t>(std::ranges::count(has, true));
  legal.possible(x, y) = std::min(most, settled_most);
  legal.shared(x, y) = groups > 0 && rule != inclusive && rule != exclusive ? 1 : 0;
}

const Draw& draw_of(const Scene& scene, const Projected& projected, const Hit& hit) {
  return scene.draws[projected.triangles[hit.primitive].draw];
}

/// Stencil and depth test of the hit; updates the stencil plane.
bool tested(const PixelHit& h, double z, Planes& planes, int x, int y) {
  const bool passes_depth = passes(h.hit.depth_func, z, planes.depth(x, y));
  if (h.hit.stencil == nullptr) return passes_depth;
  std::uint8_t& held = planes.stencil(x, y);
  const bool passed = stencil_passes(*h.hit.stencil, held);
  held = stencil_after(*h.hit.stencil, passes_depth, held);
  return passed && passes_depth;
}

/// Draws the hits that are inside in double into the planes at the pixel, and sets PixelHit::drawn.
void draw_inside(const Scene& scene, const Projected& projected, std::span<PixelHit> hits, int x, int y,
                 Planes& planes) {
  const FrameFormat& frame = scene.frame;
  FrameColor color(frame, projected.conventions.blending, projected.conventions.color_rounding);
  for (PixelHit& h : hits) {
    if (!h.inside) continue;
    ++planes.count(x, y);
    planes.id_sum(x, y) += id_weight(h.hit.primitive);
    const double z = in_format(frame.depth, std::clamp(h.win.z, 0.0, 1.0));
    if (!h.hit.alpha_passes || !tested(h, z, planes, x, y)) continue;
    h.drawn = true;
    planes.id(x, y) = static_cast<std::int32_t>(h.hit.primitive);
    if (h.hit.depth_mask) planes.depth(x, y) = z;
    color_hit(scene, projected, x, y, h);
    planes.shaded(x, y) = glm::vec4(h.hit.color);
    color.write(draw_of(scene, projected, h.hit).merge, around(h.hit.color, 0));
  }
  planes.color(x, y) = to_format(frame.color, middle(color.written()), projected.conventions.color_rounding);
}

void add_fragments(const Projected& projected, std::span<const PixelHit> hits, int x, int y, StageSet wanted,
                   Records<double>& out) {
  for (const PixelHit& h : hits) {
    if (!h.inside) continue;
    WindowTriangle<double> triangle{};
    triangle.primitive = h.hit.primitive;
    triangle.front = projected.triangles[h.hit.primitive].sign > 0;
    triangle.corners = 0;
    if (wanted.has(Stage::coverage)) {
      out.covered.push_back({static_cast<std::uint32_t>(out.triangles.size()), static_cast<std::uint16_t>(x),
                             static_cast<std::uint16_t>(y)});
      out.triangles.push_back(triangle);
    }
    if (wanted.has(Stage::depth)) out.depth.push_back(std::clamp(h.win.z, 0.0, 1.0));
    if (wanted.has(Stage::shade)) out.shaded.push_back({h.hit.color});
    if (wanted.has(Stage::visibility)) out.drawn.push_back({h.drawn});
  }
}

/// Sets the answers' colours, computing those of the winners' hits that have none yet.
void color_answers(const Scene& scene, const Projected& projected, std::span<PixelHit> hits, int x, int y,
                   std::span<LegalAnswer> answers) {
  for (LegalAnswer& answer : answers) {
    if (answer.primitive == kBackground) continue;
    const auto primitive = static_cast<std::uint32_t>(answer.primitive);
    PixelHit& h = *std::ranges::lower_bound(hits, primitive, {}, [](const PixelHit& of) { return of.hit.primitive; });
    color_hit(scene, projected, x, y, h);
    answer.color = h.hit.color;
    answer.color_bound = static_cast<float>(h.hit.color_bound);
  }
}

/// Interval of the frame's colour where all these hits cover the pixel. nullopt: which of their fragments are drawn, or
/// how often, is open, or the colour of one has no bound.
std::optional<ColorInterval> color_of(const Scene& scene, const Projected& projected, std::span<const Hit> hits) {
  FrameColor color(scene.frame, projected.conventions.blending, projected.conventions.color_rounding,
                   BlendedIn::floats);
  LegalFold fold(scene.frame);
  for (const Hit& hit : hits) {
    if (!hit.alpha_passes) continue;
    const std::int32_t held = fold.winners().front().primitive;
    fold.draw(hit, true);
    const std::vector<LegalAnswer>& left = fold.winners();
    const bool drawn = left.size() == 1 && left[0].primitive == static_cast<std::int32_t>(hit.primitive);
    const bool hidden = left.size() == 1 && left[0].primitive == held;
    if (hit.alpha_fails || drawn == hidden || (drawn && !std::isfinite(hit.color_bound))) return std::nullopt;
    const Merge& state = draw_of(scene, projected, hit).merge;
    if (drawn && hit.certain && hit.pieces > 1 && (state.blend || state.logic_op)) return std::nullopt;
    if (drawn) color.write(state, around(hit.color, hit.color_bound));
  }
  return color.written();
}

/// All choices of the certain hits and one member of each group, a flag per hit. Empty: there are more than `most`.
std::vector<std::vector<bool>> choices(std::span<const Hit> hits, std::size_t most) {
  std::map<int, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].certain) members[hits[i].group].push_back(i);
  }
  std::vector<std::vector<bool>> out(1, std::vector<bool>(hits.size(), false));
  for (std::size_t i = 0; i < hits.size(); ++i) out[0][i] = hits[i].certain;
  for (const auto& [group, of_group] : members) {
    std::vector<std::vector<bool>> longer;
    for (const std::vector<bool>& chosen : out) {
      for (const std::size_t member : of_group) longer.emplace_back(chosen)[member] = true;
    }
    if (longer.size() > most) return {};
    out = std::move(longer);
  }
  return out;
}

/// Sets the legal interval of the frame's colour at a pixel. Unbounded where a drawn fragment's colour has no bound, or
/// where more is open about the drawn fragments than a few choices of one member from each group. `is_counted`: each
/// group makes one fragment, and all other hits are certain.
void fold_colors(const Scene& scene, const Projected& projected, std::span<const Hit> hits, bool is_counted,
                 glm::ivec2 pixel, Legal& legal) {
  constexpr float kUnbounded = std::numeric_limits<float>::infinity();
  constexpr std::size_t kMostChoices = 16;
  legal.color_lo(pixel.x, pixel.y) = glm::vec4(-kUnbounded);
  legal.color_hi(pixel.x, pixel.y) = glm::vec4(kUnbounded);
  glm::vec4 least(kUnbounded), most(-kUnbounded);
  const auto widen = [&](std::span<const Hit> covering) {
    const std::optional<ColorInterval> color = color_of(scene, projected, covering);
    if (!color) return false;
    least = glm::min(least, low(*color));
    most = glm::max(most, high(*color));
    return true;
  };
  const auto is_open = [](const Hit& hit) { return !hit.certain && hit.alpha_passes; };
  if (std::ranges::none_of(hits, is_open)) {
    if (!widen(hits)) return;
  } else if (is_counted) {
    std::vector<Hit> covering;
    for (const std::vector<bool>& chosen : choices(hits, kMostChoices)) {
      covering.clear();
      for (std::size_t i = 0; i < hits.size(); ++i) {
        if (chosen[i]) covering.push_back(hits[i]);
      }
      if (!widen(covering)) return;
    }
  }
  if (least.x > most.x) return;  // open, or too many choices
  legal.color_lo(pixel.x, pixel.y) = least;
  legal.color_hi(pixel.x, pixel.y) = most;
}

/// Per pixel, whether it is one of `pixels`; empty where they are none.
std::vector<bool> asked_pixels(const FrameFormat& frame, std::span<const glm::ivec2> pixels) {
  if (pixels.empty()) return {};
  const auto width = static_cast<std::size_t>(frame.width);
  std::vector<bool> asked(width * static_cast<std::size_t>(frame.height));
  for (const glm::ivec2 p : pixels) {
    const bool is_inside = p.x >= 0 && p.y >= 0 && p.x < frame.width && p.y < frame.height;
    if (is_inside) asked[static_cast<std::size_t>(p.y) * width + static_cast<std::size_t>(p.x)] = true;
  }
  return asked;
}

}  // namespace

Oracle consult(const Scene& scene, const Projected& projected, const Candidates& candidates, const Request& request) {
  const FrameFormat& frame = scene.frame;
  Oracle out{{}, empty_planes(frame), {}};
  Legal& legal = out.legal;
  legal.certain = {frame.width, frame.height, 0};
  legal.possible = {frame.width, frame.height, 0};
  legal.shared = {frame.width, frame.height, 0};
  if (!colors_replace(scene)) legal.color_lo = legal.color_hi = {frame.width, frame.height};
  legal.first.reserve(legal.certain.size() + 1);
  legal.answers.reserve(legal.certain.size());
  legal.first.push_back(0);

  ByPixel by_pixel(candidates, legal.certain.size());
  const Repeated repeated(scene, projected);
  std::vector<PixelHit> hits;
  std::vector<Hit> to_fold;
  std::vector<LegalAnswer> answers;
  const std::vector<bool> asked = asked_pixels(frame, request.pixels);
  double by_depth = 0, centres = 0, at_cuts = 0;
  const std::size_t most_answers =
      request.memory_budget / (2 * sizeof(LegalAnswer));  // a vector that grows is there twice
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      hits.clear();
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x);
      const bool records = !asked.empty() && asked[pixel];
      const Colors colors = records || !legal.color_lo.empty() ? Colors::now : Colors::asked;
      for (const std::uint32_t primitive : by_pixel.at(pixel)) {
        if (const auto hit = pixel_hit(scene, projected, primitive, x, y, colors)) hits.push_back(*hit);
      }
      repeated.set_surfaces(hits);
      settle_pixel(projected, hits, x, y, legal);
      to_fold.clear();
      for (const PixelHit& h : hits) to_fold.push_back(h.hit);
      fold_hits(to_fold, frame, answers);
      if (colors == Colors::asked) color_answers(scene, projected, hits, x, y, answers);
      legal.answers.insert(legal.answers.end(), answers.begin(), answers.end());
      if (legal.answers.size() > most_answers)
        require_budget(scene, 2 * legal.answers.size() * sizeof(LegalAnswer), request.memory_budget);
      legal.first.push_back(static_cast<std::uint32_t>(legal.answers.size()));
      draw_inside(scene, projected, hits, x, y, out.planes);
      if (records) add_fragments(projected, hits, x, y, request.records, out.records);
      const auto is_settled = [](const Hit& hit) { return hit.certain || hit.group >= 0; };
      const bool is_counted = legal.certain(x, y) == legal.possible(x, y) && std::ranges::all_of(to_fold, is_settled);
      if (!legal.color_lo.empty()) fold_colors(scene, projected, to_fold, is_counted, {x, y}, legal);
      const DepthShare share = ambiguous_by_depth(scene, hits, out.planes.id(x, y));
      by_depth += share.area;
      centres += share.centre ? 1 : 0;
      const auto is_open_at_cut = [](const PixelHit& h) { return h.at_cut && !h.hit.certain && h.hit.group < 0; };
      at_cuts += answers.size() > 1 && std::ranges::any_of(hits, is_open_at_cut) ? 1 : 0;
    }
  }
  legal.predicted_ambiguous =
      std::max(by_depth, centres) + ambiguous_by_edges(scene, projected, out.planes.id) + at_cuts;
  return out;
}

std::size_t candidate_budget(const Scene& scene, std::size_t memory_budget) {
  const std::size_t pixels = static_cast<std::size_t>(scene.frame.width) * static_cast<std::size_t>(scene.frame.height);
  // Per pixel: `certain`, `possible`, `shared`, the index of answers, the index of candidates with its copy while it is
  // made, and two answers (most pixels have one).
  const std::size_t fixed = plane_bytes(scene) + pixels * (5 * sizeof(std::uint32_t) + 1 + 2 * sizeof(LegalAnswer));
  require_budget(scene, fixed, memory_budget);
  return (memory_budget - fixed) / (sizeof(Candidate) + sizeof(std::uint32_t));
}

Legal legal_by_boxes(const Scene& of_dialect, const Request& request) {
  const SceneByConventions by_conventions(of_dialect, request.conventions);
  const Scene& scene = *by_conventions;
  Candidates candidates(candidate_budget(scene, request.memory_budget), asked_pixels(scene.frame, request.pixels));
  const Projected projected = project(scene, request.conventions);
  add_by_boxes(projected, candidates);
  add_by_edges(projected, candidates);
  Request of_pixels;
  of_pixels.memory_budget = request.memory_budget;
  return consult(scene, projected, candidates, of_pixels).legal;
}

}  // namespace plumbline::math
