// plumb list: stages, renderers, faults and scenes.
#include <fstream>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "base/temporary_path.h"
#include "cli/commands.h"
#include "cli/likely/known_faults.h"
#include "scene/file/scene_file.h"
#include "scene/frame_buffer.h"

namespace plumbline::cli {

namespace {

void list_stages() {
  for (std::size_t i = 0; i < kStageNames.size(); ++i) fmt::print("{:>2} {}\n", i, kStageNames[i]);
}

// Packages of Debian that a reference which is not built in needs.
std::string how_to_build(const std::string& name) {
  const std::string what = name == "osmesa"   ? "libosmesa6-dev (none from Mesa 25.1 on: egl takes its place)"
                           : name == "embree" ? "libembree-dev (Embree 3 or 4)"
                                              : "libegl-dev and libgl1-mesa-dri";
  return fmt::format("not built in: install {}, and build plumbline anew", what);
}

// Draws a frame of one pixel: a renderer in a process of its own starts that process only when it draws. Throws
// RendererFailed.
void try_out(Renderer& renderer) {
  const TemporaryPath file(temporary_files(), "plumb-list-", TemporaryPath::Kind::file);
  std::ofstream(file.path()) << R"({"description": "A point.", "frame": {"width": 1, "height": 1},
    "draws": [{"mesh": {"points": {"positions": [[0, 0, 0]]}}, "lit": false}]})";
  renderer.capture(load_scene(file.path()), {});
}

void list_renderer(const std::string& name) {
  const std::unique_ptr<Renderer> renderer = make_reference(name, {});
  if (renderer == nullptr) return fmt::print("{}: {}\n", name, how_to_build(name));
  if (in_own_process(name)) try_out(*renderer);
  const RendererInfo info = renderer->info();
  fmt::print("{} ({}){}\n", name, info.version, info.legal ? ": an oracle of legal answers" : "");
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const Ability& ability = info.stages[i];
    fmt::print("  {:<10} {}{}{}\n", kStageNames[i], ability.shows ? "shown" : "not shown",
               ability.runs ? ", can be run alone" : "", ability.reason.empty() ? "" : ": " + ability.reason);
  }
}

void list_renderers() {
  for (const std::string& name : renderer_names()) {
    try {
      list_renderer(name);
    } catch (const RendererFailed& e) {
      const char* package = name == "osmesa" ? ", install libosmesa6"
                            : name == "egl"  ? ", install libgl1-mesa-dri"
                                             : "";
      fmt::print("{}: built in, and not usable here{}: {}\n", name, package, e.what());
    } catch (const std::runtime_error& e) {  // of temporary files
      fmt::print("{}: built in, and not usable here: {}\n", name, e.what());
    }
  }
}

void list_faults() {
  fmt::print("Put in by --fault:\n");
  for (const FaultInfo& fault : fault_infos()) {
    const std::string report = fault.report.empty() ? "" : fmt::format(" ({})", fault.report);
    fmt::print("{:<36} {:<10} {}{}\n", fault.name, fault.stage, fault.changes, report);
  }
  fmt::print("\nNamed by plumb check and diagnose too, from pictures; --fault does not put them in:\n");
  for (const KnownFault& fault : picture_faults())
    fmt::print("{:<36} {:<10} {}\n", fault.name, fault.stage, fault.says);
}

void list_scenes(const std::vector<std::string>& folders, const SceneArguments& arguments) {
  const std::vector<std::filesystem::path> paths(folders.begin(), folders.end());
  for (const auto& file : find_scenes(paths)) {
    const Scene scene = arguments.load(file);
    fmt::print("{:<28} {} x {} x {} bytes = {}: {}\n", scene.name, scene.frame.width, scene.frame.height,
               pixel_bytes(scene.frame), buffer_bytes(scene.frame), scene.description);
  }
}

}  // namespace

int list(const ListOptions& o) {
  if (o.what == "scenes" && o.folders.empty()) throw std::invalid_argument("list scenes: name a folder");
  const bool all = o.what == "all";
  if (!all && o.what != "scenes" && !o.folders.empty()) {
    throw std::invalid_argument(fmt::format("list {}: expected no folder, found {}", o.what, o.folders.front()));
  }
  if (all || o.what == "stages") list_stages();
  if (all || o.what == "renderers") list_renderers();
  if (all || o.what == "faults") list_faults();
  if (!o.folders.empty()) list_scenes(o.folders, o.scene_arguments);
  return kHolds;
}

}  // namespace plumbline::cli
