#include "scene/antialias.h"

namespace plumbline {

std::vector<Scene> passes_of(const Scene& scene) {
  const Antialias antialias = scene.frame.antialias;
  Scene pass = scene;
  pass.frame.antialias = {};
  if (antialias.kind != Antialias::Kind::none) pass.path.clear();
  switch (antialias.kind) {
    case Antialias::Kind::none: return {pass};
    case Antialias::Kind::multisample: {
      std::vector<Scene> passes(kSamples.size(), pass);
      for (int i = 0; i < static_cast<int>(passes.size()); ++i)
        passes[static_cast<std::size_t>(i)].frame.pass.sample = i;
      return passes;
    }
    case Antialias::Kind::supersample: {
      const int n = antialias.factor;
      pass.frame.width *= n;
      pass.frame.height *= n;
      for (Draw& draw : pass.draws) {
        if (draw.scissor) {
          const Scissor& s = *draw.scissor;
          draw.scissor = {s.x * n, s.y * n, s.width * n, s.height * n};
        }
      }
      return {pass};
    }
    case Antialias::Kind::taps: {
      std::vector<Scene> passes(kTaps.size(), pass);
      for (std::size_t i = 0; i < passes.size(); ++i) passes[i].frame.pass.shift = {-kTaps[i].dx, -kTaps[i].dy};
      return passes;
    }
  }
  return {pass};
}

std::vector<PixelSample> samples_of(const Antialias& antialias) {
  std::vector<PixelSample> samples;
  switch (antialias.kind) {
    case Antialias::Kind::none: return {{0, {0, 0}, 1}};
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
