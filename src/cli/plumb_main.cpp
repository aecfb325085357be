#include "cli/plumb_main.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/options/say.h"

namespace plumbline::cli {

int plumb_main(int argc, char** argv) {
  try {
    const Parsed parsed = parse(argc, argv);
    const int code = parsed.command ? parsed.command() : parsed.exit;
    if (!std::cout || std::fflush(stdout) != 0) {  // std::cout: of CLI11's texts
      throw std::runtime_error(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
    }
    return code;
  } catch (const std::filesystem::filesystem_error& e) {
    say(fmt::format("{}: {}", e.path1().string(), e.code().message()));
  } catch (const std::system_error& e) {  // of fmt::print: "cannot write to file"
    const bool of_print = std::string_view(e.what()).starts_with("cannot write to file");
    say(of_print ? fmt::format("standard output: cannot be written: {}", e.code().message()) : e.what());
  } catch (const std::exception& e) {
    say(e.what());
  }
  return kBadInput;
}

}  // namespace plumbline::cli
