#include "check/judge/rounded_colors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/by_conventions.h"
#include "check/bounds/barycentrics.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

// Range of the change that roundings make to a colour.
struct Change {
  double least = 0, most = 0;
};

// The value within [from + least, from + most] that is nearest to `to`; `from` where `to` is NaN.
double nearest(double from, double to, const Change& change) {
  return std::isnan(to) ? from : std::clamp(to, from + change.least, from + change.most);
}

class CodeRoundings {
 public:
  explicit CodeRoundings(const SceneJudgement& c)
      : c_(c),
        draws_(c.scene),
        scale_(color_scale(c.scene.frame.color)),
        middle_(middle_of(c.conventions.color_rounding)) {}

  // Of a colour, and before it of its corners (to the nearest).
  Change of_attribute(std::size_t i) const {
    const Change own = has_codes_of_fragments(c_.scene.frame, c_.conventions) ? last() : Change{};
    const double reach = of_corners(i);
    return {own.least - reach, own.most + reach};
  }

  // Roundings before the last one may reach the result with either sign.
  Change of_shaded(std::size_t i) const {
    const Draw* draw = draw_of(i);
    if (draw == nullptr) return {};
    const Records<double>& r = c_.candidate.records;
    int before = is_code(r.attributes[i].color) ? 0 : 1;
    if (draw->texture && i < r.texels.size()) before += is_code(r.texels[i].color) ? 0 : 1;
    before += draw->texture && draw->texture->environment == TextureEnvironment::blend ? 1 : 0;
    before += draw->lit && c_.scene.light_model.separate_specular ? 1 : 0;
    before += is_lit_per_fragment(*draw) ? 1 : 0;
    before += draw->fog ? 1 : 0;
    const double reach = before * one() * (0.5 + std::abs(middle_));
    return {last().least - reach, last().most + reach};
  }

 private:
  double one() const { return 1 / scale_; }
  Change last() const { return {-one() * (0.5 + middle_), one() * (0.5 - middle_)}; }
  double of_corners(std::size_t i) const {
    const Records<double>& r = c_.candidate.records;
    const Covered& at = r.covered[i];
    if (!has_codes_of_vertices(c_.scene.frame, c_.conventions) || at.triangle >= r.triangles.size()) return 0;
    const WindowTriangle<double>& t = r.triangles[at.triangle];
    if (std::ranges::all_of(t.v, [&](const WindowVertex<double>& v) { return is_code(v.color); })) return 0;
    const Vec3<double> shares = glm::abs(barycentrics(t, at.x + 0.5, at.y + 0.5).value);
    return 0.5 * one() * std::max(1.0, shares.x + shares.y + shares.z);
  }
  bool is_code(const Vec4<double>& color) const {
    constexpr double kFloat = 0x1p-16;  // of a code, in float [codes]
    const Vec4<double> codes = scale_ * color;
    return glm::all(glm::lessThanEqual(glm::abs(codes - glm::round(codes)), Vec4<double>(kFloat)));
  }
  const Draw* draw_of(std::size_t i) const {
    const Records<double>& r = c_.candidate.records;
    const std::uint32_t triangle = r.covered[i].triangle;
    return triangle < r.triangles.size() ? draws_.draw(r.triangles[triangle].primitive) : nullptr;
  }

  const SceneJudgement& c_;
  DrawIndex draws_;
  double scale_, middle_;
};

// Moves each colour of `theirs` to the nearest to that of `mine` within change_of(number of the record).
void move(auto& theirs, const auto& mine, auto color_of, auto change_of) {
  if (theirs.size() != mine.size()) return;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const Change change = change_of(i);
    for (int k = 0; k < 4; ++k) color_of(theirs[i])[k] = nearest(color_of(theirs[i])[k], color_of(mine[i])[k], change);
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
  const auto of_attribute = [&](std::size_t i) { return roundings.of_attribute(i); };
  if (stage == Stage::attributes) {
    move(made.attributes, mine.attributes, color, of_attribute);
    for (const Varying v : kAllVaryings) {
      if (is_lit(v)) move(made.varyings[v].fragments, mine.varyings[v].fragments, itself, of_attribute);
    }
  } else if (mine.attributes.size() == mine.covered.size() && mine.shaded.size() == mine.covered.size()) {
    move(made.shaded, mine.shaded, color, [&](std::size_t i) { return roundings.of_shaded(i); });
  }
  return made;
}

}  // namespace plumbline::check
