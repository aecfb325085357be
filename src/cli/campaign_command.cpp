// plumb campaign: random scenes by the thousand, judged; what is found is made small and sorted.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "base/atomic_path.h"
#include "base/temporary_path.h"
#include "campaign/entry_bytes.h"
#include "campaign/journal.h"
#include "campaign/results.h"
#include "cli/campaign_findings.h"
#include "cli/campaign_judge.h"
#include "cli/commands.h"
#include "cli/fingerprints.h"
#include "cli/judge_in_workers.h"
#include "cli/options/program_argument.h"
#include "cli/options/references.h"
#include "cli/options/say.h"
#include "cli/worker_bytes.h"

namespace plumbline::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMostSeeds = 1'000'000;  // of a process: their scenes' numbers take some 500 MB

struct Range {
  std::uint64_t first = 0, last = 0;
};

Range range_of(const std::string& text) {
  Range out;
  const std::size_t dots = text.find("..");
  const auto number = [](std::string_view digits, std::uint64_t& to) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), to);
    return error == std::errc() && end == digits.data() + digits.size() && !digits.empty();
  };
  const std::string_view all = text;
  if (dots == text.npos || !number(all.substr(0, dots), out.first) || !number(all.substr(dots + 2), out.last) ||
      out.first > out.last || out.last - out.first >= kMostSeeds) {
    throw std::invalid_argument(
        fmt::format("--seeds: expected FIRST..LAST, at most {} seeds, found {}", kMostSeeds, text));
  }
  return out;
}

std::vector<campaign::Generator> generators_of(const std::string& option) {
  std::vector<campaign::Generator> out;
  for (const campaign::Generator of : campaign::kGenerators) {
    const bool is_of_both =
        option == "both" && (of == campaign::Generator::ordinary || of == campaign::Generator::hard);
    if (is_of_both || option == name_of(of)) out.push_back(of);
  }
  return out;
}

// A scene for each seed and generator, in turn, so that the findings of both come evenly. `parents`: scenes of the
// round before, of which a seed picks one and changes it. Empty: the first round.
std::vector<campaign::SceneId> scenes_of(const Range& range, const std::string& generator,
                                         std::span<const campaign::SceneId> parents) {
  std::vector<campaign::SceneId> out;
  for (const campaign::Generator of : generators_of(generator)) {
    std::vector<campaign::SceneId> mine;
    std::ranges::copy_if(parents, std::back_inserter(mine),
                         [&](const campaign::SceneId& id) { return id.generator == of; });
    if (mine.empty() && !parents.empty()) continue;
    for (std::uint64_t seed = range.first;; ++seed) {
      out.push_back(mine.empty() ? campaign::SceneId{of, {}} : mine[seed % mine.size()]);
      out.back().seeds.push_back(seed);
      if (seed == range.last) break;
    }
  }
  std::ranges::stable_sort(out, {}, [](const campaign::SceneId& id) { return id.seeds.back(); });
  return out;
}

// Progress on stderr: a line that is written over on a terminal, elsewhere one a minute. New signatures go to stdout.
class ProgressLine {
 public:
  explicit ProgressLine(std::size_t scenes) : scenes_(scenes) {}
  void scene(const campaign::Entry& entry) {
    ++done_;
    for (const campaign::Signature& signature : entry.found) {
      ++found_;
      if (known_.insert(signature).second)
        fmt::print("{}{}: {}\n", terminal_ ? "\r\x1b[K" : "", to_string(entry.id), to_string(signature));
    }
    const auto now = Clock::now();
    if (now - last_ < (terminal_ ? std::chrono::milliseconds(200) : std::chrono::minutes(1))) return;
    last_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count(),
                 rate = static_cast<double>(done_) / seconds;
    fmt::print(stderr, "{}{} of {} scenes, {:.1f}/s, {} do not hold, {:.0f} s left{}", terminal_ ? "\r\x1b[K" : "",
               done_, scenes_, rate, found_, static_cast<double>(scenes_ - done_) / rate, terminal_ ? "" : "\n");
    std::fflush(stdout);
  }
  ~ProgressLine() {
    if (terminal_) fmt::print(stderr, "\r\x1b[K");
  }

 private:
  std::size_t scenes_, done_ = 0, found_ = 0;
  std::set<campaign::Signature> known_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  bool terminal_ = ::isatty(STDERR_FILENO) != 0;
};

void judge_scenes(std::span<const campaign::SceneId> scenes, const CheckRules& rules, campaign::Journal& journal) {
  const TemporaryPath scratch(temporary_files(), "plumb-campaign-", TemporaryPath::Kind::private_folder);
  std::vector<JudgeRequest> requests(scenes.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < scenes.size(); ++i) order.push_back(i), requests[i].scene = i;
  ProgressLine line(scenes.size());
  const auto make = [&](Progress& progress) -> Workers::Answer {
    const auto judge = std::make_shared<CampaignJudge>(rules, progress, scratch.path() / std::to_string(::getpid()));
    return [&, judge](const std::string& bytes) {
      JudgeRequest request = request_of(bytes);
      campaign::Entry out;
      if (request.not_compared.empty()) {
        out = judge->judge(scenes[request.scene], std::move(request.ended));
      } else {
        out.found = {{"none", "failed: the comparison " + request.not_compared, "comparison"}};
      }
      ByteWriter writer;
      visit(writer, out);
      return writer.done();
    };
  };
  const auto ask = [&](std::size_t i) { return to_bytes(requests[i]); };
  // A scene's first SIGKILL may be the kernel's, for lack of memory: the scene is judged again, and not blamed.
  std::set<std::size_t> killed;
  const auto ask_again = [&](std::size_t i, const WorkerEnd& end) {
    if (end.signal == SIGKILL && killed.insert(i).second) return to_bytes(requests[i]);
    (end.step == Progress::kBetween ? requests[i].not_compared : requests[i].ended[end.step]) = end.how;
    return to_bytes(requests[i]);
  };
  const auto took = [&](std::size_t i, const std::string& bytes) {
    campaign::Entry entry;
    ByteReader reader(bytes, nullptr);
    visit(reader, entry);
    entry.id = scenes[i];
    journal.add(entry);
    line.scene(entry);
  };
  Workers(worker_count(rules.options, scenes.size()), rules.options.limits, make).run({order, ask, took, ask_again});
}

std::string journal_name(const CampaignOptions& o, const Range& range) {
  const std::string round = o.round > 1 ? fmt::format("round{}-", o.round) : "";
  return fmt::format("{}{}-{}-{}.journal", round, o.generator, range.first, range.last);
}

std::vector<fs::path> journals_in(const fs::path& folder) {
  std::vector<fs::path> out;
  if (!fs::exists(folder)) return out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".journal") out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

// How long to wait for a journal that another process holds: it may only be reading.
constexpr std::chrono::seconds kReading{10};

// The journal, which another process may have for a moment, or for long: then a note says what is waited for.
campaign::Journal opened(const fs::path& file, const std::string& terms) {
  try {
    return campaign::Journal(file, terms, std::chrono::milliseconds(500));
  } catch (const campaign::JournalInUse&) {
    say(fmt::format("note: {}: in use by another process: waiting {} for it", file.string(), kReading));
  }
  return campaign::Journal(file, terms, kReading);
}

// Entries of the folder's journals but `mine`; a journal that another process has is left out, with a note. Without
// `mine`, all journals: throws JournalInUse.
std::vector<std::vector<campaign::Entry>> entries_in(const fs::path& folder, const std::string& terms,
                                                     const fs::path& mine = {}) {
  std::vector<std::vector<campaign::Entry>> out;
  const auto until = Clock::now() + kReading;
  for (const fs::path& file : journals_in(folder)) {
    if (file == mine) continue;
    try {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
      const std::chrono::milliseconds wait =
          std::clamp(left, std::chrono::milliseconds(0), std::chrono::milliseconds(500));
      out.push_back(campaign::Journal(file, terms, wait).entries());
    } catch (const campaign::JournalInUse&) {
      if (mine.empty()) throw;
      say(fmt::format("note: {}: in use by another campaign: its scenes may be judged twice", file.string()));
    }
  }
  return out;
}

// Scenes of a round, from its results and those of the rounds before. Throws JournalInUse while one is judged.
std::string lines_of_kept(std::size_t round, const fs::path& folder, const std::string& terms) {
  std::vector<std::vector<campaign::Entry>> journals;
  for (const fs::path& file : journals_in(folder)) {
    journals.push_back(opened(file, terms).entries());
    std::erase_if(journals.back(), [&](const campaign::Entry& e) { return e.id.seeds.size() > round; });
  }
  campaign::Results results = campaign::merged(journals);
  std::string out;
  for (const campaign::SceneId& id : results.kept[round]) out += to_string(id) + "\n";
  if (out.empty())
    throw std::invalid_argument(fmt::format("--round {}: expected results of round {}, found none", round + 1, round));
  return out;
}

// The scenes of a round that the next one changes: a line for each in `folder`/rounds/ROUND.txt, which is written once.
// All processes of the next round read the same.
std::vector<campaign::SceneId> kept_of(std::size_t round, const fs::path& folder, const std::string& terms) {
  const fs::path file = folder / "rounds" / fmt::format("{}.txt", round);
  if (!fs::exists(file)) {
    const std::string lines = lines_of_kept(round, folder / "journal", terms);
    fs::create_directories(file.parent_path());
    write_file(file, lines);
  }
  std::vector<campaign::SceneId> out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    try {
      out.push_back(campaign::scene_id_of(line));
    } catch (const std::invalid_argument& bad) {
      throw std::invalid_argument(fmt::format("{}: line {}: {}", file.string(), out.size() + 1, bad.what()));
    }
  }
  if (out.empty()) throw std::invalid_argument(fmt::format("{}: expected scenes, found none", file.string()));
  return out;
}

// Scenes of the options' seeds, generator and round.
std::vector<campaign::SceneId> scenes_of(const CampaignOptions& o, const std::string& terms) {
  const Range range = range_of(o.seeds);
  std::vector<campaign::SceneId> out = scenes_of(
      range, o.generator, o.round > 1 ? kept_of(o.round - 1, o.folder, terms) : std::vector<campaign::SceneId>());
  if (out.empty()) {
    throw std::invalid_argument(fmt::format("--round {}: expected {} scenes that round {} keeps, found none", o.round,
                                            o.generator, o.round - 1));
  }
  return out;
}

// Each file is written in a temporary folder and renamed, so that it appears whole: write_file() would scan the folder,
// with its thousands of files, for each.
void write_scenes(const CampaignOptions& o, const std::string& terms) {
  const std::vector<campaign::SceneId> scenes = scenes_of(o, terms);
  const fs::path folder = o.folder;
  std::error_code error;
  for (const campaign::Generator of : generators_of(o.generator)) {
    fs::create_directories(folder / name_of(of), error);
    if (error) throw OutputError(folder / name_of(of), error.message());
  }
  const TemporaryPath scratch(folder, ".plumb-", TemporaryPath::Kind::private_folder);
  for (const campaign::SceneId& id : scenes) {
    const fs::path file = folder / (to_string(id) + ".json"), written = scratch.path() / "scene.json";
    std::ofstream out(written, std::ios::binary);
    out << campaign::scene_text(id);
    out.close();
    if (out) fs::rename(written, file, error);
    if (!out || error) throw OutputError(file, out ? error.message() : "the device is full, or refuses");
  }
}

// Writes terms.txt if absent; refuses other terms than it holds. (Journals have terms, too, but one that another
// process holds cannot be read.)
void require_terms(const fs::path& journals, const std::string& terms) {
  const fs::path file = journals / "terms.txt";
  if (!fs::exists(file)) write_file(file, terms + "\n");
  std::ifstream in(file);
  const std::string its{std::istreambuf_iterator<char>(in), {}};
  if (its == terms + "\n") return;
  throw std::invalid_argument(fmt::format(
      "{}: expected a journal of this campaign ({}), found one of {}: take another folder, or delete this one",
      file.string(), terms, its.substr(0, its.find_last_not_of('\n') + 1)));
}

// Checks, before the work, that results.json and the findings can be written at its end.
void require_results(const fs::path& folder) {
  require_writable_file(folder / "results.json");
  const fs::path findings = folder / "findings";
  if (fs::exists(findings) && !fs::is_directory(findings)) throw OutputError(findings, "it is no folder");
}

// Judges the scenes that no journal of the folder holds, into the journal of the options' range.
void judge_range(const CampaignOptions& o, const CheckRules& rules, const fs::path& journals,
                 const std::string& terms) {
  const Range range = range_of(o.seeds);
  std::vector<campaign::SceneId> scenes = scenes_of(o, terms);
  std::error_code error;
  fs::create_directories(journals, error);
  if (error) throw OutputError(journals, error.message());
  if (!o.judge_only) require_results(o.folder);
  const fs::path file = journals / journal_name(o, range);
  const auto of_others = entries_in(journals, terms, file);  // a journal of other terms is refused before there is ours
  require_terms(journals, terms);
  campaign::Journal journal = opened(file, terms);
  std::set<campaign::SceneId> judged = journal.judged();
  for (const auto& of_other : of_others) {
    for (const campaign::Entry& entry : of_other) judged.insert(entry.id);
  }
  std::erase_if(scenes, [&](const campaign::SceneId& id) { return judged.contains(id); });
  judge_scenes(scenes, rules, journal);
}

// Folders of the images that ordinary scenes name: beside an installed program, or in the project that it was built in.
std::vector<std::string> with_suite_images(std::vector<std::string> assets) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* from_program : {"../share/plumbline/scenes/texture", "../../tests/scenes/texture"}) {
    const fs::path folder = (program / from_program).lexically_normal();
    if (fs::is_directory(folder)) assets.push_back(folder.string());
  }
  return assets;
}

}  // namespace

int campaign(const CampaignOptions& o) {
  CheckRules rules{o.judging, std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())};
  rules.names_causes = false;  // but of findings, once each (leave_findings)
  rules.options.cache.clear();
  rules.options.against = without_repeats(rules.options.against);
  rules.options.scene_arguments.assets = with_suite_images(o.judging.scene_arguments.assets);
  if (!rules.options.candidate.command.empty()) require_program(rules.options.candidate);
  const std::string& fault = rules.options.fault;
  make_candidate(faulted_reference(fault).empty() ? fault : "");  // refuses an unknown fault
  const std::string terms = campaign_fingerprint(rules.options);
  const fs::path folder = o.folder, journals = folder / "journal";
  if (o.write) {
    write_scenes(o, terms);
    const std::vector<std::string>& assets = rules.options.scene_arguments.assets;
    const bool writes_ordinary = o.generator == "both" || o.generator == name_of(campaign::Generator::ordinary);
    if (writes_ordinary && !assets.empty())
      say(fmt::format("note: images that ordinary scenes name are found by --assets {}", fmt::join(assets, " ")));
    return kHolds;
  }
  if (!o.seeds.empty()) judge_range(o, rules, journals, terms);
  if (o.judge_only) return kHolds;
  if (!fs::is_directory(journals)) {
    throw std::invalid_argument(fmt::format("{}: expected the folder of a campaign, found no journal", o.folder));
  }
  require_results(folder);
  const campaign::Results results = campaign::merged(entries_in(journals, terms));
  if (results.held == 0 && results.found.empty() && results.conflicts.empty()) {
    fmt::print("{}", text_of(results));
    throw std::invalid_argument(fmt::format("{}: expected a scene that could be judged, found none", o.folder));
  }
  const std::string findings = leave_findings(folder / "findings", results.found, rules);
  write_file(folder / "results.json", json_of(results, terms));
  std::vector<std::string> mistakes = not_accepted(conventions_of(rules.options.candidate.conventions));
  for (std::string& line : mistakes) line += '\n';
  fmt::print("{}{}{}{}judging: {:.1f} ms a scene\n", findings, text_of(results), fmt::join(mistakes, ""),
             rules.options.candidate.command.empty() ? "" : convention_notes(rules.options.candidate.conventions),
             results.milliseconds / static_cast<double>(std::max<std::uint64_t>(results.scenes(), 1)));
  return results.found.empty() && results.conflicts.empty() && mistakes.empty() ? kHolds : kDiffers;
}

}  // namespace plumbline::cli
