// A capture that is there already, as a renderer: of a program that has run, or a folder that was written.
#pragma once

#include <memory>
#include <string>

#include "capture/renderer.h"

namespace plumbline {

/// A renderer of this one scene, which shows what the capture holds, whatever is asked of it. Throws
/// std::invalid_argument, naming `from`, where the capture is not of the scene's size or its records are not of the
/// scene's draws and vertices in number, and for an antialiased scene, whose passes no capture holds.
///
/// Winners that contradict the picture (contradictions.h) are not shown: that is the capture's fault, no test's.
std::unique_ptr<Renderer> make_replayed_renderer(Capture capture, const Scene& scene, const std::string& from,
                                                 const Conventions& conventions = undeclared());

}  // namespace plumbline
