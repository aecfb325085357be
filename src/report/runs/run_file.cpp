#include "report/runs/run_file.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "scene/json/json_file.h"

namespace plumbline::report {

namespace {

using check::Comparison;
using check::Outcome;
using check::SceneVerdict;

constexpr std::size_t kMostRows = 1'000'000;
constexpr double kLargest = std::numeric_limits<double>::max();

// Numbers that JSON cannot hold are words.
double number(const JsonNode& node) {
  if (node.value().kind != JsonValue::Kind::text) return node.number(-kLargest, kLargest);
  return node.choice<double>({{"inf", std::numeric_limits<double>::infinity()},
                              {"-inf", -std::numeric_limits<double>::infinity()},
                              {"nan", std::numeric_limits<double>::quiet_NaN()}});
}

std::uint64_t count(const JsonNode& node) {
  return static_cast<std::uint64_t>(node.integer(0, std::numeric_limits<std::int64_t>::max()));
}

// Text that may be empty.
std::string text(const JsonNode& node) {
  return node.value().kind == JsonValue::Kind::text && node.value().text.empty() ? "" : node.text();
}

std::string text_if_any(const JsonNode& node, std::string_view key) {
  const auto found = node.find(key);
  return found ? text(*found) : "";
}

template <class E, std::size_t N>
E named(const JsonNode& node, std::string_view what, const std::array<std::string_view, N>& names) {
  const auto found = std::ranges::find(names, std::string_view(node.text()));
  if (found == names.end()) node.refuse(fmt::format("{} ({} to {})", what, names.front(), names.back()));
  return static_cast<E>(found - names.begin());
}

std::array<std::string_view, check::kOutcomes> outcome_names() {
  std::array<std::string_view, check::kOutcomes> out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = name_of(static_cast<Outcome>(i));
  return out;
}

// Parses the text of check::to_string(Place): pixel and record; the rest, "primitive N" included, is the field.
check::Place place_at(const JsonNode& node, std::set<std::string>& words) {
  check::Place out;
  std::string rest = text(node["place"]);
  const auto take = [&](const std::string& part) {
    if (!rest.starts_with(part)) return false;
    rest.erase(0, std::min(rest.size(), part.size() + 1));  // and a space
    return true;
  };
  if (const auto pixel = node.find("pixel")) {
    const std::vector<JsonNode> xy = pixel->elements(2, 2);
    out.x = static_cast<int>(xy[0].integer(0, std::numeric_limits<int>::max()));
    out.y = static_cast<int>(xy[1].integer(0, std::numeric_limits<int>::max()));
    if (!take(fmt::format("pixel {},{}", out.x, out.y))) node["place"].refuse("the place to begin with the pixel");
  }
  long long record = -1;
  if (std::sscanf(rest.c_str(), "record %lld", &record) == 1 && record >= 0 && take(fmt::format("record {}", record))) {
    out.record = record;
  }
  out.field = words.insert(rest).first->c_str();
  return out;
}

check::Worst worst_at(const JsonNode& node, std::set<std::string>& words) {
  return {place_at(node, words), number(node["candidate"]), number(node["reference"]), number(node["difference"]),
          number(node["tolerance"])};
}

Comparison comparison_at(const JsonNode& node, std::set<std::string>& words) {
  node.only({"scene", "reference", "kind", "title", "stage", "outcome", "pixels", "differing", "ambiguous",
             "max_difference", "unit", "worst", "disputed", "max_ratio", "histogram", "dispute", "ledger", "note"});
  Comparison c;
  c.scene = node["scene"].text();
  c.judge = {node["reference"].text(), named<check::Kind>(node["kind"], "a kind of judge", check::kKindNames)};
  c.stage = named<Stage>(node["stage"], "a stage", kStageNames);
  c.outcome = named<Outcome>(node["outcome"], "an outcome", outcome_names());
  check::Measurement& m = c.measurement;
  m.items = count(node["pixels"]), m.differing = count(node["differing"]), m.ambiguous = count(node["ambiguous"]);
  m.disputed = count(node["disputed"]);
  m.max_difference = number(node["max_difference"]), m.max_ratio = number(node["max_ratio"]);
  m.unit = text(node["unit"]);
  if (node["worst"].value().kind != JsonValue::Kind::null) m.worst = worst_at(node["worst"], words);
  const std::vector<JsonNode> histogram = node["histogram"].elements(m.histogram.size(), m.histogram.size());
  for (std::size_t i = 0; i < histogram.size(); ++i) m.histogram[i] = count(histogram[i]);
  if (const auto dispute = node.find("dispute")) {
    m.dispute = worst_at(*dispute, words);
    m.reason = text((*dispute)["reason"]);
  }
  c.ledger_row = text_if_any(node, "ledger");
  c.note = text_if_any(node, "note");
  return c;
}

Shard shard_at(const JsonNode& node) {
  Shard out;
  node.only({"index", "of", "scenes"});
  out.of = static_cast<int>(node["of"].integer(1, 1'000'000));
  out.index = static_cast<int>(node["index"].integer(1, out.of));
  out.scenes = static_cast<std::size_t>(count(node["scenes"]));
  return out;
}

}  // namespace

CheckRun read_run(const std::filesystem::path& path) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 30;
  CheckRun run;
  run.file = path.string();
  const JsonValue value = read_json_file(path, run.file, kMostBytes);
  const JsonNode root(value, "");
  if (const auto n = root.find("version")) n->integer(1, 1);
  if (!root.find("comparisons") || root.find("format")) root.require_format("plumbline run");  // 0.1 wrote none
  root.only({"format", "version", "versions", "fault", "against", "golden", "failures", "tolerances", "shard", "scenes",
             "comparisons"});
  const JsonNode versions = root["versions"], tolerances = root["tolerances"];
  for (const JsonNode& node : {versions, tolerances}) {
    if (node.value().kind != JsonValue::Kind::object) node.refuse("an object");
  }
  for (const auto& [name, version] : versions.value().members) run.head.versions[name] = text(versions[name]);
  for (const auto& [name, factor] : tolerances.value().members) run.tolerances[name] = number(tolerances[name]);
  run.head.fault = text(root["fault"]);
  run.head.golden = root["golden"].boolean();
  for (const JsonNode& node : root["against"].elements(0, kMostRows)) run.head.against.push_back(node.text());
  for (const JsonNode& node : root["failures"].elements(0, kMostRows)) run.head.failures.push_back(node.text());
  run.head.shard = shard_at(root["shard"]);
  for (const JsonNode& node : root["scenes"].elements(0, kMostRows)) {
    node.only({"scene", "file", "seconds", "empty_holds", "knows_no_color", "failure", "repeat", "cause"});
    SceneVerdict& verdict = run.verdicts.emplace_back();
    verdict.scene = node["scene"].text();
    verdict.path = node["file"].text();
    verdict.seconds = node["seconds"].number(0, kLargest);
    if (const auto empty_holds = node.find("empty_holds")) verdict.empty_holds = empty_holds->boolean();
    if (const auto no_color = node.find("knows_no_color")) verdict.knows_no_color = no_color->boolean();
    verdict.failure = text_if_any(node, "failure");
    verdict.repeat = text_if_any(node, "repeat");
    if (const std::string cause = text_if_any(node, "cause"); !cause.empty()) verdict.causes = {cause};
  }
  // Comparisons are in the order of their scenes, which distinguishes two scenes of one name.
  std::size_t at = 0;
  for (const JsonNode& node : root["comparisons"].elements(0, kMostRows)) {
    Comparison c = comparison_at(node, run.words);
    while (at < run.verdicts.size() && run.verdicts[at].scene != c.scene) ++at;
    if (at == run.verdicts.size()) node["scene"].refuse("one of \"scenes\", in their order");
    const bool fails = is_failure(c.outcome) && c.outcome != Outcome::missing;  // which --allow-missing allows
    if (fails && run.verdicts[at].failure.empty()) node["outcome"].refuse("one that holds, as its scene does");
    run.verdicts[at].comparisons.push_back(std::move(c));
  }
  return run;
}

bool all_hold(std::span<const SceneVerdict> verdicts) {
  return std::ranges::all_of(verdicts, [](const SceneVerdict& v) { return v.failure.empty(); });
}

double seconds(std::span<const SceneVerdict> verdicts) {
  double sum = 0;
  for (const SceneVerdict& v : verdicts) sum += v.seconds;
  return sum;
}

}  // namespace plumbline::report
