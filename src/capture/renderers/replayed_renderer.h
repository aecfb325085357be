// Renderer that replays a capture: of a program that has run, or of a capture folder.
#pragma once

#include <memory>
#include <string>

#include "capture/renderer.h"

namespace plumbline {

/// A renderer of this one scene: capture() returns the whole capture, whatever is requested. Throws
/// std::invalid_argument, naming `from`, where the capture has another size, other numbers of draws, lights or
/// vertices, or a primitive that the scene does not have; where complete_records() throws; and for an antialiased
/// scene, whose passes no capture holds.
///
/// Drops a planes.id that contradicts planes.count or planes.color (contradictions.h), and marks visibility as
/// `contradicted`: the export is at fault, not the depth test.
std::unique_ptr<Renderer> make_replayed_renderer(Capture capture, const Scene& scene, const std::string& from,
                                                 const Conventions& conventions = undeclared());

}  // namespace plumbline
