#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "check/bounds/fragment_bounds.h"
#include "check/bounds/open_pixels.h"
#include "check/bounds/units.h"
#include "check/compare/blending.h"
#include "check/compare/compare_planes.h"
#include "check/compare/same_winners.h"

namespace plumbline::check {

namespace {

Vec4<double> codes_of(const Vec4<double>& color, double scale) {
  return glm::roundEven(glm::clamp(color, 0.0, 1.0) * scale);
}

// Codes by which a reference's clear colour may be off: 1 where colour times scale in float may be the middle between
// two codes, else 0.
double cleared_codes(const FrameFormat& frame, int channel) {
  const double scale = color_scale(frame.color), code = scale * static_cast<double>(frame.clear_color[channel]);
  return std::abs(code - std::floor(code) - 0.5) <= scale * u / 2 ? 1 : 0;
}

// Values of the winner's edges or corners that another renderer may hold at the pixel.
std::vector<EdgeValue> values_beside(const Scene& scene, const Capture& candidate, std::int32_t id, int x, int y) {
  const auto triangles = triangles_of(candidate.records, id);
  std::vector<EdgeValue> out = edge_values(triangles, x, y);
  const std::vector<EdgeValue> tied = tied_corners(triangles, x, y, depth_step(scene.frame.depth, 1));
  out.insert(out.end(), tied.begin(), tied.end());
  return out;
}

// Removes all values unless the candidate's own colour is one of them, within `reach` of each channel.
void keep_beside_own(std::vector<EdgeValue>& values, const glm::vec4& own, const Vec4<double>& reach) {
  const auto is_own = [&](const EdgeValue& value) {
    bool is_near = true;
    for (int c = 0; c < 4; ++c) is_near = is_near && std::abs(value.color[c] - static_cast<double>(own[c])) <= reach[c];
    return is_near;
  };
  if (std::ranges::none_of(values, is_own)) values.clear();
}

// Unit in which colours of the frame are compared.
std::string code_unit(const FrameFormat& frame) {
  const double scale = color_scale(frame.color);
  return scale > 0 ? fmt::format("1/{:.0f}", scale) : "u";
}

}  // namespace

Measurement compare_shaded_planes(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor) {
  const Planes &a = candidate.planes, &b = reference.planes;
  const FragmentBounds bounds(scene, candidate, reference, factor);
  return where_winners_agree(a, b, &Planes::shaded, "u", [&](Meter& meter, int x, int y, std::int32_t id) {
    const Place place{x, y, id, "color", true};
    if (id == kBackground) {  // no fragment has a colour; merge judges the clear colour
      for (const Planes* side : {&a, &b}) add_finite_color(meter, Vec4<double>(side->shaded(x, y)), place);
      return;
    }
    const FragmentBound bound = bounds.of_winner(id, x, y);
    meter.suspect(bound.reason);
    std::vector<EdgeValue> edges = values_beside(scene, candidate, id, x, y);
    keep_beside_own(edges, a.shaded(x, y), bound.color + bound.apart);
    for (int c = 0; c < 4; ++c) {
      const double v = a.shaded(x, y)[c], w = b.shaded(x, y)[c];
      double diff = std::min(difference(v, w), difference(v + bound.line_shift[c], w));
      for (const EdgeValue& edge : edges) diff = std::min(diff, difference(edge.color[c], w));
      const bool is_open = !std::isfinite(bound.color[c]);
      // NaN of the reference, its 0 / 0 for a triangle without area, is no evidence about the candidate.
      if (is_open && std::isnan(w) && std::isfinite(v)) {
        meter.ambiguous();
      } else if (is_open) {
        add_open_value(meter, v, place, w);
      } else {
        meter.value(diff / u, bound.color[c] / u, place, v, w, bound.apart[c] / u);
      }
    }
  });
}

Measurement compare_codes(const Scene& scene, const Capture& candidate, const Capture& reference, double codes,
                          double factor) {
  const Planes &a = candidate.planes, &b = reference.planes;
  const double scale = color_scale(scene.frame.color);
  const FragmentBounds bounds(scene, candidate, reference, factor);
  const std::string unit = code_unit(scene.frame);
  return where_winners_agree(a, b, &Planes::color, unit, [&](Meter& meter, int x, int y, std::int32_t id) {
    const bool cleared = id == kBackground;
    const FragmentBound fragment = cleared ? FragmentBound{} : bounds.of_winner(id, x, y);
    const Vec4<double> bound = fragment.color + fragment.apart;
    meter.suspect(fragment.reason);
    std::vector<EdgeValue> edges = values_beside(scene, candidate, id, x, y);
    for (EdgeValue& edge : edges) edge.color = glm::clamp(edge.color, 0.0, 1.0);
    keep_beside_own(edges, a.color(x, y), bound + (codes + 0.5) / scale);
    for (int c = 0; c < 4; ++c) {
      const double v = std::round(scale * a.color(x, y)[c]), w = std::round(scale * b.color(x, y)[c]);
      if (!std::isfinite(bound[c])) {
        add_open_value(meter, v, {x, y, id, "color", true}, w);
        continue;
      }
      double diff = difference(v, w);
      for (const EdgeValue& edge : edges) diff = std::min(diff, difference(std::round(scale * edge.color[c]), w));
      if (fragment.line_shift[c] != 0 && a.shaded.size() == a.color.size()) {
        const double along = static_cast<double>(a.shaded(x, y)[c]) + fragment.line_shift[c];
        diff = std::min(diff, difference(std::round(scale * std::clamp(along, 0.0, 1.0)), w));
      }
      meter.value(diff, cleared ? cleared_codes(scene.frame, c) : codes, {x, y, id, "color", true}, v, w,
                  std::floor(scale * bound[c]));
    }
  });
}

namespace {

// Fragments drawn at a pixel, one over the other.
struct Layers {
  int count = 0;
  double bound = 0;                     // sum of the errors of the fragments' colours
  bool combined = false;                // by a logic op
  bool certain = true;                  // both sides have the codes that logic ops combine
  glm::bvec4 holds_clear_color{true};   // the clear colour is there still
  glm::bvec4 reads_clear_color{false};  // a logic op has combined it
};

// Lays fragment `i` over the layers. A reference's fault at it makes later values suspect.
void add_layer(const Records<double>& r, const FragmentBounds& bounds, double scale, std::size_t i, Meter& meter,
               Layers& out) {
  const FragmentBound of = bounds.of_fragment(i);
  ++out.count;
  if (!of.reason.empty()) meter.suspect(of.reason);
  const Vec4<double> sum = of.color + glm::abs(of.line_shift) + of.apart;
  out.bound += std::max({sum.r, sum.g, sum.b, sum.a});
  const Merge& merge = bounds.draw_of(r.triangles[r.covered[i].triangle].primitive).merge;
  out.combined = out.combined || (merge.logic_op && scale > 0);
  for (int c = 0; c < 4; ++c) {
    if (merge.logic_op) out.reads_clear_color[c] = out.reads_clear_color[c] || out.holds_clear_color[c];
    if (!merge.logic_op && !merge.blend && merge.color_mask[c]) out.holds_clear_color[c] = false;
  }
  out.certain = out.certain && (!merge.blend || merge.logic_op) && i < r.shaded.size() &&
                codes_of(r.shaded[i].color - sum, scale) == codes_of(r.shaded[i].color + sum, scale);
}

}  // namespace

Measurement compare_blended(const Scene& scene, const Capture& candidate, const Capture& reference, const Legal& legal,
                            double codes, double factor) {
  const Planes &a = candidate.planes, &b = reference.planes;
  const double scale = color_scale(scene.frame.color);
  const FragmentBounds bounds(scene, candidate, reference, factor);
  const FragmentsByPixel fragments = FragmentsByPixel::drawn(scene.frame, candidate.records);
  const Plane<std::uint8_t> tied = legal.empty() ? open_by_depth(scene, candidate) : Plane<std::uint8_t>();
  const OthersCover others_cover(a, b);
  const std::string unit = code_unit(scene.frame);
  const bool reads = factors_read_frame(scene);
  const Plane<double> roundings = scale > 0 ? Plane<double>() : blending_roundings(scene, candidate.records);
  return where_winners_agree(a, b, &Planes::color, unit, [&](Meter& meter, int x, int y, std::int32_t id) {
    const Place place{x, y, id, "color", true};
    const bool open = others_cover(x, y) || (!legal.color_lo.empty() && !std::isfinite(legal.color_lo(x, y).x)) ||
                      (!tied.empty() && tied(x, y) != 0);
    Layers drawn;
    fragments.each(x, y, [&](std::size_t i) { add_layer(candidate.records, bounds, scale, i, meter, drawn); });
    // A fragment's error counts as source colour, in the source's factor, and in the factor of the frame's colour,
    // which is at most `held` (codes: 1; float: the number of fragments).
    const double layers = reads ? std::exp2(drawn.count) - 1 : drawn.count,
                 held = scale > 0 ? 1 : std::max(1, drawn.count),
                 bound = drawn.bound * (2 + held) * (reads ? std::exp2(drawn.count - 1) : 1);
    for (int c = 0; c < 4; ++c) {
      const double v = a.color(x, y)[c], w = b.color(x, y)[c], clear = cleared_codes(scene.frame, c);
      const double allowed = codes * layers + clear;
      // Codes that no comparison can call wrong: of uncertain operands of a logic op, or of too many blended layers.
      const bool any_code =
          drawn.combined ? !drawn.certain || (drawn.reads_clear_color[c] && clear > 0) : scale > 0 && allowed >= scale;
      if (open || !std::isfinite(bound) || any_code || (scale == 0 && !std::isfinite(roundings(x, y)))) {
        add_open_value(meter, v, place, w);
      } else if (scale > 0) {
        const double code = std::round(scale * v), code_ref = std::round(scale * w);
        meter.value(difference(code, code_ref), drawn.combined ? 0 : allowed, place, code, code_ref,
                    drawn.combined ? 0 : std::floor(scale * bound));
      } else {
        meter.value(difference(v, w) / u, bound / u + roundings(x, y), place, v, w);
      }
    }
  });
}

Measurement compare_merge(const Scene& scene, const Planes& candidate, const Planes& exact, double factor,
                          const Legal& bounds, const Conventions& conventions, const Plane<double>& roundings) {
  const bool shows_depth = !candidate.depth.empty();
  std::string why;
  if (shows_depth &&
      !(same_size(candidate.depth, exact.depth, why) && same_size(candidate.depth, candidate.color, why)))
    return mismatch("half code", why, candidate.depth.size());
  const double scale = color_scale(scene.frame.color);
  const bool codes = scale > 0;
  const double unit = codes ? 0.5 / scale + 4 * u : u;
  const StoredColors stored{conventions, scale};
  const bool shows_winners = candidate.id.size() == candidate.color.size();
  std::optional<glm::vec4> cleared;  // colour of the first background pixel
  const auto is_cleared = [&](int x, int y) {
    if (!shows_winners || candidate.id(x, y) != kBackground) return false;
    return candidate.color(x, y) == (cleared ? *cleared : cleared.emplace(candidate.color(x, y)));
  };
  return compare_planes(candidate.color, exact.color, codes ? "half code" : "u", [&](Meter& meter, int x, int y) {
    const std::int64_t id = shows_winners ? candidate.id(x, y) : -1;
    const glm::vec4 &low = bounds.color_lo.empty() ? exact.color(x, y) : bounds.color_lo(x, y),
                    &high = bounds.color_hi.empty() ? exact.color(x, y) : bounds.color_hi(x, y);
    for (int c = 0; c < 4; ++c) {
      const double v = candidate.color(x, y)[c];
      const double least = stored.of_channel(low[c], c), most = stored.of_channel(high[c], c);
      double off = distance_outside(stored.middle(v), least, most);
      // The clear colour, one for all pixels, may be rounded, and encoded, otherwise than fragments are.
      if (is_cleared(x, y)) off = std::min(off, distance_outside(v, low[c], high[c]));
      const double tolerance = codes ? factor : roundings.empty() ? 0 : roundings(x, y);
      const Place place{x, y, id, "color", true};
      if (std::isfinite(tolerance)) {
        meter.value(off / unit, tolerance, place, v, least);
      } else {
        add_open_value(meter, v, place, least);
      }
      meter_code(meter, scale, v, {x, y, id, "no code", true});
    }
    if (!shows_depth) return;
    const double z = candidate.depth(x, y), z_ref = exact.depth(x, y);
    meter.value(difference(z, z_ref) / depth_step(scene.frame.depth, z_ref), 0, {x, y, id, "z, in steps", true}, z,
                z_ref);
  });
}

}  // namespace plumbline::check
