#include "matrix/report.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/atomic_path.h"

namespace plumbline::matrix {

namespace {

using Json = nlohmann::ordered_json;

std::size_t sum(const std::vector<Row>& rows, auto of_row) {
  return std::accumulate(rows.begin(), rows.end(), std::size_t{0},
                         [&](std::size_t n, const Row& row) { return n + of_row(row); });
}
std::size_t judged(const std::vector<Row>& rows) {
  return sum(rows, [](const Row& row) { return row.answers.size(); });
}
std::size_t right(const std::vector<Row>& rows) {
  return sum(rows, [](const Row& row) { return row.right(); });
}
std::size_t seen(const std::vector<Row>& rows) {
  return sum(rows, [](const Row& row) { return row.seen(); });
}
std::size_t caught(const std::vector<Row>& rows) {
  return sum(rows, [](const Row& row) { return row.seen() > 0 ? std::size_t{1} : 0; });
}

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 1 : static_cast<double>(part) / static_cast<double>(all);
}

std::vector<std::string_view> names_of(const std::vector<Stage>& stages) {
  std::vector<std::string_view> out;
  for (const Stage stage : stages) out.push_back(name_of(stage));
  return out;
}

// The comparisons that saw it, the most frequent first.
std::vector<std::pair<std::string, std::size_t>> seen_by(const Row& row) {
  std::map<std::string, std::size_t> count;
  for (const Answer& a : row.answers) {
    if (a.seen()) ++count[a.by];
  }
  std::vector<std::pair<std::string, std::size_t>> out(count.begin(), count.end());
  std::ranges::stable_sort(out, std::greater(), [](const auto& entry) { return entry.second; });
  return out;
}

std::string text_of(const Answer& a) {
  if (!a.failed.empty()) return "failed: " + a.failed;
  return fmt::format("{}, wrong by itself: {}", a.by,
                     a.wrong.empty() ? "none" : fmt::to_string(fmt::join(names_of(a.wrong), ", ")));
}

void add_head(std::string& out, std::string_view what) {
  out += fmt::format("{:<42} {:<11} {:>8} {:>6} {:>5} {:>5}  {}\n", what, "stage", "affected", "judged", "seen",
                     "right", "first seen by");
}

// A row of the table, and below it what was not right.
void add_row(std::string& out, const Row& row, const std::vector<std::string>& scenes) {
  const auto by = seen_by(row);
  const std::string_view stage = row.subject.broken.size() == 1 ? name_of(row.subject.broken[0]) : "";
  out += fmt::format("{:<42} {:<11} {:>8} {:>6} {:>5} {:>5}  {}\n", row.subject.name, stage, row.affected,
                     row.answers.size(), row.seen(), row.right(), by.empty() ? "" : by[0].first);
  std::vector<std::string_view> not_seen;
  for (const Answer& a : row.answers) {
    if (is_right(a, row.subject)) continue;
    if (a.seen()) {
      out += fmt::format("    {}: {}\n", scenes[a.scene], text_of(a));
    } else {
      not_seen.push_back(scenes[a.scene]);
    }
  }
  if (!not_seen.empty()) out += fmt::format("    not seen: {}\n", fmt::join(not_seen, " "));
}

void add_worst(std::string& out, const std::vector<Row>& rows) {
  std::vector<const Row*> worst;
  for (const Row& row : rows) {
    if (row.right() < row.answers.size()) worst.push_back(&row);
  }
  const auto share_of = [](const Row* row) { return share(row->right(), row->answers.size()); };
  std::ranges::stable_sort(worst, std::less(), share_of);
  if (worst.size() > 10) worst.resize(10);
  if (!worst.empty()) out += "the worst:\n";
  for (const Row* row : worst)
    out += fmt::format("  {:5.1f} %  {} ({} of {})\n", 100 * share_of(row), row->subject.name, row->right(),
                       row->answers.size());
}

Json json_of(const Row& row, const std::vector<std::string>& scenes) {
  Json by = Json::object(), not_right = Json::array();
  for (const auto& [comparison, count] : seen_by(row)) by[comparison] = count;
  for (const Answer& a : row.answers) {
    if (is_right(a, row.subject)) continue;
    not_right.push_back({{"scene", scenes[a.scene]},
                         {"seen_by", a.by},
                         {"first", a.first ? Json(name_of(*a.first)) : Json(nullptr)},
                         {"wrong", names_of(a.wrong)},
                         {"failed", a.failed}});
  }
  return {{"name", row.subject.name}, {"broken", names_of(row.subject.broken)},
          {"affected", row.affected}, {"judged", row.answers.size()},
          {"seen", row.seen()},       {"right", row.right()},
          {"first_seen_by", by},      {"not_right", not_right}};
}

Json json_of(const std::vector<Row>& rows, const std::vector<std::string>& scenes) {
  Json out = Json::array();
  for (const Row& row : rows) out.push_back(json_of(row, scenes));
  return out;
}

}  // namespace

std::size_t Row::seen() const {
  return static_cast<std::size_t>(std::ranges::count_if(answers, [](const Answer& a) { return a.seen(); }));
}
std::size_t Row::right() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(answers, [&](const Answer& a) { return is_right(a, subject); }));
}

Shares shares(const Matrix& m) {
  return {share(caught(m.faults), m.faults.size()), share(right(m.faults), judged(m.faults)),
          share(right(m.pairs), judged(m.pairs)), share(right(m.legal), judged(m.legal))};
}

bool holds(const Shares& s) {
  return s.caught >= kRequired.caught && s.faults >= kRequired.faults && s.pairs >= kRequired.pairs &&
         s.legal >= kRequired.legal;
}

std::string text_of(const Matrix& m) {
  std::string out;
  add_head(out, "fault");
  for (const Row& row : m.faults) add_row(out, row, m.scenes);
  if (!m.pairs.empty()) add_head(out += '\n', "pair");
  for (const Row& row : m.pairs) add_row(out, row, m.scenes);
  if (!m.legal.empty()) add_head(out += '\n', "legal");
  for (const Row& row : m.legal) add_row(out, row, m.scenes);
  out += '\n';
  add_worst(out, m.faults);
  const Shares s = shares(m);
  out += fmt::format("faults: {} of {} caught; {} scenes affected, {} judged: {} seen, {} named right: {:.2f} %\n",
                     caught(m.faults), m.faults.size(), sum(m.faults, [](const Row& row) { return row.affected; }),
                     judged(m.faults), seen(m.faults), right(m.faults), 100 * s.faults);
  if (!m.pairs.empty()) {
    out += fmt::format("pairs: {}, on {} scenes: both named on {}: {:.2f} %\n", m.pairs.size(), judged(m.pairs),
                       right(m.pairs), 100 * s.pairs);
  }
  if (!m.legal.empty()) {
    out += fmt::format("legal: {}, on {} scenes: {} alarms\n", m.legal.size(), judged(m.legal),
                       judged(m.legal) - right(m.legal));
  }
  return out + fmt::format("{} in {:.0f} s\n", holds(s) ? "holds" : "DOES NOT HOLD", m.seconds);
}

void write_json(const Matrix& m, const std::filesystem::path& file) {
  const Shares s = shares(m);
  const Json out{{"holds", holds(s)},
                 {"seconds", m.seconds},
                 {"shares", {{"caught", s.caught}, {"faults", s.faults}, {"pairs", s.pairs}, {"legal", s.legal}}},
                 {"required",
                  {{"caught", kRequired.caught},
                   {"faults", kRequired.faults},
                   {"pairs", kRequired.pairs},
                   {"legal", kRequired.legal}}},
                 {"faults", json_of(m.faults, m.scenes)},
                 {"pairs", json_of(m.pairs, m.scenes)},
                 {"legal", json_of(m.legal, m.scenes)}};
  AtomicPath path(file);
  path.write(out.dump(1) + "\n");
  path.commit();
}

}  // namespace plumbline::matrix
