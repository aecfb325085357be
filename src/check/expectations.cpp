#include "check/expectations.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "scene/json_file.h"

namespace plumbline::check {

namespace {

std::string row_of(const Expectation& e) { return fmt::format("{}, {}, {}", e.scene, e.reference, name_of(e.stage)); }

Stage stage_at(const JsonNode& node) {
  const auto found = std::ranges::find(kStageNames, std::string_view(node.text()));
  if (found == kStageNames.end())
    node.refuse(fmt::format("a stage ({} to {})", kStageNames.front(), kStageNames.back()));
  return static_cast<Stage>(found - kStageNames.begin());
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
  int year = 0, end = 0;
  unsigned month = 0, day = 0;
  if (text.size() == 10 && std::sscanf(text.c_str(), "%4d-%2u-%2u%n", &year, &month, &day, &end) == 3 && end == 10) {
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
    if (date.ok()) return date;
  }
  throw std::invalid_argument(fmt::format("expected a day as YYYY-MM-DD, found \"{}\"", text));
}

std::string to_string(std::chrono::sys_days day) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

std::vector<Expectation> read_expectations(const std::filesystem::path& path) {
  const JsonFile file(path);
  file.root().only({"expectations"});
  std::vector<Expectation> out;
  std::set<std::tuple<std::string, std::string, Stage>> rows;
  for (const JsonNode& node : file.root()["expectations"].elements(0, 10'000)) {
    node.only({"scene", "reference", "stage", "outcome", "reason", "issue", "expires"});
    Expectation e;
    e.scene = node["scene"].text();
    e.reference = node["reference"].text();
    e.stage = stage_at(node["stage"]);
    if (const auto outcome = node.find("outcome")) {
      e.outcome = outcome->choice<Outcome>(
          {{"different", Outcome::different}, {"missing", Outcome::missing}, {"failed", Outcome::failed}});
    }
    e.reason = node["reason"].text();
    e.issue = node["issue"].text();
    e.expires = day_at(node["expires"]);
    if (!rows.emplace(e.scene, e.reference, e.stage).second) node.refuse("each comparison once", row_of(e) + " twice");
    out.push_back(std::move(e));
  }
  return out;
}

std::vector<Settled> settle(std::span<const Expectation> expectations, std::span<const std::string> asked,
                            std::chrono::sys_days today, SceneVerdict& verdict) {
  std::vector<Settled> out;
  for (const Expectation& e : expectations) {
    const std::string renderer = e.reference.substr(0, e.reference.find(' '));
    if (e.scene != verdict.scene || std::ranges::count(asked, renderer) == 0) continue;
    const auto is_it = [&](const Comparison& c) { return c.reference == e.reference && c.stage == e.stage; };
    std::vector<Comparison*> rows;
    for (Comparison& c : verdict.comparisons) {
      if (is_it(c)) rows.push_back(&c);
    }
    const bool occurs = std::ranges::any_of(rows, [&](const Comparison* c) { return c->outcome == e.outcome; });
    if (rows.empty()) {
      out.push_back({&e, Settlement::unmatched, fmt::format("expectation {}: there is no such row", row_of(e))});
    } else if (!occurs) {
      out.push_back({&e, Settlement::passed,
                     fmt::format("unexpected {}: {}, expected {} ({}, {}): the expectation can go", row_of(e),
                                 name_of(rows.front()->outcome), name_of(e.outcome), e.reason, e.issue)});
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

}  // namespace plumbline::check
