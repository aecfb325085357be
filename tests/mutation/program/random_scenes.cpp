#include "mutation/program/random_scenes.h"

#include "tests/property/random_scene.h"

namespace plumbline::mutation {

Scene random_scene_of(std::uint64_t seed, int number) {
  const rc::Random random(seed + static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15u);
  return rc::gen::exec([] { return test::random_scene(); })(random, number % 100).value();
}

}  // namespace plumbline::mutation
