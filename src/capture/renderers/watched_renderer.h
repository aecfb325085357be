// A renderer in a worker process (base/workers.h): what it is asked is a step that the worker's parent can see, and a
// step that has ended a worker before is not asked again.
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

/// How the worker ended, by the step that it was at.
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

/// The inner renderer, number `number` of its worker. Each call is a step: drawing watched, drawing a picture alone,
/// and each stage run alone. capture() and run_stage() throw RendererFailed with the words of `ended` where their step
/// stands there, and where memory is lacking. Null stays null.
std::unique_ptr<Renderer> make_watched(std::unique_ptr<Renderer> inner, std::uint32_t number, const Watch& watch);

}  // namespace plumbline
