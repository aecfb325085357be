#include "report/runs/json_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_path.h"
#include "report/text/comparison_json.h"

namespace plumbline::report {

namespace {

using Json = nlohmann::ordered_json;

// A file's name for what it holds, and the version of that format, which rises when a key is dropped or changes
// its meaning (CHANGELOG.md).
Json head_of(const char* what) { return {{"format", fmt::format("plumbline {}", what)}, {"version", 1}}; }

void write(const std::filesystem::path& file, const Json& json) {
  write_file(file, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

void write_json(const std::filesystem::path& file, std::span<const check::SceneVerdict> verdicts, const RunHead& head) {
  const Shard& shard = head.shard;
  Json out = head_of("run");
  out.update(
      {{"versions", head.versions},
       {"fault", head.fault},
       {"against", head.against},
       {"golden", head.golden},
       {"failures", head.failures},
       {"tolerances", Json::object()},
       {"shard", {{"index", shard.index}, {"of", shard.of}, {"scenes", std::max(shard.scenes, verdicts.size())}}},
       {"scenes", Json::array()},
       {"comparisons", Json::array()}});
  for (const check::Tolerance& row : check::ledger()) out["tolerances"][name_of(row)] = row.factor;
  for (const check::SceneVerdict& verdict : verdicts) {
    Json scene{{"scene", verdict.scene}, {"file", verdict.path}, {"seconds", verdict.seconds}};
    if (verdict.empty_holds) scene["empty_holds"] = true;
    if (verdict.knows_no_color) scene["knows_no_color"] = true;
    if (!verdict.failure.empty()) scene["failure"] = verdict.failure, scene["repeat"] = verdict.repeat;
    if (!verdict.causes.empty()) scene["cause"] = verdict.causes.front();
    out["scenes"].push_back(std::move(scene));
    for (const check::Comparison& c : verdict.comparisons) out["comparisons"].push_back(comparison_json(c));
  }
  write(file, out);
}

void write_json(const std::filesystem::path& file, const check::Diagnosis& diagnosis,
                const std::map<std::string, std::string>& versions, const std::string& pixel_history) {
  Json out = head_of("diagnosis");
  out.update({{"scene", diagnosis.verdict.scene},
              {"file", diagnosis.verdict.path},
              {"versions", versions},
              {"first", diagnosis.first ? Json(name_of(*diagnosis.first)) : Json(nullptr)},
              {"wrong", Json::array()},
              {"findings", Json::array()},
              {"comparisons", Json::array()}});
  for (const Stage stage : diagnosis.wrong) out["wrong"].push_back(name_of(stage));
  for (const check::Finding& f : diagnosis.findings) {
    out["findings"].push_back({{"stage", name_of(f.stage)},
                               {"reference", f.judge.reference},
                               {"kind", name_of(f.judge.kind)},
                               {"title", title_of(f.judge)},
                               {"pixels", f.measurement.items},
                               {"differing", f.measurement.differing},
                               {"explains", f.explains},
                               {"numbers", f.numbers},
                               {"causes", f.causes},
                               {"picture", f.picture}});
  }
  for (const check::Comparison& c : diagnosis.verdict.comparisons) out["comparisons"].push_back(comparison_json(c));
  if (!pixel_history.empty()) out["pixel_history"] = Json::parse(pixel_history);
  write(file, out);
}

void write_json(const std::filesystem::path& file, const std::string& a, const std::string& b, double tolerance,
                std::span<const check::StoredComparison> comparisons) {
  Json out = head_of("comparison");
  out.update({{"a", a}, {"b", b}, {"tolerance", tolerance}, {"comparisons", Json::array()}});
  for (const check::StoredComparison& c : comparisons) {
    const check::Measurement& m = c.measurement;
    Json row{{"what", c.what},
             {"outcome", name_of(c.outcome)},
             {"items", m.items},
             {"differing", m.differing},
             {"max_difference", json_number(m.max_difference)},
             {"worst", m.max_difference > 0 ? worst_json(m.worst) : Json(nullptr)},
             {"histogram", m.histogram}};
    if (c.codes > 0) row["codes"] = c.codes;
    if (!c.note.empty()) row["note"] = c.note;
    out["comparisons"].push_back(std::move(row));
  }
  write(file, out);
}

namespace {

// Two digits: enough to judge a tolerance by, and the same from one run to the next.
Json share(double ratio) { return json_number(std::round(ratio * 100) / 100); }

// Number of scenes of each group, and the group's largest difference by reference, stage and unit. A combination that
// is absent is equal, or was not compared.
Json groups(std::span<const check::SceneVerdict> verdicts) {
  struct Group {
    int scenes = 0;
    std::map<std::string, double> largest;
  };
  std::map<std::string, Group> by_name;
  for (const check::SceneVerdict& verdict : verdicts) {
    Group& group = by_name[check::group_of(verdict.scene)];
    ++group.scenes;
    for (const check::Comparison& c : verdict.comparisons) {
      if (!(c.measurement.max_difference > 0)) continue;
      double& largest =
          group.largest[fmt::format("{}, {}, {}", title_of(c.judge), name_of(c.stage), c.measurement.unit)];
      largest = std::max(largest, c.measurement.max_difference);
    }
  }
  Json out = Json::array();
  for (const auto& [name, group] : by_name) {
    Json largest = Json::object();
    for (const auto& [what, difference] : group.largest) largest[what] = fmt::format("{:.2g}", difference);
    out.push_back({{"name", name}, {"scenes", group.scenes}, {"largest_difference", largest}});
  }
  return out;
}

}  // namespace

void write_ledger(const std::filesystem::path& file, std::span<const check::SceneVerdict> verdicts) {
  Json rows = Json::array();
  for (const check::LedgerUse& use : check::ledger_use(verdicts)) {
    rows.push_back({{"name", name_of(*use.row)},
                    {"factor", use.row->factor},
                    {"unit", use.row->unit},
                    {"largest_seen", use.largest_ratio < 0 ? Json(nullptr) : share(use.largest_ratio)},
                    {"where", use.where}});
  }
  const Json out{{"tolerances", rows}, {"groups", groups(verdicts)}};
  write(file, out);
}

}  // namespace plumbline::report
