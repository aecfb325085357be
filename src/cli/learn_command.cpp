// plumb learn: a renderer's conventions, from its pictures and depths.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_path.h"
#include "capture/files/conventions_file.h"
#include "capture/files/image_file.h"
#include "capture/same_bits.h"
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

// A renderer, and the probes that it has drawn.
class Remembering : public Renderer {
 public:
  explicit Remembering(std::unique_ptr<Renderer> inner) : inner_(std::move(inner)) {}
  RendererInfo info() const override { return inner_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    Capture out = inner_->capture(scene, request);
    drawn_.emplace_back(scene, out.planes);
    return out;
  }
  const std::vector<std::pair<Scene, Planes>>& drawn() const { return drawn_; }

 private:
  std::unique_ptr<Renderer> inner_;
  std::vector<std::pair<Scene, Planes>> drawn_;
};

// Finding about probes that a server draws otherwise when it is started for each alone. Empty: no difference, or the
// program is no server. Comparing ends after 10 s, with a line for people on how many probes it came to.
std::string kept_state(ProgramArgument program, const std::vector<std::pair<Scene, Planes>>& drawn) {
  constexpr std::chrono::seconds kMost{10};
  const auto until = std::chrono::steady_clock::now() + kMost;
  if (program.command.find("{serve}") == std::string::npos) return "";
  program.time_limit = std::min(program.time_limit, kMost);
  std::size_t compared = 0, others = 0;
  for (const auto& [scene, planes] : drawn) {
    if (std::chrono::steady_clock::now() > until) break;
    try {
      const Planes alone = make_probed_program(program)->capture(scene, Request{}).planes;
      others += !have_same_bits(alone.color, planes.color) || !have_same_bits(alone.depth, planes.depth);
    } catch (const RendererFailed&) {  // it may be slow
      continue;
    } catch (const Unsupported&) {
      ++others;
    }
    ++compared;
  }
  if (compared < drawn.size()) fmt::print("state: compared on {} of {} probes, within 10 s\n", compared, drawn.size());
  if (others == 0) return "";
  return fmt::format(
      "{} of {} probes are drawn otherwise when the program is started for each alone: it keeps a state (is the frame "
      "cleared, and its depths?), or does not set its memory",
      others, compared);
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

// Mistakes that the file, which is about to be written anew, accepts; none where it is no file of conventions.
std::vector<std::string> accepted_before(const std::string& file) {
  if (file.empty() || !std::filesystem::exists(file)) return {};
  try {
    return read_conventions(file).accepted;
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

int learn(const LearnOptions& o) {
  const Output outputs[] = {{"--output", o.output}};
  require_outputs(outputs, {}, {});
  require_folder({"--pictures", o.pictures});
  Remembering renderer(asked_renderer(o));
  make_folder(o.pictures);
  learn::Learned learned;
  try {
    learned = learn::learn(renderer);
  } catch (const Unsupported& e) {
    throw std::invalid_argument(
        fmt::format("not learned: expected a rectangle of unlit triangles, found unsupported: {}", e.what()));
  } catch (const RendererFailed& e) {
    fmt::print("failed: {}\n", e.what());
    return kDiffers;
  }
  if (std::string state = kept_state(o.candidate, renderer.drawn()); !state.empty())
    learned.conventions.unexplained.push_back(std::move(state));
  learned.conventions.accepted = accepted_before(o.output);
  fmt::print("{}", learn::learned_text(learned));
  if (!o.output.empty()) write_file(o.output, conventions_text(learned.conventions));
  if (!o.pictures.empty()) write_pictures(o.pictures, learned);
  return not_accepted(learned.conventions).empty() ? kHolds : kDiffers;
}

}  // namespace plumbline::cli
