// An export is all that a renderer needs.
#include <algorithm>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/atomic_path.h"
#include "export/export_folder.h"
#include "pipeline/render.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "scene/antialias.h"
#include "scene/file/scene_file.h"
#include "tests/export/drawn_from_export.h"
#include "tests/suite.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

ExportedStages stages_of(const Scene& scene) {
  Request request;
  request.planes = WantedPlanes::none;
  request.records = {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window};
  return {pipeline::make_pipeline()->capture(scene, request),
          exact::make_exact()->capture(scene, request).records.matrices};
}

bool same(const pipeline::Frame& a, const pipeline::Frame& b) {
  const auto equal = [](const auto& x, const auto& y) {
    const bool same_size = x.width() == y.width() && x.height() == y.height();
    return same_size &&
           (x.empty() || std::memcmp(x.values().data(), y.values().data(), x.size() * sizeof x.values()[0]) == 0);
  };
  return equal(a.color_rgba8, b.color_rgba8) && equal(a.color_rgba16, b.color_rgba16) &&
         equal(a.color_rgba32f, b.color_rgba32f) && equal(a.depth_code, b.depth_code) &&
         equal(a.depth_z32f, b.depth_z32f) && equal(a.stencil, b.stencil);
}

class ExportOf : public TestFolder, public ::testing::WithParamInterface<fs::path> {};
using ExportFolder = TestFolder;

// A scene of many triangles shows no more than one of some thousands, and takes seconds.
bool is_large(const Scene& scene) {
  constexpr std::size_t kMostPrimitives = 400'000;
  return std::ranges::any_of(scene.meshes, [](const Mesh& m) { return m.triangles.size() > kMostPrimitives; });
}

TEST_P(ExportOf, EverySceneOfTheGroupDrawsTheSameBits) {
  const fs::path group[] = {GetParam()};
  std::size_t drawn = 0;
  for (const fs::path& file : find_scenes(group)) {
    const Scene scene = load_scene(file);
    if (is_large(scene)) continue;
    const fs::path to = root_ / "export";
    write_export(scene, stages_of, to);
    const std::vector<Scene> passes = passes_of(scene);
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const bool single = !antialiased(scene);
      const pipeline::Frame frame = test::drawn_from_export(single ? to : to / fmt::format("pass{}", i));
      EXPECT_TRUE(same(frame, pipeline::render(passes[i]))) << scene.name << " pass " << i;
      ++drawn;
    }
  }
  EXPECT_GT(drawn, 0u);
}

std::vector<fs::path> groups() {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(suite_folder())) {
    if (entry.is_directory()) out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}
INSTANTIATE_TEST_SUITE_P(Groups, ExportOf, ::testing::ValuesIn(groups()),
                         [](const auto& group) { return group.param.filename().string(); });

TEST_F(ExportFolder, IsReplacedWhereItHoldsAnExportAndLeftAloneElse) {
  const fs::path to = root_ / "export";
  const Scene scene = suite_scene("antialias/taps_gl");
  write_export(scene, stages_of, to);
  EXPECT_TRUE(fs::exists(to / "pass5" / "manifest.json"));
  write_export(suite_scene("clip/crowd"), stages_of, to);
  EXPECT_FALSE(fs::exists(to / "pass5"));
  test::write_text(to / "mine.txt", "mine");
  EXPECT_THROW(write_export(scene, stages_of, to), OutputError);
  EXPECT_TRUE(fs::exists(to / "mine.txt"));
}

}  // namespace
}  // namespace plumbline
