#include "check/judge/run_by_conventions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "capture/fragment_outcomes.h"
#include "check/bounds/open_pixels.h"
#include "check/compare/window_area.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

using C = Conventions;

// ---- coverage: exact's rule is left_bottom; another is that of a frame that is mirrored.

struct Mirror {
  bool x, y;
};

Mirror mirror_of(C::TieRule rule) {
  using enum C::TieRule;
  return {rule == right_bottom || rule == right_top, rule == left_top || rule == right_top};
}

Scene mirrored(const Scene& scene, Mirror by) {
  Scene out = scene;
  for (Draw& draw : out.draws) {
    if (!draw.scissor) continue;
    Scissor& box = *draw.scissor;
    if (by.x) box.x = scene.frame.width - (box.x + box.width);
    if (by.y) box.y = scene.frame.height - (box.y + box.height);
  }
  return out;
}

// The triangles, or else the lines and points: the others are moved to where they cover nothing.
Capture window_records(const Capture& in, bool of_triangles) {
  Capture out;
  out.width = in.width;
  out.height = in.height;
  out.records.triangles = in.records.triangles;
  for (WindowTriangle<double>& t : out.records.triangles) {
    if ((t.corners == 3) == of_triangles) continue;
    t.corners = 3;
    for (WindowVertex<double>& v : t.v) v.snapped = {0, 0};
  }
  return out;
}

void mirror(Capture& window, const FrameFormat& frame, Mirror by) {
  for (WindowTriangle<double>& t : window.records.triangles) {
    for (WindowVertex<double>& v : t.v) {
      if (by.x) v.snapped.x = kSubpixel * (frame.width - 1) - v.snapped.x;
      if (by.y) v.snapped.y = kSubpixel * (frame.height - 1) - v.snapped.y;
    }
    t.front = t.front != (by.x != by.y);
  }
}

template <class T>
void mirror(Plane<T>& plane, Mirror by) {
  const Plane<T> was = plane;
  for (int y = 0; y < was.height(); ++y) {
    for (int x = 0; x < was.width(); ++x)
      plane(x, y) = was(by.x ? was.width() - 1 - x : x, by.y ? was.height() - 1 - y : y);
  }
}

template <class T>
void add(Plane<T>& sum, const Plane<T>& other) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum.values()[i] += other.values()[i];
}

Capture cover_by_rule(Renderer& referee, const Scene& scene, const Capture& in, Mirror by) {
  Capture window = window_records(in, true);
  mirror(window, scene.frame, by);
  Capture out = referee.run_stage(mirrored(scene, by), Stage::coverage, window);
  for (Covered& c : out.records.covered) {
    if (by.x) c.x = static_cast<std::uint16_t>(scene.frame.width - 1 - c.x);
    if (by.y) c.y = static_cast<std::uint16_t>(scene.frame.height - 1 - c.y);
  }
  mirror(out.planes.count, by);
  mirror(out.planes.id_sum, by);
  if (std::ranges::any_of(in.records.triangles, [](const auto& t) { return t.corners != 3; })) {
    const Capture others = referee.run_stage(scene, Stage::coverage, window_records(in, false));
    out.records.covered.insert(out.records.covered.end(), others.records.covered.begin(), others.records.covered.end());
    add(out.planes.count, others.planes.count);
    add(out.planes.id_sum, others.planes.id_sum);
  }
  std::ranges::sort(out.records.covered, {}, [](const Covered& c) { return std::tuple(c.triangle, c.y, c.x); });
  return out;
}

// ---- depth, attributes, texture

bool is_turned_over(const WindowTriangle<double>& t) {
  const double lies = twice_area(t, kAsItLies);
  return t.corners == 3 && std::isfinite(lies) && lies != 0 && (lies > 0) != (twice_area(t, kSnapped) > 0);
}

// The capture with snapped corners that face as the unsnapped ones; exact reads nothing but the facing from them. (It
// interpolates between the snapped corners of triangles that snapping turns over: reference/exact/barycentric.h.)
Capture facing_as_it_lies(const Capture& in) {
  Capture out = in;
  for (WindowTriangle<double>& t : out.records.triangles) {
    if (!is_turned_over(t)) continue;
    const int up = twice_area(t, kAsItLies) > 0 ? kSubpixel : -kSubpixel;
    t.v[0].snapped = {0, 0}, t.v[1].snapped = {kSubpixel, 0}, t.v[2].snapped = {0, up};
  }
  return out;
}

// The capture with its corners where the grid has them. window.snapped holds grids of at most 8 bits.
Capture with_snapped_corners(const Capture& in, const C& conventions) {
  Capture out = in;
  const bool is_finer = conventions.subpixel_bits > 8;
  for (WindowTriangle<double>& t : out.records.triangles) {
    for (WindowVertex<double>& v : t.v) {
      for (int i = 0; i < 2; ++i) {
        const double fine = std::ldexp(v.p_win[i] - 0.5, conventions.subpixel_bits);
        v.p_win[i] =
            0.5 + (is_finer ? std::ldexp(rounded(conventions.subpixel_rounding, fine), -conventions.subpixel_bits)
                            : static_cast<double>(v.snapped[i]) / kSubpixel);
      }
    }
  }
  return out;
}

// ---- visibility

bool passes_in_float(const DrawIndex& draws, const Records<double>& r, std::size_t i) {
  const Draw* draw = draws.draw(r.triangles.at(r.covered[i].triangle).primitive);
  if (draw == nullptr || !draw->alpha_test) return true;
  const double alpha = r.shaded[i].color.a;
  return alpha_outcomes(*draw->alpha_test, ColorFormat::rgba32f, alpha, alpha).may_pass;
}

// Fragments that fail their alpha test are left out; the others are tested by what remains of the draws' tests.
Capture test_in_float(Renderer& referee, const Scene& scene, const Capture& in) {
  const Records<double>& r = in.records;
  const DrawIndex draws(scene);
  Capture left;
  left.width = in.width;
  left.height = in.height;
  left.records.triangles = r.triangles;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    if (!passes_in_float(draws, r, i)) continue;
    numbers.push_back(i);
    left.records.covered.push_back(r.covered[i]);
    left.records.depth.push_back(r.depth[i]);
  }
  Scene untested = scene;
  for (Draw& draw : untested.draws) draw.alpha_test.reset();
  Capture out = referee.run_stage(untested, Stage::visibility, left);
  std::vector<Drawn> drawn(r.covered.size());
  for (std::size_t k = 0; k < std::min(numbers.size(), out.records.drawn.size()); ++k)
    drawn[numbers[k]] = out.records.drawn[k];
  out.records.drawn = std::move(drawn);
  return out;
}

}  // namespace

bool knows_ties(const Scene& scene, const Conventions& c) {
  using enum C::TieRule;
  const bool is_of_sides =
      c.tie_rule == left_bottom || c.tie_rule == left_top || c.tie_rule == right_bottom || c.tie_rule == right_top;
  return is_of_sides && settles_ties(c) && c.subpixel_bits <= 8 && !scene.frame.pass.sample;
}

Capture run_by_conventions(Renderer& referee, const Scene& scene, Stage stage, const Capture& in,
                           const Conventions& conventions) {
  const Records<double>& r = in.records;
  const bool interpolates = stage == Stage::depth || stage == Stage::attributes || stage == Stage::texture;
  if (interpolates && conventions.subpixel_bits == C::kFloat && std::ranges::any_of(r.triangles, is_turned_over))
    return referee.run_stage(scene, stage, facing_as_it_lies(in));
  if (interpolates && conventions.subpixel_bits != C::kFloat && conventions.attribute_corners == C::Corners::snapped)
    return referee.run_stage(scene, stage, with_snapped_corners(in, conventions));
  const Mirror by = mirror_of(conventions.tie_rule);
  if (stage == Stage::coverage && knows_ties(scene, conventions) && (by.x || by.y))
    return cover_by_rule(referee, scene, in, by);
  const bool has_alphas = r.depth.size() == r.covered.size() && r.shaded.size() == r.covered.size();
  if (stage == Stage::visibility && tests_alpha(scene) && has_alphas &&
      conventions.alpha_test == C::AlphaTest::in_float)
    return test_in_float(referee, scene, in);
  return referee.run_stage(scene, stage, in);
}

}  // namespace plumbline::check
