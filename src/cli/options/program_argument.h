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
  bool probes = false;  ///< also called for each primitive, for coverage and winners (capture/renderers/probes.h)
  std::string from{};   ///< "clip", "window": the program begins there, earlier stages are given; empty: at the start
  std::string conventions{};            ///< file of its conventions (capture/files/conventions_file.h), or empty
  std::chrono::seconds time_limit{60};  ///< of a scene
};

/// Renderer that runs the command line in a shell. Placeholders: {scene}, the scene's file; {input}, the folder of its
/// export; {output}, the folder for the capture; or {serve}, which becomes --serve: the program is started once, and
/// asked by lines (capture/renderers/process_renderer.h). After capture(), info() is of what the program left for that
/// scene. Throws std::invalid_argument unless {output} and one of {scene} and {input}, or {serve} alone, stand in the
/// command line, after a program and without quotes around them; JsonError for a bad file of conventions.
std::unique_ptr<Renderer> make_program(const ProgramArgument& program);

/// Throws std::invalid_argument where make_program() does, where the first word of the command line is a path, and no
/// program is there, or where it is a name that the shell does not know. A first word with a sign that the shell reads,
/// "$" for instance, passes.
void require_program(const ProgramArgument& program);

/// A program for plumb learn: captures are handed on by no conventions, with depths as they are left, not as codes of
/// the scene's format.
std::unique_ptr<Renderer> make_probed_program(const ProgramArgument& program);

/// The conventions that the file declares; without one, undeclared(). Throws JsonError.
Conventions conventions_of(const std::string& file);

/// Lines for people: conventions that the file leaves open, which are judged as OpenGL's or not at all. No file: those
/// of a renderer that declares none. Throws JsonError.
std::string convention_notes(const std::string& file);

/// Hint for people about a wrong renderer: its conventions may be others than the file declares or, without a file,
/// than OpenGL's; and how to find them. A line and a command; empty where the file lists what
/// plumb learn left open or unexplained.
std::string hint_of_conventions(const std::string& file);

/// The command line with {submission} replaced by the folder's absolute path, quoted for a shell. Throws
/// std::invalid_argument where {submission} is missing.
std::string command_of_submission(const std::string& command, const std::filesystem::path& folder);

/// Stages 0 to 4 by our pipeline, and the matrices in double.
ExportedStages exported_stages(const Scene& scene);

}  // namespace plumbline::cli
