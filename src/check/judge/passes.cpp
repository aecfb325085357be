#include "check/judge/passes.h"

namespace plumbline::check {

std::vector<Scene> pass_scenes(const Scene& scene) {
  const Antialias antialias = scene.frame.antialias;
  if (antialias.kind == Antialias::Kind::none) return {scene};
  Scene pass = scene;
  pass.path.clear();  // it stands in no file
  pass.frame.antialias = Antialias{};
  std::vector<Scene> passes;
  const auto add = [&](std::optional<int> sample, double shift_x, double shift_y) {
    pass.frame.pass = {{shift_x, shift_y}, sample};
    passes.push_back(pass);
  };
  switch (antialias.kind) {
    case Antialias::Kind::none: break;
    case Antialias::Kind::multisample:
      for (int sample = 0; sample < 4; ++sample) add(sample, 0, 0);
      break;
    case Antialias::Kind::supersample:
      pass.frame.width *= antialias.factor;
      pass.frame.height *= antialias.factor;
      for (Draw& draw : pass.draws) {
        if (!draw.scissor) continue;
        for (int* side : {&draw.scissor->x, &draw.scissor->y, &draw.scissor->width, &draw.scissor->height})
          *side *= antialias.factor;
      }
      add(std::nullopt, 0, 0);
      break;
    case Antialias::Kind::taps:  // AAFilter of CSCI-580's homework 6, with the sign of the vertices' shift [pixels]
      add(std::nullopt, 0.52, -0.38);
      add(std::nullopt, -0.41, -0.56);
      add(std::nullopt, -0.27, -0.08);
      add(std::nullopt, 0.17, 0.29);
      add(std::nullopt, -0.58, 0.55);
      add(std::nullopt, 0.31, 0.71);
      break;
  }
  return passes;
}

}  // namespace plumbline::check
