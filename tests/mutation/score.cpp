#include "mutation/score.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumbline::mutation {

namespace {

bool names_stages(const Judged& j) {
  const std::string& name = j.rule->names[0];
  return name != "any" && name != "data" && name != "picture";
}
bool in_painter(const Judged& j) { return j.rule->names[0] == "picture"; }
bool equivalent(const Judged& j) { return j.verdict.outcome == Outcome::equivalent; }
bool named(const Judged& j) { return j.verdict.named_by_check() && j.verdict.named_by_diagnose(); }

std::string group_of(const Judged& j) {
  const std::vector<std::string>& names = j.rule->names;
  return names[0] == "any" ? "no stage" : names.size() > 1 ? "several stages" : names[0];
}

double percent(std::size_t part, std::size_t of) {
  return of == 0 ? 100 : 100 * static_cast<double>(part) / static_cast<double>(of);
}

struct Row {
  std::array<std::size_t, kOutcomes> outcomes{};
  std::size_t all = 0, by_check = 0, by_diagnose = 0, by_both = 0;
};

std::string table_of(const std::vector<Judged>& judged) {
  std::map<std::string, Row> rows;
  for (const Judged& j : judged) {
    for (Row* row : {&rows[group_of(j)], &rows["~ all"]}) {
      ++row->all;
      ++row->outcomes[static_cast<std::size_t>(j.verdict.outcome)];
      row->by_check += j.verdict.named_by_check() ? 1 : 0;
      row->by_diagnose += j.verdict.named_by_diagnose() ? 1 : 0;
      row->by_both += named(j) ? 1 : 0;
    }
  }
  std::string out = fmt::format("{:<16}{:>8}", "changed", "changes");
  for (std::size_t i = 0; i < kOutcomes; ++i) out += fmt::format("{:>11}", name_of(static_cast<Outcome>(i)));
  out += fmt::format("{:>8}{:>10}{:>6}   named rightly by\n", "check", "diagnose", "both");
  for (const auto& [name, row] : rows) {
    out += fmt::format("{:<16}{:>8}", name, row.all);
    for (const std::size_t n : row.outcomes) out += fmt::format("{:>11}", n);
    out += fmt::format("{:>8}{:>10}{:>6}\n", row.by_check, row.by_diagnose, row.by_both);
  }
  return out;
}

}  // namespace

std::string description(const Judged& j) {
  return fmt::format("{} {}: {}:{}: {}: \"{}\" -> \"{}\"", j.seed, j.number, j.change.file, j.change.line,
                     j.change.kind, j.lines.before, j.lines.after);
}

std::string outcome_line(const Judged& j) {
  const Verdict& v = j.verdict;
  std::string out(name_of(v.outcome));
  if (v.affected > 0) out += fmt::format(", {} scenes affected", v.affected);
  if (!v.scene.empty()) out += ", " + v.scene;
  if (!v.note.empty()) out += ": " + v.note;
  if (v.found()) {
    out += fmt::format(", named {} by check ({}), {} by diagnose ({})", v.check.first, v.check.by, v.diagnose.first,
                       v.diagnose.by);
    if (!named(j)) out += fmt::format(", expected {}", fmt::join(v.expected, " or "));
  }
  return out;
}

Score score_of(const std::vector<Judged>& judged) {
  Score out;
  for (const Judged& j : judged) {
    ++out.changes;
    if (equivalent(j)) {
      ++out.equivalent;
      continue;
    }
    if (j.verdict.found()) ++out.found;
    if (j.verdict.outcome == Outcome::tables) ++out.by_tables;
    if (names_stages(j)) {
      ++out.in_stages;
      if (named(j)) ++out.named;
    }
    if (in_painter(j) && j.verdict.found()) {
      ++out.in_painter;
      if (named(j)) ++out.picture;
    }
  }
  return out;
}

bool holds(const Score& s) {
  return s.changes >= 200 && 100 * s.equivalent <= 12 * s.changes && 100 * s.found >= 97 * (s.changes - s.equivalent) &&
         100 * s.named >= 93 * s.in_stages && s.picture == s.in_painter;
}

std::string report_of(const std::vector<Judged>& judged) {
  std::string out, unseen, otherwise;
  for (const Judged& j : judged) {
    const std::string lines = fmt::format("  {}\n    {}\n", description(j), outcome_line(j));
    if (equivalent(j)) continue;
    if (!j.verdict.found()) unseen += lines;
    if (j.verdict.found() && !named(j)) otherwise += lines;
  }
  if (!unseen.empty()) out += "\nnot found by references or the row picture:\n" + unseen;
  if (!otherwise.empty()) out += "\nfound, but named otherwise:\n" + otherwise;
  const Score s = score_of(judged);
  const std::size_t rest = s.changes - s.equivalent;
  out += fmt::format(
      "\n{}\n{} changes; {} equivalent or not run ({:.1f} %, at most 12); of the others {} of {} found "
      "({:.1f} %, at least 97; {} of them, in data that every renderer is given, by the data's tests alone);\nof those "
      "in stages {} of {} named rightly ({:.1f} %, at least 93); of "
      "the painter's that are found {} of {} by the row picture alone\n",
      table_of(judged), s.changes, s.equivalent, percent(s.equivalent, s.changes), s.found, rest,
      percent(s.found, rest), s.by_tables, s.named, s.in_stages, percent(s.named, s.in_stages), s.picture,
      s.in_painter);
  return out;
}

std::string log_of(const std::vector<Judged>& judged) {
  std::string out =
      "seed\tnumber\tfile\tline\tkind\toutcome\taffected\tscene\texpected\tcheck\tby\tdiagnose\tby\tbefore\tafter\tnote"
      "\n";
  for (const Judged& j : judged) {
    const Verdict& v = j.verdict;
    out +=
        fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", j.seed, j.number, j.change.file,
                    j.change.line, j.change.kind, name_of(v.outcome), v.affected, v.scene, fmt::join(v.expected, ","),
                    v.check.first, v.check.by, v.diagnose.first, v.diagnose.by, j.lines.before, j.lines.after, v.note);
  }
  return out;
}

}  // namespace plumbline::mutation
