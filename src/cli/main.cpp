// plumb: the command line of plumbline.
#include <cstdio>
#include <exception>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/commands.h"

int main(int argc, char** argv) {
  using namespace plumbline::cli;
  CLI::App app("Draws scenes, and compares every stage of the drawing with independent references.", "plumb");
  app.set_version_flag("--version", "plumb " PLUMBLINE_VERSION);
  app.require_subcommand(1);
  app.footer("Exit code: 0 all hold, 1 something differs or failed, 2 bad input or usage.");
  const Command commands[] = {add_render(app), add_check(app), add_capture(app), add_list(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? kHolds : kBadInput;
  }
  try {
    for (const Command& command : commands) {
      const int code = command();
      if (code >= 0) return code;
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "plumb: {}\n", e.what());
  }
  return kBadInput;
}
