#include "cli/options/program_argument.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "capture/renderers/probes.h"
#include "capture/renderers/process_renderer.h"
#include "capture/renderers/replayed_renderer.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::cli {

namespace {

// Replaces each `what` in the text. Whether there was one.
bool replace(std::string& text, std::string_view what, std::string_view by) {
  bool found = false;
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size(), found = true)
    text.replace(at, what.size(), by);
  return found;
}

ProcessSpec spec_of(const std::string& command) {
  ProcessSpec spec;
  spec.name = "program";
  spec.shown = command;
  spec.confined = true;
  std::string line = command;  // a shell's
  spec.serves = replace(line, "{serve}", "--serve");
  const bool scene = replace(line, "{scene}", "\"$1\""), input = replace(line, "{input}", "\"$2\""),
             output = replace(line, "{output}", "\"$3\"");
  if (spec.serves ? scene || input || output : !output || !(scene || input)) {
    throw std::invalid_argument(fmt::format(
        "--program: expected {{output}} and {{input}} or {{scene}} in the command line, or {{serve}} alone, "
        "found {}",
        command));
  }
  spec.argv = {"sh", "-c", line, "sh"};
  if (!spec.serves) spec.argv.insert(spec.argv.end(), {scene ? "{scene}" : "", input ? "{input}" : "", "{output}"});
  if (input || spec.serves) {
    spec.write_input = [](const Scene& of, const std::filesystem::path& folder) {
      write_export(of, exported_stages, folder);
    };
  }
  return spec;
}

class Program : public Renderer {
 public:
  Program(const std::string& command, bool probes)
      : process_(make_process_renderer(spec_of(command))), probes_(probes) {
    info_.name = "program";
    for (Ability& ability : info_.stages) ability.reason = "it left nothing";
  }
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene& scene, const Request&) override {
    for (Ability& ability : info_.stages) ability = {false, false, "it left nothing"};
    Request everything;
    everything.records = StageSet::all();
    Capture left = capture_of(scene, everything);
    if (probes_) probe(scene, left);
    const std::unique_ptr<Renderer> replayed = make_replayed_renderer(std::move(left), scene, "--program");
    info_ = replayed->info();
    return replayed->capture(scene, everything);
  }

 private:
  // What it leaves beyond the budget is its own mistake.
  Capture capture_of(const Scene& scene, const Request& request) {
    try {
      return process_->capture(scene, request);
    } catch (const OverBudget& error) {
      throw RendererFailed(error.what());
    }
  }

  // What cannot be probed is not shown.
  void probe(const Scene& scene, Capture& left) {
    try {
      add_probed_planes(scene, *process_, left);
    } catch (const Unsupported&) {
    }
  }

  std::unique_ptr<Renderer> process_;
  bool probes_;
  RendererInfo info_;
};

}  // namespace

std::unique_ptr<Renderer> make_program(const std::string& command, bool probes) {
  return std::make_unique<Program>(command, probes);
}

ExportedStages exported_stages(const Scene& scene) {
  Request request;
  request.planes = WantedPlanes::none;
  request.records = {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window};
  Request of_matrices = request;
  of_matrices.records = {Stage::matrices};
  return {pipeline::make_pipeline()->capture(scene, request),
          exact::make_exact()->capture(scene, of_matrices).records.matrices};
}

}  // namespace plumbline::cli
