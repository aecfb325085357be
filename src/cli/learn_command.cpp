// plumb learn: a renderer's conventions, from its pictures and depths.
#include <filesystem>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "base/atomic_path.h"
#include "capture/files/conventions_file.h"
#include "capture/files/image_file.h"
#include "cli/commands.h"
#include "cli/options/outputs.h"
#include "cli/options/program_argument.h"
#include "learn/learn.h"

namespace plumbline::cli {

namespace {

std::unique_ptr<Renderer> asked_renderer(const LearnOptions& o) {
  if (!o.candidate.command.empty()) {
    require_program(o.candidate);
    return make_probed_program(o.candidate);
  }
  if (o.with.empty()) throw std::invalid_argument("learn: expected --program CMD or --with NAME, found neither");
  std::unique_ptr<Renderer> renderer = make_renderer(o.with);
  if (renderer == nullptr) throw std::invalid_argument(fmt::format("this plumb was built without {}", o.with));
  return renderer;
}

// Before the work, as it may be refused.
void make_folder(const std::string& folder) {
  try {
    if (!folder.empty()) std::filesystem::create_directories(folder);
  } catch (const std::filesystem::filesystem_error& e) {
    throw std::runtime_error(fmt::format("--pictures: {}: {}", folder, e.code().message()));
  }
}

void write_pictures(const std::string& folder, const learn::Learned& learned) {
  for (const learn::ProbePicture& picture : learned.pictures) {
    const std::filesystem::path name = std::filesystem::path(picture.name).filename();
    write_image(std::filesystem::path(folder) / (name.string() + ".png"), picture.color);
  }
}

}  // namespace

int learn(const LearnOptions& o) {
  const Output outputs[] = {{"--output", o.output}};
  require_outputs(outputs, {}, {});
  require_folder({"--pictures", o.pictures});
  const std::unique_ptr<Renderer> renderer = asked_renderer(o);
  make_folder(o.pictures);
  learn::Learned learned;
  try {
    learned = learn::learn(*renderer);
  } catch (const Unsupported& e) {
    throw std::invalid_argument(fmt::format(
        "not learned: expected a rectangle drawn (unlit triangles, depth_func always), found unsupported: {}",
        e.what()));
  } catch (const RendererFailed& e) {
    fmt::print("failed: {}\n", e.what());
    return kDiffers;
  }
  fmt::print("{}", learn::learned_text(learned));
  if (!o.output.empty()) write_file(o.output, conventions_text(learned.conventions));
  if (!o.pictures.empty()) write_pictures(o.pictures, learned);
  return mistaken(learned.conventions).empty() ? kHolds : kDiffers;
}

}  // namespace plumbline::cli
