#include "cli/options/argument_kinds.h"

#include <chrono>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/renderers.h"

namespace plumbline::cli {

void add_assets(CLI::App& command, SceneArguments& arguments) {
  command.add_option("--assets", arguments.assets, "Folders where mesh files are looked for, after the scene's own")
      ->check(CLI::ExistingDirectory);
}

void add_against(CLI::App& command, std::vector<std::string>& against) {
  command
      .add_option("--against", against,
                  fmt::format("References: {} (default: {})", fmt::join(known_reference_names(), ", "),
                              fmt::join(default_references(), ", ")))
      ->check(CLI::IsMember(known_reference_names()))
      ->delimiter(',');
}

void add_limits(CLI::App& command, WorkerLimits& limits, ProgramArgument& program) {
  command
      .add_option_function<int>(
          "--time-limit",
          [&limits, &program](int seconds) { limits.step = program.time_limit = std::chrono::seconds(seconds); },
          "Seconds that a renderer may take to draw a scene or run a stage (default: 300), or the program to answer "
          "(default: 60)")
      ->check(CLI::Range(1, 1'000'000));
  command
      .add_option_function<int>(
          "--memory-limit", [&limits](int mebibytes) { limits.memory = static_cast<std::uint64_t>(mebibytes) << 20; },
          "MiB that all renderers of a process may take (default: 12288)")
      ->check(CLI::Range(64, 1 << 30));
}

const char* const kProgramHelp =
    "{scene} in it is the scene's file, {input} the folder of its export, {output} that for the capture; or {serve}: "
    "started once, it is asked by lines";

void add_conventions(CLI::App& command, std::string& file) {
  text(command, "--conventions", file,
       "What the other renderer declares of itself (plumb learn finds it): what these explain is no difference, and "
       "mistakes among these are reported once");
}

CLI::Option* add_program(CLI::App& command, ProgramArgument& program, const std::string& what) {
  CLI::Option* line = text(command, "--program", program.command, what + kProgramHelp);
  command
      .add_flag("--each-primitive", program.probes,
                "Call the program for each primitive alone as well: coverage and winners are judged by such pictures")
      ->needs(line);
  text(command, "--from", program.from,
       "clip or window: the program begins with the export's vertices in clip space, or its triangles in window space; "
       "the stages before are given, and not judged")
      ->check(CLI::IsMember({"clip", "window"}))
      ->needs(line);
  add_conventions(command, program.conventions);
  return line;
}

}  // namespace plumbline::cli
