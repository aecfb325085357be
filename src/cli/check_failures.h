// What plumb check says of a scene that does not hold, and what it leaves of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "capture/renderer.h"
#include "check/judge/judge.h"
#include "check/verdict/expectations.h"
#include "cli/commands.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// Settles the verdict's expectations, and says in it why it does not hold, if so, and the command that repeats it.
/// Returns what became of the expectations.
std::vector<check::Settled> settle_and_explain(check::SceneVerdict& verdict, const CheckOptions& options,
                                               const std::vector<check::Expectation>& expectations,
                                               std::chrono::sys_days today);

/// How many expectations came to what.
std::string settled_line(const std::vector<check::Settled>& settled, std::size_t expectations);

/// The scene once more, as a page with pictures in `folder`/<scene>; under ctest its pictures are named so that CTest
/// attaches them to the test. Returns what to print. Throws OutputError.
std::string leave_report(const std::string& folder, const Scene& scene, const check::SceneVerdict& verdict,
                         Renderer& candidate, std::span<const check::Reference> references);

/// `folder`/<scene>.txt: the scene's table, the failure's lines, and `word`; where that is empty, "holds" or "FAILED".
/// Throws OutputError.
void leave_rows(const std::string& folder, const check::SceneVerdict& verdict, const std::string& failure,
                std::string_view word = {});

}  // namespace plumbline::cli
