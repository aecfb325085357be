// Mistakes of scanline rasterizers, which step a triangle's edges from row to row and its values along each row's span.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "faults/lists.h"
#include "faults/variants.h"

namespace plumbline::faults {

namespace {

// Number of the first row, or column, whose centre is at `at` or beyond [1/256 pixel].
int first_centre(double at) { return static_cast<int>(std::ceil(at / kSubpixel)); }

// x where the edge crosses a row's centre [1/256 pixel]: `lower` and `upper` are its ends.
double x_at_row(glm::dvec2 lower, glm::dvec2 upper, int row) {
  return lower.x + (row * kSubpixel - lower.y) * (upper.x - lower.x) / (upper.y - lower.y);
}

// End of an edge at which it begins: rows are stepped upwards or downwards.
enum class From { below, above };

// The edge's x in its first row is that of the end at which it begins.
template <From from>
double x_not_advanced(glm::dvec2 lower, glm::dvec2 upper, int row) {
  const double slope = (upper.x - lower.x) / (upper.y - lower.y),
               first = from == From::below ? first_centre(lower.y) : first_centre(upper.y) - 1,
               begin = from == From::below ? lower.y : upper.y;
  return x_at_row(lower, upper, row) + (begin - first * kSubpixel) * slope;
}

// Mistake at a part of the triangle: a row beside the middle corner or a pixel of each span is left out, or the pixel
// after each span is drawn.
enum class Misdrawn { none, below_middle, above_middle, first_pixels, last_pixels, pixel_after };

bool loses_row(Misdrawn what, const std::array<double, 3>& corners_y, int row) {
  std::array<double, 3> y = corners_y;
  std::ranges::sort(y);
  const int middle = first_centre(y[1]);
  if (what == Misdrawn::below_middle) return row == middle - 1 && y[0] < y[1];
  return what == Misdrawn::above_middle && row == middle && y[1] < y[2];
}

// Triangle's pixels by spans, whose ends are x(lower, upper, row) on the edges: centres on the left end are in.
template <auto x, Misdrawn what>
PixelList by_spans(const Triangle& t, const PixelBounds& box) {
  if (t.corners != 3) return pipeline::covered_pixels(t, box);
  PixelList out;
  const auto y = [&](std::size_t i) { return static_cast<double>(t.v[i].snapped.y); };
  const PixelBounds b = pipeline::intersection(pipeline::pixel_bounds(t), box);
  for (int row = b.y0; row < b.y1; ++row) {
    std::optional<std::pair<double, double>> span;
    for (std::size_t i = 0; i < 3; ++i) {
      glm::dvec2 lower(t.v[i].snapped), upper(t.v[(i + 1) % 3].snapped);
      if (lower.y > upper.y) std::swap(lower, upper);
      if (row < first_centre(lower.y) || row >= first_centre(upper.y)) continue;
      const double at = x(lower, upper, row);
      span = span ? std::minmax({span->first, span->second, at}) : std::pair(at, at);
    }
    if (!span || loses_row(what, {y(0), y(1), y(2)}, row)) continue;
    const int first = first_centre(span->first) + (what == Misdrawn::first_pixels ? 1 : 0),
              more = int{what == Misdrawn::pixel_after} - int{what == Misdrawn::last_pixels},
              end = first_centre(span->second) + more;
    for (int column = std::max(first, box.x0); column < std::min(end, box.x1); ++column) out.emplace_back(column, row);
  }
  return out;
}

// Distance from `at` on to the next centre of a pixel, or of a row [pixels].
double ahead_of(double at) { return std::ceil(at - 0.5) + 0.5 - at; }

// Span of a pixel's row [pixels], and the edge that begins it. Edge i lies opposite corner i.
struct Span {
  std::size_t edge = 3;  // none
  double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
};
Span span_of(const Setup& s, const Pixels<float>& p) {
  const Barycentric at = pipeline::barycentric(s.planes, p);
  const double value[] = {at.l0, at.l1, at.l2},
               slope[] = {-s.planes.l1.x - s.planes.l2.x, s.planes.l1.x, s.planes.l2.x};
  Span out;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = p.x_win - value[i] / slope[i];
    if (slope[i] > 0 && x > out.begin) {
      out.edge = i;
      out.begin = x;
    } else if (slope[i] < 0) {
      out.end = std::min(out.end, x);
    }
  }
  return out;
}

// y of a corner, where the edges of the other two meet.
double y_of_corner(const Setup& s, const Pixels<float>& p, std::size_t corner) {
  const Barycentric at = pipeline::barycentric(s.planes, p);
  const auto &l1 = s.planes.l1, &l2 = s.planes.l2;
  const double w1 = (corner == 1 ? 1.0 : 0.0) - at.l1, w2 = (corner == 2 ? 1.0 : 0.0) - at.l2;
  return p.y_win + (l1.x * w2 - l2.x * w1) / (l1.x * l2.y - l2.x * l1.y);
}

Pixels<float> moved(const Pixels<float>& p, double x, double y) { return {p.x, p.y, p.x_win + x, p.y_win + y}; }

// Place whose values a pixel has if the first pixel of a span has the values of the span's left end.
Pixels<float> span_not_advanced(const Setup& s, const Pixels<float>& p) {
  const Span span = span_of(s, p);
  return span.edge < 3 ? moved(p, -ahead_of(span.begin), 0) : p;
}

// Centre of the first pixel of the span.
Pixels<float> first_of_span(const Setup& s, const Pixels<float>& p) {
  const Span span = span_of(s, p);
  return span.edge < 3 ? moved(p, span.begin + ahead_of(span.begin) - p.x_win, 0) : p;
}

// Place whose values a pixel has if the first row of an edge has the values of the edge's lower, or upper, corner.
template <From from>
Pixels<float> edge_not_advanced(const Setup& s, const Pixels<float>& p) {
  const Span span = span_of(s, p);
  if (span.edge == 3) return p;
  const auto [lower, upper] =
      std::minmax({y_of_corner(s, p, (span.edge + 1) % 3), y_of_corner(s, p, (span.edge + 2) % 3)});
  if (!std::isfinite(lower) || !std::isfinite(upper)) return p;
  return moved(p, 0, from == From::below ? -ahead_of(lower) : 1 - ahead_of(upper));
}

// Attributes with perspective at the first pixel of the span, every 16th after it, and the last; linear between.
Color<float> in_blocks_of_16(const Setup& s, const pipeline::AttributeSetup& of, const Pixels<float>& p) {
  const auto value_at = [&](double x) { return pipeline::mean<float>(of, weights_of(s, moved(p, x - p.x_win, 0))); };
  const Span span = span_of(s, p);
  const double first = span.begin + ahead_of(span.begin), last = std::floor(span.end - 0.5) + 0.5,
               begin = first + 16 * std::floor((p.x_win - first) / 16), end = std::min(begin + 16, last);
  if (!std::isfinite(begin) || !(begin < end)) return value_at(p.x_win);
  const auto t = static_cast<float>((p.x_win - begin) / (end - begin));
  const Color<float> a = value_at(begin), b = value_at(end);
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.a + t * (b.a - a.a)};
}

Pixels<float> at_left_side(const Setup&, const Pixels<float>& p) { return moved(p, -0.5, 0); }

template <auto place>
float depth_at(const Setup& s, const Pixels<float>& p) {
  return right_depth(s, place(s, p));
}
template <auto place>
Color<float> attributes_at(const Setup& s, const pipeline::AttributeSetup& of, const Pixels<float>& p) {
  return pipeline::mean<float>(of, weights_of(s, place(s, p)));
}
template <auto place>
constexpr auto kDepth = put<&Stages::depth, depth_at<place>>;
template <auto place>
constexpr auto kAttributes = put<&Stages::attributes, attributes_at<place>>;
template <auto x, Misdrawn what>
constexpr auto kCoverage = put<&Stages::coverage, by_spans<x, what>>;

constexpr std::array kScanline = {
    stage_fault("coverage.edges_not_advanced", "an edge's x in its first row is that of its lower corner",
                kCoverage<x_not_advanced<From::below>, Misdrawn::none>),
    stage_fault("coverage.edges_not_advanced_down", "an edge's x in its first row is that of its upper corner",
                kCoverage<x_not_advanced<From::above>, Misdrawn::none>),
    stage_fault("coverage.row_below_middle_lost", "the last row below a triangle's middle corner is not drawn",
                kCoverage<x_at_row, Misdrawn::below_middle>),
    stage_fault("coverage.row_above_middle_lost", "the first row above a triangle's middle corner is not drawn",
                kCoverage<x_at_row, Misdrawn::above_middle>),
    stage_fault("coverage.first_of_spans_lost", "the first pixel of a triangle's row is not drawn",
                kCoverage<x_at_row, Misdrawn::first_pixels>),
    stage_fault("coverage.last_of_spans_lost", "the last pixel of a triangle's row is not drawn",
                kCoverage<x_at_row, Misdrawn::last_pixels>),
    stage_fault("coverage.pixel_after_spans", "the pixel after a triangle's row is drawn, too",
                kCoverage<x_at_row, Misdrawn::pixel_after>),
    stage_fault("depth.edges_not_advanced", "a left edge's depth in its first row is that of its lower corner",
                kDepth<edge_not_advanced<From::below>>),
    stage_fault("depth.edges_not_advanced_down", "a left edge's depth in its first row is that of its upper corner",
                kDepth<edge_not_advanced<From::above>>),
    stage_fault("depth.spans_not_advanced", "a span's first pixel has the depth of the span's end",
                kDepth<span_not_advanced>),
    stage_fault("depth.one_per_span", "a span has the depth of its first pixel", kDepth<first_of_span>),
    stage_fault("depth.at_left_side", "depths are those of the middle of pixels' left sides", kDepth<at_left_side>),
    stage_fault("attributes.edges_not_advanced",
                "a left edge's attributes in its first row are those of its lower corner",
                kAttributes<edge_not_advanced<From::below>>),
    stage_fault("attributes.edges_not_advanced_down",
                "a left edge's attributes in its first row are those of its upper corner",
                kAttributes<edge_not_advanced<From::above>>),
    stage_fault("attributes.spans_not_advanced", "a span's first pixel has the attributes of the span's end",
                kAttributes<span_not_advanced>),
    stage_fault("attributes.one_per_span", "a span has the attributes of its first pixel", kAttributes<first_of_span>),
    stage_fault("attributes.in_blocks_of_16",
                "w divides attributes at every 16th pixel of a span; they are linear between",
                put<&Stages::attributes, in_blocks_of_16>),
    stage_fault("attributes.at_left_side", "attributes are those of the middle of pixels' left sides",
                kAttributes<at_left_side>),
};

}  // namespace

std::span<const Fault> of_scanline() { return kScanline; }

}  // namespace plumbline::faults
