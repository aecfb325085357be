#include "cli/options/program_argument.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "capture/files/conventions_file.h"
#include "capture/renderers/probes.h"
#include "capture/renderers/process_renderer.h"
#include "capture/renderers/replayed_renderer.h"
#include "cli/options/scene_arguments.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::cli {

namespace {

// Replaces each `what` in the text; returns whether there was one.
bool replace(std::string& text, std::string_view what, std::string_view by) {
  bool found = false;
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size(), found = true)
    text.replace(at, what.size(), by);
  return found;
}

// Number of stages that are given to a program with --from: those before clip, or up to window.
std::size_t given(const std::string& from) {
  return from.empty() ? 0 : static_cast<std::size_t>(from == "clip" ? Stage::clip : Stage::coverage);
}

// Whether the export's window.snapped are on the declared grid.
bool has_exported_grid(const Conventions& conventions) {
  return conventions.subpixel_bits == Conventions().subpixel_bits &&
         conventions.subpixel_rounding == Conventions::Rounding::nearest;
}

// The records of the export stand for what the program might have left of these stages. A program of another grid snaps
// p_win itself, by its conventions.
void give(const std::string& from, const Conventions& conventions, const Scene& scene, Capture& left) {
  Records<double> ours = exported_stages(scene).ours.records;
  Records<double>& r = left.records;
  r.matrices = std::move(ours.matrices), r.lights = std::move(ours.lights), r.vertices = std::move(ours.vertices);
  r.lit = std::move(ours.lit);
  for (const char* column : {"vertex.p_eye", "vertex.n_eye"}) left.derived.erase(column);
  for (const Varying v : kAllVaryings) r.varyings[v].vertices = std::move(ours.varyings[v].vertices);
  if (from != "window") return;
  for (const char* column : {"clip.cut", "window.snapped", "window.front", "window.corners", "window.width"}) {
    left.derived.erase(column);
  }
  if (!has_exported_grid(conventions)) left.derived.insert("window.snapped");
  r.polygons = std::move(ours.polygons), r.triangles = std::move(ours.triangles);
  for (const Varying v : kAllVaryings) {
    r.varyings[v].clipped = std::move(ours.varyings[v].clipped);
    r.varyings[v].triangles = std::move(ours.varyings[v].triangles);
  }
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    if (r.covered[i].triangle < r.triangles.size()) continue;
    throw std::invalid_argument(fmt::format("coverage.triangle: element {}: expected a triangle below {}, found {}", i,
                                            r.triangles.size(), r.covered[i].triangle));
  }
}

// Throws where a placeholder is quoted (it is quoted when replaced) or stands where the program should.
void require_placeholders(const std::string& command) {
  for (const std::string_view word : {"{input}", "{output}", "{scene}", "{serve}"}) {
    for (const char quote : {'\'', '"'}) {
      const std::string quoted = fmt::format("{0}{1}{0}", quote, word);
      if (command.find(quoted) == command.npos) continue;
      throw std::invalid_argument(fmt::format("--program: expected {} without quotes, found {}", word, quoted));
    }
    if (std::string_view(command)
            .substr(std::min(command.find_first_not_of(" \t\n"), command.size()))
            .starts_with(word))
      throw std::invalid_argument(fmt::format("--program: expected a program before {}, found {}", word, command));
  }
}

ProcessSpec spec_of(const ProgramArgument& program) {
  const std::string& command = program.command;
  require_placeholders(command);
  ProcessSpec spec;
  spec.conventions = conventions_of(program.conventions);
  if (!program.from.empty()) {
    spec.give = [from = program.from, by = spec.conventions](const Scene& scene, Capture& left) {
      give(from, by, scene, left);
    };
  }
  spec.name = "program";
  spec.shown = command;
  spec.confined = true;
  spec.timeout = program.time_limit;
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
  explicit Program(const ProgramArgument& program)
      : process_(make_process_renderer(spec_of(program))), program_(program) {
    info_.name = "program";
    info_.conventions = process_->info().conventions;
    for (Ability& ability : info_.stages) ability.reason = "it left nothing";
  }
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene& scene, const Request&) override {
    for (Ability& ability : info_.stages) ability = {false, false, "it left nothing"};
    Request everything;
    everything.records = StageSet::all();
    Capture left = capture_of(scene, everything);
    const bool has_winners = !left.planes.id.empty();
    const std::string unprobed = program_.probes ? probe(scene, left) : "";
    const bool are_probed = !has_winners && !left.planes.id.empty();
    const std::unique_ptr<Renderer> replayed = replayed_of(std::move(left), scene);
    info_ = replayed->info();
    for (const Stage stage : {Stage::coverage, Stage::visibility}) {
      if (!unprobed.empty() && !info_[stage].shows) info_[stage].reason = "--each-primitive: " + unprobed;
    }
    if (are_probed) info_[Stage::visibility].contradicted = false;  // the program has not said who they are
    for (std::size_t i = 0; i < given(program_.from); ++i) {
      info_.stages[i] = {false, false, fmt::format("given: --from {}", program_.from), false, true};
    }
    return replayed->capture(scene, everything);
  }

 private:
  // The capture that the program leaves; one beyond the budget is its own mistake.
  Capture capture_of(const Scene& scene, const Request& request) {
    try {
      return process_->capture(scene, request);
    } catch (const OverBudget& error) {
      throw RendererFailed(error.what());
    }
  }

  std::unique_ptr<Renderer> replayed_of(Capture left, const Scene& scene) const {
    try {
      return make_replayed_renderer(std::move(left), scene, "program", process_->info().conventions);
    } catch (const std::invalid_argument& error) {
      throw RendererFailed(error.what());
    }
  }

  // Returns why coverage or winners cannot be probed; empty: they are.
  std::string probe(const Scene& scene, Capture& left) {
    try {
      add_probed_planes(scene, *process_, left);
      return "";
    } catch (const Unsupported& error) {
      return error.what();
    }
  }

  std::unique_ptr<Renderer> process_;
  ProgramArgument program_;
  RendererInfo info_;
};

}  // namespace

void require_program(const ProgramArgument& program) {
  make_program(program);
  const std::string first = program.command.substr(0, program.command.find_first_of(" \t\n"));
  constexpr std::string_view kOfShell = "\\\"'`$&|;<>(){}[]*?!#~=%";
  if (first.empty() || first.find_first_of(kOfShell) != first.npos) return;
  const std::filesystem::path path = first;
  const bool found = path.has_parent_path()
                         ? std::filesystem::is_regular_file(path) && ::access(first.c_str(), X_OK) == 0
                         : std::system(("command -v -- " + first + " >/dev/null 2>&1").c_str()) == 0;
  if (found) return;
  const bool is_there = path.has_parent_path() && std::filesystem::exists(path);
  const char* what = !is_there ? "none" : std::filesystem::is_directory(path) ? "a folder" : "another file";
  throw std::invalid_argument(fmt::format("--program: {}: expected a program that can be run, found {}", first, what));
}

std::unique_ptr<Renderer> make_program(const ProgramArgument& program) { return std::make_unique<Program>(program); }

std::unique_ptr<Renderer> make_probed_program(const ProgramArgument& program) {
  ProcessSpec spec = spec_of(program);
  spec.conventions = {};
  spec.raw_depth = true;
  return make_process_renderer(std::move(spec));
}

Conventions conventions_of(const std::string& file) { return file.empty() ? undeclared() : read_conventions(file); }

namespace {

bool is_opengls(const Conventions& conventions, std::string_view name) {
  const Conventions opengls;
  bool out = true;
  const auto compare = [&](const ConventionWords& words, auto member) {
    if (words.name == name) out = conventions.*member == opengls.*member;
  };
  each_choice(compare);
  each_number_of_bits(compare);
  compare(kSampleWords, &Conventions::sample);
  compare(kOffsetWords, &Conventions::offset_unit);
  compare(kFloatOffsetWords, &Conventions::float_offset_unit);
  return out;
}

}  // namespace

std::string convention_notes(const std::string& file) {
  const Conventions conventions = conventions_of(file);
  std::string out;
  const bool by_floats = settles_ties_of_floats(conventions), settles = by_floats || settles_ties(conventions);
  // A key may have got its value since plumb learn left it open.
  std::vector<std::string> open = conventions.open;
  std::erase_if(open, [&](const std::string& name) {
    return !is_opengls(conventions, name) || (name == "tie_rule" && !settles);
  });
  if (!open.empty()) out += fmt::format("open in {}, and judged as OpenGL's: {}\n", file, fmt::join(open, ", "));
  if (!conventions.accepted.empty())
    out += fmt::format("accepted by {}, if mistaken: {}\n", file, fmt::join(conventions.accepted, ", "));
  if (by_floats)
    out += "judged only between corners that no arithmetic in float rounds: which triangle owns a sample on an edge\n";
  if (!settles)
    out += fmt::format("not judged: which triangle owns a sample on an edge ({})\n",
                       file.empty() ? "no tie rule is declared: plumb learn"
                       : conventions.tie_rule == Conventions::TieRule::any
                           ? fmt::format("{} declares no tie rule", file)
                           : "a rule is settled by subpixel_bits 0 to 10 or float, the sample at a multiple of 1/256 "
                             "pixel or on the grid; where rows count from the top, subpixel_rounding nearest or "
                             "window_y down");
  return out;
}

std::string hint_of_conventions(const std::string& file) {
  if (const Conventions declared = conventions_of(file); !declared.open.empty() || !declared.unexplained.empty())
    return "";  // of plumb learn
  const std::string judged_by = file.empty() ? "OpenGL's" : "those of " + file;
  return fmt::format(
      "the renderer's own conventions (grid, tie rule, roundings, corners) may be others than {}:\n"
      "  plumb learn --program CMD -o FILE, then --conventions FILE\n",
      judged_by);
}

std::string command_of_submission(const std::string& command, const std::filesystem::path& folder) {
  std::string line = command;
  if (replace(line, "{submission}", shell_word(std::filesystem::absolute(folder).lexically_normal().string())))
    return line;
  throw std::invalid_argument(
      fmt::format("--submissions: expected {{submission}} in the command line of --program, found {}", command));
}

ExportedStages exported_stages(const Scene& scene) {
  Request request;
  request.planes = WantedPlanes::none;
  request.records = kGeometryStages;
  Request of_matrices = request;
  of_matrices.records = {Stage::matrices};
  return {pipeline::make_pipeline()->capture(scene, request),
          exact::make_exact()->capture(scene, of_matrices).records.matrices};
}

}  // namespace plumbline::cli
