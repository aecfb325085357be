#include "cli/campaign_findings.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "base/atomic_path.h"
#include "base/temporary_path.h"
#include "cli/campaign_judge.h"
#include "cli/check_failures.h"
#include "cli/judge_in_workers.h"
#include "report/text/conformance.h"

namespace plumbline::cli {

namespace {

namespace fs = std::filesystem;

// A name for a folder: letters and digits, and one - for all else.
std::string slug(const std::string& text) {
  std::string out;
  for (const char given : text) {
    const char c = given >= 'A' && given <= 'Z' ? static_cast<char>(given - 'A' + 'a') : given;
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    if (plain) out += c;
    if (!plain && !out.empty() && out.back() != '-') out += '-';
  }
  while (out.ends_with('-')) out.pop_back();
  return out.substr(0, 120);
}

struct Finding {
  const campaign::Group* group;
  fs::path folder;
  std::string found;  ///< the scene as it was found
};

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool has_bytes(const fs::path& file) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(file, none);
  return !none && size > 0;
}

// Findings whose folder is missing, incomplete, or of another scene than the group's lowest.
std::vector<Finding> unfinished_findings(const fs::path& folder, const std::vector<campaign::Group>& groups) {
  std::set<std::string> names;
  std::vector<Finding> out;
  for (const campaign::Group& group : groups) {
    const auto& [stage, cause, reference] = group.signature;
    std::string name = slug(fmt::format("{}-{}-{}", stage, cause, reference));
    while (!names.insert(name).second) name += "-2";
    Finding finding{&group, folder / name, campaign::scene_text(group.first.front())};
    const bool whole = has_bytes(finding.folder / "scene.txt") && has_bytes(finding.folder / "scene.json");
    if (!whole || read(finding.folder / "found.json") != finding.found) out.push_back(std::move(finding));
  }
  return out;
}

// Writes found.json and scene.json of each finding. Where a worker ends while it shrinks a scene, scene.json is the
// scene as it was found.
void leave_smallest(const std::vector<Finding>& findings, const CheckRules& rules) {
  constexpr std::string_view kAsFound = "as found";
  std::vector<std::size_t> order(findings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const TemporaryPath scratch(temporary_files(), "plumb-campaign-", TemporaryPath::Kind::private_folder);
  const auto make = [&](Progress& progress) -> Workers::Answer {
    const auto judge = std::make_shared<CampaignJudge>(rules, progress, scratch.path() / std::to_string(::getpid()));
    return [&, judge](const std::string& number) {
      if (number == kAsFound) return std::string();
      const campaign::Group& of = *findings[std::stoul(number)].group;
      return judge->shrink(of.first.front(), of.signature);
    };
  };
  const auto ask = [](std::size_t i) { return std::to_string(i); };
  const auto ask_again = [&](std::size_t, const WorkerEnd&) { return std::string(kAsFound); };
  const auto took = [&](std::size_t i, const std::string& smallest) {
    const Finding& of = findings[i];
    const fs::path found = of.folder / "found.json", file = of.folder / "scene.json";
    fs::create_directories(of.folder);
    fs::remove(of.folder / "scene.txt");  // which is written last
    const OutputFile files[] = {{found, of.found}, {file, smallest.empty() ? of.found : smallest}};
    write_files(files);
  };
  Workers(worker_count(rules.options, findings.size()), rules.options.limits, make).run({order, ask, took, ask_again});
}

// Line for people about a finding whose scene holds, or cannot be judged, when judged again.
std::string not_repeated(const check::SceneVerdict& verdict, const campaign::Signature& found) {
  const bool is_unable = report::conformance_of(verdict) == report::Conformance::unable;
  return fmt::format("not repeated {}: {}; judged again, {}: it came of scenes drawn before, or of chance\n",
                     verdict.path, to_string(found), is_unable ? "nothing can be judged" : "nothing is wrong");
}

}  // namespace

std::string leave_findings(const fs::path& folder, const std::vector<campaign::Group>& groups,
                           const CheckRules& rules) {
  const std::vector<Finding> findings = unfinished_findings(folder, groups);
  if (findings.empty()) return "";
  leave_smallest(findings, rules);
  std::vector<Scene> scenes;
  for (const Finding& finding : findings) {
    scenes.push_back(rules.options.scene_arguments.load(finding.folder / "scene.json"));
  }
  CheckRules with_pages{rules.options, rules.today};
  with_pages.options.failures = folder.string();
  std::set<std::string> words;
  std::string out;
  judge_in_workers(scenes, with_pages, words, [&](const JudgedScene& judged) {
    if (judged.failure.empty()) {
      const auto of = std::ranges::find(scenes, judged.verdict.path, &Scene::path) - scenes.begin();
      const std::string line = not_repeated(judged.verdict, findings.at(static_cast<std::size_t>(of)).group->signature);
      leave_rows(folder.string(), judged.verdict, line, "not repeated");
      out += line;
      return;
    }
    leave_rows(folder.string(), judged.verdict, judged.failure);
    out += judged.failure;
    for (const std::string& cause : judged.verdict.causes) out += fmt::format("  likely: {}\n", cause);
  });
  return out;
}

}  // namespace plumbline::cli
