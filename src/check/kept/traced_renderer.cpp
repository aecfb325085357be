#include "check/kept/traced_renderer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "capture/capture_columns.h"
#include "capture/files/conventions_file.h"
#include "scene/antialias.h"

namespace plumbline::check {

namespace {

class CaptureHasher {
 public:
  explicit CaptureHasher(Hasher& hasher) : hasher_(hasher) {}
  // Column by column, in pieces that stay in the cache.
  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>& records) {
    constexpr std::size_t kPiece = 512;
    hasher_.add_text(group.name);
    hasher_.add_value(std::uint64_t{records.size()});
    columns.each([&](const auto& column) {
      for (std::span<const Record> left(records); !left.empty(); left = left.subspan(std::min(kPiece, left.size()))) {
        const std::vector<char> bytes = packed(left.first(std::min(kPiece, left.size())), column);
        hasher_.add(bytes.data(), bytes.size());
      }
    });
  }
  template <class T>
  void plane(Handed of, const Plane<T>& plane) {
    hasher_.add_text(of.name);
    hasher_.add_value(glm::ivec2(plane.width(), plane.height()));
    hasher_.add(plane.values().data(), plane.size() * sizeof(T));
  }

 private:
  Hasher& hasher_;
};

Hash hash_of_capture(const Capture& capture) {
  Hasher hasher;
  hasher.add_text(capture.renderer);
  hasher.add_text(capture.version);
  hasher.add_value(glm::ivec3(capture.width, capture.height, capture.depth_in_float ? 1 : 0));
  hasher.add_value(glm::ivec1(static_cast<int>(capture.snapped_by)));
  for (const auto* names : {&capture.derived, &capture.without_records}) {
    hasher.add_value(glm::ivec1(static_cast<int>(names->size())));
    for (const std::string& name : *names) hasher.add_text(name);
  }
  CaptureHasher all(hasher);
  visit_capture(all, capture);
  for (const Plane<glm::vec4>& samples : capture.samples) all.plane({Stage::resolve, "samples"}, samples);
  return hasher.done();
}

bool may_be_made_again(const Request& request) { return !request.legal && request.conventions == Conventions{}; }

bool is_pass(const Scene& scene, const Scene& of, std::size_t i) {
  const Pass pass = state_of_pass(of.frame, i);
  return antialiased(of) && !antialiased(scene) && scene.name == of.name && scene.frame.pass.shift == pass.shift &&
         scene.frame.pass.sample == pass.sample;
}

bool same_question(TracedCall a, TracedCall b) {
  a.answer = b.answer = a.info = b.info = {};
  ByteWriter of_a, of_b;
  visit(of_a, a);
  visit(of_b, b);
  return of_a.done() == of_b.done();
}

}  // namespace

Hash hash_of(const RendererInfo& info) {
  Hasher hasher;
  hasher.add_text(info.name);
  hasher.add_text(info.version);
  for (const Ability& a : info.stages) {
    hasher.add_value(std::array{a.shows, a.runs, a.planes_alone, a.given, a.contradicted});
    hasher.add_text(a.reason);
  }
  hasher.add_value(std::array{static_cast<int>(info.profile), info.legal ? 1 : 0});
  hasher.add_text(conventions_text(info.conventions));
  for (const std::string& painter : info.painters) hasher.add_text(painter);
  return hasher.done();
}

const Scene& TracedRenderer::scene_of(std::uint64_t pass) {
  if (pass == TracedCall::kWhole) return scene_;
  if (passes_.empty()) passes_ = passes_of(scene_);
  return passes_.at(pass);
}

TracedRenderer::Answer TracedRenderer::ask(std::uint64_t pass, const Request& request) {
  Answer out{{pass, request, {}, {}}, {}, {}, {}};
  try {
    out.capture = inner_.capture(scene_of(pass), request);
    out.call.answer = hash_of_capture(out.capture);
  } catch (const OverBudget& e) {
    out.over_budget = e.what();
    out.call.answer = hash_of(*out.over_budget);
  } catch (...) {
    out.failure = std::current_exception();
    return out;
  }
  out.call.info = hash_of(inner_.info());
  return out;
}

bool TracedRenderer::answers_as_before(std::span<const TracedCall> calls) {
  for (const TracedCall& call : calls) {
    Answer answer = ask(call.pass, call.request);
    if (!answer.failure && answer.call.answer == call.answer && answer.call.info == call.info) continue;
    held_ = std::move(answer);
    return false;
  }
  return true;
}

Capture TracedRenderer::capture(const Scene& scene, const Request& request) {
  const std::size_t passes = pass_count(scene_.frame.antialias);
  std::uint64_t pass = TracedCall::kWhole;
  if (&scene != &scene_) {
    pass = 0;
    while (pass < passes && !is_pass(scene, scene_, pass)) ++pass;
  }
  std::optional<std::vector<TracedCall>> before = std::exchange(calls_, std::nullopt);  // left so where asking throws
  if (!before || pass == passes || !may_be_made_again(request)) return inner_.capture(scene, request);
  const bool is_held = held_ && same_question(held_->call, {pass, request, {}, {}});
  std::optional<Answer> answer = is_held ? std::exchange(held_, std::nullopt) : ask(pass, request);
  if (answer->failure) std::rethrow_exception(answer->failure);
  before->push_back(answer->call);
  calls_ = std::move(before);
  if (answer->over_budget) throw OverBudget(*answer->over_budget);
  return std::move(answer->capture);
}

Capture TracedRenderer::run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) {
  calls_.reset();
  return inner_.run_stage(scene, stage, in, conventions);
}

}  // namespace plumbline::check
