#include "scene/antialias.h"

namespace plumbline {

std::size_t pass_count(const Antialias& antialias) {
  switch (antialias.kind) {
    case Antialias::Kind::none: return 1;
    case Antialias::Kind::multisample: return kSamples.size();
    case Antialias::Kind::supersample: return 1;
    case Antialias::Kind::taps: return kTaps.size();
  }
  return 1;
}

Pass state_of_pass(const FrameFormat& frame, std::size_t i) {
  Pass own = frame.pass;
  if (frame.antialias.kind == Antialias::Kind::multisample) own.sample = static_cast<int>(i);
  if (frame.antialias.kind == Antialias::Kind::taps) own.shift = {-kTaps[i].dx, -kTaps[i].dy};
  return own;
}

void pass_of(const Scene& scene, std::size_t i, Scene& pass) {
  const Antialias antialias = scene.frame.antialias;
  pass = scene;
  pass.frame.antialias = {};
  pass.frame.pass = state_of_pass(scene.frame, i);
  if (antialias.kind != Antialias::Kind::none) pass.path.clear();
  if (antialias.kind != Antialias::Kind::supersample) return;
  const int n = antialias.factor;
  pass.frame.width *= n;
  pass.frame.height *= n;
  for (Draw& draw : pass.draws) {
    if (draw.scissor) {
      const Scissor& s = *draw.scissor;
      draw.scissor = {s.x * n, s.y * n, s.width * n, s.height * n};
    }
  }
}

std::vector<Scene> passes_of(const Scene& scene) {
  std::vector<Scene> passes(pass_count(scene.frame.antialias));
  for (std::size_t i = 0; i < passes.size(); ++i) pass_of(scene, i, passes[i]);
  return passes;
}

PixelSamples samples_of(const Antialias& antialias) {
  PixelSamples samples;
  switch (antialias.kind) {
    case Antialias::Kind::none: samples.push_back({0, {0, 0}, 1}); break;
    case Antialias::Kind::multisample:
      for (std::size_t i = 0; i < kSamples.size(); ++i) samples.push_back({i, {0, 0}, 1});
      break;
    case Antialias::Kind::supersample:
      for (int y = 0; y < antialias.factor; ++y) {
        for (int x = 0; x < antialias.factor; ++x) samples.push_back({0, {x, y}, 1});
      }
      break;
    case Antialias::Kind::taps:
      for (std::size_t i = 0; i < kTaps.size(); ++i) samples.push_back({i, {0, 0}, kTaps[i].weight});
      break;
  }
  return samples;
}

}  // namespace plumbline
