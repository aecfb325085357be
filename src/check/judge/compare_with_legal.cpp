#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "check/bounds/units.h"
#include "check/compare/compare_planes.h"
#include "check/judge/rows.h"

namespace plumbline::check {

namespace {

// Cracks and double paint: a sample on edges that triangles share is in one of them, whatever the tie rule. Where as
// many other samples differ, triangles may be missing, or drawn twice.
std::string cracks_note(const Plane<std::uint32_t>& count, const Legal& legal) {
  std::size_t cracks = 0, twice = 0, others = 0;
  if (count.size() != legal.shared.size()) return "";
  for (std::size_t i = 0; i < count.size(); ++i) {
    const std::uint32_t n = count.values()[i], low = legal.certain.values()[i], high = legal.possible.values()[i];
    if (low <= n && n <= high) continue;
    if (legal.shared.values()[i] == 0) {
      ++others;
    } else {
      ++(n < low ? cracks : twice);
    }
  }
  if (cracks + twice == 0) return "";
  if (others >= cracks + twice) {
    return fmt::format("{} samples on edges that triangles share differ, and {} others: whole triangles?",
                       cracks + twice, others);
  }
  return fmt::format(
      "on edges that triangles share {} samples are in none of them (cracks), {} in too many (painted twice)", cracks,
      twice);
}

// Whether the oracle predicts how many pixels the grid leaves open. It does so for fine grids, rounded to the nearest.
// On others, corners on the frame's sides leave pixels open that the edges' length does not count.
bool predicts_open_pixels(const Conventions& conventions) {
  const int bits = conventions.subpixel_bits;
  const bool is_fine = bits == Conventions::kFloat || bits >= Conventions().subpixel_bits;
  return is_fine && conventions.subpixel_rounding == Conventions::Rounding::nearest;
}

// Codes of another renderer's depths, as it declares them. (The rounding of ours is judged by exact, stage by stage.)
DeclaredCodes declared_codes(const SceneJudgement& c) {
  const Conventions& d = c.conventions;
  if (depth_scale(c.scene.frame.depth) == 0 || !c.foreign) return {};
  const auto is_open = [&](std::string_view name) { return leaves_open(d, name); };
  DeclaredCodes out;
  out.has_codes = !(d == undeclared()) && !is_open("depth_format");
  // The product by the largest code is rounded in float, too: by up to a code of 24 bits, 1/256 of one of 16. Depths of
  // 16 bits beside stencil values are made of codes of 24, because OpenGL has no such format; not those of a renderer
  // that has 16 bits alone.
  const FrameFormat& frame = c.scene.frame;
  const bool is_made_of_24 = frame.stencil != StencilFormat::none && d.depth_format != Conventions::Depth::z16;
  const bool is_coarse = depth_scale(frame.depth) <= 65535 && !is_made_of_24;
  const bool is_exact = d.depth_arithmetic == Conventions::DepthArithmetic::in_double && !is_open("depth_arithmetic");
  if (out.has_codes && (is_exact || is_coarse) && !is_open("depth_rounding")) out.rounding = d.depth_rounding;
  if (!is_exact) out.product_error = 2 * u * depth_scale(frame.depth);  // of the product, and of z as a float
  return out;
}

}  // namespace

void compare_with_legal(const SceneJudgement& c, const Legal& legal, Stage stage, const JudgeId& name) {
  const Planes& planes = c.candidate.planes;
  const auto add = [&](auto compare, std::optional<Stage> as = {}) {
    const Tolerance& row = tolerance(Profile::oracle, as.value_or(stage));
    c.add(name, stage, compare(row.factor), &row);
  };
  switch (stage) {
    case Stage::coverage:
      return c.add(name, stage, compare_legal_count(planes, legal), nullptr, cracks_note(planes.count, legal));
    case Stage::depth: {
      const DeclaredCodes declared = declared_codes(c);
      // A declared rounding allows half a step about the middle of the depths that it maps to the code (exact.depth).
      const Tolerance& row = tolerance(declared.rounding ? Profile::exact : Profile::oracle, stage);
      return c.add(name, stage, compare_legal_depth(c.scene, planes, legal, row.factor, declared), &row);
    }
    case Stage::attributes:
    case Stage::shade:
      return add([&](double f) { return compare_legal_shaded(c.scene, planes, legal, f, c.conventions); },
                 Stage::attributes);
    case Stage::visibility: {
      Measurement m = compare_legal_winner(planes, legal);
      // Pixels are open where the snapping bound of an edge reaches their centre; the edges' length predicts how many.
      // Budget: twice the prediction and three standard deviations.
      const double budget = 2 * legal.predicted_ambiguous;
      const double scatter = 3 * std::sqrt(budget + 1);
      std::string note = fmt::format("{} ambiguous, {:.1f} predicted", m.ambiguous, legal.predicted_ambiguous);
      if (predicts_open_pixels(c.conventions) && !(static_cast<double>(m.ambiguous) <= budget + scatter)) {
        note += ": more than twice as many";
        m.differing = std::max(m.differing, m.ambiguous);
      }
      return c.add(name, stage, std::move(m), nullptr, std::move(note));
    }
    case Stage::merge:
      return add([&](double f) { return compare_legal_merge(c.scene, planes, legal, f, c.conventions); });
    default: return;
  }
}

}  // namespace plumbline::check
