#include "faults/endings.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <regex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "faults/variants.h"

namespace plumbline::faults {

namespace {

void crash(const pipeline::DrawInput&, pipeline::Polygon&) { ::raise(SIGSEGV); }

void hang(const pipeline::DrawInput&, const pipeline::Polygon&, std::vector<pipeline::ShadedTriangle>&) {
  while (true) ::pause();
}

void take_memory(const pipeline::LightInput&, std::vector<pipeline::Attributes>& out) {
  while (true) out.resize(2 * out.size() + 1);
}

void refuse(const Matrices<float>&, Normals, const Mesh&, std::vector<Vertex<float>>&) {
  throw std::runtime_error("a vertex too many");
}

template <auto member, auto function>
constexpr Fault ending(std::string_view name, std::string_view changes, Stage stage) {
  return {name, changes, stage, put<member, function>};
}

constexpr Fault kEndings[] = {
    ending<&Stages::vertex, refuse>("endings.throw", "the vertex stage throws", Stage::vertex),
    ending<&Stages::light, take_memory>("endings.memory", "the light stage takes all memory", Stage::light),
    ending<&Stages::clip, crash>("endings.crash", "the clip stage is ended by a signal", Stage::clip),
    ending<&Stages::window, hang>("endings.hang", "the window stage does not end", Stage::window),
};

class Ending final : public Renderer {
 public:
  Ending(std::unique_ptr<Renderer> inner, ReferenceEnding ending)
      : inner_(std::move(inner)), ending_(std::move(ending)) {}
  RendererInfo info() const override { return inner_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    if (scene.name == ending_.scene) end();
    return inner_->capture(scene, request);
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) override {
    return inner_->run_stage(scene, stage, in, conventions);
  }

 private:
  void end() const {
    if (ending_.how == "crash") ::raise(SIGSEGV);
    if (ending_.how == "exit") std::exit(0);
    while (ending_.how == "hang") ::pause();
    std::vector<char> memory(1);
    while (ending_.how == "memory") memory.resize(2 * memory.size());
    throw std::runtime_error("a scene too many");
  }

  std::unique_ptr<Renderer> inner_;
  ReferenceEnding ending_;
};

}  // namespace

std::span<const Fault> endings() { return kEndings; }

std::optional<ReferenceEnding> reference_ending(std::string_view fault) {
  static const std::regex kForm("endings\\.(throw|memory|crash|exit|hang):([a-z_]+):(.+)");
  const std::string text(fault);
  std::smatch parts;
  if (!std::regex_match(text, parts, kForm)) return std::nullopt;
  return ReferenceEnding{parts[1], parts[2], parts[3]};
}

std::unique_ptr<Renderer> make_ending(std::unique_ptr<Renderer> inner, ReferenceEnding ending) {
  return std::make_unique<Ending>(std::move(inner), std::move(ending));
}

}  // namespace plumbline::faults
