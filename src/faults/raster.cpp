#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "faults/lists.h"
#include "faults/pixel_barycentrics.h"
#include "faults/pixels_in_order.h"
#include "faults/variants.h"

namespace plumbline::faults {

namespace {

// 5. Coverage.

bool top_edges_for_bottom(std::int64_t step_x, std::int64_t step_y) {
  return step_x > 0 || (step_x == 0 && step_y < 0);
}

// Coverage of triangles by pixels(); lines and points stay right.
template <auto pixels>
PixelList triangles_by(const Triangle& t, const PixelBounds& box) {
  return t.corners == 3 ? pixels(t, box) : pipeline::covered_pixels(t, box);
}

// Edge functions in 32 bits [(1/256 pixel)^2], which overflow from triangles of 180 x 180 pixels on.
PixelList in_32_bits(const Triangle& t, const PixelBounds& box) {
  const pipeline::Edges edges = pipeline::edges_of(t);
  PixelList out;
  for (const glm::ivec2 p : pipeline::covered_pixels({}, pipeline::pixel_bounds(t), box)) {
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t e = edges.at_origin[i] + edges.step_x[i] * p.x + edges.step_y[i] * p.y;
      inside = inside && static_cast<std::int32_t>(static_cast<std::uint32_t>(e)) >= 0;
    }
    if (inside) out.push_back(p);
  }
  return out;
}

PixelList at_corner(const Triangle& t, const PixelBounds& box) {
  return pipeline::covered_pixels(pipeline::as_seen_from(t, glm::ivec2(-kSubpixel / 2)), box);
}

template <int columns, int rows>
PixelList box_short_by(const Triangle& t, const PixelBounds& box) {
  const PixelBounds b = pipeline::pixel_bounds(t);
  return pipeline::covered_pixels(pipeline::edges_of(t), {b.x0, b.y0, b.x1 - columns, b.y1 - rows}, box);
}

template <int columns, int rows>
PixelList box_begun_late_by(const Triangle& t, const PixelBounds& box) {
  const PixelBounds b = pipeline::pixel_bounds(t);
  return pipeline::covered_pixels(pipeline::edges_of(t), {b.x0 + columns, b.y0 + rows, b.x1, b.y1}, box);
}

PixelList box_filled(const Triangle& t, const PixelBounds& box) {
  return pipeline::covered_pixels({}, pipeline::pixel_bounds(t), box);
}

// Coverage by the edges but the one of that number, from corner to corner in the order given. A window triangle begins
// with the second corner (stages.h, 4); edges_of() goes round back faces the other way.
template <int number>
PixelList edge_missing(const Triangle& t, const PixelBounds& box) {
  constexpr int kOfFront = (number + 2) % 3;
  const int left_out = t.front ? kOfFront : 2 - kOfFront;
  pipeline::Edges edges = pipeline::edges_of(t);
  edges.at_origin[left_out] = edges.step_x[left_out] = edges.step_y[left_out] = 0;
  return pipeline::covered_pixels(edges, pipeline::pixel_bounds(t), box);
}

// Coverage without triangles of det < 1, twice the area in pixels (ssloy/tinyrenderer, 87bc715, our_gl.cpp).
PixelList small_dropped(const Triangle& t, const PixelBounds& box) {
  const bool is_small = std::abs(snapped_area(t)) < std::int64_t{kSubpixel} * kSubpixel;
  return is_small ? PixelList{} : pipeline::covered_pixels(t, box);
}

PixelBounds scissor_with_its_far_sides(const Scissor& box, const PixelBounds& frame) {
  return pipeline::scissored({box.x, box.y, box.width + 1, box.height + 1}, frame);
}

// Coverage of lines and points by pixels(); triangles stay right.
template <auto pixels>
PixelList lines_by(const Triangle& t, const PixelBounds& box) {
  return t.corners == 3 ? pipeline::covered_pixels(t, box) : pixels(t, box);
}
bool contains(const PixelList& pixels, glm::ivec2 p) {
  return std::find(pixels.begin(), pixels.end(), p) != pixels.end();
}
bool inside(const PixelBounds& box, glm::ivec2 p) {
  return p.x >= box.x0 && p.y >= box.y0 && p.x < box.x1 && p.y < box.y1;
}

PixelList line_end_drawn(const Triangle& t, const PixelBounds& box) {
  PixelList pixels = pipeline::covered_pixels(t, box);
  const Triangle end{{t.v[1], t.v[1], t.v[1]}, t.primitive, true, 1};
  for (const glm::ivec2 last : pipeline::covered_pixels(end, box)) {
    if (!contains(pixels, last)) pixels.push_back(last);
  }
  return pixels;
}

// The first pixel in each column, in the order in which the line is drawn.
PixelList steep_lines_torn(const Triangle& t, const PixelBounds& box) {
  PixelList one_per_column;
  for (const glm::ivec2 p : pixels_in_order(t, box)) {
    if (one_per_column.empty() || one_per_column.back().x != p.x) one_per_column.push_back(p);
  }
  return one_per_column;
}

// Each pixel of the line of width 1 becomes a run of `width` pixels along the major axis.
PixelList lines_widened_along(const Triangle& t, const PixelBounds& box) {
  if (t.corners != 2 || t.width == 1) return pipeline::covered_pixels(t, box);
  Triangle of_width_1 = t;
  of_width_1.width = 1;
  const auto width = static_cast<int>(t.width);
  const glm::ivec2 d = glm::abs(t.v[1].snapped - t.v[0].snapped),
                   along = d.x >= d.y ? glm::ivec2(1, 0) : glm::ivec2(0, 1);
  PixelList pixels;
  for (const glm::ivec2 p :
       pipeline::covered_pixels(of_width_1, {box.x0 - width, box.y0 - width, box.x1 + width, box.y1 + width})) {
    for (int k = 0; k < width; ++k) {
      const glm::ivec2 q = p + along * (k - width / 2);
      if (inside(box, q) && !contains(pixels, q)) pixels.push_back(q);
    }
  }
  return pixels;
}

PixelList points_off_by_half(const Triangle& t, const PixelBounds& box) {
  Triangle moved = t;
  if (t.corners == 1) moved.v[0].snapped += kSubpixel / 2;
  return pipeline::covered_pixels(moved, box);
}

// Coverage at samples mirrored in the pixel's middle row; depth at the right ones.
pipeline::SampleOffsets mirrored_samples(glm::ivec2 sample) { return {{sample.x, -sample.y}, sample, {0, 0}}; }

// 6. Depth.

pipeline::SampleOffsets depth_of_centre(glm::ivec2 sample) { return {sample, {0, 0}, {0, 0}}; }

// The triangle's plane, of the state that `change` altered.
template <auto change>
pipeline::DepthSetup depth_under(const Triangle& triangle, const pipeline::DepthState& state) {
  pipeline::DepthState wrong = state;
  change(wrong);
  return pipeline::depth_setup(triangle, wrong);
}

constexpr auto kNoSlope = [](pipeline::DepthState& s) { s.offset.factor = 0; };
constexpr auto kSlopeOfOne = [](pipeline::DepthState& s) { s.offset = {0, s.offset.factor + s.offset.units}; };
constexpr auto kTowardsTheEye = [](pipeline::DepthState& s) { s.offset = {-s.offset.factor, -s.offset.units}; };
constexpr auto kClampedToFormat = [](pipeline::DepthState& s) {
  s.low = 0;
  s.high = 1;
};

constexpr auto kNotClamped = [](pipeline::DepthState& s) {
  s.low = -256;
  s.high = 256;
};

// The mean of the corners' depths, by which a painter's algorithm sorts.
pipeline::DepthSetup one_depth(const Triangle& triangle, const pipeline::DepthState& state) {
  pipeline::DepthSetup s = pipeline::depth_setup(triangle, state);
  s.z0 += (s.dz1 + s.dz2) / 3;
  s.dz1 = s.dz2 = 0;
  return s;
}

// The first corner's depth, all over the triangle.
pipeline::DepthSetup depth_of_first(const Triangle& triangle, const pipeline::DepthState& state) {
  pipeline::DepthSetup s = pipeline::depth_setup(triangle, state);
  s.z0 += s.dz2;
  s.dz1 = s.dz2 = 0;
  return s;
}

float truncated_depth(const Setup& setup, const Pixels<float>& p) {
  const double z = window_z(setup, p), scale = setup.depth.scale;
  return scale == 0.0 ? static_cast<float>(z) : static_cast<float>(static_cast<std::int64_t>(z * scale));
}

// Scale 2^n for 2^n - 1; larger codes become the last.
float scaled_by_power_of_two(const Setup& setup, const Pixels<float>& p) {
  const double scale = setup.depth.scale;
  if (scale == 0.0) return right_depth(setup, p);
  return static_cast<float>(std::min(pipeline::round_even(window_z(setup, p) * (scale + 1)), scale));
}

float depth_at_corner(const Setup& s, const Pixels<float>& p) {
  return right_depth(s, Pixels<float>{p.x, p.y, p.x_win - 0.5, p.y_win - 0.5});
}

// Window z by the perspective-correct weights of attributes.
float depth_in_perspective(const Setup& s, const Pixels<float>& p) {
  const pipeline::Weights<float> w = weights_of(s, p);
  const double z = s.depth.z0 + static_cast<double>(w.k1) * s.depth.dz1 + static_cast<double>(w.k2) * s.depth.dz2;
  return stored_depth(s.depth, pipeline::clamp01(z));
}

// 7. Attributes.

using TriangleAttributes = pipeline::AttributeSetup;

pipeline::SampleOffsets color_of_sample(glm::ivec2 sample) { return {sample, sample, sample}; }

// Corners a and b have each other's weights. An uncut triangle has its second corner first, its first last.
template <std::size_t a, std::size_t b>
Color<float> corners_swapped(const Setup& s, const TriangleAttributes& of, const Pixels<float>& p) {
  const Barycentric at = pipeline::barycentric(s.planes, p);
  std::array<double, 3> l = {at.l0, at.l1, at.l2};
  std::swap(l[a], l[b]);
  std::array<float, 3> q;
  for (std::size_t i = 0; i < 3; ++i) q[i] = pipeline::to_float(l[i]) * s.perspective.inv_w[i];
  return pipeline::mean<float>(of, pipeline::weights<float>(q[1], q[2], q[0] + q[1] + q[2]));
}

// Corner i has corner i + turn's weight.
template <std::size_t turn>
Color<float> corners_turned(const Setup& s, const TriangleAttributes& of, const Pixels<float>& p) {
  const Barycentric b = pipeline::barycentric(s.planes, p);
  const std::array<double, 3> l = {b.l0, b.l1, b.l2};
  std::array<float, 3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t from = (i + turn) % 3;
    q[i] = pipeline::to_float(l[from]) * s.perspective.inv_w[from];
  }
  return pipeline::mean<float>(of, pipeline::weights<float>(q[1], q[2], q[0] + q[1] + q[2]));
}

// Weights by w instead of 1/w.
Color<float> nearness_reversed(const Setup& s, const TriangleAttributes& of, const Pixels<float>& p) {
  std::array<float, 3> w = s.perspective.inv_w;
  for (float& inv_w : w) inv_w = 1 / inv_w;
  const pipeline::PerspectiveSetup wrong = pipeline::perspective_setup(w, s.planes, s.perspective.in_blocks);
  return pipeline::mean<float>(of, pipeline::weights<float>(wrong, pipeline::from_anchor<float>(s.planes, p)));
}

// Attributes, each channel of them changed.
template <auto change>
Color<float> each_channel(const Setup& s, const TriangleAttributes& of, const Pixels<float>& p) {
  const Color<float> c = pipeline::mean<float>(of, weights_of(s, p));
  return {change(c.r), change(c.g), change(c.b), change(c.a)};
}

constexpr auto kClamped = [](float v) { return pipeline::clamp01(v); };
constexpr auto kOf8Bits = [](float v) { return pipeline::round_even(v * 255) / 255; };

Color<float> mean_of_corners(const Setup&, const TriangleAttributes& of, const Pixels<float>&) {
  return pipeline::mean<float>(of, pipeline::weights<float>(1, 1, 3));
}

// The interpolated a / w, not divided by the interpolated 1/w.
Color<float> not_divided(const Setup& s, const TriangleAttributes& of, const Pixels<float>& p) {
  const double inv_w = pipeline::value_at<float>(s.perspective.sum, pipeline::from_anchor<float>(s.planes, p));
  const Color<float> c = pipeline::mean<float>(of, weights_of(s, p));
  const auto over_w = [&](float v) { return static_cast<float>(static_cast<double>(v) * inv_w); };
  return {over_w(c.r), over_w(c.g), over_w(c.b), over_w(c.a)};
}

constexpr std::array kRaster = {
    stage_fault("coverage.inclusive_edges", "pixels on any edge are covered: shared edges are painted twice",
                put<&Stages::coverage, tied<all_edges_in>>),
    stage_fault("coverage.top_for_bottom", "of horizontal edges, the one above has its pixels: the rule of y downwards",
                put<&Stages::coverage, tied<top_edges_for_bottom>>, "nesbox/TIC-80#1644"),
    stage_fault("coverage.in_32_bits", "edge functions overflow 32 bits: large triangles have holes",
                put<&Stages::coverage, triangles_by<in_32_bits>>, "vindar/tgx#31"),
    stage_fault("coverage.at_corner", "pixels are covered where their lower left corners are",
                put<&Stages::coverage, triangles_by<at_corner>>, "hrydgard/ppsspp#9681"),
    stage_fault("coverage.box_one_short", "the bounding box lacks its last column and row",
                put<&Stages::coverage, triangles_by<box_short_by<1, 1>>>),
    stage_fault("coverage.box_filled", "the whole bounding box of a triangle is covered",
                put<&Stages::coverage, triangles_by<box_filled>>),
    stage_fault("coverage.first_edge_missing", "the edge from the first corner to the second is not tested",
                put<&Stages::coverage, triangles_by<edge_missing<0>>>),
    stage_fault("coverage.second_edge_missing", "the edge from the second corner to the third is not tested",
                put<&Stages::coverage, triangles_by<edge_missing<1>>>),
    stage_fault("coverage.third_edge_missing", "the edge from the third corner to the first is not tested",
                put<&Stages::coverage, triangles_by<edge_missing<2>>>),
    stage_fault("coverage.last_column_lost", "the bounding box lacks its last column",
                put<&Stages::coverage, triangles_by<box_short_by<1, 0>>>),
    stage_fault("coverage.last_row_lost", "the bounding box lacks its last row",
                put<&Stages::coverage, triangles_by<box_short_by<0, 1>>>),
    stage_fault("coverage.first_column_lost", "the bounding box lacks its first column",
                put<&Stages::coverage, triangles_by<box_begun_late_by<1, 0>>>),
    stage_fault("coverage.first_row_lost", "the bounding box lacks its first row",
                put<&Stages::coverage, triangles_by<box_begun_late_by<0, 1>>>),
    stage_fault("coverage.small_dropped", "triangles of less than half a pixel's area are dropped: det < 1",
                put<&Stages::coverage, triangles_by<small_dropped>>),
    stage_fault("coverage.scissor_inclusive", "the scissor box has one column and one row too many",
                put<&Stages::scissor, scissor_with_its_far_sides>),
    stage_fault("coverage.line_end_drawn", "a line's last pixel is drawn too: lines that meet paint it twice",
                put<&Stages::coverage, lines_by<line_end_drawn>>),
    stage_fault("coverage.steep_lines_torn", "lines are stepped along x in every octant: steep ones have gaps",
                put<&Stages::coverage, lines_by<steep_lines_torn>>),
    stage_fault("coverage.lines_widened_along", "wide lines are widened along their major axis, not across it",
                put<&Stages::coverage, lines_by<lines_widened_along>>),
    stage_fault("coverage.points_off_by_half", "points' squares lie half a pixel too far right and up",
                put<&Stages::coverage, lines_by<points_off_by_half>>),
    stage_fault("coverage.samples_mirrored", "the samples' y is counted downwards in the pixel",
                put<&Stages::sample_offsets, mirrored_samples>),
    stage_fault("depth.truncated", "depth codes are truncated, not rounded", put<&Stages::depth, truncated_depth>),
    stage_fault("depth.scaled_by_power_of_two", "depth codes are of z times 2^n, not 2^n - 1",
                put<&Stages::depth, scaled_by_power_of_two>),
    stage_fault("depth.at_corner", "depths are those of the pixels' lower left corners",
                put<&Stages::depth, depth_at_corner>),
    stage_fault("depth.in_perspective", "window z is interpolated with perspective, by 1/w once more",
                put<&Stages::depth, depth_in_perspective>),
    stage_fault("depth.one_per_triangle", "a triangle has one depth, the mean of its corners'",
                put<&Stages::depth_setup, one_depth>),
    stage_fault("depth.of_first_corner", "a triangle has one depth, its first corner's",
                put<&Stages::depth_setup, depth_of_first>),
    stage_fault("depth.of_centre", "all samples of a pixel have the depth at its centre",
                put<&Stages::sample_offsets, depth_of_centre>),
    stage_fault("depth.clamped_to_format", "depths beyond the draw's range are clamped to [0,1]",
                put<&Stages::depth_setup, depth_under<kClampedToFormat>>),
    stage_fault("depth.not_clamped", "depths beyond the draw's range are left as they are",
                put<&Stages::depth_setup, depth_under<kNotClamped>>),
    stage_fault("depth.offset_without_slope", "a polygon offset is of its units alone",
                put<&Stages::depth_setup, depth_under<kNoSlope>>),
    stage_fault("depth.offset_slope_of_one", "a polygon offset takes its factor for units",
                put<&Stages::depth_setup, depth_under<kSlopeOfOne>>, "Kazade/GLdc#32"),
    stage_fault("depth.offset_sign", "a polygon offset moves the other way: that of a reversed depth buffer",
                put<&Stages::depth_setup, depth_under<kTowardsTheEye>>, "mrdoob/three.js#34606"),
    stage_fault("attributes.affine", "attributes are interpolated without perspective",
                put<&Stages::attributes, affine_attributes>),
    stage_fault("attributes.mean_of_corners", "a triangle has the mean of its corners' attributes everywhere",
                put<&Stages::attributes, mean_of_corners>),
    stage_fault("attributes.not_divided", "attributes over w are not divided by the interpolated 1/w",
                put<&Stages::attributes, not_divided>),
    stage_fault("attributes.nearness_reversed", "corners count by w, not by 1/w",
                put<&Stages::attributes, nearness_reversed>),
    stage_fault("attributes.wrong_corners", "two corners have each other's barycentric coordinates",
                put<&Stages::attributes, corners_swapped<1, 2>>, "ssloy/tinyrenderer#40"),
    stage_fault("attributes.first_corners_swapped", "the first two corners have each other's barycentric coordinates",
                put<&Stages::attributes, corners_swapped<0, 2>>),
    stage_fault("attributes.last_corners_swapped", "the last two corners have each other's barycentric coordinates",
                put<&Stages::attributes, corners_swapped<0, 1>>),
    stage_fault("attributes.next_corner", "each corner has the attributes of the next",
                put<&Stages::attributes, corners_turned<2>>),
    stage_fault("attributes.corner_before", "each corner has the attributes of the one before it",
                put<&Stages::attributes, corners_turned<1>>),
    stage_fault("attributes.clamped", "all that is interpolated is clamped to [0,1]",
                put<&Stages::attributes, each_channel<kClamped>>),
    stage_fault("attributes.of_8_bits", "all that is interpolated is rounded to 1/255",
                put<&Stages::attributes, each_channel<kOf8Bits>>),
    stage_fault("attributes.of_sample", "a sample's colour is that at its own place, not at the pixel's centre",
                put<&Stages::sample_offsets, color_of_sample>),
};

}  // namespace

std::span<const Fault> of_raster() { return kRaster; }

}  // namespace plumbline::faults
