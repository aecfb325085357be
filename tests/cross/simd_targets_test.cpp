// Every SIMD target draws what float draws, bit for bit; and none leaves code behind that others would run.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "../extent.h"
#include "pipeline/painter.h"
#include "pipeline/render.h"
#include "pipeline/window.h"
#include "scene/antialias.h"
#include "scene/scene_file.h"

namespace plumbline::pipeline {
namespace {

template <class T>
bool same_bits(const Plane<T>& a, const Plane<T>& b) {
  return a.size() == b.size() && std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)) == 0;
}

bool same_bits(const Frame& a, const Frame& b) {
  return same_bits(a.color_rgba8, b.color_rgba8) && same_bits(a.color_rgba12, b.color_rgba12) &&
         same_bits(a.color_rgba16, b.color_rgba16) && same_bits(a.color_rgba32f, b.color_rgba32f) &&
         same_bits(a.depth_code, b.depth_code) && same_bits(a.depth_z32f, b.depth_z32f) &&
         same_bits(a.stencil, b.stencil);
}

TEST(SimdTargets, DrawEverySceneAsItsDefinitionDoes) {
  const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
  const std::vector<std::filesystem::path> files = find_scenes(folder);
  const Stages stages = production_stages();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < files.size(); i += one_of(3)) {
    for (const Scene& pass : passes_of(load_scene(files[i], {}))) {
      const Frame definition = render(pass, stages);
      for (const SimdTarget& target : simd_targets()) {
        EXPECT_TRUE(same_bits(Painter(1, target).draw(pass), definition)) << target.name << ", " << files[i];
        ++compared;
      }
    }
  }
  std::printf("%zu frames compared, by %zu targets\n", compared, simd_targets().size());
}

// What the linker may put in the place of others of its name is this target's own.
TEST(SimdTargets, NoneOfTheirFunctionsAreSharedWithOtherCode) {
  std::istringstream objects(PLUMBLINE_SIMD_OBJECTS);
  int functions = 0;
  for (std::string object; std::getline(objects, object, ':');) {
    const std::string stem = std::filesystem::path(object).stem(), target = stem.substr(stem.rfind('_') + 1);
    FILE* nm = popen(("nm --defined-only --extern-only --format=posix '" + object + "'").c_str(), "r");
    ASSERT_NE(nm, nullptr);
    std::array<char, 65536> line;
    while (std::fgets(line.data(), line.size(), nm) != nullptr) {
      const std::string symbol = line.data();
      EXPECT_NE(symbol.find(target), std::string::npos) << symbol;
      ++functions;
    }
    EXPECT_EQ(pclose(nm), 0) << object;
  }
  EXPECT_GE(functions, 2);
}

}  // namespace
}  // namespace plumbline::pipeline
