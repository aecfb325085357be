#include "check/judge/rounded_colors.h"

#include <algorithm>
#include <cmath>

#include "capture/by_conventions.h"
#include "check/bounds/bounds.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

// The value within `change` of `from`, or of `from` clamped to [0,1] as codes are, that is nearest to `to`.
double nearest(double from, double to, const RoundingRange& change) {
  if (std::isnan(from) || std::isnan(to)) return from;
  const double as_is = std::clamp(to, from + change.least, from + change.most), whole = std::clamp(from, 0.0, 1.0),
               clamped = std::clamp(std::clamp(to, whole + change.least, whole + change.most), 0.0, 1.0);
  return std::abs(clamped - to) < std::abs(as_is - to) ? clamped : as_is;
}

class CodeRoundings {
 public:
  explicit CodeRoundings(const SceneJudgement& c)
      : c_(c),
        draws_(c.scene),
        scale_(color_scale(c.scene.frame.color)),
        last_(range_of(c.conventions.color_rounding)) {}

  // Change of a fragment's interpolated colour, and before it of its corners.
  RoundingRange of_attribute(std::size_t i, int) const {
    const bool rounds = has_codes_of_fragments(c_.scene.frame, c_.conventions);
    const double reach = of_corners(i);
    return in_colors({(rounds ? last_.least : 0) - reach, (rounds ? last_.most : 0) + reach});
  }

  // Change of a channel of a shaded colour. Roundings before the last one may reach the result with either sign.
  RoundingRange of_shaded(std::size_t i, int channel) const {
    const Draw* draw = draw_of(i);
    if (draw == nullptr) return {};
    const Records<double>& r = c_.candidate.records;
    const bool is_color_code = is_code(scale_ * r.attributes[i].color[channel]);
    if (is_plain(c_.scene, *draw) && is_color_code) return in_colors({-kFloatOfCode, kFloatOfCode});
    int before = is_color_code ? 0 : 1;
    if (draw->texture && i < r.texels.size()) before += is_code(scale_ * r.texels[i].color[channel]) ? 0 : 1;
    if (channel < 3) {  // steps that leave alpha as it is
      before += draw->texture && draw->texture->environment == TextureEnvironment::blend ? 1 : 0;
      before += draw->lit && c_.scene.light_model.separate_specular ? 1 : 0;
      before += is_lit_per_fragment(*draw) ? 1 : 0;
      before += draw->fog ? 1 : 0;
    }
    const double reach = before * std::max(-last_.least, last_.most);
    return in_colors({last_.least - reach, last_.most + reach});
  }

 private:
  RoundingRange in_colors(const RoundingRange& codes) const { return {codes.least / scale_, codes.most / scale_}; }
  // Change of an interpolated colour by its corners' rounding to the nearest codes, if these are not recorded [codes].
  double of_corners(std::size_t i) const {
    const Records<double>& r = c_.candidate.records;
    const Covered& at = r.covered[i];
    if (!has_codes_of_vertices(c_.scene.frame, c_.conventions) || at.triangle >= r.triangles.size()) return 0;
    const WindowTriangle<double>& t = r.triangles[at.triangle];
    double most = 0;
    for (const WindowVertex<double>& v : t.v) {
      const Vec4<double> codes = scale_ * v.color, off = glm::abs(codes - glm::round(codes));
      most = std::max({most, off.r, off.g, off.b, off.a});
    }
    if (most == 0) return 0;
    const Vec3<double> shares = glm::abs(barycentrics(t, at.x + 0.5, at.y + 0.5).value);
    return std::max(most, kFloatOfCode) * std::max(1.0, shares.x + shares.y + shares.z);
  }
  const Draw* draw_of(std::size_t i) const {
    const Records<double>& r = c_.candidate.records;
    const std::uint32_t triangle = r.covered[i].triangle;
    return triangle < r.triangles.size() ? draws_.draw(r.triangles[triangle].primitive) : nullptr;
  }

  const SceneJudgement& c_;
  DrawIndex draws_;
  double scale_;
  RoundingRange last_;  // of the last rounding [codes]
};

// Moves each colour of `theirs` to the nearest to that of `mine` within change_of(number of the record, channel).
void move(auto& theirs, const auto& mine, auto color_of, auto change_of) {
  if (theirs.size() != mine.size()) return;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    for (int k = 0; k < 4; ++k)
      color_of(theirs[i])[k] = nearest(color_of(theirs[i])[k], color_of(mine[i])[k], change_of(i, k));
  }
}

}  // namespace

const Records<double>& with_rounded_colors(const SceneJudgement& c, Stage stage, const Records<double>& theirs,
                                           Records<double>& made) {
  const Records<double>& mine = c.candidate.records;
  const bool of_fragments = has_codes_of_fragments(c.scene.frame, c.conventions),
             of_vertices = has_codes_of_vertices(c.scene.frame, c.conventions) && stage == Stage::attributes;
  if (!c.foreign || !(of_fragments || of_vertices) || (stage != Stage::attributes && stage != Stage::shade))
    return theirs;
  made = theirs;
  const CodeRoundings roundings(c);
  const auto color = [](auto& record) -> auto& { return record.color; };
  const auto itself = [](auto& record) -> auto& { return record; };
  const auto of_attribute = [&](std::size_t i, int k) { return roundings.of_attribute(i, k); };
  if (stage == Stage::attributes) {
    move(made.attributes, mine.attributes, color, of_attribute);
    for (const Varying v : kAllVaryings) {
      if (is_lit(v)) move(made.varyings[v].fragments, mine.varyings[v].fragments, itself, of_attribute);
    }
  } else if (mine.attributes.size() == mine.covered.size() && mine.shaded.size() == mine.covered.size()) {
    move(made.shaded, mine.shaded, color, [&](std::size_t i, int k) { return roundings.of_shaded(i, k); });
  }
  return made;
}

}  // namespace plumbline::check
