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

/// Another text wherever verdicts of a campaign may be others, but the scene: this program's file, candidate and the
/// files that its command line names, those of the folders of --assets, references, limits.
std::string terms_of(const CheckOptions& options);

}  // namespace plumbline::cli
