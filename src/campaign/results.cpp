#include "campaign/results.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace plumbline::campaign {

namespace {

using Json = nlohmann::ordered_json;
using Groups = std::map<Signature, Group>;

void add(Groups& groups, const std::vector<Signature>& signatures, const SceneId& id) {
  for (const Signature& signature : signatures) {
    Group& group = groups[signature];
    group.signature = signature;
    ++group.scenes;
    if (group.first.size() < kMostFirst) group.first.push_back(id);  // ids come sorted
  }
}

std::vector<Group> list_of(Groups groups) {
  std::vector<Group> out;
  for (auto& [signature, group] : groups) out.push_back(std::move(group));
  return out;
}

std::vector<std::string> texts_of(const std::vector<SceneId>& ids) {
  std::vector<std::string> out;
  for (const SceneId& id : ids) out.push_back(to_string(id));
  return out;
}

std::vector<std::string> names_of(const std::vector<std::size_t>& states) {
  std::vector<std::string> out;
  for (const std::size_t state : states) out.push_back(state_names()[state]);
  return out;
}

std::string states_text(const Results& results) {
  std::vector<std::string> rounds;
  for (const auto& [round, kept] : results.kept) rounds.push_back(fmt::format("{} in round {}", kept.size(), round));
  constexpr std::size_t kShown = 10;
  std::vector<std::string> never = names_of(results.reached.never());
  const std::size_t more = never.size() - std::min(never.size(), kShown);
  never.resize(never.size() - more);
  return fmt::format("states: {} of {}, and {} pairs; scenes that reached a new pair: {}\n{}", results.reached.states(),
                     state_names().size(), results.reached.pairs(), fmt::join(rounds, ", "),
                     never.empty() ? ""
                                   : fmt::format("never: {}{}\n", fmt::join(never, "; "),
                                                 more > 0 ? fmt::format("; {} more (results.json)", more) : ""));
}

std::string lines_of(std::vector<Group> groups) {
  std::ranges::stable_sort(groups, std::ranges::greater(), &Group::scenes);
  std::string out;
  for (const Group& g : groups) {
    out += fmt::format("{:>7}  {}: {}\n", g.scenes, to_string(g.signature), fmt::join(texts_of(g.first), ", "));
  }
  return out;
}

std::uint64_t unable_scenes(const Results& results) {
  std::uint64_t out = 0;
  for (const auto& [reason, scenes] : results.unable) out += scenes;
  return out;
}

// Lines of the reasons why scenes could not be judged, the most frequent first.
std::string unable_lines(const std::map<std::string, std::uint64_t>& unable) {
  std::vector<std::pair<std::string, std::uint64_t>> reasons(unable.begin(), unable.end());
  std::ranges::stable_sort(reasons, std::ranges::greater(), &std::pair<std::string, std::uint64_t>::second);
  std::string out;
  for (const auto& [reason, scenes] : reasons) out += fmt::format("{:>7}  {}\n", scenes, reason);
  return out;
}

Json json_of_groups(const std::vector<Group>& groups) {
  Json out = Json::array();
  for (const Group& g : groups) {
    out.push_back({{"stage", g.signature.stage},
                   {"cause", g.signature.cause},
                   {"reference", g.signature.reference},
                   {"scenes", g.scenes},
                   {"first", texts_of(g.first)}});
  }
  return out;
}

}  // namespace

std::string to_string(const Signature& signature) {
  return fmt::format("{}, {} (against {})", signature.stage, signature.cause, signature.reference);
}

std::uint64_t Results::scenes() const {
  std::uint64_t out = 0;
  for (const auto& [generator, count] : judged) out += count;
  return out;
}

Results merged(const std::vector<std::vector<Entry>>& journals) {
  std::map<SceneId, const Entry*> all;
  std::vector<SceneId> conflicts;
  for (const std::vector<Entry>& journal : journals) {
    for (const Entry& entry : journal) {
      const auto [known, is_new] = all.try_emplace(entry.id, &entry);
      if (!is_new && !same_verdict(*known->second, entry)) conflicts.push_back(entry.id);
    }
  }
  std::ranges::sort(conflicts);
  conflicts.erase(std::unique(conflicts.begin(), conflicts.end()), conflicts.end());
  for (const SceneId& id : conflicts) all.erase(id);  // a scene with two verdicts has none
  Results out;
  out.conflicts = std::move(conflicts);
  Groups found, disputes;
  for (const auto& [id, entry] : all) {
    ++out.judged[id.generator];
    if (entry->found.empty()) ++(entry->unable.empty() ? out.held : out.unable[entry->unable]);
    out.milliseconds += entry->milliseconds;
    add(found, entry->found, id);
    add(disputes, entry->disputes, id);
  }
  std::map<std::size_t, std::vector<const Entry*>> rounds;
  for (const auto& [id, entry] : all) rounds[id.seeds.size()].push_back(entry);
  for (const auto& [round, entries] : rounds) {
    for (const Entry* entry : entries) {
      if (out.reached.add(entry->states)) out.kept[round].push_back(entry->id);
    }
  }
  out.found = list_of(std::move(found));
  out.disputes = list_of(std::move(disputes));
  return out;
}

std::string text_of(const Results& results) {
  std::string out;
  for (const auto& [generator, count] : results.judged)
    out += fmt::format("{} scenes: {}\n", name_of(generator), count);
  out += fmt::format("hold: {}\n", results.held);
  if (!results.unable.empty())
    out += fmt::format("nothing could be judged: {}\n{}", unable_scenes(results), unable_lines(results.unable));
  if (2 * unable_scenes(results) > results.scenes() && !results.judged.contains(Generator::flat)) {
    out += "most scenes ask for more than is drawn; other generators ask for less:\n";
    if (!results.judged.contains(Generator::plain)) out += "--generator plain: opaque triangles alone\n";
    if (!results.judged.contains(Generator::inside))
      out += "--generator inside: opaque triangles in perspective that no plane cuts\n";
    out += "--generator flat: triangles of one colour a draw, without a depth test\n";
  }
  out += states_text(results);
  if (!results.found.empty())
    out += fmt::format("findings: scenes, signature, first scenes\n{}", lines_of(results.found));
  if (!results.disputes.empty()) {
    out += fmt::format("the reference is wrong: scenes, signature, first scenes\n{}", lines_of(results.disputes));
  }
  if (!results.conflicts.empty()) {
    out += fmt::format("judged differently by two journals: {}\n", fmt::join(texts_of(results.conflicts), ", "));
  }
  return out;
}

std::string json_of(const Results& results, const std::string& terms) {
  Json out = {{"format", "plumbline campaign"}, {"version", 1}, {"terms", terms}};
  out["judged"] = Json::object();
  for (const auto& [generator, count] : results.judged) out["judged"][std::string(name_of(generator))] = count;
  out["held"] = results.held;
  out["unable"] = unable_scenes(results);
  out["unable_because"] = results.unable;
  out["found"] = json_of_groups(results.found);
  out["disputes"] = json_of_groups(results.disputes);
  out["states"] = {{"reached", results.reached.states()},
                   {"pairs", results.reached.pairs()},
                   {"never", names_of(results.reached.never())}};
  out["conflicts"] = texts_of(results.conflicts);
  return out.dump(1) + "\n";
}

}  // namespace plumbline::campaign
