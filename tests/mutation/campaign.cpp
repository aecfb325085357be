#include "mutation/campaign.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "mutation/fields.h"
#include "mutation/kept.h"
#include "mutation/tree.h"

namespace plumbline::mutation {

namespace {

namespace fs = std::filesystem;

// A queue between the one that compiles and those that judge.
class Compiled {
 public:
  explicit Compiled(std::size_t most) : most_(most) {}
  void put(Judged judged) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_.size() < most_; });
    waiting_.push_back(std::move(judged));
    changed_.notify_all();
  }
  void end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  std::optional<Judged> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !waiting_.empty() || ended_; });
    if (waiting_.empty()) return std::nullopt;
    Judged out = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    return out;
  }

 private:
  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Judged> waiting_;
  bool ended_ = false;
};

std::string name_of(const Judged& j) { return fmt::format("{}_{}", j.seed, j.number); }

std::string reason_of(const Judged& j, const std::vector<Equivalent>& equivalents) {
  const auto found = std::ranges::find_if(equivalents, [&](const Equivalent& e) {
    return e.file == j.change.file && e.before == j.lines.before && e.after == j.lines.after;
  });
  return found == equivalents.end() ? "" : found->reason;
}

}  // namespace

std::vector<Judged> changes_of_seed(const fs::path& root, const std::vector<FileRule>& rules, const std::string& seed) {
  const std::map<std::string, std::string> sources = sources_of(root, rules);
  Draw draw(sources, rules, number_of(seed, 16, "the seed"));
  std::vector<Judged> out;
  for (Judged next; draw.next(next.change);) {
    next.seed = seed;
    next.number = out.size() + 1;
    next.lines = lines_of(sources.at(next.change.file), next.change);
    next.rule = rule_of(rules, next.change.file, next.change.function);
    out.push_back(next);
  }
  return out;
}

std::vector<Judged> run_campaign(const CampaignOptions& options, const std::vector<FileRule>& rules,
                                 const std::function<void(const Judged&)>& took) {
  const fs::path table = options.root / "tests/mutation/equivalent.tsv";
  const std::vector<Equivalent> equivalents = read_equivalents(table);
  Tree tree(options.root, options.out, options.workers);
  tree.copy_programs(options.out / "as_it_is");
  const std::map<ChangeKey, Verdict> known_verdicts =
      options.keep.empty() ? std::map<ChangeKey, Verdict>{} : read_found(options.keep, sources_hash(options.root));
  const Judge judge(options.out / "as_it_is", tree.source() / "tests/scenes", options.out / "rows");
  Compiled compiled(options.workers + 1);
  std::vector<Judged> done;
  std::mutex mutex;
  const auto take = [&](Judged j) {
    const std::lock_guard lock(mutex);
    took(j);
    done.push_back(std::move(j));
  };
  const auto judge_one = [&](Judged j) {
    const fs::path programs = options.out / "programs" / name_of(j);
    j.verdict = judge.judge(programs, *j.rule, reason_of(j, equivalents), name_of(j));
    fs::remove_all(programs);
    take(std::move(j));
  };
  std::vector<std::exception_ptr> errors(options.workers);
  std::vector<std::jthread> judges;
  for (unsigned i = 1; i < options.workers; ++i) {
    judges.emplace_back([&, i] {
      try {
        while (std::optional<Judged> next = compiled.take()) judge_one(std::move(*next));
      } catch (...) {
        errors[i] = std::current_exception();
        while (compiled.take()) {  // the one that compiles must not wait for ever
        }
      }
    });
  }
  const auto start = std::chrono::steady_clock::now();
  const auto late = [&] {
    return options.minutes && std::chrono::steady_clock::now() - start > std::chrono::minutes(*options.minutes);
  };
  std::set<std::tuple<std::string, std::string, std::string>> known;  // two seeds may draw the same
  try {
    for (const std::string& seed : options.seeds) {
      std::size_t count = 0;
      for (const Judged& j : changes_of_seed(tree.source(), rules, seed)) {
        if (count == options.changes || late()) break;
        if (options.only && j.number != *options.only) continue;
        if (!known.emplace(j.change.file, j.lines.before, j.lines.after).second) continue;
        const auto found = known_verdicts.find(key_of(j));
        const auto is_settled = [&](const Verdict& v) { return v.found() || v.note == reason_of(j, equivalents); };
        if (found != known_verdicts.end() && is_settled(found->second)) {
          ++count;
          Judged kept = j;
          kept.verdict = found->second;
          take(std::move(kept));
          continue;
        }
        if (!tree.build_changed(j.change, options.out / "programs" / name_of(j))) continue;
        ++count;
        options.workers > 1 ? compiled.put(j) : judge_one(j);
      }
    }
  } catch (...) {
    errors[0] = std::current_exception();
  }
  compiled.end();
  judges.clear();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
  std::ranges::sort(done, {}, [&](const Judged& j) {
    return std::pair(std::ranges::find(options.seeds, j.seed) - options.seeds.begin(), j.number);
  });
  return done;
}

}  // namespace plumbline::mutation
