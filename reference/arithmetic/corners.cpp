// A scene's corners in double, and on the declared grid (settles_grid()).
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <vector>

#include "reference/arithmetic/bounded.h"
#include "reference/arithmetic/color_error.h"
#include "reference/arithmetic/light.h"
#include "reference/arithmetic/matrices.h"
#include "reference/arithmetic/project.h"

namespace plumbline::math {

namespace {

/// Limit below which a matrix entry becomes 0 in float (float_matrices()): an error of the whole entry, 2^24 roundings.
constexpr double kZeroEntry = 1e-12;

glm::dmat4 sizes(const glm::dmat4& m) {
  glm::dmat4 out;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      const double size = std::abs(m[column][row]);
      out[column][row] = size < kZeroEntry ? size / kFloatRounding : size;
    }
  }
  return out;
}

/// Per vertex, the index of the first vertex whose position has the same bits.
std::vector<std::uint32_t> weld(const Mesh& mesh) {
  struct Bits {
    std::uint32_t x, y, z;
    bool operator==(const Bits&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Bits& b) const {
      return (b.x * std::size_t{0x9e3779b97f4a7c15}) ^ (b.y * std::size_t{0xc2b2ae3d27d4eb4f}) ^
             (b.z * std::size_t{0x165667b19e3779f9});
    }
  };
  std::unordered_map<Bits, std::uint32_t, Hash> first;
  first.reserve(mesh.positions.size());
  std::vector<std::uint32_t> point;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    Bits bits;
    std::memcpy(&bits, &mesh.positions[i], sizeof bits);
    point.push_back(first.emplace(bits, static_cast<std::uint32_t>(i)).first->second);
  }
  return point;
}

// Exponent of a number's lowest bit that is 1; of 0: of no bit.
int lowest_bit(double number) {
  if (number == 0) return std::numeric_limits<int>::max();
  int exponent = 0;
  const double significand = std::frexp(std::abs(number), &exponent);
  constexpr int kBits = std::numeric_limits<double>::digits;
  return exponent - kBits + std::countr_zero(static_cast<std::uint64_t>(std::ldexp(significand, kBits)));
}

// Terms of a sum. Their products and partial sums, in any order, are multiples of 2^lowest of at most `size`: floats
// hold them all if that is at most 2^24 multiples.
struct Terms {
  int lowest = std::numeric_limits<int>::max();
  double size = 0;
  void add(double a, double b, double c) {
    if (a == 0 || b == 0 || c == 0) return;
    lowest = std::min(lowest, lowest_bit(a) + lowest_bit(b) + lowest_bit(c));
    size += std::abs(a * b * c);
  }
  bool are_floats() const { return size == 0 || size <= std::ldexp(1.0, std::numeric_limits<float>::digits + lowest); }
};

Terms terms_of(const Matrices<double>& m, const glm::dvec4& p, int row) {
  Terms out;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) out.add(m.projection[i][row], m.model_view[k][i], p[k]);
  }
  return out;
}

// Corner::is_exact: w is a power of 2, so that 1 / w is, too; x_win = (x / w + 1) width / 2, or the sum of these terms.
bool is_exact(const Matrices<double>& m, const glm::dvec4& p, const glm::dvec4& p_clip, glm::ivec2 frame) {
  if (!(p_clip.w > 0 && std::isfinite(p_clip.w))) return false;
  const int of_w = lowest_bit(p_clip.w);
  if (std::ldexp(1.0, of_w) != p_clip.w || !terms_of(m, p, 3).are_floats()) return false;
  for (int i = 0; i < 2; ++i) {
    const Terms clip = terms_of(m, p, i);
    const double half = 0.5 * frame[i], x = std::abs(p_clip[i] / p_clip.w);
    const int lowest = std::min(clip.size == 0 ? 0 : clip.lowest - of_w, 0);
    if (!clip.are_floats() || !Terms{lowest + lowest_bit(half), (x + 1) * half}.are_floats()) return false;
  }
  return true;
}

double steps_of(const Projected& scene) { return std::ldexp(1.0, scene.conventions.subpixel_bits); }

}  // namespace

void add_corners(const Scene& scene, const Draw& draw, Projected& out) {
  const Mesh& mesh = scene.meshes[draw.mesh];
  const Matrices<double> m = double_matrices(scene, draw);
  const glm::dmat4 clip = m.projection * m.model_view;
  if (out.perspective) out.distance_per_w = 1 / std::abs(m.projection[2][3]);
  if (out.conventions.depth_of == Conventions::DepthOf::inv_w)
    out.z_view_of_zero = z_view_of_zero(m.projection, out.conventions.clip_depth);
  const glm::dmat4 clip_size = sizes(m.projection) * sizes(m.model_view);
  const glm::dvec2 half(0.5 * scene.frame.width, 0.5 * scene.frame.height);
  const std::vector<std::uint32_t> point = weld(mesh);
  const bool two = scene.light_model.sides == LightModel::Sides::two, separate = scene.light_model.separate_specular;
  const auto first = static_cast<std::uint32_t>(out.corners.size());
  const LitDraw lit{scene, draw, out.lights};
  const bool of_floats = settles_ties_of_floats(out.conventions);
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec4 p(mesh.positions[i], 1);
    const glm::dvec3 p_eye(m.model_view * p), n_eye = normal_in_eye_space(draw.normals, m.normal, mesh.normals[i]);
    const glm::dvec4 c = clip * p, size = clip_size * glm::abs(p);
    Corner corner;
    corner.v = {c.x * half.x - out.sample.x * c.w, c.y * half.y - out.sample.y * c.w, c.w};
    corner.z = c.z;
    corner.size = {size.x * half.x, size.y * half.y, size.z, size.w};
    if (out.conventions.clip_depth == Conventions::ClipDepth::zero_to_w) {  // [0,w] is [-w,w] of 2 z - w
      corner.z = 2 * c.z - c.w;
      corner.size.z = 2 * size.z + size.w;
    }
    corner.color = vertex_color(lit, i, p_eye, n_eye);
    corner.color_error = color_error(lit, m, out.light_errors, i);
    corner.texcoord = mesh.texcoords.empty() ? glm::dvec2(0) : glm::dvec2(mesh.texcoords[i]);
    const auto lit_part = [&](LitPart part, glm::dvec4& of_part, double& error) {
      if (!two && !separate) return;
      of_part = vertex_color(lit, i, p_eye, n_eye, part);
      error = color_error(lit, m, out.light_errors, i, part);
    };
    lit_part({true, false}, corner.back_color, corner.back_color_error);
    lit_part({false, true}, corner.secondary, corner.secondary_error);
    lit_part({true, true}, corner.back_secondary, corner.back_secondary_error);
    corner.z_eye = p_eye.z;
    corner.z_eye_error = 6 * kFloatRounding * (sizes(m.model_view) * glm::abs(p)).z;  // entries, products, sums
    const BoundedVector place = eye_position(mesh, m, i), normal = eye_normal(draw, mesh, m, i);
    corner.p_eye = place.v;
    corner.p_eye_error = place.error;
    corner.n_eye = normal.v;
    corner.n_eye_error = normal.error;
    corner.point = first + point[i];
    corner.is_exact = of_floats && is_exact(m, p, c, {scene.frame.width, scene.frame.height});
    out.corners.push_back(corner);
  }
}

GridPoints grid_points(const Projected& scene, const Corner& corner) {
  const Conventions::Rounding of_x = subpixel_rounding(scene.conventions, 0),
                              of_y = subpixel_rounding(scene.conventions, 1);
  const double steps = steps_of(scene), before = of_x == Conventions::Rounding::nearest ? 0 : kOfFixedPoint;
  const glm::dvec2 off = steps * (corner_displacement(scene, corner) + before);
  const glm::dvec2 at = steps * scene.place(corner);
  GridPoints out;
  if (!(off.x < 0.5 && off.y < 0.5)) return out;
  const auto snapped = [&](glm::dvec2 p) { return glm::dvec2(rounded(of_x, p.x), rounded(of_y, p.y)); };
  const glm::dvec2 low = snapped(at - off), high = snapped(at + off);
  for (double y = low.y; y <= high.y; ++y) {
    for (double x = low.x; x <= high.x; ++x) out.at[out.count++] = {x, y};
  }
  return out;
}

double snapping_step(const Conventions& c) {
  if (c.subpixel_bits == Conventions::kFloat) return 0;
  const double step = std::ldexp(1.0, -c.subpixel_bits);
  return c.subpixel_rounding == Conventions::Rounding::nearest ? step / 2 : step;
}

std::optional<Corner> on_grid(const Projected& scene, const Corner& corner) {
  const GridPoints points = grid_points(scene, corner);
  if (points.count != 1) return std::nullopt;
  const glm::dvec2 at = points.at[0] / steps_of(scene) - scene.middle();
  Corner out = corner;
  out.v = {at * corner.v.z, corner.v.z};
  return out;
}

}  // namespace plumbline::math
