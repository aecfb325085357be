#include "cli/arguments.h"

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "base/did_you_mean.h"
#include "cli/commands.h"
#include "cli/options/argument_kinds.h"
#include "cli/options/say.h"
#include "notes/notes.h"

namespace plumbline::cli {

namespace {

template <class Options>
void add_drawing(CLI::App& command, Options& o) {
  text(command, "scene", o.scene, "Scene file")->required();
  text(command, "--with", o.with, fmt::format("Renderer: {}", fmt::join(renderer_names(), ", ")))
      ->capture_default_str();
  text(command, "--fault", o.fault, "Put a fault into our renderer (plumb list faults)");
  add_assets(command, o.scene_arguments);
}

void add(CLI::App& command, RenderOptions& o) {
  add_drawing(command, o);
  text(command, "-o,--output", o.output, "Colour: .png, .tga, .ppm, or .exr for float")->required();
  text(command, "--depth", o.depth, "Window depth: .exr");
}

// Our renderer with a fault, or a program in its place.
CLI::Option* add_candidate(CLI::App& command, CheckOptions& o) {
  CLI::Option* fault = text(command, "--fault", o.fault, "Put a fault into our renderer (plumb list faults)");
  CLI::Option* program =
      add_program(command, o.candidate, "Judge what this command line draws, in our renderer's place: ");
  program->excludes(fault);
  command.get_option("--conventions")->needs(program);
  return program;
}

void add_jobs(CLI::App& command, int& jobs) {
  command
      .add_option("--jobs", jobs,
                  "Scenes judged at a time, each in a process of its own (default: the number of processors)")
      ->check(CLI::Range(1, kMostJobs));
}

// Option that clears `seeks_causes`.
CLI::Option* add_no_causes(CLI::App& command, bool& seeks_causes) {
  return command.add_flag_callback(
      "--no-causes", [&seeks_causes] { seeks_causes = false; },
      "Do not draw wrong scenes with each known fault, which takes most of the time where many are wrong");
}

void add(CLI::App& command, CheckOptions& o) {
  text(command, "scenes", o.scenes, "Scene files, and folders of them")->required();
  add_against(command, o.against);
  text(command, "--json", o.json, "Write one object per comparison");
  text(command, "--report", o.report, "Write a page with pictures into this folder");
  text(command, "--ledger", o.ledger, "Write the largest difference seen for each tolerance");
  text(command, "--junit", o.junit, "Write a test case per scene as JUnit's XML");
  text(command, "--markdown", o.markdown, "Write a summary for a CI page");
  command.add_flag("-v,--verbose", o.verbose,
                   "Print the rows of every scene (default: of those that do not hold, or of a single one)");
  text(command, "--rows", o.rows, "Leave each scene's rows, and whether it holds, in this folder");
  text(command, "--failures", o.failures, "Leave a page of each scene that does not hold in this folder");
  text(command, "--expect", o.expect, "Known differences, each with reason, issue and last day");
  text(command, "--today", o.today, "YYYY-MM-DD, for their last days (default: the clock's)");
  text(command, "--shard", o.shard, "I/N: every Nth scene, from number I on");
  text(command, "--golden", o.golden, "Compare with the goldens in this folder as well, stage by stage");
  CLI::Option* program = add_candidate(command, o);
  program->excludes(command.get_option("--golden"));
  CLI::Option* submissions = text(command, "--submissions", o.submissions,
                                  "A folder: judge the program for each folder in it, which is {submission} in the "
                                  "command line; a row for each")
                                 ->needs(program);
  CLI::Option* rubric = text(command, "--grade", o.rubric, "With --program: points by scene and stage, as JSON")
                            ->needs(command.get_option("--program"));
  CLI::Option* grades = text(command, "--grades", o.grades,
                             "Write the points earned as Gradescope's results.json; of --submissions a folder of such");
  rubric->needs(grades);
  grades->needs(rubric);
  for (const char* of_one : {"--json", "--report", "--ledger", "--junit", "--rows", "--failures", "--expect"})
    submissions->excludes(command.get_option(of_one));
  add_jobs(command, o.jobs);
  add_limits(command, o.limits, o.candidate);
  text(command, "--cache", o.cache,
       "Keep verdicts in this folder for later runs (default: plumbline in the user's folder of caches)")
      ->envname("PLUMBLINE_CACHE");
  const auto without_cache = [&o] { o.cache.clear(); };
  command.add_flag_callback("--no-cache", without_cache, "Judge every scene anew, and keep nothing")
      ->envname("PLUMBLINE_NO_CACHE");
  command.add_flag("--allow-missing", o.allow_missing, "A reference that is not built in is no failure");
  add_no_causes(command, o.seeks_causes)->needs(command.get_option("--program"));
  add_assets(command, o.scene_arguments);
}

void add(CLI::App& command, CampaignOptions& o) {
  text(command, "folder", o.folder, "Folder of the campaign: its journals, its findings, results.json")->required();
  text(command, "--seeds", o.seeds,
       "FIRST..LAST: judge a scene for each, but those that a journal holds; without it, "
       "report what the journals hold");
  command
      .add_option("--generator", o.generator,
                  "ordinary, hard, both, plain, inside or flat: who writes the scenes; plain: opaque triangles alone; "
                  "inside: such ones that no plane cuts; flat: of one colour a draw, without a depth test")
      ->check(CLI::IsMember({"ordinary", "hard", "both", "plain", "inside", "flat"}))
      ->capture_default_str();
  command
      .add_option("--round", o.round,
                  "From 2 on: the seeds change scenes of the round before, those that reached something new")
      ->check(CLI::Range(1, 100))
      ->capture_default_str()
      ->needs(command.get_option("--seeds"));
  command.add_flag("--judge-only", o.judge_only, "Fill the journal alone: findings are neither shrunk nor reported")
      ->needs(command.get_option("--seeds"));
  command.add_flag("--write", o.write, "Write the scenes' files, FOLDER/GENERATOR/SEED.json, and judge none")
      ->needs(command.get_option("--seeds"))
      ->excludes(command.get_option("--judge-only"));
  add_against(command, o.judging.against);
  add_candidate(command, o.judging);
  add_jobs(command, o.judging.jobs);
  add_limits(command, o.judging.limits, o.judging.candidate);
  add_assets(command, o.judging.scene_arguments);
}

void add(CLI::App& command, LearnOptions& o) {
  CLI::Option* program =
      text(command, "--program", o.candidate.command, std::string("Ask what this command line draws: ") + kProgramHelp);
  text(command, "--with", o.with, fmt::format("Or one of ours: {}", fmt::join(renderer_names(), ", ")))
      ->excludes(program);
  command
      .add_option_function<int>(
          "--time-limit", [&o](int seconds) { o.candidate.time_limit = std::chrono::seconds(seconds); },
          "Seconds that the program may take to answer (default: 60)")
      ->check(CLI::Range(1, 1'000'000));
  text(command, "-o,--output", o.output, "Write conventions.json, which check and diagnose take (--conventions)");
  text(command, "--pictures", o.pictures, "Leave the probes' pictures in this folder");
}

void add(CLI::App& command, DiagnoseOptions& o) {
  text(command, "scene", o.scene, "Scene file")->required();
  add_against(command, o.against);
  text(command, "--json", o.json, "Write the diagnosis as JSON");
  text(command, "--report", o.report, "Write a page with a picture of every stage into this folder");
  text(command, "--pixel", o.pixel,
       "X,Y: show every fragment that reached the pixel, in each renderer, and what became of it; rows count from the "
       "bottom, in gzrender from the top");
  command
      .add_option("--fragments", o.most_fragments,
                  "Of a scene with more fragments, look at those about the worst pixels alone")
      ->capture_default_str();
  add_limits(command, o.limits, o.candidate);
  CLI::Option* fault = text(command, "--fault", o.fault, "Put a fault into our renderer (plumb list faults)");
  CLI::Option* folder = text(command, "--capture", o.folder, "Diagnose what another renderer left in this folder");
  add_program(command, o.candidate, "Diagnose what this command line leaves: ")->excludes(fault)->excludes(folder);
  folder->excludes(fault);
  add_no_causes(command, o.seeks_causes);
  CLI::Option* picture = text(command, "--picture", o.picture,
                              "Name the known faults that draw pictures like this one, which is all there is");
  text(command, "--depth", o.depth, "With --picture: window z as .exr, which is compared as well")->needs(picture);
  for (const char* other : {"--against", "--json", "--report", "--pixel", "--fragments", "--fault", "--capture",
                            "--program", "--conventions", "--no-causes"})
    picture->excludes(command.get_option(other));
  add_assets(command, o.scene_arguments);
}

void add(CLI::App& command, CaptureOptions& o) {
  add_drawing(command, o);
  CLI::Option* folder = text(command, "folder", o.folder, "Folder for the manifest and its arrays");
  CLI::Option* scene = command.get_option("scene")->required(false);
  text(command, "--check", o.check, "Check a capture that is there against itself: depths, codes, rows, matrices")
      ->excludes(scene)
      ->excludes(folder);
}

void add(CLI::App& command, ExportOptions& o) {
  text(command, "scene", o.scene, "Scene file")->required();
  text(command, "folder", o.folder, "Folder for the manifest and its arrays")->required();
  add_assets(command, o.scene_arguments);
}

void add(CLI::App& command, CompareOptions& o) {
  text(command, "A", o.a, "An image (anything that OpenImageIO reads), or a capture's folder")->required();
  text(command, "B", o.b, "The same")->required();
  text(command, "--tolerance", o.tolerance, "Largest difference of a channel that holds, such as 0.001 or 1/255")
      ->capture_default_str();
  text(command, "-o,--output", o.output, "Write the difference of two images as .png, .tga, .ppm or .exr");
  text(command, "--amplify", o.amplify, "By what the difference is multiplied (default: the largest is white)");
  text(command, "--json", o.json, "Write one object per comparison");
  command.add_flag("--allow-missing", o.allow_missing, "What one capture alone holds is no failure");
}

void add_golden(CLI::App& command, GoldenOptions& o) {
  text(command, "scenes", o.scenes, "Scene files, and folders of them (default: the whole suite)");
  text(command, "--suite", o.suite, "The folder of all scenes that have goldens")->capture_default_str();
  text(command, "--golden", o.golden, "The folder of goldens")->capture_default_str();
  text(command, "--fault", o.fault, "Put a fault into our renderer (plumb list faults)");
  add_assets(command, o.scene_arguments);
}

// plumb golden check, plumb golden update.
void add_golden_commands(CLI::App& app, std::function<int()>& chosen, const std::string& program) {
  CLI::App* golden = app.add_subcommand("golden", "Compare scenes with their goldens, or make goldens anew");
  golden->require_subcommand(1);
  const auto o = std::make_shared<GoldenOptions>();
  o->program = program;
  CLI::App* check = golden->add_subcommand("check", "Compare what we draw with the goldens, bit for bit");
  CLI::App* update =
      golden->add_subcommand("update", "Write the goldens that every reference vouches for; ends 1 if so");
  add_golden(*check, *o);
  add_golden(*update, *o);
  update->add_flag("--check", o->check, "Write nothing");
  text(*update, "--report", o->report, "Write a page of old, new and difference into this folder");
  check->callback([&chosen, o] { chosen = [o] { return golden_check(*o); }; });
  update->callback([&chosen, o] { chosen = [o] { return golden_update(*o); }; });
}

void add(CLI::App& command, ListOptions& o) {
  command.add_option("what", o.what, "all, stages, renderers, faults, scenes")
      ->check(CLI::IsMember({"all", "stages", "renderers", "faults", "scenes"}));
  text(command, "folders", o.folders, "Where to look for scenes");
  add_assets(command, o.scene_arguments);
}

void add(CLI::App& command, NotesOptions& o) {
  std::vector<std::string> numbers;
  for (const notes::Note& note : notes::all()) numbers.emplace_back(note.number);
  command.add_option("note", o.number, fmt::format("One of {} (default: all)", fmt::join(numbers, ", ")))
      ->check(CLI::IsMember(numbers));
}

void add_factor(CLI::App& command, const std::string& name, double& value, const std::string& help) {
  // The range alone lets NaN pass.
  const auto number = [](std::string& given) {
    return std::string(std::isnan(std::atof(given.c_str())) ? "it is no number" : "");
  };
  command.add_option(name, value, help)
      ->check(CLI::Range(1.0, 1e9))
      ->check(CLI::Validator(number, ""))
      ->capture_default_str();
}

void add(CLI::App& command, DiffOptions& o) {
  text(command, "OLD", o.before, "What plumb check --json wrote, then")->required();
  text(command, "NEW", o.now, "and now")->required();
  text(command, "--json", o.json, "Write the changes as JSON");
  text(command, "--markdown", o.markdown, "Write the changes for a CI page");
  add_factor(command, "--moved", o.factor,
             "Report a row whose largest difference or counts changed by more than this factor");
  add_factor(command, "--slower", o.slower,
             "Report a scene whose time changed by more than this factor, and by 0.25 s or more");
}

void add(CLI::App& command, MergeOptions& o) {
  text(command, "runs", o.runs, "What plumb check --json wrote for each shard, or for one run")->required();
  text(command, "-o,--output", o.output, "Write them as one run's JSON");
  text(command, "--junit", o.junit, "Write a test case per scene as JUnit's XML");
  text(command, "--markdown", o.markdown, "Write a summary for a CI page");
  text(command, "--ledger", o.ledger, "Write the largest difference seen for each tolerance");
  text(command, "--suite", o.suite, "A folder of which every scene is to be in the runs");
  text(command, "--without", o.without,
       "Scenes of --suite that may be absent from the runs (GROUP/SCENE); listed as not run");
  text(command, "--expect", o.expect, "The runs' known differences: each is to be of a scene that is there");
}

// A subcommand whose options, once parsed, `run` is called with.
template <class Options>
void add_command(CLI::App& app, std::function<int()>& chosen, const std::string& name, const std::string& help,
                 int (*run)(const Options&), Options options = {}) {
  const auto o = std::make_shared<Options>(std::move(options));
  CLI::App* command = app.add_subcommand(name, help);
  add(*command, *o);
  command->callback([&chosen, run, o] { chosen = [run, o] { return run(*o); }; });
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

// The command whose arguments are read: the innermost that was named.
CLI::App& innermost(CLI::App& app) {
  CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

// "report merge: ", the command whose arguments are read; empty: none was named.
std::string command_before(CLI::App& app) {
  std::string path;
  for (const CLI::App* at = &innermost(app); at != &app; at = at->get_parent())
    path = at->get_display_name() + " " + path;
  if (path.empty()) return "";
  path.back() = ':';
  return path + " ";
}

// Message about a surplus word of a command line, with the name that was probably meant.
std::string unexpected(CLI::App& app, const std::string& word) {
  const CLI::App& command = innermost(app);
  std::vector<std::string> names = names_of(command);
  const bool is_option = word.starts_with("-"), is_command = !is_option && !names.empty();
  if (is_option) {
    names.clear();
    for (const CLI::Option* option : command.get_options()) {
      if (option->nonpositional()) names.push_back(option->get_name());
    }
  }
  const std::string hint =
      did_you_mean(word.substr(0, word.find('=')), std::vector<std::string_view>(names.begin(), names.end()));
  const std::string where = command_before(app);
  if (is_command) return fmt::format("{}expected a command: {}; found {}{}", where, fmt::join(names, ", "), word, hint);
  return fmt::format("{}unexpected {} {}{}", where, is_option ? "option" : "argument", word, hint);
}

// CLI11 takes the next word where a value is empty, even if it is an option: an unset variable would write anywhere.
void require_values(int argc, char** argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string_view word = argv[i];
    if (word.starts_with("--") && word.find('=') == word.size() - 1) {
      throw CLI::ArgumentMismatch(fmt::format("{}: expected a value, found nothing", word.substr(0, word.size() - 1)));
    }
  }
}
void require_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& value : option->results()) {
      if (option->get_positional() || !value.starts_with("--")) continue;
      throw CLI::ArgumentMismatch(fmt::format("{}: expected a value, found {}", option->get_name(), value));
    }
  }
  for (const CLI::App* command : app.get_subcommands()) require_values(*command);
}

}  // namespace

Parsed parse(int argc, char** argv) {
  CLI::App app("Draws scenes, and compares every stage of the drawing with independent references.", "plumb");
  app.set_version_flag("--version", "plumb " PLUMBLINE_VERSION);
  app.footer("Exit code: 0 all hold, 1 something differs or failed, 2 bad input or usage.");
  Parsed out;
  add_command(app, out.command, "render", "Draw a scene into a picture", render);
  CheckOptions check_options;
  if (argc > 0) check_options.program = argv[0];
  add_command(app, out.command, "check", "Compare our renderer with the references, stage by stage", check,
              check_options);
  CampaignOptions campaign_options;
  campaign_options.judging.program = check_options.program;
  add_command(app, out.command, "campaign", "Judge random scenes by the thousand, and make small what is found",
              campaign, campaign_options);
  add_command(app, out.command, "diagnose", "Name every stage that is wrong, with its numbers and likely causes",
              diagnose);
  add_command(app, out.command, "capture", "Write what a renderer hands out at every stage into a folder", capture);
  add_command(app, out.command, "export", "Write a scene as plain arrays, for a renderer in any language",
              export_scene);
  add_command(app, out.command, "learn",
              "Find the conventions that a renderer draws by, from pictures and depths alone", learn);
  add_command(app, out.command, "compare",
              "Compare two images, or two captures, number by number; pixels count from the lower left", compare);
  add_golden_commands(app, out.command, check_options.program);
  add_command(app, out.command, "list", "Show the stages, renderers, faults and scenes that there are", list);
  CLI::App* report = app.add_subcommand("report", "Compare and merge runs of plumb check by the JSON that they left");
  report->require_subcommand(1);
  add_command(*report, out.command, "diff", "What is newly broken or fixed, not judged any more, or has moved",
              report_diff);
  add_command(*report, out.command, "merge", "Shards of a run, as that run", report_merge);
  add_command(app, out.command, "notes",
              "Show what each section of the course notes teaches, and where it is done and shown here", notes);
  try {
    require_values(argc, argv);
    app.parse(argc, argv);
    require_values(app);
    if (!out.command) throw CLI::RequiredError(fmt::format("A command: {}", fmt::join(names_of(app), ", ")));
  } catch (const CLI::ParseError& e) {
    out.command = nullptr;
    const std::vector<std::string> extras = app.remaining(true);
    const bool is_misspelt =
        dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr || dynamic_cast<const CLI::RequiredError*>(&e) != nullptr;
    if (is_misspelt && !extras.empty()) {
      say(unexpected(app, extras.front()));
      out.exit = kBadInput;
    } else if (e.get_exit_code() == 0) {
      out.exit = app.exit(e);  // prints --help, --version
    } else {
      say(fmt::format("{}{} (--help shows all arguments)", command_before(app), e.what()));
      out.exit = kBadInput;
    }
  }
  return out;
}

}  // namespace plumbline::cli
