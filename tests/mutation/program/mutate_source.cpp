// Random changes of the sources, and who sees them: exit 0 where what must hold holds, 1 where it does not, 2 on bad
// usage, or where the sources as they are do not hold.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "mutation/campaign.h"
#include "mutation/kept.h"

int main(int argc, char** argv) {
  using namespace plumbline::mutation;
  CLI::App app("Random changes of the sources: does plumb check see them, and name the right stage?");
  CampaignOptions options;
  options.root = PLUMBLINE_SOURCE_DIR;
  options.out = options.root / "build/mutants_source";
  options.workers = std::max(1u, std::thread::hardware_concurrency());
  bool list = false;
  app.add_option("seeds", options.seeds, "hexadecimal")->required();
  app.add_option("--changes", options.changes, "that compile, of each seed");
  app.add_option("--number", options.only, "only the seed's change of this number");
  app.add_option("--minutes", options.minutes, "after which no other change is begun");
  app.add_option("--keep", options.keep, "a log of the same sources, of which only what was not found is judged again")
      ->check(CLI::ExistingFile);
  app.add_option("--workers", options.workers, "threads")->check(CLI::Range(1u, 64u));
  app.add_option("--out", options.out, "the folder in which the changed sources are built");
  app.add_flag("--list", list, "prints the changes, and builds none");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  try {
    const std::vector<FileRule> rules = read_file_rules(options.root / "tests/mutation/files.tsv");
    if (list) {
      for (const std::string& seed : options.seeds) {
        std::vector<Judged> changes = changes_of_seed(options.root, rules, seed);
        changes.resize(std::min(changes.size(), options.changes));
        for (const Judged& j : changes) fmt::print("{}\n", description(j));
      }
      return 0;
    }
    const auto start = std::chrono::steady_clock::now();
    const std::string head = log_head(sources_hash(options.root));
    std::vector<Judged> so_far;
    const auto took = [&](const Judged& j) {
      fmt::print("{}\n    {}\n", description(j), outcome_line(j));
      std::fflush(stdout);
      so_far.push_back(j);
      std::ofstream(options.out / "changes.tsv") << head << log_of(so_far);
    };
    const std::vector<Judged> judged = run_campaign(options, rules, took);
    fmt::print("{}in {:.0f} min; every change: {}\n", report_of(judged),
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / 60,
               (options.out / "changes.tsv").string());
    return holds(score_of(judged)) ? 0 : 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "mutate_source: {}\n", e.what());
    return 2;
  }
}
