// plumb golden: what we draw against what was blessed, and blessing.
#include <algorithm>
#include <chrono>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_path.h"
#include "capture/files/image_file.h"
#include "capture/same_bits.h"
#include "check/diagnose/diagnose.h"
#include "check/golden/golden.h"
#include "cli/commands.h"
#include "cli/options/outputs.h"
#include "cli/options/references.h"
#include "report/page/golden_page.h"
#include "report/text/diagnosis_text.h"
#include "scene/file/scene_file.h"

namespace plumbline::cli {

namespace {

namespace fs = std::filesystem;

// A diagnosis takes as long as a hundred goldens: of a change that breaks all of them a few tell the cause.
constexpr std::size_t kMostDiagnosed = 3;

struct Suite {
  std::vector<Scene> scenes;
  std::vector<fs::path> files;
  bool whole = false;            // no scenes were named: goldens without a scene are orphans
  std::set<std::string> groups;  // groups whose goldens may be orphans, where --suite is a group; empty: all
};

Suite load(const GoldenOptions& o) {
  Suite out;
  out.whole = o.scenes.empty();
  const std::vector<fs::path> paths =
      out.whole ? std::vector<fs::path>{o.suite} : std::vector<fs::path>(o.scenes.begin(), o.scenes.end());
  out.files = find_scenes(paths);
  if (out.whole && !fs::is_directory(o.suite)) {
    throw SceneError(fmt::format("--suite {}: expected a folder; scenes are named without it", o.suite));
  }
  out.scenes = o.scene_arguments.load(
      out.files, [](const Scene& scene) { require_budget(scene, plane_bytes(scene), Request{}.memory_budget); });
  std::set<std::string> names;
  for (const Scene& scene : out.scenes) {
    if (!names.insert(scene.name).second)
      throw SceneError(fmt::format("{}: expected scenes of different names, found {} twice", scene.path, scene.name));
  }
  const auto lies_in_suite = [&](const fs::path& file) { return fs::equivalent(file.parent_path(), o.suite); };
  if (out.whole && std::ranges::any_of(out.files, lies_in_suite)) {
    for (const Scene& scene : out.scenes) out.groups.insert(check::group_of(scene.name));
  }
  return out;
}

std::vector<std::string> orphans(const Suite& suite, const check::GoldenManifest& manifest) {
  std::vector<std::string> out;
  for (const auto& golden : manifest.scenes) {
    const std::string& name = golden.first;
    const auto has_name = [&](const Scene& scene) { return scene.name == name; };
    const bool asked = suite.whole && (suite.groups.empty() || suite.groups.contains(check::group_of(name)));
    if (asked && std::ranges::none_of(suite.scenes, has_name)) out.push_back(name);
  }
  return out;
}

std::string command(const GoldenOptions& o, const std::string& verb, const std::string& scene) {
  std::string out = fmt::format("{} golden {} {}", shell_word(o.program), verb, shell_word(scene));
  if (o.golden != GoldenOptions{}.golden) out += " --golden " + shell_word(o.golden);
  if (!o.fault.empty()) out += " --fault " + shell_word(o.fault);
  return out + o.scene_arguments.repeated();
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int golden_check(const GoldenOptions& o) {
  const auto start = std::chrono::steady_clock::now();
  const Suite suite = load(o);
  const check::GoldenSet goldens(o.golden, check::GoldenSet::Access::read);
  const std::unique_ptr<Renderer> candidate = make_candidate(o.fault);
  std::vector<const Scene*> wrong;
  std::size_t failures = 0;
  for (const Scene& scene : suite.scenes) {
    const check::GoldenDifference difference = check::compare_golden(scene, *candidate, goldens);
    if (!difference.any()) continue;
    ++failures;
    if (difference.why.empty()) wrong.push_back(&scene);
    fmt::print("different {}\n{}  repeat: {}\n", scene.name, describe(difference), command(o, "check", scene.path));
    std::fflush(stdout);
  }
  for (const std::string& name : orphans(suite, goldens.manifest())) {
    ++failures;
    fmt::print("orphan {}: a golden of a scene that is not there: scripts/regenerate_goldens removes it\n", name);
  }
  const check::GoldenSet::Strays strays = goldens.strays();
  for (const std::string& file : strays.others) {
    ++failures;
    fmt::print("extra {}: a file that the manifest does not name: remove it\n", (fs::path(o.golden) / file).string());
  }
  if (!strays.leftovers.empty()) {
    fmt::print("{} files are left of an update that was killed, such as {}: the next one removes them\n",
               strays.leftovers.size(), strays.leftovers[0]);
  }
  const std::string summary =
      fmt::format("{}: {} scenes against their goldens in {:.1f} s, {} failures\n", failures == 0 ? "ok" : "FAILED",
                  suite.scenes.size(), seconds_since(start), failures);
  if (!wrong.empty()) {
    const References references = make_references(reference_names(), o.scene_arguments.assets);
    for (const Scene* scene : std::span(wrong).first(std::min(wrong.size(), kMostDiagnosed))) {
      fmt::print("\n{}: what the references say of it\n{}", scene->path,
                 report::diagnosis_text(check::diagnose(*scene, *candidate, references.list)));
      std::fflush(stdout);
    }
    if (wrong.size() > kMostDiagnosed) {
      fmt::print("\n{} more differ; each has its diagnosis alone: {}\n", wrong.size() - kMostDiagnosed,
                 command(o, "check", wrong[kMostDiagnosed]->path));
    }
    fmt::print("\nIf the change is meant: scripts/regenerate_goldens, which asks the references.\n");
  }
  fmt::print("{}", summary);
  return failures == 0 ? kHolds : kDiffers;
}

namespace {

// A golden's difference, and whether the references vouch for the new picture.
struct Asked {
  check::GoldenDifference difference;
  check::Vouch vouch;
};

// The references' answer to a picture that is not its golden's.
Asked ask(const Scene& scene, Renderer& candidate, const References& references, const std::string& fault,
          check::GoldenDifference difference) {
  const std::string ours = candidate.info().name;
  check::BothCaptures drawn;
  const check::SceneVerdict verdict = check::judge(scene, candidate, references.list, &drawn);
  check::Vouch vouch = check::vouch(verdict, ours, reference_names());
  if (!fault.empty()) vouch.refusals.push_back(fmt::format("drawn with the fault {}: never blessed", fault));
  const Planes& judged = drawn.candidate.planes;
  if (!have_same_bits(judged.color, difference.drawn.color) || !have_same_bits(judged.depth, difference.drawn.depth)) {
    vouch.refusals.push_back(fmt::format("{} drew another picture when it was judged", ours));
  }
  return {std::move(difference), std::move(vouch)};
}

void print(const Scene& scene, const std::string& says, const Asked& asked) {
  fmt::print("{} {}\n{}", says, scene.name, describe(asked.difference));
  for (const std::string& refusal : asked.vouch.refusals) fmt::print("  because of {}\n", refusal);
  if (asked.vouch.refusals.empty()) fmt::print("  vouched for by {}\n", fmt::join(asked.vouch.by, ", "));
  for (const std::string& dispute : asked.vouch.disputed) fmt::print("  disputed: {}\n", dispute);
  std::fflush(stdout);
}

}  // namespace

namespace {

// Makes a folder; the destructor removes it if it was new and is still empty.
class UsedFolder {
 public:
  explicit UsedFolder(fs::path folder) : folder_(std::move(folder)), is_new_(fs::create_directories(folder_)) {}
  ~UsedFolder() {
    std::error_code not_empty;
    if (is_new_) fs::remove(folder_, not_empty);
  }
  UsedFolder(const UsedFolder&) = delete;
  UsedFolder& operator=(const UsedFolder&) = delete;

 private:
  fs::path folder_;
  bool is_new_;
};

}  // namespace

int golden_update(const GoldenOptions& o) {
  const auto start = std::chrono::steady_clock::now();
  const Suite suite = load(o);
  std::optional<UsedFolder> folder;
  if (!o.check) {
    folder.emplace(o.golden);
    require_writable_file(fs::path(o.golden) / "manifest.json");
  }
  check::GoldenSet goldens(o.golden, check::GoldenSet::Access::update);
  const std::size_t orphaned = orphans(suite, goldens.manifest()).size(), all = goldens.manifest().scenes.size();
  if (orphaned > 10 && 2 * orphaned > all) {
    throw SceneError(fmt::format("--suite {}: expected the scenes of {}, found no scene for {} of its {} goldens",
                                 o.suite, o.golden, orphaned, all));
  }
  std::optional<report::GoldenPage> page;
  if (!o.report.empty()) page.emplace(o.report);
  const std::unique_ptr<Renderer> candidate = make_candidate(o.fault);
  std::optional<References> references;  // starting them takes longer than a look at all goldens
  check::GoldenManifest next = goldens.manifest();
  std::map<std::string, std::string> files, versions;
  std::size_t written = 0, refused = 0, removed = 0;
  for (const Scene& scene : suite.scenes) {
    check::GoldenDifference difference = check::compare_golden(scene, *candidate, goldens);
    if (!difference.any()) continue;
    if (!references) {
      references = make_references(reference_names(), o.scene_arguments.assets);
      versions = versions_of(*candidate, *references);
      versions["OpenImageIO"] = image_library_version();
      next.versions[check::key_of(versions)] = versions;
    }
    Asked asked = ask(scene, *candidate, *references, o.fault, std::move(difference));
    const bool granted = asked.vouch.refusals.empty();
    const std::string says = !granted ? "refused" : o.check ? "would be written" : "accepted";
    print(scene, says, asked);
    if (page) page->add(scene, says, asked.difference, asked.vouch);
    ++(granted ? written : refused);
    if (!granted) continue;
    check::Golden golden = check::make_golden(scene, asked.difference.drawn, files);
    golden.producer = candidate->info().name + " " + candidate->info().version;
    golden.versions = check::key_of(versions);
    golden.references = std::move(asked.vouch.references);
    golden.vouched = std::move(asked.vouch.by);
    golden.disputed = std::move(asked.vouch.disputed);
    next.scenes[scene.name] = std::move(golden);
  }
  for (const std::string& name : orphans(suite, goldens.manifest())) {
    fmt::print("{} {}: its scene is not there\n", o.check ? "would be removed" : "removed", name);
    next.scenes.erase(name);
    ++removed;
  }
  const bool change = written + removed > 0;
  if (!o.check && change) goldens.write(std::move(next), files);
  if (!o.check && !change) goldens.remove_leftovers();
  const std::vector<std::string> extra = goldens.strays().others;
  for (const std::string& file : extra) {
    fmt::print("extra {}: a file that the manifest does not name, and that is not ours to remove: remove it\n",
               (fs::path(o.golden) / file).string());
  }
  const std::string summary = fmt::format("{}: {} scenes in {:.1f} s, {} goldens {}, {} refused, {} removed\n",
                                          refused > 0 ? "REFUSED"
                                          : !change   ? "nothing to write"
                                          : o.check   ? "would write"
                                                      : "written: look at them, then commit",
                                          suite.scenes.size(), seconds_since(start), written,
                                          o.check ? "to write" : "written", refused, removed);
  if (page) page->write(summary);
  fmt::print("{}", summary);
  return change || refused > 0 || !extra.empty() ? kDiffers : kHolds;
}

}  // namespace plumbline::cli
