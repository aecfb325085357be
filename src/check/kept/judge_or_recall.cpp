#include "check/kept/judge_or_recall.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <system_error>
#include <utility>

#include "check/kept/traced_renderer.h"
#include "check/verdict/verdict_bytes.h"

namespace plumbline::check {

namespace {

struct Kept {
  std::vector<TracedCall> calls;
  SceneVerdict verdict;
};
template <class Archive>
void visit(Archive& archive, Kept& kept) {
  visit_all(archive, kept.calls, kept.verdict);
}

template <class T>
std::string to_bytes(T value) {
  ByteWriter writer;
  visit(writer, value);
  return writer.done();
}

Hash key_of(const Scene& scene, std::span<const Reference> references, const std::string& judges) {
  Hasher hasher;
  hasher.add_text(judges);
  hasher.add_text(scene.name);
  hasher.add_text(scene.path);
  hasher.add_value(scene_hash(scene));
  for (const Reference& reference : references) {
    hasher.add_text(reference.name);
    if (reference.renderer != nullptr) hasher.add_value(hash_of(reference.renderer->info()));
  }
  return hasher.done();
}

bool was_read_from_its_files(const Scene& scene, std::filesystem::file_time_type began) {
  return std::ranges::all_of(scene.files, [&](const std::string& file) {
    std::error_code gone;
    return std::filesystem::last_write_time(file, gone) < began && !gone;
  });
}

std::optional<Kept> find(const VerdictStore& store, const Hash& key, std::set<std::string>& words) {
  const std::optional<std::string> bytes = store.find(key);
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes, &words);
  Kept out;
  visit(reader, out);
  return out;
}

bool is_kept(const SceneVerdict& verdict) {
  return std::ranges::none_of(verdict.comparisons, [](const Comparison& c) { return is_failure(c.outcome); });
}

std::string without_time(SceneVerdict verdict) {
  verdict.seconds = 0;
  return to_bytes(std::move(verdict));
}

}  // namespace

bool tried_at_random(double seconds) {
  static std::mt19937_64 random{std::random_device{}()};
  constexpr double kShare = 1.0 / 64;
  return std::bernoulli_distribution(kShare / std::max(seconds, 1.0))(random);
}

SceneVerdict judge_or_recall(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                             KeptVerdicts& kept, BothCaptures* drawn, std::span<const Reference> arbiters) {
  const auto judge_as = [&](Renderer& drawing) {
    return judge(scene, drawing, references, drawn, ~std::uint64_t{0}, arbiters);
  };
  if (!was_read_from_its_files(scene, kept.began)) return judge_as(candidate);
  const auto start = std::chrono::steady_clock::now();
  const Hash key = key_of(scene, references, kept.judges);
  std::optional<Kept> before = find(kept.store, key, kept.words);
  TracedRenderer traced(scene, candidate);
  if (before && !traced.answers_as_before(before->calls)) before.reset();
  if (before && !kept.is_tried(before->verdict.seconds)) {
    before->verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(before->verdict);
  }
  SceneVerdict verdict = judge_as(traced);
  if (before && without_time(before->verdict) != without_time(verdict)) {
    kept.store.forget(key);
    verdict.comparisons.push_back(
        not_judged(scene.name, "comparison", Stage::merge, Outcome::failed,
                   "the cached verdict differs from a new one of the same answers (--no-cache judges anew)"));
  } else if (traced.calls() && is_kept(verdict)) {
    kept.store.keep(key, to_bytes(Kept{*traced.calls(), verdict}));
  }
  return verdict;
}

}  // namespace plumbline::check
