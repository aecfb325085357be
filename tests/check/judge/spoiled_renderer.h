// A renderer in which chosen stages are wrong, each by itself.
#pragma once

#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "capture/renderer.h"
#include "check/judge/stage_copy.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Changes what the stage handed on by more than any tolerance, and keeps it consistent: one field of all its records;
/// of coverage and visibility one fragment, of merge and resolve pixel (0, 0).
inline void spoil(const Scene& scene, Stage stage, Capture& c) {
  Records<double>& r = c.records;
  const auto turned = [](double value) { return value > 0.5 ? 0.25 : 0.75; };
  switch (stage) {
    case Stage::matrices:
      for (auto& m : r.matrices) m.projection[0][0] *= 1.125;
      return;
    case Stage::vertex:
      for (auto& v : r.vertices) v.p_clip.y += 0.125;
      return;
    case Stage::light:
      for (auto& l : r.lit) l.color.r = turned(l.color.r);
      return;
    case Stage::clip:
      for (auto& v : r.polygons.vertices) v.color.g = turned(v.color.g);
      return;
    case Stage::window:
      for (auto& t : r.triangles) t.v[1].p_win.z = turned(t.v[1].p_win.z);
      return;
    case Stage::coverage: {
      if (r.covered.empty()) return;
      const Covered last = r.covered.back();
      r.covered.pop_back();
      c.planes.count(last.x, last.y) -= 1;
      c.planes.id_sum(last.x, last.y) -= id_weight(r.triangles[last.triangle].primitive);
      return;
    }
    case Stage::depth:
      for (double& z : r.depth) z = turned(z);
      round_to_formats(scene, stage, c);
      return;
    case Stage::attributes:
      for (auto& a : r.attributes) a.color.b = turned(a.color.b);
      return;
    case Stage::texture:
      for (auto& t : r.texels) t.color.r = turned(t.color.r);
      return;
    case Stage::shade:
      for (auto& s : r.shaded) s.color.g = turned(s.color.g);
      return;
    case Stage::visibility:
      if (!r.drawn.empty()) r.drawn[0].drawn = !r.drawn[0].drawn;
      return;
    case Stage::merge:
    case Stage::resolve: c.planes.color(0, 0).r = c.planes.color(0, 0).r > 0.5f ? 0.0f : 1.0f; return;
  }
}

/// Runs `inner`'s stages 0 to 11 one after the other, those of `wrong` spoiled. Captures of antialiased scenes are
/// `inner`'s own.
class Spoiled : public Renderer {
 public:
  Spoiled(std::unique_ptr<Renderer> inner, std::set<Stage> wrong)
      : inner_(std::move(inner)), wrong_(std::move(wrong)) {}
  RendererInfo info() const override { return inner_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    Capture out = inner_->capture(scene, request);
    if (antialiased(scene)) return out;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(Stage::merge); ++i) {
      const auto stage = static_cast<Stage>(i);
      if (has_stage(scene, stage)) copy_stage(stage, run_stage(scene, stage, out, {}), out);
    }
    return out;
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) override {
    Capture out = inner_->run_stage(scene, stage, in, conventions);
    if (!wrong_.contains(stage)) return out;
    out.records.triangles = stage > Stage::window ? in.records.triangles : out.records.triangles;
    spoil(scene, stage, out);
    return out;
  }

 private:
  std::unique_ptr<Renderer> inner_;
  std::set<Stage> wrong_;
};

}  // namespace plumbline::check
