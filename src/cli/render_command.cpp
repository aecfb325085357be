// plumb render: a scene to a picture. plumb capture: a scene to a capture folder.
#include <cstdio>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "base/atomic_path.h"
#include "capture/contradictions.h"
#include "capture/files/capture_folder.h"
#include "capture/files/image_file.h"
#include "capture/renderers/process_renderer.h"
#include "cli/commands.h"
#include "cli/options/outputs.h"
#include "cli/options/program_argument.h"
#include "export/export_folder.h"

namespace plumbline::cli {

namespace {

std::unique_ptr<Renderer> renderer_of(const std::string& with, const std::string& fault) {
  if (!fault.empty() && with != "ours") throw std::invalid_argument("--fault goes with our renderer alone");
  if (with == "ours") return make_candidate(fault);
  std::unique_ptr<Renderer> renderer = make_renderer(with);
  if (renderer == nullptr) throw std::invalid_argument(fmt::format("this plumb was built without {}", with));
  return renderer;
}

// The frame's colour; of a renderer that finds what is visible and no more, each primitive in a colour of its own,
// mixed from its number.
Plane<glm::vec4> picture_of(const Capture& drawn) {
  if (!drawn.planes.color.empty()) return drawn.planes.color;
  Plane<glm::vec4> out(drawn.planes.id.width(), drawn.planes.id.height(), {0, 0, 0, 1});
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::int32_t id = drawn.planes.id.values()[i];
    if (id == kBackground) continue;
    const std::uint32_t mixed = (static_cast<std::uint32_t>(id) + 1) * 0x9e3779b1u;
    out.values()[i] =
        glm::vec4(64 + (mixed >> 8 & 127), 64 + (mixed >> 16 & 127), 64 + (mixed >> 24 & 127), 255) / 255.0f;
  }
  return out;
}

}  // namespace

int render(const RenderOptions& o) {
  require_image_name(o.output);
  if (!o.depth.empty()) require_depth_name(o.depth);
  const std::filesystem::path inputs[] = {o.scene};
  const Output files[] = {{"--output", o.output}, {"--depth", o.depth}};
  require_outputs(files, {}, inputs);
  const std::unique_ptr<Renderer> renderer = renderer_of(o.with, o.fault);
  Request request;
  request.planes = WantedPlanes::picture;
  const Scene scene = o.scene_arguments.load(o.scene);
  require_image_name(o.output, scene.frame.color);
  Capture drawn = renderer->capture(scene, request);
  drawn.planes.color = picture_of(drawn);
  if (rows_from_top(scene.dialect)) {
    drawn.planes.color = upside_down(drawn.planes.color);
    drawn.planes.depth = upside_down(drawn.planes.depth);
  }
  const Bytes color = encode_image(o.output, drawn.planes.color, scene.frame.color);
  if (o.depth.empty()) {
    write_file(o.output, color);
    return kHolds;
  }
  const Bytes depth = encode_depth_exr(o.depth, drawn.planes.depth);
  const OutputFile both[] = {{o.output, color}, {o.depth, depth}};
  write_files(both);
  return kHolds;
}

namespace {

// A capture checked against itself.
int check_capture(const std::string& folder) {
  const std::vector<std::string> found = contradictions(read_capture(folder));
  for (const std::string& line : found) fmt::print("{}: {}\n", folder, line);
  if (found.empty()) fmt::print("{}: nothing contradicts itself\n", folder);
  return found.empty() ? kHolds : kDiffers;
}

}  // namespace

int capture(const CaptureOptions& o) {
  if (!o.check.empty()) return check_capture(o.check);
  if (o.folder.empty()) throw std::invalid_argument("capture: expected a scene and a folder, or --check FOLDER");
  require_writable_capture(o.folder);
  const std::unique_ptr<Renderer> renderer = renderer_of(o.with, o.fault);
  const Scene scene = o.scene_arguments.load(o.scene);
  try {
    write_capture(renderer->capture(scene, {.records = StageSet::all()}), o.folder);
    return kHolds;
  } catch (const Unsupported& e) {
    std::fputs((std::string(e.what()) + "\n").c_str(), stderr);
  } catch (const OverBudget& e) {
    std::fputs((std::string(e.what()) + "\n").c_str(), stderr);
  }
  return kUnsupportedStatus;
}

int export_scene(const ExportOptions& o) {
  require_writable_export(o.folder);
  write_export(o.scene_arguments.load(o.scene), exported_stages, o.folder);
  return kHolds;
}

}  // namespace plumbline::cli
