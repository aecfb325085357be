// Which scenes a fault affects: whether any bit of what the pipeline hands on is another.
#include <array>
#include <bitset>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "capture/files/capture_columns.h"
#include "matrix/matrix.h"
#include "matrix/parallel.h"
#include "pipeline/convert.h"
#include "pipeline/render.h"
#include "scene/antialias.h"

namespace plumbline::matrix {

namespace {

using faults::FragmentTable;
using faults::Table;

// ---- what a scene never asks for cannot affect it

const Table& production() {
  static const Table kTable = faults::production();
  return kTable;
}

// A function of the table, of those that some scenes do without.
template <auto member>
auto& of(Table& table) {
  if constexpr (requires { table.fragment.*member; }) {
    return table.fragment.*member;
  } else {
    return table.resolve.*member;
  }
}

template <auto member>
thread_local bool was_called = false;

template <auto member, class R, class... A>
R note_call(A... a) {
  was_called<member> = true;
  return of<member>(const_cast<Table&>(production()))(a...);
}
template <auto member, class R, class... A>
void watch(R (*&function)(A...)) {
  was_called<member> = false;
  function = note_call<member, R, A...>;
}

template <auto... members>
struct Some {
  // The pipeline, that notes which of them it calls.
  static Table watched() {
    Table table = production();
    (watch<members>(of<members>(table)), ...);
    return table;
  }
  static std::bitset<sizeof...(members)> called() {
    std::bitset<sizeof...(members)> out;
    std::size_t i = 0;
    ((out[i++] = was_called<members>), ...);
    return out;
  }
  // The table with the pipeline's own in place of those not called.
  static Table of_called(Table table, const std::bitset<sizeof...(members)>& called) {
    Table own = production();
    std::size_t i = 0;
    ((of<members>(table) = called[i++] ? of<members>(table) : of<members>(own)), ...);
    return table;
  }
};
using Rare = Some<&FragmentTable::thin_pixels, &FragmentTable::scissor, &FragmentTable::texture, &FragmentTable::shade,
                  &FragmentTable::shade_surface, &FragmentTable::alpha_passes, &FragmentTable::stencil_test,
                  &FragmentTable::blend, &FragmentTable::logic, &pipeline::ResolveStage::multisample,
                  &pipeline::ResolveStage::weighted>;

// ---- bits

// Column by column, for records have padding.
struct Bits {
  std::uint64_t hash = 0;
  void add(const auto& value) {
    std::array<std::uint32_t, (sizeof value + 3) / 4> words{};
    std::memcpy(words.data(), &value, sizeof value);
    for (const std::uint32_t word : words) hash = ((hash ^ word) * 0x9e3779b97f4a7c15u) ^ (hash >> 29);
  }
  void group(std::string_view, const auto& records, const auto&... columns) {
    add(records.size());
    const auto add_column = [&](const auto& column) {
      const std::size_t corners = column.kCorners == 0 ? 1 : column.kCorners;
      for (const auto& record : records) {
        for (std::size_t i = 0; i < corners; ++i) add(column.at(record, i));
      }
    };
    (add_column(columns), ...);
  }
  void plane(std::string_view, const auto& plane) {
    add(plane.size());
    for (const auto& value : plane.values()) add(value);
  }
};

std::uint64_t bits_of(const Capture& capture) {
  Bits bits;
  visit_capture(capture, bits);
  return bits.hash;
}

std::uint64_t bits_of(const pipeline::Geometry& geometry) {
  Capture capture;
  pipeline::widen_geometry(geometry.records, {StageSet::all(), false, {}, {}}, capture.records);
  return bits_of(capture);
}

std::uint64_t bits_of(const pipeline::Frame& frame) {
  Bits bits;
  bits.plane("", frame.color_rgba8);
  bits.plane("", frame.color_rgba12);
  bits.plane("", frame.color_rgba16);
  bits.plane("", frame.color_rgba32f);
  bits.plane("", frame.depth_code);
  bits.plane("", frame.depth_z32f);
  bits.plane("", frame.stencil);
  return bits.hash;
}

// ---- one scene

// One of the scenes that are drawn for it, and what the pipeline makes of that.
class Pass {
 public:
  explicit Pass(Scene scene)
      : scene_(std::move(scene)),
        geometry_(pipeline::run_geometry(scene_, production().geometry)),
        geometry_bits_(bits_of(geometry_)) {}

  bool changed_by(const pipeline::GeometryStages& stages) const {
    return bits_of(pipeline::run_geometry(scene_, stages)) != geometry_bits_;
  }
  pipeline::Frame picture(const pipeline::FragmentFunctions& fragment) const {
    pipeline::Frame frame(scene_.frame);
    pipeline::NoTap tap;
    draw(fragment.draw, frame, tap);
    return frame;
  }
  std::uint64_t fragments(const pipeline::FragmentFunctions& fragment) const {
    Request request{StageSet::all(), false, {}, {}};
    request.memory_budget = std::size_t{1} << 40;
    pipeline::Frame frame(scene_.frame);
    pipeline::CaptureTap tap(scene_, request, 0);
    draw(fragment.draw_tapped, frame, tap);
    Capture capture;
    tap.hand_out(geometry_.records.triangles, capture);
    return bits_of(capture);
  }

 private:
  void draw(const auto& function, pipeline::Frame& frame, auto& tap) const {
    const std::vector<pipeline::Surface> surfaces = pipeline::surfaces_of(scene_, geometry_.records);
    function({geometry_.records.triangles, geometry_.first_triangle, scene_.draws, surfaces, scene_.depth_clamp},
             scene_.frame, frame, tap);
  }

  Scene scene_;
  pipeline::Geometry geometry_;
  std::uint64_t geometry_bits_;
};

class Unfaulted {
 public:
  explicit Unfaulted(const Scene& scene) : format_(scene.frame) {
    for (Scene& pass : passes_of(scene)) passes_.emplace_back(std::move(pass));
  }

  bool changed_by(const Table& given) {
    const auto any_pass = [&](auto changes) {
      for (std::size_t i = 0; i < passes_.size(); ++i) {
        if (changes(i)) return true;
      }
      return false;
    };
    if (given.geometry != production().geometry &&
        any_pass([&](std::size_t i) { return passes_[i].changed_by(given.geometry); }))
      return true;
    if (given.fragment == production().fragment && given.resolve == production().resolve) return false;
    std::call_once(is_drawn_, [&] { draw(); });  // what is wrong before needs no pixel
    const Table table = Rare::of_called(given, called_);
    if (table.resolve != production().resolve && resolved(table.resolve) != resolved_bits_) return true;
    if (table.fragment == production().fragment) return false;
    const pipeline::FragmentFunctions fragment = faults::stages_of(table).fragment;
    return any_pass([&](std::size_t i) { return bits_of(passes_[i].picture(fragment)) != picture_bits_[i]; }) ||
           any_pass([&](std::size_t i) { return passes_[i].fragments(fragment) != fragment_bits_[i]; });
  }

 private:
  void draw() {
    const pipeline::Stages watched = faults::stages_of(Rare::watched());
    for (const Pass& pass : passes_) {
      pictures_.push_back(pass.picture(watched.fragment));
      picture_bits_.push_back(bits_of(pictures_.back()));
      fragment_bits_.push_back(pass.fragments(watched.fragment));
    }
    resolved_bits_ = resolved(watched.resolve);
    called_ = Rare::called();
  }
  std::uint64_t resolved(const pipeline::ResolveStage& stage) const {
    return format_.antialias.kind == Antialias::Kind::none ? 0 : bits_of(pipeline::resolve(stage, format_, pictures_));
  }

  FrameFormat format_;
  std::vector<Pass> passes_;
  std::once_flag is_drawn_;
  std::vector<pipeline::Frame> pictures_;
  std::vector<std::uint64_t> picture_bits_, fragment_bits_;
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
        if (unfaulted[s]->changed_by(subjects[i].table)) out[i].push_back(s);
      } catch (const std::exception& e) {
        throw std::runtime_error(fmt::format("{} on {}: {}", subjects[i].name, scenes[s].name, e.what()));
      }
    }
  });
  return out;
}

}  // namespace plumbline::matrix
