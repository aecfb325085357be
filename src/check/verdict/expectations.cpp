#include "check/verdict/expectations.h"

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/json/json_file.h"

namespace plumbline::check {

namespace {

std::string row_of(const Expectation& e) {
  return fmt::format("{}, {}, {}", e.scene, title_of({e.reference, e.kind.value_or(Kind::side_by_side)}),
                     name_of(e.stage));
}

bool is_of(const Expectation& e, const JudgeId& judge) {
  const bool of_exact = judge.kind >= Kind::from_scene && judge.kind <= Kind::repaired;
  return judge.reference == e.reference && (e.kind ? judge.kind == *e.kind : !of_exact);
}

std::chrono::sys_days day_at(const JsonNode& node) {
  try {
    return day_of(node.text());
  } catch (const std::invalid_argument&) {
    node.refuse("a day as YYYY-MM-DD");
  }
}

}  // namespace

std::chrono::sys_days day_of(const std::string& text) {
  std::tm parts{};
  std::istringstream(text) >> std::get_time(&parts, "%Y-%m-%d");
  const std::chrono::year_month_day date{std::chrono::year(parts.tm_year + 1900),
                                         std::chrono::month(static_cast<unsigned>(parts.tm_mon + 1)),
                                         std::chrono::day(static_cast<unsigned>(parts.tm_mday))};
  if (date.ok() && to_string(date) == text) return date;
  throw std::invalid_argument(fmt::format("expected a day as YYYY-MM-DD, found \"{}\"", text));
}

std::string to_string(std::chrono::sys_days day) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

std::vector<Expectation> read_expectations(const std::filesystem::path& path, std::span<const std::string> renderers) {
  const JsonFile file(path);
  file.root().only({"expectations"});
  std::vector<Expectation> out;
  std::set<std::tuple<std::string, std::string, std::optional<Kind>, Stage>> rows;
  for (const JsonNode& node : file.root()["expectations"].elements(0, 10'000)) {
    node.only({"scene", "reference", "kind", "stage", "outcome", "reason", "issue", "expires"});
    Expectation e;
    e.scene = node["scene"].text();
    e.reference = node["reference"].text();
    if (std::ranges::count(renderers, e.reference) == 0) {
      node["reference"].refuse(fmt::format("a reference, one of {}", fmt::join(renderers, ", ")));
    }
    if (const auto kind = node.find("kind")) e.kind = kind->choice<Kind>(kKindNames);
    e.stage = node["stage"].choice<Stage>(kStageNames);
    if (const auto outcome = node.find("outcome")) {
      e.outcome = outcome->choice<Outcome>(
          {{"different", Outcome::different}, {"missing", Outcome::missing}, {"failed", Outcome::failed}});
    }
    e.reason = node["reason"].text();
    e.issue = node["issue"].text();
    e.expires = day_at(node["expires"]);
    if (!rows.emplace(e.scene, e.reference, e.kind, e.stage).second)
      node.refuse("each comparison once", row_of(e) + " twice");
    out.push_back(std::move(e));
  }
  return out;
}

std::vector<Settled> settle_expectations(std::span<const Expectation> expectations, std::span<const std::string> asked,
                                         std::chrono::sys_days today, SceneVerdict& verdict) {
  std::vector<Settled> out;
  std::vector<Outcome> judged;  // rows' outcomes before any expectation: two may hold for one row
  std::ranges::transform(verdict.comparisons, std::back_inserter(judged), &Comparison::outcome);
  const auto judged_of = [&](const Comparison* c) {
    return judged[static_cast<std::size_t>(c - verdict.comparisons.data())];
  };
  for (const Expectation& e : expectations) {
    if (e.scene != verdict.scene || std::ranges::count(asked, e.reference) == 0) continue;
    const auto is_it = [&](const Comparison& c) { return is_of(e, c.judge) && c.stage == e.stage; };
    std::vector<Comparison*> rows;
    for (Comparison& c : verdict.comparisons) {
      if (is_it(c)) rows.push_back(&c);
    }
    const bool occurs = std::ranges::any_of(rows, [&](const Comparison* c) { return judged_of(c) == e.outcome; });
    if (rows.empty()) {
      out.push_back({&e, Settlement::unmatched, fmt::format("expectation {}: there is no such row", row_of(e))});
    } else if (!occurs) {
      out.push_back({&e, Settlement::passed,
                     fmt::format("unexpected {}: {}, expected {} ({}, {}): the expectation can go", row_of(e),
                                 name_of(judged_of(rows.front())), name_of(e.outcome), e.reason, e.issue)});
    } else if (today > e.expires) {
      out.push_back({&e, Settlement::expired,
                     fmt::format("expired {}: was expected until {} ({}, {})", row_of(e), to_string(e.expires),
                                 e.reason, e.issue)});
    } else {
      for (Comparison* c : rows) {
        if (c->outcome != e.outcome) continue;
        c->note = fmt::format("known to be {} until {}: {} ({}){}{}", name_of(e.outcome), to_string(e.expires),
                              e.reason, e.issue, c->note.empty() ? "" : "; ", c->note);
        c->outcome = Outcome::expected;
      }
      out.push_back({&e, Settlement::occurred, ""});
    }
  }
  return out;
}

std::vector<std::string> of_no_scene(std::span<const Expectation> expectations,
                                     std::span<const SceneVerdict> verdicts) {
  std::vector<std::string> out;
  for (const Expectation& e : expectations) {
    if (std::ranges::find(verdicts, e.scene, &SceneVerdict::scene) == verdicts.end()) {
      out.push_back(fmt::format("expectation {}: there is no such scene", row_of(e)));
    }
  }
  return out;
}

}  // namespace plumbline::check
