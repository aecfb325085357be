// A renderer in a worker process (base/workers.h). Each call is a step, which the worker's parent can see; a step that
// has ended a worker before throws instead of running again.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/workers.h"
#include "capture/renderer.h"

namespace plumbline {

/// Steps that have ended workers: by step, how the worker ended.
using EndedSteps = std::map<std::uint32_t, std::string>;

/// State that all renderers of one worker share.
struct Watch {
  Progress* progress;
  const EndedSteps* ended;
  std::chrono::milliseconds limit;  ///< of a step
};

/// Watched renderer that make() makes, in a step of its own. Where making throws std::runtime_error or std::bad_alloc,
/// or has ended a worker before: a renderer `name` that shows nothing, and whose calls throw RendererFailed with the
/// reason. Null stays null. Other exceptions of make() are passed on.
std::unique_ptr<Renderer> make_watched(const std::string& name, const std::function<std::unique_ptr<Renderer>()>& make,
                                       std::uint32_t number, const Watch& watch);

/// Watched renderer around `inner`, which has this number in its worker. Steps: a capture() of a picture alone
/// (WantedPlanes::picture and no records), any other capture(), and run_stage() of each stage. A step throws
/// RendererFailed where memory is lacking and, with the recorded words, where watch.ended holds the step. Null stays
/// null.
std::unique_ptr<Renderer> make_watched(std::unique_ptr<Renderer> inner, std::uint32_t number, const Watch& watch);

}  // namespace plumbline
