#include "report/text/diagnosis_text.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "check/verdict/verdict.h"

namespace plumbline::report {

using check::Comparison;
using check::Outcome;

namespace {

std::string cell_of(const Comparison& c) {
  switch (c.outcome) {
    case Outcome::different: return fmt::format("DIFFERENT {}", c.measurement.differing);
    case Outcome::dispute: return fmt::format("dispute {}", c.measurement.disputed);
    case Outcome::ambiguous_only: return fmt::format("ambiguous {}", c.measurement.ambiguous);
    case Outcome::unsupported: return "-";
    case Outcome::failed: return "FAILED";
    default: return std::string(name_of(c.outcome));
  }
}

std::string stage_names(const std::vector<Stage>& stages) {
  std::vector<std::string_view> names;
  for (const Stage stage : stages) names.push_back(name_of(stage));
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

// Remark on a first different stage that may be right: its difference is legal, or the frame alone was judged.
std::string_view remark_on(const check::Diagnosis& diagnosis) {
  const Stage stage = *diagnosis.first;
  const bool is_frame_illegal = std::ranges::any_of(diagnosis.verdict.comparisons, [](const Comparison& c) {
    return check::judges_legality(c.judge, c.stage) && c.outcome == Outcome::different;
  });
  const bool is_legal = !is_frame_illegal && check::is_legal(diagnosis.verdict, stage);
  const bool follows_from_order = stage == Stage::visibility || stage == Stage::merge;
  if (is_legal && check::differs_by_steps(diagnosis.verdict, stage))
    return "; within the error of stepping in float, and the frame is legal";
  if (is_legal && follows_from_order) return "; the frame is legal: ties, or fragments drawn in another order, do this";
  if (check::is_by_frame_alone(diagnosis.verdict)) return ", or an earlier one: the frame alone was judged";
  return "";
}

std::string first_line(const check::Diagnosis& diagnosis) {
  if (!diagnosis.first && !diagnosis.wrong.empty()) {
    return fmt::format("none; legal, but not by the tie rule that is judged by: {}", stage_names(diagnosis.wrong));
  }
  if (!diagnosis.first) {
    std::vector<Stage> failed;
    for (const Comparison& c : diagnosis.verdict.comparisons) {
      if (c.outcome == Outcome::failed && std::ranges::count(failed, c.stage) == 0) failed.push_back(c.stage);
    }
    return failed.empty() ? "none" : fmt::format("none; failed: {}", stage_names(failed));
  }
  std::vector<std::string> by;
  for (const Comparison& c : diagnosis.verdict.comparisons) {
    if (c.stage == *diagnosis.first && c.outcome == Outcome::different) by.push_back(title_of(c.judge));
  }
  if (by.empty()) return fmt::format("{} (failed)", name_of(*diagnosis.first));
  return fmt::format("{} (against {}){}", name_of(*diagnosis.first), fmt::join(by, "; "), remark_on(diagnosis));
}

std::string finding_text(const check::Finding& f) {
  const check::Measurement& m = f.measurement;
  std::string out = m.items == 0 ? fmt::format("\n{}, of {}: failed\n", name_of(f.stage), title_of(f.judge))
                                 : fmt::format("\n{}, against {}: {} of {} beyond tolerance\n", name_of(f.stage),
                                               title_of(f.judge), m.differing, m.items);
  if (f.explains > 0) out += fmt::format("  explains {} pixels of the picture\n", f.explains);
  for (const std::string& line : f.numbers) out += fmt::format("  {}\n", line);
  for (const std::string& cause : f.causes) out += fmt::format("  likely cause: {}\n", cause);
  return out + f.picture;
}

}  // namespace

std::string stage_table(const check::SceneVerdict& verdict, std::optional<Stage> first) {
  std::vector<std::string> columns;  // in the order in which they were asked
  std::map<std::pair<std::size_t, std::string>, std::string> cells;
  for (const Comparison& c : verdict.comparisons) {
    const std::string column = title_of(c.judge);
    if (std::ranges::count(columns, column) == 0) columns.push_back(column);
    cells[{static_cast<std::size_t>(c.stage), column}] = cell_of(c);
  }
  const auto of = [&](std::size_t stage, const std::string& column) {
    const auto found = cells.find({stage, column});
    return found == cells.end() ? std::string() : found->second;
  };
  std::vector<std::size_t> widths;
  for (const std::string& column : columns) {
    std::size_t width = column.size();
    for (std::size_t i = 0; i < kStageNames.size(); ++i) width = std::max(width, of(i, column).size());
    widths.push_back(width);
  }
  std::string out = fmt::format("   {:<10}", "stage");
  const auto end_line = [&] { out.erase(out.find_last_not_of(' ') + 1), out += '\n'; };
  for (std::size_t k = 0; k < columns.size(); ++k) out += fmt::format("  {:<{}}", columns[k], widths[k]);
  end_line();
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    if (std::ranges::none_of(verdict.comparisons, [&](const Comparison& c) { return c.stage == Stage(i); })) continue;
    out += fmt::format("{} {:<10}", first == Stage(i) ? "->" : "  ", kStageNames[i]);
    for (std::size_t k = 0; k < columns.size(); ++k) out += fmt::format("  {:<{}}", of(i, columns[k]), widths[k]);
    end_line();
  }
  return out;
}

std::string diagnosis_text(const check::Diagnosis& diagnosis) {
  std::string out = stage_table(diagnosis.verdict, diagnosis.first);
  const bool none_alone = std::ranges::none_of(diagnosis.verdict.comparisons, [](const Comparison& c) {
    return check::judges_alone(c) && check::was_compared(c);
  });
  out += fmt::format("\nfirst different stage: {}\nwrong by itself: {}\n", first_line(diagnosis),
                     none_alone ? "not judged" : stage_names(diagnosis.wrong));
  out += check::judged_text(diagnosis.verdict);
  if (std::ranges::any_of(diagnosis.verdict.comparisons,
                          [](const Comparison& c) { return c.note == check::kOverBudget; }))
    out += fmt::format("{}: those about the worst pixels alone were (--fragments)\n", check::kOverBudget);
  for (const check::Finding& f : diagnosis.findings) out += finding_text(f);
  for (const Comparison& c : diagnosis.verdict.comparisons) {
    if (c.outcome == Outcome::failed || c.outcome == Outcome::missing || c.outcome == Outcome::dispute)
      out += fmt::format("{}: {}, {}: {}\n", name_of(c.outcome), title_of(c.judge), name_of(c.stage), check::remark(c));
  }
  return out;
}

}  // namespace plumbline::report
