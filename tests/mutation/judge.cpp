#include "mutation/judge.h"

#include <algorithm>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "mutation/run.h"

namespace plumbline::mutation {

namespace {

namespace fs = std::filesystem;

constexpr unsigned kMostSeconds = 600;  ///< of programs that draw all scenes
const std::vector<std::string> kRandomScenes = {"--random", "1", "2000"};
constexpr std::size_t kBatches[] = {3, 12, ~std::size_t{0}};

std::string ending(const Ended& ended) {
  return ended.how.empty() ? fmt::format("exit code {}", ended.code) : ended.how;
}

// A renderer that never ends is a row `failed` of its stage after that time; the slowest of the scenes takes 5 s.
// Memory: below what run() allows, so that the renderer fails and not plumb.
constexpr unsigned kRendererSeconds = 60;
const std::vector<std::string> kLimits = {"--time-limit", std::to_string(kRendererSeconds), "--memory-limit", "4096"};

// Seconds for the judgement of so many scenes, in each of which the capture and the painter may never end.
unsigned seconds_of(std::size_t scenes) {
  return std::min(60 + (5 + 2 * kRendererSeconds) * static_cast<unsigned>(std::min<std::size_t>(scenes, kMostSeconds)),
                  kMostSeconds);
}

std::vector<std::string> with_limits(std::vector<std::string> argv) {
  argv.insert(argv.end(), kLimits.begin(), kLimits.end());
  return argv;
}

std::string last_line(const fs::path& file) {
  std::istringstream in(text_of(file));
  std::string out;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) out = line;
  }
  return out.substr(0, 200);
}

}  // namespace

Judge::Judge(fs::path programs, fs::path scenes, fs::path out)
    : programs_(std::move(programs)), scenes_(std::move(scenes)), out_(std::move(out)) {
  fs::create_directories(out_);
  as_it_is_ = hashes(programs_, {scenes_.string()}, out_ / "scenes.tsv");
  const auto failed = std::ranges::find_if(as_it_is_.of, [](const auto& of) { return of.second.failed(); });
  if (!as_it_is_.stopped.empty() || as_it_is_.of.empty() || failed != as_it_is_.of.end()) {
    throw std::runtime_error(fmt::format("the scenes cannot be drawn by the sources as they are: {}{}",
                                         as_it_is_.stopped, failed == as_it_is_.of.end() ? "" : failed->first));
  }
}

// Throws where the scene fails without the change: its rows would say nothing of the change.
void Judge::require_held(const std::string& scene, const std::string& name) const {
  const fs::path text = out_ / (name + ".as_it_is.txt");
  if (run(with_limits({programs_ / "plumb", "check", scenes_ / (scene + ".json")}), text, seconds_of(1)).ok()) return;
  throw std::runtime_error(fmt::format("{} fails in the sources as they are: see {}", scene, text.string()));
}

SceneHashes Judge::hashes(const fs::path& programs, const std::vector<std::string>& of, const fs::path& file) const {
  std::vector<std::string> argv = {programs / "scene_hashes"};
  argv.insert(argv.end(), of.begin(), of.end());
  const Ended ended = run(argv, file, kMostSeconds);
  SceneHashes out;
  if (!ended.ok()) out.stopped = ending(ended);
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::string name, work, hash;
    if (!std::getline(fields, name, '\t') || !std::getline(fields, work, '\t')) continue;
    SceneHashes::Line& read = out.of[name];
    read.work = number_of(work, 10, file.string());
    while (std::getline(fields, hash, '\t')) read.hashes.push_back(hash);
  }
  return out;
}

Verdict Judge::judge(const fs::path& programs, const FileRule& rule, const std::string& reason,
                     const std::string& name) const {
  Verdict out;
  if (text_of(programs / "plumb") == text_of(programs_ / "plumb")) {
    out.outcome = Outcome::equivalent;
    out.note = "the compiler makes the same program of it";
    return out;
  }
  const SceneHashes changed = hashes(programs, {scenes_.string()}, out_ / (name + ".scenes.tsv"));
  std::vector<Affected> scenes = affected(as_it_is_, changed);
  out.affected = scenes.size();
  const bool unloaded = scenes.empty() && !changed.stopped.empty();  // scenes that cannot be loaded any more, say
  const bool same = scenes.empty() && !unloaded;
  if (scenes.empty()) {
    for (const auto& [scene, line] : as_it_is_.of) scenes.push_back({scene, false, unloaded});
  }
  if (same) {  // code that the references share may change theirs, and what is recorded is not all hashed
    find(programs, rule, scenes, name, out);
    if (out.found()) return out;
    out = Verdict();
    survive(programs, reason, name, out);
  } else {
    out.scene = scenes[0].scene;
    out.outcome = Outcome::goldens;
    find(programs, rule, scenes, name, out);
  }
  const bool data = rule.names[0] == "data" && !out.found() && out.outcome != Outcome::equivalent;
  if (data && !run({programs / "data_tests"}, out_ / (name + ".tables.txt"), kMostSeconds).ok()) {
    out.outcome = Outcome::tables;
    out.check.first = out.diagnose.first = "none";
  }
  return out;
}

void Judge::find(const fs::path& programs, const FileRule& rule, const std::vector<Affected>& scenes,
                 const std::string& name, Verdict& out) const {
  const fs::path json = out_ / (name + ".json"), text = out_ / (name + ".txt");
  const bool painter = rule.names[0] == "picture";
  const auto expect = [&](const Affected& a) {
    out.scene = a.scene;
    if (rule.names[0] == "any" || rule.names[0] == "data") return;
    out.expected = a.picture_alone ? std::vector<std::string>{"picture"} : rule.names;
    if (a.failed && !painter) out.expected.push_back("picture");
  };
  std::size_t from = 0;
  for (const std::size_t batch : kBatches) {
    const auto some = std::span(scenes).subspan(from, std::min(batch, scenes.size() - from));
    if (some.empty()) return;
    from += some.size();
    std::vector<std::string> argv = with_limits({programs / "plumb", "check", "--jobs", "1", "--json", json});
    for (const Affected& a : some) argv.push_back(scenes_ / (a.scene + ".json"));
    fs::remove(json);
    const Ended ended = run(argv, text, seconds_of(some.size()));
    if (!ended.how.empty() || ended.code > 1 || !fs::exists(json)) {
      out.outcome = Outcome::ended;
      expect(some[0]);
      out.check = out.diagnose = {"ended", ""};
      out.note = fmt::format("plumb check: {}: {}", ending(ended), last_line(text));
      return;
    }
    const std::map<std::string, Named> named = named_by_check(text_of(json));
    const auto seen = std::ranges::find_if(some, [&](const Affected& a) { return named.contains(a.scene); });
    if (seen == some.end()) continue;
    require_held(seen->scene, name);
    expect(*seen);
    out.check = named.at(seen->scene);
    out.outcome = out.check.first == "picture" ? Outcome::picture : Outcome::references;
    if (painter) {  // on no scene may another row fail
      const auto other = std::ranges::find_if(named, [](const auto& of) { return of.second.first != "picture"; });
      if (other != named.end()) out.check = other->second;
    }
    const Ended diagnosed =
        run(with_limits({programs / "plumb", "diagnose", scenes_ / (out.scene + ".json"), "--json", json}), text,
            seconds_of(1));
    out.diagnose = {"ended", ending(diagnosed)};
    if (diagnosed.how.empty() && diagnosed.code < 2) out.diagnose = named_by_diagnose(text_of(json));
    return;
  }
}

void Judge::survive(const fs::path& programs, const std::string& reason, const std::string& name, Verdict& out) const {
  std::call_once(random_drawn_, [&] { random_as_it_is_ = hashes(programs_, kRandomScenes, out_ / "random.tsv"); });
  const SceneHashes random = hashes(programs, kRandomScenes, out_ / (name + ".random.tsv"));
  const std::vector<Affected> scenes = affected(random_as_it_is_, random);
  if (!random.stopped.empty() || !random_as_it_is_.stopped.empty() || !scenes.empty()) {
    out.note = fmt::format("{} of 2,000 random scenes differ, the first: {}", scenes.size(),
                           scenes.empty() ? random.stopped : scenes[0].scene);
    return;
  }
  if (!reason.empty()) out.outcome = Outcome::equivalent;
  out.note = reason.empty() ? "2,000 random scenes have the same bits" : reason;
}

}  // namespace plumbline::mutation
