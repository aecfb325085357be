// The judges of a run: what verdicts follow from beside scenes and candidates' answers.
#pragma once

#include <string>

#include "cli/commands.h"

namespace plumbline::cli {

/// SHA-256 of the libraries and files of this program that judge, as they were built: all but those that draw for the
/// candidate alone (src/kernels, pipeline, painter, renderers). Of nothing else: src/cli/CMakeLists.txt.
extern const char* const kJudgesPrint;

/// Another text wherever verdicts may be others: kJudgesPrint; the libraries that are loaded, by size and time; the
/// processor, for which Mesa compiles its shaders; Mesa's and Embree's settings in the environment; the run's options.
std::string judges_of(const CheckOptions& options);

/// Hash of this program's file: all that draws and judges.
std::string program_print();

/// " (HASH)" of the files that words of the command line name; of none, nothing.
std::string files_print(const std::string& command);

}  // namespace plumbline::cli
