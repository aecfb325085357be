// Messages and files of plumb check about a scene that does not hold.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "capture/renderer.h"
#include "check/judge/judge.h"
#include "check/verdict/expectations.h"
#include "cli/commands.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// Settles the expectations of the verdict's scene, and returns them. Where the scene does not hold, fills
/// verdict.failure, lines that say why, and verdict.repeat, the command that judges it again.
std::vector<check::Settled> settle_and_explain(check::SceneVerdict& verdict, const CheckOptions& options,
                                               const std::vector<check::Expectation>& expectations,
                                               std::chrono::sys_days today);

/// Line with the number of expectations by fate. `expectations`: the number of all that were read.
std::string settled_line(const std::vector<check::Settled>& settled, std::size_t expectations);

/// Lines of a run's failures, in which the stderr of a program that fails alike on many scenes stands once.
class RunFailures {
 public:
  /// Adds the lines of the verdict's scene, `failure`.
  void add(const check::SceneVerdict& verdict, std::string failure);
  const std::string& text() const { return text_; }

 private:
  std::map<std::string, std::string> first_;  // lines of a stderr, and the first scene's name
  std::string text_;
};

/// Judges the scene once more and writes a page with pictures into `folder`/<scene>. Returns lines to print; under
/// ctest they name the pictures as CTest attaches them to the test. Throws OutputError.
std::string leave_report(const std::string& folder, const Scene& scene, const check::SceneVerdict& verdict,
                         Renderer& candidate, std::span<const check::Reference> references);

/// `folder`/<scene>.txt: the scene's table, the failure's lines, and `word`; where that is empty, "holds" or "FAILED".
/// Throws OutputError.
void leave_rows(const std::string& folder, const check::SceneVerdict& verdict, const std::string& failure,
                std::string_view word = {});

}  // namespace plumbline::cli
