#include "capture/conventions.h"

#include <fmt/format.h>

namespace plumbline {

std::string bits_text(int bits) { return bits == Conventions::kFloat ? "float" : std::to_string(bits); }

std::string sample_text(const glm::dvec2& sample) { return fmt::format("{:.4g}, {:.4g}", sample.x, sample.y); }

std::vector<std::string> mistaken(const Conventions& conventions) {
  const Conventions expected;
  std::vector<std::string> out;
  const auto add = [&](const ConventionWords& words, std::string_view found, std::string_view of_dialect) {
    out.push_back(fmt::format("{}: {}, expected {} ({})", words.name, found, of_dialect, words.meaning));
  };
  if (conventions.sample != expected.sample)
    add(kSampleWords, sample_text(conventions.sample), sample_text(expected.sample));
  each_choice([&](const ConventionWords& words, auto member) {
    const auto found = conventions.*member;
    if (found == expected.*member || words.is_free) return;
    if (words.name == "depth_format" && name_of(found) != "z16") return;  // more than was asked for
    add(words, name_of(found), name_of(expected.*member));
  });
  using enum Conventions::TieRule;
  if (conventions.tie_rule == inclusive || conventions.tie_rule == exclusive) {
    out.push_back(fmt::format("tie_rule: {}, expected each sample on a shared edge in one triangle: it is in {}",
                              name_of(conventions.tie_rule), conventions.tie_rule == inclusive ? "both" : "none"));
  }
  return out;
}

Conventions undeclared() {
  Conventions out;
  out.alpha_test = Conventions::AlphaTest::either;
  out.level_of_detail = Conventions::LevelOfDetail::approximate;
  return out;
}

}  // namespace plumbline
