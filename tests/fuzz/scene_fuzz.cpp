// Any text as a scene file: it is a scene, which then draws, or it is refused.
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  try {
    const Scene scene = load_scene(fuzz::folder().write("scene.json", fuzz::text(data, size)), {.asset_folders = {}});
    const bool small =
        scene.frame.width * scene.frame.height <= 1 << 14 && draw_ranges(scene).back().first_primitive < 1000;
    if (small) pipeline::make_pipeline()->capture(scene, {});
  } catch (const SceneError&) {
  } catch (const OverBudget&) {
  }
  return 0;
}
