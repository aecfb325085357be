#include "capture/renderers/replayed_renderer.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "capture/capture_columns.h"
#include "capture/complete_records.h"
#include "capture/contradictions.h"
#include "capture/legal.h"
#include "scene/draw_index.h"

namespace plumbline {

namespace {

// Whether the capture holds the group's arrays, with or without records. The stage is judged in both cases.
bool holds(const Capture& c, std::string_view group, const auto& records) {
  return !records.empty() || c.without_records.contains(std::string(group));
}

// Parts of a stage that a capture holds.
struct Held {
  bool records, planes;
};

// Whether the capture holds the stage's records: every group, but for varyings and lights, which not all scenes have.
struct HeldRecords {
  Stage stage;
  const Capture& capture;
  bool any = false, all = true;
  void group(Handed group, const auto&, const auto& records) {
    if (group.stage != stage || group.per == Per::light || group.varying) return;
    any = true;
    all &= holds(capture, group.name, records);
  }
  void plane(Handed, const auto&) const {}
};

bool holds_planes(const Planes& p, const Scene& scene, Stage stage) {
  switch (stage) {
    case Stage::coverage: return !p.count.empty();
    case Stage::depth: return !p.depth.empty();
    case Stage::attributes:
    case Stage::shade: return !p.shaded.empty();
    case Stage::texture: return !p.texel.empty() && !p.id.empty();
    case Stage::visibility:
      return scene.frame.stencil == StencilFormat::none ? !p.id.empty() && p.stencil.empty() : !p.stencil.empty();
    case Stage::merge: return !p.color.empty();
    default: return false;
  }
}

Held held(const Capture& c, const Scene& scene, Stage stage) {
  HeldRecords held{stage, c};
  visit_capture(held, c);
  const bool has_triangles = stage != Stage::coverage || holds(c, "window", c.records.triangles);
  return {held.any && held.all && has_triangles, holds_planes(c.planes, scene, stage)};
}

// Planes of coverage and visibility that records of fragments come to, where the capture has none.
void add_planes_of_records(Capture& c) {
  const std::vector<Covered>& covered = c.records.covered;
  if (!holds(c, "coverage", covered)) return;
  const bool known = holds(c, "window", c.records.triangles);  // which primitives the fragments are of
  const bool counts = c.planes.count.empty(), sums = known && c.planes.id_sum.empty();
  const bool winners = known && c.planes.id.empty() && c.records.drawn.size() == covered.size();
  if (counts) c.planes.count = Plane<std::uint32_t>(c.width, c.height);
  if (sums) c.planes.id_sum = Plane<std::uint64_t>(c.width, c.height);
  if (winners) c.planes.id = Plane<std::int32_t>(c.width, c.height, kBackground);
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const auto [triangle, x, y] = covered[i];
    const std::uint32_t primitive = known ? c.records.triangles[triangle].primitive : 0;
    if (counts) ++c.planes.count(x, y);
    if (sums) c.planes.id_sum(x, y) += id_weight(primitive);
    if (winners && c.records.drawn[i].drawn) c.planes.id(x, y) = static_cast<std::int32_t>(primitive);
  }
}

class ReplayedRenderer : public Renderer {
 public:
  ReplayedRenderer(Capture capture, const Scene& scene, const Conventions& conventions) : capture_(std::move(capture)) {
    const std::vector<std::string> of_winners = contradictions_of(capture_, Stage::visibility, conventions);
    if (!of_winners.empty()) capture_.planes.id = {};
    if (scene.frame.stencil == StencilFormat::none) capture_.planes.stencil = {};  // of a buffer that no draw uses
    add_planes_of_records(capture_);
    info_.name = capture_.renderer;
    info_.version = capture_.version;
    info_.conventions = conventions;
    for (const Stage stage : kAllStages) {
      const Held here = held(capture_, scene, stage);
      info_[stage].shows = here.records || here.planes;
      info_[stage].planes_alone = !here.records;
      if (!info_[stage].shows) info_[stage].reason = "the capture does not hold it";
    }
    contradict(Stage::visibility, of_winners);
    for (const Stage stage : {Stage::window, Stage::coverage, Stage::texture, Stage::shade})
      contradict(stage, contradictions_of(capture_, stage, conventions));
  }
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene&, const Request&) override { return capture_; }

 private:
  void contradict(Stage stage, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    info_[stage].contradicted = true;
    info_[stage].reason = "the capture contradicts itself: " + lines.front();
  }

  Capture capture_;
  RendererInfo info_;
};

}  // namespace

std::unique_ptr<Renderer> make_replayed_renderer(Capture capture, const Scene& scene, const std::string& from,
                                                 const Conventions& conventions) {
  const auto require = [&](bool holds, const std::string& expected, const std::string& found) {
    if (!holds) throw std::invalid_argument(fmt::format("{}: expected {}, found {}", from, expected, found));
  };
  require(!antialiased(scene), "a scene of one sample a pixel", "an antialiased one: no capture holds its passes");
  require(capture.width == scene.frame.width && capture.height == scene.frame.height,
          fmt::format("a capture of the scene's {} x {} pixels", scene.frame.width, scene.frame.height),
          fmt::format("one of {} x {}", capture.width, capture.height));
  const DrawIndex draws(scene);
  const auto fits = [&](const char* what, const char* group, std::size_t is, std::size_t expected) {
    const bool lacks = is == 0 && !capture.without_records.contains(group);
    require(lacks || is == expected, fmt::format("{} {}, as the scene has", expected, what), std::to_string(is));
  };
  fits("draws' matrices", "matrices", capture.records.matrices.size(), scene.draws.size());
  fits("lights", "matrices.light", capture.records.lights.size(), scene.lights.size());
  fits("vertices", "vertex", capture.records.vertices.size(), draws.vertices());
  fits("lit vertices", "light", capture.records.lit.size(), draws.vertices());
  const auto primitives = static_cast<std::int64_t>(draws.primitives());
  const auto require_primitive = [&](std::int64_t primitive, std::int64_t least, const auto& place) {
    if (primitive >= least && primitive < primitives) return;
    throw std::invalid_argument(fmt::format("{}: {}: expected {} to {}, the scene's last primitive, found {}", from,
                                            place(), least, primitives - 1, primitive));
  };
  const auto& polygons = capture.records.polygons.polygons;
  for (std::size_t i = 0; i < polygons.size(); ++i)
    require_primitive(polygons[i].primitive, 0, [&] { return fmt::format("clip.polygon.primitive: element {}", i); });
  const auto& triangles = capture.records.triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    require_primitive(triangles[i].primitive, 0, [&] { return fmt::format("window.primitive: element {}", i); });
  const Plane<std::int32_t>& id = capture.planes.id;
  for (std::size_t i = 0; i < id.size(); ++i) {
    require_primitive(id.values()[i], kBackground, [&] {
      const auto width = static_cast<std::size_t>(id.width());
      return fmt::format("planes.id: pixel {}, {}", i % width, i / width);
    });
  }
  try {
    complete_records(scene, capture, conventions);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", from, error.what()));
  }
  return std::make_unique<ReplayedRenderer>(std::move(capture), scene, conventions);
}

}  // namespace plumbline
