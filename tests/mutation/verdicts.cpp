// Names that plumb check and plumb diagnose give, from their JSON, and scenes whose hashes differ.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "capture/stages.h"
#include "mutation/judge.h"

namespace plumbline::mutation {

namespace {

using Json = nlohmann::json;

std::size_t order_of(const std::string& stage) {
  return static_cast<std::size_t>(std::ranges::find(kStageNames, stage) - kStageNames.begin());
}

bool fails(const Json& row) { return row["outcome"] == "different" || row["outcome"] == "failed"; }
bool is_picture(const Json& row) { return row["reference"] == "picture"; }

// The first stage among the rows that fail; `picture` where no other row fails.
struct First {
  Named named{"none", ""};
  std::size_t at = ~std::size_t{0};
  bool crashed = false;  // the row `failed`

  void add(const Json& row) {
    const std::size_t here = is_picture(row) ? kStageNames.size() + 1 : order_of(row["stage"]);
    if (here >= at) return;
    at = here;
    named.first = is_picture(row) ? "picture" : row["stage"].get<std::string>();
    named.by = row.value("title", row["reference"].get<std::string>()) + ", " + row["stage"].get<std::string>();
    crashed = row["outcome"] == "failed";
    if (crashed) named.by += " (failed: " + row.value("note", "") + ")";
  }
};

// The stage and the reference of "first different stage: STAGE (against REFERENCE)", of plumb check's lines on one
// scene; no stage where there is no such line.
Named announced(const std::string& failure) {
  static constexpr std::string_view kStage = "first different stage: ", kReference = " (against ";
  const std::size_t at = failure.find(kStage);
  if (at == std::string::npos) return {};
  const std::size_t stage = at + kStage.size(), end = failure.find(kReference, stage);
  const std::size_t reference = end + kReference.size();
  const std::string name = failure.substr(stage, end - stage);
  return {name, failure.substr(reference, failure.find(')', reference) - reference) + ", " + name};
}

bool is_among(const std::string& name, const std::vector<std::string>& expected) {
  return expected.empty() || std::ranges::count(expected, name) > 0;
}

}  // namespace

std::string_view name_of(Outcome outcome) {
  static constexpr std::array<std::string_view, kOutcomes> kNames = {"references", "picture",  "ended",     "tables",
                                                                     "goldens",    "survived", "equivalent"};
  return kNames[static_cast<std::size_t>(outcome)];
}

bool Verdict::named_by_check() const { return found() && is_among(check.first, expected); }
bool Verdict::named_by_diagnose() const { return found() && is_among(diagnose.first, expected); }

std::vector<Affected> affected(const SceneHashes& as_it_is, const SceneHashes& changed) {
  std::vector<Affected> out;
  for (const auto& [name, line] : changed.of) {
    const auto before = as_it_is.of.find(name);
    if (before == as_it_is.of.end() || before->second.hashes == line.hashes) continue;
    const auto& was = before->second.hashes;
    const bool both = !line.failed() && was.size() == line.hashes.size();
    out.push_back({name, both && std::equal(was.begin(), was.end() - 1, line.hashes.begin()), line.failed()});
  }
  std::ranges::stable_sort(out, {},
                           [&](const Affected& a) { return std::pair(a.picture_alone, as_it_is.of.at(a.scene).work); });
  return out;
}

std::map<std::string, Named> named_by_check(const std::string& json) {
  std::map<std::string, First> first;
  const Json run = Json::parse(json);
  for (const Json& row : run["comparisons"]) {
    if (fails(row)) first[row["scene"]].add(row);
  }
  for (const Json& scene : run.value("scenes", Json::array())) {
    const auto of = first.find(scene["scene"]);
    if (of == first.end() || of->second.crashed || of->second.named.first == "picture") continue;
    Named named = announced(scene.value("failure", ""));
    if (!named.first.empty()) of->second.named = std::move(named);
  }
  std::map<std::string, Named> out;
  for (auto& [scene, f] : first) out[scene] = std::move(f.named);
  return out;
}

Named named_by_diagnose(const std::string& json) {
  const Json run = Json::parse(json);
  First first;
  for (const Json& row : run["comparisons"]) {
    if (fails(row)) first.add(row);
  }
  if (first.named.first != "picture" && run["first"].is_string()) first.named.first = run["first"];
  return first.named;
}

}  // namespace plumbline::mutation
