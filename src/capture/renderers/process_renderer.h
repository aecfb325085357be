// Program as a renderer. The program is handed a scene and an empty folder, in which it leaves a capture
// (capture_folder.h).
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "capture/renderer.h"

namespace plumbline {

/// Exit status of a program that cannot draw the scene or show it: outcome `unsupported`, and the last line of its
/// stderr is the reason.
inline constexpr int kUnsupportedStatus = 77;

struct ProcessSpec {
  std::string name;
  std::string version;  ///< of info(); a capture's manifest has a version of its own
  /// argv[0] is looked for in PATH; in each, {scene} is replaced by the scene's file, {input} by the folder that
  /// write_input writes, and {output} by the folder for the capture.
  std::vector<std::string> argv;
  /// A server, started once: it reads a line "INPUT<tab>OUTPUT" for each scene, and answers by a line: "ok",
  /// "unsupported REASON" or "failed REASON". {input} and {output} in argv are not replaced.
  bool serves = false;
  /// Writes confined to the folder that holds {input} and {output}, which is the TMPDIR; files to a capture's budget
  /// (base/confine.h).
  bool confined = false;
  std::string shown = "";  ///< the command line as messages show it; empty: argv
  std::function<void(const Scene&, const std::filesystem::path& folder)> write_input{};
  std::function<void(const Scene&, Capture&)> give{};  ///< adds the given records, where those of coverage are wanted
  Conventions conventions = {};                    ///< the program's; captures are mapped to OpenGL's (to_dialect())
  bool raw_depth = false;                          ///< depths in floats are not taken for codes of the scene's format
  std::map<std::string, std::string> environment;  ///< added to the inherited one, or in the place of its variables
  std::chrono::milliseconds timeout{60'000};       ///< of a call; then the program and all that it started are killed
  StageSet shows;                                  ///< stages that info() says are shown
};

/// info() runs nothing. capture() runs the program, waits, reads the folder, and hands on the records of the stages
/// that the request names, of all primitives and pixels. Throws RendererFailed, with the last lines of the program's
/// stderr, where it cannot be started, exits with other than 0 and 77, is killed by a signal, takes longer than the
/// timeout, or leaves no capture, a broken one, or one of another size; OverBudget where what it left is beyond the
/// budget; and Unsupported where it exits with 77, or says so, for an antialiased scene, and, with {scene} in argv, for
/// a scene that was not read from a file. Refuses a spec without argv (std::invalid_argument), and a machine on which
/// no temporary folder can be made (std::runtime_error).
std::unique_ptr<Renderer> make_process_renderer(ProcessSpec spec);

}  // namespace plumbline
