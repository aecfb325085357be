#include "check/judge/run_by_conventions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "capture/by_conventions.h"
#include "capture/fragment_outcomes.h"
#include "check/bounds/open_pixels.h"
#include "check/bounds/units.h"
#include "reference/arithmetic/frame_color.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

using C = Conventions;

// ---- window: exact snaps to 1/256 pixel, and samples at centres. For another grid, exact runs in a window magnified
// from the frame's corner; for another sample, in a window that is moved (capture/by_conventions.h).

constexpr int kFinestBits = 16;       // for renderers without a grid
constexpr double kFarthest = 0x1p30;  // of snapped positions [steps of the grid]

// Fraction bits of the grid, fewer where positions on it would be too large.
int bits_of_grid(const Scene& scene, const Records<double>& r, const C& conventions) {
  int bits = conventions.subpixel_bits == C::kFloat ? kFinestBits : conventions.subpixel_bits;
  const DrawIndex draws(scene);
  double farthest = 0;  // [pixels]
  for (const ClipPolygon& polygon : r.polygons.polygons) {
    const auto draw = draws.of_primitive(polygon.primitive);
    const std::size_t end = std::size_t{polygon.first} + polygon.count;
    if (!draw || end > r.polygons.vertices.size()) continue;  // exact says so
    const Matrices<double>& m = r.matrices[*draw];
    for (std::size_t i = polygon.first; i < end; ++i) {
      const Vec4<double>& p = r.polygons.vertices[i].p_clip;
      const glm::dvec2 p_win = glm::abs(glm::dvec2(p) / p.w * glm::dvec2(m.win_scale) + glm::dvec2(m.win_translate));
      const double most = std::max(p_win.x, p_win.y);
      if (std::isfinite(most)) farthest = std::max(farthest, most);
    }
  }
  while (bits > 8 && std::ldexp(farthest, bits) >= kFarthest) --bits;
  return bits;
}

// Bias [steps] that turns rounding to nearest into the declared rounding. A position less than 2^-20 from a whole
// number counts as that number.
double bias_of(C::Rounding rounding) {
  constexpr double kHalf = 0.5 - 0x1p-20;
  return rounding == C::Rounding::down ? -kHalf : rounding == C::Rounding::up ? kHalf : 0;
}

Capture window_on_grid(Renderer& referee, const Scene& scene, const Capture& in, const C& conventions) {
  const double times = std::ldexp(1.0, bits_of_grid(scene, in.records, conventions) - 8);
  glm::dvec2 bias{};
  for (int i = 0; i < 2; ++i) bias[i] = 0.5 + bias_of(subpixel_rounding(conventions, i)) / kSubpixel;
  Capture magnified = in;
  for (Matrices<double>& m : magnified.records.matrices) {
    for (int i = 0; i < 2; ++i) m.win_scale[i] *= times, m.win_translate[i] = m.win_translate[i] * times + bias[i];
  }
  Capture out = referee.run_stage(scene, Stage::window, magnified);
  for (WindowTriangle<double>& t : out.records.triangles) {
    for (WindowVertex<double>& v : t.v) {
      for (int i = 0; i < 2; ++i) {
        v.p_win[i] = (v.p_win[i] - bias[i]) / times + 0.5 - conventions.sample[i];
        v.snapped[i] = whole_in_range(snapped(conventions, i, (v.p_win[i] - 0.5) * kSubpixel));
      }
    }
  }
  return out;
}

// ---- coverage: exact's rule is left_bottom; another is that of a frame that is mirrored.

struct Mirror {
  bool x = false, y = false;
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
    const int right = std::min(box.x + box.width, scene.frame.width),
              top = std::min(box.y + box.height, scene.frame.height);
    box.x = std::min(box.x, right), box.width = right - box.x;
    box.y = std::min(box.y, top), box.height = top - box.y;
    if (by.x) box.x = scene.frame.width - right;
    if (by.y) box.y = scene.frame.height - top;
  }
  return out;
}

bool is_turned_over(const WindowTriangle<double>& t) {
  const double lies = twice_area(t, kUnsnapped), snapped = twice_area(t, kSnapped);
  return t.corners == 3 && std::isfinite(lies) && lies != 0 && (lies > 0 ? snapped <= 0 : snapped >= 0);
}

// True of a triangle that the grid turns over, and that is faced (and was not culled) by its unsnapped corners.
bool faces_unsnapped(const WindowTriangle<double>& t) {
  return is_turned_over(t) && t.front == (twice_area(t, kUnsnapped) > 0);
}

// Faces triangles of faces_unsnapped() that have fragments as their snapped corners, whose inside exact covers; the
// others, which an edge function by the unsnapped face may lose, cover nothing.
void face_by_grid(const std::vector<Covered>& covered, std::vector<WindowTriangle<double>>& triangles) {
  for (const Covered& c : covered) {
    if (c.triangle < triangles.size() && faces_unsnapped(triangles[c.triangle]))
      triangles[c.triangle].front = !triangles[c.triangle].front;
  }
}

// Window records of triangles alone, or of lines and points alone: the records of the other kind become degenerate.
Capture window_records(const Capture& in, bool of_triangles) {
  Capture out;
  out.width = in.width;
  out.height = in.height;
  out.records.triangles = in.records.triangles;
  face_by_grid(in.records.covered, out.records.triangles);
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
  std::ranges::sort(out.records.covered, {}, draw_order);
  return out;
}

// ---- depth, attributes, texture

// Snapped corners that face as the unsnapped ones; exact reads nothing but the facing from them. (It interpolates
// between the snapped corners of triangles that snapping turns over: reference/exact/barycentric.h.)
void face_unsnapped(WindowTriangle<double>& t) {
  if (!is_turned_over(t)) return;
  const int up = twice_area(t, kUnsnapped) > 0 ? kSubpixel : -kSubpixel;
  t.v[0].snapped = {0, 0}, t.v[1].snapped = {kSubpixel, 0}, t.v[2].snapped = {0, up};
}

// Whether the stage interpolates between snapped corners.
bool goes_by_grid(Stage stage, const C& conventions) {
  if (conventions.subpixel_bits == C::kFloat) return false;
  return stage == Stage::depth ? conventions.depth_corners == C::DepthCorners::snapped
                               : conventions.attribute_corners == C::Corners::snapped;
}

// The corners where the grid has them. window.snapped holds grids of at most 8 bits.
void move_to_grid(WindowTriangle<double>& t, const C& conventions) {
  const int bits = conventions.subpixel_bits;
  for (WindowVertex<double>& v : t.v) {
    for (int i = 0; i < 2; ++i) {
      v.p_win[i] = 0.5 + (bits > 8 ? std::ldexp(on_grid(conventions, i, v.p_win[i]), -bits) - conventions.sample[i]
                                   : static_cast<double>(v.snapped[i]) / kSubpixel);
    }
  }
}

Capture interpolate_by(Renderer& referee, const Scene& scene, Stage stage, const Capture& in, const C& conventions) {
  const bool is_finer = conventions.subpixel_bits == C::kFloat || conventions.subpixel_bits > 8;
  const bool are_snapped = goes_by_grid(stage, conventions);
  const bool is_affine = conventions.interpolation == C::Interpolation::affine && stage != Stage::depth;
  const bool turns_over = is_finer && std::ranges::any_of(in.records.triangles, is_turned_over);
  if (!turns_over && !are_snapped && !is_affine) return referee.run_stage(scene, stage, in, conventions);
  Capture between = in;
  for (WindowTriangle<double>& t : between.records.triangles) {
    if (are_snapped) move_to_grid(t, conventions);
    if (is_finer) face_unsnapped(t);
    for (WindowVertex<double>& v : t.v) v.inv_w = is_affine ? 1 : v.inv_w;
  }
  return referee.run_stage(scene, stage, between, conventions);
}

Capture interpolate(Renderer& referee, const Scene& scene, Stage stage, const Capture& in, const C& conventions) {
  Capture out = interpolate_by(referee, scene, stage, in, conventions);
  if (stage != Stage::attributes || interpolation_of_colors(conventions) == conventions.interpolation) return out;
  C of_colors = conventions;
  of_colors.interpolation = interpolation_of_colors(conventions);
  Capture colors = interpolate_by(referee, scene, stage, in, of_colors);
  out.records.attributes = std::move(colors.records.attributes);
  for (const Varying v : kAllVaryings) {
    if (is_lit(v)) out.records.varyings[v].fragments = std::move(colors.records.varyings[v].fragments);
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

// Number of fragments drawn, winners and stencil values that differ; those of other sizes are not compared.
std::size_t apart(const Capture& a, const Capture& b) {
  const auto differing = [](const auto& mine, const auto& theirs, auto of) {
    std::size_t out = 0;
    for (std::size_t i = 0; i < mine.size() && mine.size() == theirs.size(); ++i) out += of(mine[i]) != of(theirs[i]);
    return out;
  };
  const auto plane = [&](auto of) {
    return differing((a.planes.*of).values(), (b.planes.*of).values(), [](auto v) { return v; });
  };
  return differing(a.records.drawn, b.records.drawn, [](const Drawn& d) { return d.drawn; }) + plane(&Planes::id) +
         plane(&Planes::stencil);
}

// Fragments' tests by the declared alpha test. Either: by codes or by floats, whichever fits `in` better.
Capture test_alpha(Renderer& referee, const Scene& scene, const Capture& in, C::AlphaTest declared) {
  if (declared == C::AlphaTest::in_float) return test_in_float(referee, scene, in);
  Capture by_codes = referee.run_stage(scene, Stage::visibility, in);
  const std::size_t off = declared == C::AlphaTest::either ? apart(by_codes, in) : 0;
  if (off == 0) return by_codes;
  Capture by_floats = test_in_float(referee, scene, in);
  return apart(by_floats, in) < off ? by_floats : by_codes;
}

// ---- merge

}  // namespace

Capture merge_as_declared(Renderer& referee, const Scene& scene, const Capture& in, const C& conventions) {
  const bool shows_winners = !in.planes.id.empty() && colors_replace(scene) && depths_replace(scene);
  if (in.records.drawn.empty() && !in.records.covered.empty() && !shows_winners) {
    Capture tested = in;
    tested.records.drawn = run_by_conventions(referee, scene, Stage::visibility, in, conventions).records.drawn;
    if (!tested.records.drawn.empty()) return merge_as_declared(referee, scene, tested, conventions);
  }
  Capture out = referee.run_stage(scene, Stage::merge, in);
  const Records<double>& r = in.records;
  const bool is_read_again = scene.frame.color != ColorFormat::rgba32f && !colors_replace(scene);
  if (!is_read_again || r.drawn.size() != r.covered.size() || r.shaded.size() != r.covered.size()) return out;
  const DrawIndex draws(scene);
  Plane<math::FrameColor> colors(
      scene.frame.width, scene.frame.height,
      math::FrameColor(scene.frame, conventions.blending, conventions.color_rounding, math::BlendedIn::floats));
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Covered& c = r.covered[i];
    const Draw* draw = r.drawn[i].drawn ? draws.draw(r.triangles.at(c.triangle).primitive) : nullptr;
    if (draw != nullptr) colors(c.x, c.y).write(draw->merge, math::around(r.shaded[i].color, 0));
  }
  out.legal.color_lo = out.legal.color_hi = {colors.width(), colors.height()};
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const math::ColorInterval color = colors.values()[i].written();
    out.planes.color.values()[i] = glm::vec4(math::middle(color));
    out.legal.color_lo.values()[i] = math::low(color);
    out.legal.color_hi.values()[i] = math::high(color);
  }
  return out;
}

bool has_other_volume(const Conventions& conventions) { return conventions.clip_depth != C::ClipDepth::minus_w_to_w; }

bool fogs_otherwise(const Scene& scene, const Conventions& c) {
  return (c.fog_factor != C().fog_factor || c.fog_distance != C().fog_distance) &&
         std::ranges::any_of(scene.draws, [](const Draw& draw) { return draw.fog.has_value(); });
}

bool differs_from_opengl(const Scene& scene, const Conventions& conventions, Stage stage) {
  const bool has_codes = has_codes_of_vertices(scene.frame, conventions);
  if (stage <= Stage::clip)
    return (stage == Stage::clip && has_other_volume(conventions)) || (stage >= Stage::light && has_codes);
  const bool is_offset = std::ranges::any_of(scene.draws, [](const Draw& d) { return d.polygon_offset.units != 0; });
  const auto unit = [&](const Conventions& by) {
    const bool of_floats = scene.frame.depth == DepthFormat::z32f;
    return of_floats                               ? by.float_offset_unit
           : scene.frame.depth == DepthFormat::z16 ? by.offset_unit.y
                                                   : by.offset_unit.x;
  };
  if (stage >= Stage::depth && is_offset && unit(conventions) != unit(C())) return true;
  if (stage >= Stage::shade && stage != Stage::visibility && fogs_otherwise(scene, conventions)) return true;
  const bool has_colors = stage >= Stage::attributes && (stage != Stage::visibility || tests_alpha(scene));
  if (has_colors && (has_codes || has_codes_of_fragments(scene.frame, conventions) ||
                     interpolation_of_colors(conventions) != conventions.interpolation))
    return true;
  if (stage >= Stage::merge && conventions.alpha == C::Alpha::none && !is_opaque(scene)) return true;
  return !mistaken(conventions).empty() || conventions.subpixel_bits != C().subpixel_bits ||
         conventions.edge_bits != C::kFloat || conventions.subpixel_rounding != C::Rounding::nearest ||
         conventions.depth_format != C::Depth::as_asked;
}

bool knows_ties(const Scene& scene, const Conventions& c) {
  using enum C::TieRule;
  const bool is_of_sides =
      c.tie_rule == left_bottom || c.tie_rule == left_top || c.tie_rule == right_bottom || c.tie_rule == right_top;
  return is_of_sides && settles_ties(c) && c.subpixel_bits <= 8 && c.edge_bits == C::kFloat && !scene.frame.pass.sample;
}

Capture run_by_conventions(Renderer& referee, const Scene& scene, Stage stage, const Capture& in,
                           const Conventions& conventions) {
  const Records<double>& r = in.records;
  switch (stage) {
    case Stage::window: {
      const bool is_dialects = conventions.subpixel_bits == 8 && conventions.sample == glm::dvec2(0.5) &&
                               conventions.subpixel_rounding == C::Rounding::nearest;
      if (is_dialects || r.matrices.size() != scene.draws.size()) break;
      return window_on_grid(referee, scene, in, conventions);
    }
    case Stage::coverage: {
      const Mirror by = knows_ties(scene, conventions) ? mirror_of(conventions.tie_rule) : Mirror{};
      if (!by.x && !by.y && std::ranges::none_of(r.triangles, faces_unsnapped)) break;
      return cover_by_rule(referee, scene, in, by);
    }
    case Stage::depth:
    case Stage::attributes:
    case Stage::texture: return interpolate(referee, scene, stage, in, conventions);
    case Stage::visibility: {
      const bool has_alphas = r.depth.size() == r.covered.size() && r.shaded.size() == r.covered.size();
      if (!tests_alpha(scene) || !has_alphas) break;
      return test_alpha(referee, scene, in, conventions.alpha_test);
    }
    case Stage::merge: {
      const bool is_opengls =
          conventions.color_rounding == C::Rounding::nearest && conventions.blending == C::Blending::in_float;
      if (is_opengls) break;
      return merge_as_declared(referee, scene, in, conventions);
    }
    default: break;
  }
  return referee.run_stage(scene, stage, in);
}

}  // namespace plumbline::check
