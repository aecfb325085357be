// plumb render: a scene to a picture. plumb capture: a scene to a capture folder.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/commands.h"
#include "cli/renderers.h"
#include "cli/scene_arguments.h"
#include "stages/capture_folder.h"
#include "stages/image_file.h"

namespace plumbline::cli {

namespace {

struct RenderArguments {
  std::string scene, output, depth, with = "ours", fault;
  SceneArguments scenes;
};

std::unique_ptr<Renderer> renderer_of(const RenderArguments& a) {
  if (!a.fault.empty() && a.with != "ours") throw std::invalid_argument("--fault goes with our renderer alone");
  if (a.with == "ours") return make_candidate(a.fault);
  std::unique_ptr<Renderer> renderer = make_renderer(a.with);
  if (renderer == nullptr) throw std::invalid_argument(fmt::format("this plumb was built without {}", a.with));
  return renderer;
}

void add_common(CLI::App& command, RenderArguments& a) {
  command.add_option("scene", a.scene, "Scene file")->required();
  command.add_option("--with", a.with, "Renderer: ours, osmesa, softpipe, embree, exact")->capture_default_str();
  command.add_option("--fault", a.fault, "Put a bug into our renderer (plumb list faults)");
  a.scenes.add_to(command);
}

}  // namespace

Command add_render(CLI::App& app) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Draw a scene into a picture");
  add_common(*command, *a);
  command->add_option("-o,--output", a->output, "Colour: .png, or .exr for float")->required();
  command->add_option("--depth", a->depth, "Window depth: .exr");
  return [a, command] {
    if (!command->parsed()) return -1;
    if (!a->depth.empty() && std::filesystem::path(a->depth).extension() != ".exr") {
      throw std::invalid_argument(fmt::format("{}: depth is written as .exr", a->depth));
    }
    const Scene scene = a->scenes.load(a->scene);
    const Capture capture = renderer_of(*a)->capture(scene, {});
    write_image(a->output, capture.planes.color);
    if (!a->depth.empty()) write_depth_exr(a->depth, capture.planes.depth);
    return static_cast<int>(kHolds);
  };
}

Command add_capture(CLI::App& app) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("capture", "Write what a renderer hands out at every stage into a folder");
  add_common(*command, *a);
  command->add_option("folder", a->output, "Folder for the manifest and its arrays")->required();
  return [a, command] {
    if (!command->parsed()) return -1;
    const Scene scene = a->scenes.load(a->scene);
    write_capture(renderer_of(*a)->capture(scene, {StageSet::all(), false, {}, {}}), a->output);
    return static_cast<int>(kHolds);
  };
}

}  // namespace plumbline::cli
