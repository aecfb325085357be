#include "capture/renderers/replayed_renderer.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace plumbline {

namespace {

// Whether it holds what comparing the stage takes.
bool holds(const Capture& c, const Scene& scene, Stage stage) {
  const Records<double>& r = c.records;
  const Planes& p = c.planes;
  const bool winners = !p.id.empty();
  switch (stage) {
    case Stage::matrices: return !r.matrices.empty();
    case Stage::vertex: return !r.vertices.empty();
    case Stage::light: return !r.lit.empty();
    case Stage::clip: return !r.polygons.polygons.empty();
    case Stage::window: return !r.triangles.empty();
    case Stage::coverage: return !p.count.empty() && !p.id_sum.empty();
    case Stage::depth: return winners && !p.depth.empty();
    case Stage::attributes: return winners && !p.shaded.empty();
    case Stage::texture: return winners && !p.texel.empty();
    case Stage::shade: return winners && !p.shaded.empty();
    case Stage::visibility: return winners && p.stencil.empty() == (scene.frame.stencil == StencilFormat::none);
    case Stage::merge: return winners && !p.color.empty() && !p.depth.empty();
    case Stage::resolve: return false;
  }
  return false;
}

class ReplayedRenderer : public Renderer {
 public:
  ReplayedRenderer(Capture capture, const Scene& scene) : capture_(std::move(capture)) {
    info_.name = capture_.renderer;
    info_.version = capture_.version;
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      info_.stages[i].shows = holds(capture_, scene, static_cast<Stage>(i));
      if (!info_.stages[i].shows) info_.stages[i].reason = "its capture does not hold it";
    }
  }
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene&, const Request&) override { return capture_; }

 private:
  Capture capture_;
  RendererInfo info_;
};

}  // namespace

std::unique_ptr<Renderer> make_replayed_renderer(Capture capture, const Scene& scene, const std::string& from) {
  const auto require = [&](bool holds, const std::string& expected, const std::string& found) {
    if (!holds) throw std::invalid_argument(fmt::format("{}: expected {}, found {}", from, expected, found));
  };
  require(scene.frame.antialias.kind == Antialias::Kind::none, "a scene of one sample a pixel",
          "an antialiased one: no capture holds its passes");
  require(capture.width == scene.frame.width && capture.height == scene.frame.height,
          fmt::format("a capture of the scene's {} x {} pixels", scene.frame.width, scene.frame.height),
          fmt::format("one of {} x {}", capture.width, capture.height));
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  const std::size_t vertices = ranges.empty() ? 0 : ranges.back().first_vertex + ranges.back().vertex_count;
  const auto fits = [&](const char* what, std::size_t is, std::size_t expected) {
    require(is == 0 || is == expected, fmt::format("{} {}, as the scene has", expected, what), std::to_string(is));
  };
  fits("draws' matrices", capture.records.matrices.size(), scene.draws.size());
  fits("lights", capture.records.lights.size(), scene.lights.size());
  fits("vertices", capture.records.vertices.size(), vertices);
  fits("lit vertices", capture.records.lit.size(), vertices);
  const std::size_t primitives = ranges.empty() ? 0 : ranges.back().first_primitive + ranges.back().primitive_count;
  for (const WindowTriangle<double>& t : capture.records.triangles)
    require(t.primitive < primitives, fmt::format("primitives of the scene's {}", primitives),
            std::to_string(t.primitive));
  for (const std::int32_t id : capture.planes.id.values())
    require(id < static_cast<std::int64_t>(primitives), fmt::format("winners of the scene's {} primitives", primitives),
            std::to_string(id));
  return std::make_unique<ReplayedRenderer>(std::move(capture), scene);
}

}  // namespace plumbline
