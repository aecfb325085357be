// --program: another renderer, by the command line that runs it.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "capture/renderer.h"
#include "export/export_folder.h"

namespace plumbline::cli {

/// --program and its options.
struct ProgramArgument {
  std::string command;  ///< empty: none is asked
  bool probes = false;  ///< it is called for each primitive, too, for coverage and winners (capture/renderers/probes.h)
  std::string from{};   ///< "clip" or "window": it begins there, and the stages before are given; empty: with all
  std::string conventions{};            ///< a file that declares them (capture/files/conventions_file.h), or empty
  std::chrono::seconds time_limit{60};  ///< of a scene
};

/// The renderer that this command line is, run by a shell: {scene} in it is the scene's file, {input} the folder of its
/// export, {output} the folder for the capture; or {serve}, which becomes --serve: the program is started once, and
/// asked by lines (capture/renderers/process_renderer.h). After capture(), info() is of what the program left for that
/// scene. Throws std::invalid_argument where the command line has none of them.
std::unique_ptr<Renderer> make_program(const ProgramArgument& program);

/// Throws std::invalid_argument where make_program() does, where the first word of the command line is a path, and no
/// program is there, or where it is a name that the shell does not know. A first word with a sign that the shell reads,
/// "$" for instance, passes.
void require_program(const ProgramArgument& program);

/// A program for probes: its depths are handed on as they are left, not taken for codes of the scene's format.
std::unique_ptr<Renderer> make_probed_program(const ProgramArgument& program);

/// The conventions that the file declares; without one, undeclared(). Throws JsonError.
Conventions conventions_of(const std::string& file);

/// Lines for people: what the conventions of the file leave open, and is judged as OpenGL's or not at all. No file: of a
/// renderer that declares none. Throws JsonError.
std::string convention_notes(const std::string& file);

/// The command line, for the submission in this folder, quoted for a shell. Throws std::invalid_argument where
/// {submission} does not stand in it.
std::string command_of_submission(const std::string& command, const std::filesystem::path& folder);

/// Stages 0 to 4 by our pipeline, and the matrices in double.
ExportedStages exported_stages(const Scene& scene);

}  // namespace plumbline::cli
