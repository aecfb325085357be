// plumb diagnose: one scene, every stage that is wrong; with --picture, known faults that draw such a frame.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "capture/by_conventions.h"
#include "capture/contradictions.h"
#include "capture/files/capture_folder.h"
#include "capture/files/image_file.h"
#include "capture/renderers/replayed_renderer.h"
#include "check/diagnose/diagnose.h"
#include "check/diagnose/history.h"
#include "cli/commands.h"
#include "cli/likely/holes.h"
#include "cli/likely/lookalikes.h"
#include "cli/options/outputs.h"
#include "cli/options/pixel_argument.h"
#include "cli/options/program_argument.h"
#include "cli/options/references.h"
#include "cli/worker_bytes.h"
#include "report/page/diagnosis_page.h"
#include "report/runs/json_report.h"
#include "report/text/diagnosis_text.h"
#include "report/text/history_text.h"
#include "scene/antialias.h"
#include "scene/draw_index.h"

namespace plumbline::cli {

namespace {

// The capture that a program left, and what the program shows of it.
class LeftCapture : public Renderer {
 public:
  LeftCapture(Capture capture, RendererInfo info) : capture_(std::move(capture)), info_(std::move(info)) {}
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene&, const Request&) override { return capture_; }

 private:
  Capture capture_;
  RendererInfo info_;
};

// Candidate of another renderer: the capture that it left. (A program is run once.)
std::unique_ptr<Renderer> outside_candidate(const DiagnoseOptions& o, const Scene& scene) {
  if (!o.folder.empty()) {
    const Conventions conventions = conventions_of(o.candidate.conventions);
    Capture left = read_capture(o.folder);
    to_dialect(conventions, left);
    return make_replayed_renderer(std::move(left), scene, o.folder, conventions);
  }
  require_program(o.candidate);
  const std::unique_ptr<Renderer> program = make_program(o.candidate);
  Capture left = program->capture(scene, {.records = StageSet::all()});
  return std::make_unique<LeftCapture>(std::move(left), program->info());
}

// Of an antialiased scene its frame, and the stages of its first pass; else the stages of the frame.
std::vector<report::Pictured> pictured(const Scene& scene, Renderer& candidate, const References& references) {
  const auto all_that_fits = [](auto capture_of) {
    try {
      return capture_of();
    } catch (const OverBudget&) {
      return Capture{};
    } catch (const Unsupported&) {
      return Capture{};
    }
  };
  std::vector<report::Pictured> out;
  if (antialiased(scene)) out.push_back({"the frame", scene, candidate.capture(scene, Request{}), {}});
  const std::vector<Scene> passes = passes_of(scene);
  Request request;
  request.records = StageSet::all();
  Capture mine = all_that_fits([&] { return candidate.capture(passes.front(), request); });
  if (mine.width == 0) mine = candidate.capture(passes.front(), Request{});
  const std::string title = !antialiased(scene)  ? "stage by stage"
                            : passes.size() == 1 ? "its samples"
                                                 : fmt::format("the first of its {} passes", passes.size());
  out.push_back({title, passes.front(), std::move(mine), {}});
  for (const check::Reference& r : references.list) {
    if (r.renderer == nullptr || !is_referee(r.renderer->info())) continue;
    out.back().expected = all_that_fits([&] { return check::expected_capture(passes.front(), *r.renderer); });
    if (antialiased(scene)) out.front().expected = all_that_fits([&] { return r.renderer->capture(scene, Request{}); });
  }
  return out;
}

// The scene to be diagnosed, and where the page goes.
struct Subject {
  const DiagnoseOptions& options;
  const Scene& scene;
  std::optional<glm::ivec2> pixel;
  std::optional<report::PageFolder> page;
};

// Lines of the capture's contradictions, with those of what the renderer has taken out of it; empty: none.
std::string contradiction_lines(const Capture& capture, const RendererInfo& renderer) {
  std::string out;
  for (const std::string& line : contradictions(capture)) out += fmt::format("  {}\n", line);
  out = out.empty() ? out : "the capture contradicts itself:\n" + out;
  for (const Stage stage : {Stage::window, Stage::visibility}) {
    if (renderer[stage].contradicted) out += fmt::format("{} FAILED: {}\n", name_of(stage), renderer[stage].reason);
  }
  return out.empty() ? out : out + "\n";
}

// Lines of declared conventions that are mistakes; the stages are judged as if they were none.
std::string convention_lines(const Conventions& conventions) {
  std::string out;
  for (const std::string& line : mistaken(conventions)) out += fmt::format("  {}\n", line);
  return out.empty() ? out : "mistakes in the conventions, by which the stages are judged:\n" + out + "\n";
}

bool holds(const check::Diagnosis& diagnosis) {
  return std::ranges::none_of(diagnosis.verdict.comparisons,
                              [](const check::Comparison& c) { return is_failure(c.outcome); });
}

std::string likely_line(const Lookalikes& found) {
  const char* why = found.by_nearness ? "its frame is as near" : "the frame is the same";
  const std::string ties = found.ties.empty() ? "" : fmt::format("  or {}: {}\n", fmt::join(found.ties, ", "), why);
  return fmt::format("likely stage{}: {}\n{}", found.together ? "s" : "", found.likely, ties);
}

// Text about the known faults that explain another renderer's frame, if one explains most differing pixels. Of a frame
// that holds, only a single fault that explains all of them is told: a legal frame may follow another rule.
std::string known_faults(const Scene& scene, const Capture& left, const RendererInfo& renderer,
                         const check::Diagnosis& diagnosis) {
  constexpr std::size_t kMostPrimitives = 200'000;  // each fault is a picture
  if (left.planes.color.empty() || DrawIndex(scene).primitives() > kMostPrimitives) return "";
  const Lookalikes found = lookalikes(scene, frame_of(left, renderer, diagnosis.verdict));
  if (found.blank && !holds(diagnosis)) return "\n" + found.text;
  const std::vector<std::string> likely = likely_of(found, diagnosis.verdict);
  if (likely.empty() || (holds(diagnosis) && (!found.whole || found.together))) return "";
  const bool is_open = !holds(diagnosis) && diagnosis.wrong.empty();
  return fmt::format("\npixels unlike plumbline's in colour{}: {}; known faults that draw such a frame:\n{}{}",
                     left.planes.depth.empty() ? ""
                     : found.by_color          ? " (depths are like no fault's)"
                                               : " or depth",
                     found.apart, found.text,
                     is_open            ? likely_line(found)
                     : holds(diagnosis) ? fmt::format("legal, and drawn as by {}\n", fmt::join(likely, " or "))
                                        : "");
}

// Text about pixels that lack a surface, of another renderer's wrong frame whose coverage nobody judged.
std::string lines_of_holes(const DiagnoseOptions& o, const Scene& scene, const Capture& left,
                           const RendererInfo& renderer, const check::Diagnosis& diagnosis) {
  if (left.planes.color.empty() || holds(diagnosis) || !check::is_by_frame_alone(diagnosis.verdict)) return "";
  const std::string text = holes_text(scene, frame_of(left, renderer, diagnosis.verdict));
  const bool may_ask = !text.empty() && !o.candidate.command.empty() && !o.candidate.probes;
  return (text.empty() ? "" : "\n" + text) + (may_ask ? "--each-primitive judges coverage\n" : "");
}

// Line where another renderer's frame is wrong, and no known fault draws such a frame; a pointer to `plumb learn` where
// no conventions are declared.
std::string hint_where_unexplained(const DiagnoseOptions& o, const check::Diagnosis& diagnosis,
                                   const std::string& faults) {
  const bool is_ours = o.candidate.command.empty() && o.folder.empty();
  if (is_ours || !faults.empty() || holds(diagnosis)) return "";
  if (!o.seeks_causes) return "\nknown faults are not sought, by --no-causes\n";
  if (o.candidate.conventions.empty())
    return "\nno known fault draws such a frame; " + hint_of_conventions(o.candidate.conventions);
  return check::is_by_frame_alone(diagnosis.verdict) ? "\nno known fault draws such a frame\n" : "";
}

// In a worker: writes the files.
DiagnosisAnswer diagnose_here(Subject& subject, const Watch& watch) {
  const DiagnoseOptions& o = subject.options;
  const Scene& scene = subject.scene;
  const bool outside = !o.folder.empty() || !o.candidate.command.empty();
  require_references(o.against);
  std::unique_ptr<Renderer> candidate;
  try {
    candidate = make_watched(outside ? outside_candidate(o, scene) : make_candidate(o.fault), 0, watch);
  } catch (const Unsupported& e) {
    throw std::invalid_argument(fmt::format("{}: not judged: the program does not draw it: {}", scene.path, e.what()));
  } catch (const RendererFailed& e) {
    return {kDiffers, fmt::format("failed {}: {}\n", scene.path, e.what())};
  }
  const References references = make_references(without_repeats(o.against), o.scene_arguments.assets, watch);
  const check::Diagnosis diagnosis = check::diagnose(scene, *candidate, references.list, o.most_fragments);
  if (check::judged_stages(diagnosis.verdict).empty() && (outside || holds(diagnosis))) {
    const std::string what = !o.folder.empty() ? o.folder : outside ? "--program" : scene.path;
    throw std::invalid_argument(fmt::format("{}: expected {} that can be judged, found {}", what,
                                            outside ? "the arrays of a stage" : "a stage",
                                            check::judged_text(diagnosis.verdict)));
  }
  std::string against_itself, open, faults, holes;
  if (outside) {
    open = convention_notes(o.candidate.conventions);
    const Capture left = candidate->capture(scene, Request{});
    against_itself = convention_lines(candidate->info().conventions) + contradiction_lines(left, candidate->info());
    if (o.seeks_causes) faults = known_faults(scene, left, candidate->info(), diagnosis);
    holes = lines_of_holes(o, scene, left, candidate->info(), diagnosis);
  }
  std::string out = fmt::format("{}: {}\n\n{}{}", scene.path, candidate->info().name, against_itself,
                                report::diagnosis_text(diagnosis)) +
                    open + holes + faults + hint_where_unexplained(o, diagnosis, faults);
  std::string history, history_text;
  if (subject.pixel) {
    const check::History known = check::pixel_history(scene, *candidate, references.list, *subject.pixel);
    const SceneByConventions seen(scene, candidate->info().conventions);
    history_text = report::history_text(*seen, known);
    if (!o.candidate.conventions.empty())
      history_text +=
          fmt::format("  fragments of osmesa and exact: by OpenGL's grid and tie rule; what is legal: by {}\n",
                      o.candidate.conventions);
    out += "\n" + history_text;
    history = report::history_json(*seen, known);
  }
  if (!o.json.empty()) report::write_json(o.json, diagnosis, versions_of(*candidate, references), history);
  if (subject.page) {
    report::write_diagnosis_page(*subject.page, scene, diagnosis, pictured(scene, *candidate, references),
                                 open + holes + faults + history_text);
    out += fmt::format("page: {}\n", (std::filesystem::absolute(o.report) / "index.html").lexically_normal().string());
  }
  const bool of_conventions_alone = holds(diagnosis) && !not_accepted(candidate->info().conventions).empty();
  if (of_conventions_alone) out += "the stages hold; FAILED by the mistakes in the conventions\n";
  return {holds(diagnosis) && !of_conventions_alone ? kHolds : kDiffers, out};
}

// The plane of an image file, whose row 0 is the bottom one, in the scene's order of rows.
template <class T>
Plane<T> in_scenes_order(const Scene& scene, Plane<T> plane) {
  return rows_from_top(scene.dialect) ? upside_down(plane) : plane;
}

template <class T>
void require_size(const std::string& file, const Plane<T>& plane, const Scene& scene) {
  if (plane.width() == scene.frame.width && plane.height() == scene.frame.height) return;
  throw std::runtime_error(fmt::format("{}: expected a picture of the scene's {} x {} pixels, found one of {} x {}",
                                       file, scene.frame.width, scene.frame.height, plane.width(), plane.height()));
}

}  // namespace

int diagnose(const DiagnoseOptions& o) {
  if (!o.candidate.conventions.empty() && o.folder.empty() && o.candidate.command.empty())
    throw std::invalid_argument("--conventions: expected --program or --capture beside it, found neither");
  conventions_of(o.candidate.conventions);  // refuses what declares none
  if (!o.picture.empty()) return diagnose_picture(o);
  const Scene scene = o.scene_arguments.load(o.scene);
  require_budget(scene, plane_bytes(scene), Request{}.memory_budget);
  Subject subject{o, scene, {}, {}};
  if (!o.pixel.empty()) subject.pixel = parse_pixel("--pixel", o.pixel, scene.frame);
  const Output outputs[] = {{"--json", o.json}};
  std::vector<std::filesystem::path> inputs = {o.scene};
  if (!o.folder.empty() && std::filesystem::is_directory(o.folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(o.folder)) inputs.push_back(entry.path());
  }
  require_outputs(outputs, {"--report", o.report}, inputs);
  if (!o.report.empty()) subject.page.emplace(o.report).remove_earlier();
  WorkerLimits limits = o.limits;
  if (!o.candidate.command.empty()) limits.step += kOwnProcessLimit;  // a program has a time limit of its own
  JudgeRequest request;
  int code = kDiffers;
  const auto make = [&](Progress& progress) -> Workers::Answer {
    return [&subject, &progress, &limits](const std::string& bytes) {
      const EndedSteps ended = request_of(bytes).ended;
      return to_bytes(diagnose_here(subject, {&progress, &ended, limits.step}));
    };
  };
  const auto take = [&](std::size_t, const std::string& answer) {
    const DiagnosisAnswer diagnosis = diagnosis_of(answer);
    code = diagnosis.code;
    fmt::print("{}", diagnosis.text);
  };
  const auto ask_again = [&](std::size_t, const WorkerEnd& end) {
    if (end.step == Progress::kBetween) throw std::runtime_error(fmt::format("{}: the diagnosis {}", o.scene, end.how));
    request.ended[end.step] = end.how;
    return to_bytes(request);
  };
  const std::size_t only[] = {0};
  Workers(1, limits, make).run({only, [&](std::size_t) { return to_bytes(request); }, take, ask_again});
  return code;
}

int diagnose_picture(const DiagnoseOptions& o) {
  const Scene scene = o.scene_arguments.load(o.scene);
  require_budget(scene, plane_bytes(scene), Request{}.memory_budget);
  GivenFrame given;
  given.conventions = undeclared();
  given.color = in_scenes_order(scene, read_image(o.picture));
  require_size(o.picture, given.color, scene);
  if (!o.depth.empty() && std::filesystem::path(o.depth).extension() != ".exr") {
    throw std::invalid_argument(fmt::format("--depth: expected an .exr file of window z, found {}", o.depth));
  }
  if (!o.depth.empty()) {
    const StoredImage depth = read_stored(o.depth);
    if (depth.channels.size() != 1) {
      throw std::invalid_argument(
          fmt::format("--depth: {}: expected one channel of window z, found {}", o.depth, depth.channels.size()));
    }
    given.depth = in_scenes_order(scene, depth.channels.front().values);
    require_size(o.depth, given.depth, scene);
  }
  const Lookalikes found = lookalikes(scene, given);
  fmt::print("{}: {} of {} pixels are more than {}/255{} from ours\n", o.picture, found.apart, given.color.size(),
             found.codes,
             o.depth.empty() || found.by_color ? ""
             : found.codes == 1                ? ", or a step of depth,"
                                               : ", or a quarter of a step of depth,");
  if (found.apart == 0) return kHolds;
  fmt::print("{}", found.text);
  if (!found.likely.empty()) fmt::print("{}", likely_line(found));
  return kDiffers;
}

}  // namespace plumbline::cli
