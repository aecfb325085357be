// Scenes that a fault affects: those on which any bit of what the pipeline hands on differs.
#include <array>
#include <bitset>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "capture/capture_columns.h"
#include "matrix/matrix.h"
#include "matrix/parallel.h"
#include "pipeline/render.h"
#include "scene/antialias.h"

namespace plumbline::matrix {

namespace {

using pipeline::Stages;

// ---- what a scene never asks for cannot affect it

const Stages& production() {
  static const Stages kStages = pipeline::production_stages();
  return kStages;
}

// The stage function of a member of Stages, or of its ResolveStage.
template <auto member>
auto& of(Stages& stages) {
  if constexpr (requires { stages.*member; }) {
    return stages.*member;
  } else {
    return stages.resolve.*member;
  }
}

template <auto member>
thread_local bool was_called = false;

template <auto member, class R, class... A>
R note_call(A... a) {
  was_called<member> = true;
  return of<member>(const_cast<Stages&>(production()))(a...);
}
template <auto member, class R, class... A>
void watch(R (*&function)(A...)) {
  was_called<member> = false;
  function = note_call<member, R, A...>;
}

template <auto... members>
struct Some {
  // The pipeline, which notes for this thread which of the members it calls.
  static Stages watched() {
    Stages stages = production();
    (watch<members>(of<members>(stages)), ...);
    return stages;
  }
  static std::bitset<sizeof...(members)> called() {
    std::bitset<sizeof...(members)> out;
    std::size_t i = 0;
    ((out[i++] = was_called<members>), ...);
    return out;
  }
  // The stages with the pipeline's own in place of those not called.
  static Stages of_called(Stages stages, const std::bitset<sizeof...(members)>& called) {
    Stages own = production();
    std::size_t i = 0;
    ((of<members>(stages) = called[i++] ? of<members>(stages) : of<members>(own)), ...);
    return stages;
  }
};
using Rare = Some<&Stages::scissor, &Stages::texture, &Stages::alpha_passes, &Stages::stencil_test, &Stages::blend,
                  &Stages::logic, &pipeline::ResolveStage::multisample, &pipeline::ResolveStage::weighted>;

// Stages 0 to 4 of `stages`, the pipeline's own after them.
Stages geometry_of(const Stages& stages) {
  Stages out = production();
  out.matrices = stages.matrices;
  out.lights = stages.lights;
  out.vertex = stages.vertex;
  out.light = stages.light;
  out.assemble = stages.assemble;
  out.clip = stages.clip;
  out.window = stages.window;
  return out;
}

// ---- bits

// Column by column, for records have padding.
struct Bits {
  std::uint64_t hash = 0;
  void add(const auto& value) {
    std::array<std::uint32_t, (sizeof value + 3) / 4> words{};
    std::memcpy(words.data(), &value, sizeof value);
    for (const std::uint32_t word : words) hash = ((hash ^ word) * 0x9e3779b97f4a7c15u) ^ (hash >> 29);
  }
  void group(Handed, const auto& columns, const auto& records) {
    add(records.size());
    columns.each([&](const auto& column) {
      for (const auto& record : records) {
        for (std::size_t i = 0; i < kPerRecord<decltype(column)>; ++i) add(column.at(record, i));
      }
    });
  }
  void plane(Handed, const auto& plane) { add_plane(plane); }
  void add_plane(const auto& plane) {
    add(plane.size());
    for (const auto& value : plane.values()) add(value);
  }
};

std::uint64_t bits_of(const Capture& capture) {
  Bits bits;
  visit_capture(bits, capture);
  return bits.hash;
}

std::uint64_t bits_of(const pipeline::Frame& frame) {
  Bits bits;
  bits.add_plane(frame.color_rgba8);
  bits.add_plane(frame.color_rgba16);
  bits.add_plane(frame.color_rgba32f);
  bits.add_plane(frame.depth_code);
  bits.add_plane(frame.depth_z32f);
  bits.add_plane(frame.stencil);
  return bits.hash;
}

// ---- one scene

std::vector<glm::ivec2> no_pixels(const pipeline::WindowTriangle&, const pipeline::PixelBounds&) { return {}; }

// Hash of all records, and of the frame's bits among the planes, that the stages make.
std::uint64_t capture_bits(const Scene& scene, const Stages& stages) {
  Request request{.records = StageSet::all()};
  request.memory_budget = std::size_t{1} << 40;
  Capture capture;
  pipeline::Recorder records(scene, request, 0, capture);
  const std::uint64_t frame = bits_of(pipeline::render(scene, stages, records));
  return bits_of(capture) ^ (frame * 0x9e3779b97f4a7c15u);
}
// Hash of stages 0 to 4.
std::uint64_t geometry_bits(const Scene& scene, Stages stages) {
  stages.coverage = no_pixels;
  return capture_bits(scene, stages);
}

class Unfaulted {
 public:
  explicit Unfaulted(const Scene& scene) : format_(scene.frame), passes_(passes_of(scene)) {
    for (const Scene& pass : passes_) geometry_bits_.push_back(geometry_bits(pass, production()));
  }

  bool changed_by(const Stages& given) {
    const auto any_pass = [&](auto changes) {
      for (std::size_t i = 0; i < passes_.size(); ++i) {
        if (changes(i)) return true;
      }
      return false;
    };
    const Stages geometry = geometry_of(given);
    if (geometry != production() &&
        any_pass([&](std::size_t i) { return geometry_bits(passes_[i], geometry) != geometry_bits_[i]; })) {
      return true;
    }
    if (geometry == given) return false;
    std::call_once(is_drawn_, [&] { draw(); });  // what is wrong before needs no pixel
    Stages stages = Rare::of_called(given, called_);
    if (stages.resolve != production().resolve && resolved(stages.resolve) != resolved_bits_) return true;
    stages.resolve = production().resolve;
    if (stages == production()) return false;
    return any_pass([&](std::size_t i) { return capture_bits(passes_[i], stages) != capture_bits_[i]; });
  }

 private:
  void draw() {
    const Stages watched = Rare::watched();
    for (const Scene& pass : passes_) {
      pictures_.push_back(pipeline::render(pass, production()));
      capture_bits_.push_back(capture_bits(pass, watched));
    }
    resolved_bits_ = resolved(watched.resolve);
    called_ = Rare::called();
  }
  std::uint64_t resolved(const pipeline::ResolveStage& stage) const {
    return format_.antialias.kind == Antialias::Kind::none ? 0 : bits_of(pipeline::resolve(stage, format_, pictures_));
  }

  FrameFormat format_;
  std::vector<Scene> passes_;
  std::vector<std::uint64_t> geometry_bits_;
  std::once_flag is_drawn_;
  std::vector<pipeline::Frame> pictures_;
  std::vector<std::uint64_t> capture_bits_;
  std::uint64_t resolved_bits_ = 0;
  decltype(Rare::called()) called_;
};

}  // namespace

std::vector<SceneList> affected(std::span<const Scene> scenes, std::span<const Subject> subjects, std::size_t most,
                                unsigned workers) {
  std::vector<std::optional<Unfaulted>> unfaulted(scenes.size());
  std::vector<std::once_flag> is_there(scenes.size());  // where a few scenes are enough, most are not looked at
  std::vector<SceneList> out(subjects.size());
  in_parallel(subjects.size(), workers, [&](std::size_t i) {
    for (std::size_t s = 0; s < scenes.size() && out[i].size() < most; ++s) {
      try {
        std::call_once(is_there[s], [&] { unfaulted[s].emplace(scenes[s]); });
        if (unfaulted[s]->changed_by(subjects[i].stages)) out[i].push_back(s);
      } catch (const std::exception& e) {
        throw std::runtime_error(fmt::format("{} on {}: {}", subjects[i].name, scenes[s].name, e.what()));
      }
    }
  });
  return out;
}

}  // namespace plumbline::matrix
