// Refusal: the reason why a renderer gave no answer.
#pragma once

#include <exception>
#include <optional>
#include <string>

#include "capture/renderer.h"
#include "check/verdict/verdict.h"

namespace plumbline::check {

/// Outcome and reason: `missing` (not built in), `unsupported` (Unsupported or OverBudget was thrown) or `failed`.
struct Refusal {
  Outcome outcome;
  std::string why;
};

/// Calls ask(). Returns the refusal, or nullopt where ask() returned. Rethrows OverBudget.
template <class Ask>
std::optional<Refusal> refusal_within_budget(Ask ask) {
  try {
    ask();
    return std::nullopt;
  } catch (const OverBudget&) {
    throw;
  } catch (const Unsupported& e) {
    return Refusal{Outcome::unsupported, e.what()};
  } catch (const std::exception& e) {
    return Refusal{Outcome::failed, e.what()};
  }
}

/// Calls ask(). Returns the refusal, or nullopt where ask() returned. OverBudget counts as `unsupported`.
template <class Ask>
std::optional<Refusal> refusal_of(Ask ask) {
  try {
    return refusal_within_budget(ask);
  } catch (const OverBudget& e) {
    return Refusal{Outcome::unsupported, e.what()};
  }
}

}  // namespace plumbline::check
