#include "reference/embree/embree.h"

#include <utility>

#include "capture/by_conventions.h"
#include "reference/arithmetic/resolve.h"
#include "reference/embree/rays.h"
#include "reference/oracle/oracle.h"

namespace plumbline::embree {

namespace {

class EmbreeRenderer final : public Renderer {
 public:
  RendererInfo info() const override {
    RendererInfo info;
    info.name = "embree";
    info.version = version_;
    for (const Stage stage :
         {Stage::coverage, Stage::depth, Stage::attributes, Stage::shade, Stage::visibility, Stage::merge}) {
      info[stage] = {true, false, ""};
    }
    for (const Stage stage : {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window}) {
      info[stage].reason = "a ray sees no vertices, only what it hits";
    }
    info[Stage::texture].reason = "a ray sees the final colour; see shade";
    info[Stage::resolve].reason = "a ray finds a sample, not what is made of it";
    info.legal = true;
    info.profile = Profile::oracle;
    return info;
  }

  Capture capture(const Scene& of_dialect, const Request& request) override {
    if (antialiased(of_dialect)) return math::capture_resolved(*this, of_dialect, request);
    const SceneByConventions by_conventions(of_dialect, request.conventions);
    const Scene& scene = *by_conventions;
    if (may_draw(scene, Topology::lines) || may_draw(scene, Topology::points)) {
      throw Unsupported("no ray meets a line or a point");
    }
    if (request.planes == WantedPlanes::none && !request.legal && request.pixels.empty()) return empty_capture(scene);
    math::Candidates candidates(math::candidate_budget(scene, request.memory_budget));
    const math::Projected projected = math::project(scene, request.conventions);
    add_by_rays(projected, candidates);
    math::add_by_edges(projected, candidates);
    math::Oracle oracle = math::consult(scene, projected, candidates, request);
    Capture out = empty_capture(scene);
    out.planes = std::move(oracle.planes);
    out.records = std::move(oracle.records);
    if (request.legal) out.legal = std::move(oracle.legal);
    return out;
  }

 private:
  Capture empty_capture(const Scene& scene) const {
    Capture out;
    out.renderer = "embree";
    out.version = version_;
    out.width = scene.frame.width;
    out.height = scene.frame.height;
    return out;
  }

  std::string version_ = version();
};

}  // namespace

std::unique_ptr<Renderer> make_embree() { return std::make_unique<EmbreeRenderer>(); }

}  // namespace plumbline::embree
