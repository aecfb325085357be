// Kinds of command line arguments that several commands take.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/workers.h"
#include "cli/options/program_argument.h"
#include "cli/options/scene_arguments.h"

namespace plumbline::cli {

/// Adds a text option that refuses an empty value.
template <class Value>
CLI::Option* text(CLI::App& command, const std::string& names, Value& value, const std::string& help) {
  const auto not_empty = [](std::string& given) { return std::string(given.empty() ? "it is empty" : ""); };
  return command.add_option(names, value, help)->check(CLI::Validator(not_empty, ""));
}

void add_assets(CLI::App& command, SceneArguments& arguments);
void add_against(CLI::App& command, std::vector<std::string>& against);
/// Limits of the worker processes in which renderers run, and of the program.
void add_limits(CLI::App& command, WorkerLimits& limits, ProgramArgument& program);
void add_conventions(CLI::App& command, std::string& file);
/// Help text about the placeholders in a program's command line.
extern const char* const kProgramHelp;
/// --program and its options; `what`: what is done with the program.
CLI::Option* add_program(CLI::App& command, ProgramArgument& program, const std::string& what);

}  // namespace plumbline::cli
