#include "report/text/markdown.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/utf8.h"

namespace plumbline::report {

using check::Comparison;
using check::Outcome;
using check::SceneVerdict;

namespace {

constexpr std::size_t kMostListed = 200;  // a CI page takes 1 MiB

std::string failures(std::span<const SceneVerdict> verdicts) {
  std::string out;
  std::size_t count = 0;
  for (const SceneVerdict& verdict : verdicts) {
    if (verdict.failure.empty() || ++count > kMostListed) continue;
    const Comparison* first = check::first_different(verdict);
    const std::string why = first != nullptr ? fmt::format("{} of {} {}", first->measurement.differing,
                                                           first->measurement.items, check::remark(*first))
                                             : verdict.failure.substr(0, verdict.failure.find('\n'));
    out +=
        fmt::format("| {} | {} | {} | {} | {} |\n", cell(verdict.scene), first == nullptr ? "" : name_of(first->stage),
                    cell(first == nullptr ? "" : title_of(first->judge)), cell(why), cell(verdict.repeat));
  }
  if (count == 0) return "";
  out = "\n### Failures\n\n| scene | first different stage | against | what | repeat |\n|---|---|---|---|---|\n" + out;
  if (count > kMostListed) out += fmt::format("\nand {} more\n", count - kMostListed);
  return out;
}

// Rows that are no failure and need a reader.
std::string listed(std::span<const SceneVerdict> verdicts, Outcome outcome) {
  std::string out;
  std::size_t count = 0;
  for (const SceneVerdict& verdict : verdicts) {
    for (const Comparison& c : verdict.comparisons) {
      if (c.outcome != outcome || ++count > kMostListed) continue;
      out += fmt::format("| {} | {} | {} | {} |\n", cell(c.scene), cell(title_of(c.judge)), name_of(c.stage),
                         cell(check::remark(c)));
    }
  }
  if (count == 0) return "";
  return fmt::format(
      "\n<details><summary>{} {}</summary>\n\n| scene | reference | stage | why |\n|---|---|---|---|\n{}\n</details>\n",
      count, name_of(outcome), out);
}

}  // namespace

std::string cell(std::string_view text) {
  std::string out;
  for (const char c : as_utf8(text)) {
    if (c == '\n' || c == '\r') {
      out += ' ';
    } else if (c == '&' || c == '<' || c == '>') {
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : "&gt;";
    } else {
      if (std::string_view("|\\`*_[]").find(c) != std::string_view::npos) out += '\\';
      out += c;
    }
  }
  return out;
}

std::string markdown(std::span<const SceneVerdict> verdicts, const std::string& summary) {
  std::array<std::size_t, check::kOutcomes> counts{};
  for (const SceneVerdict& verdict : verdicts) {
    for (const Comparison& c : verdict.comparisons) ++counts[static_cast<std::size_t>(c.outcome)];
  }
  const auto count = [&](Outcome outcome) { return counts[static_cast<std::size_t>(outcome)]; };
  std::string out = fmt::format("## plumb check\n\n{}\n\n| outcome | comparisons |\n|---|---|\n", cell(summary));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) out += fmt::format("| {} | {} |\n", cell(name_of(static_cast<Outcome>(i))), counts[i]);
  }
  out += fmt::format("\nNot run: {} unsupported, {} missing, {} failed.\n", count(Outcome::unsupported),
                     count(Outcome::missing), count(Outcome::failed));
  return out + failures(verdicts) + listed(verdicts, Outcome::expected) + listed(verdicts, Outcome::dispute);
}

}  // namespace plumbline::report
