// Reference that a candidate is judged by.
#pragma once

#include <string>

#include "capture/renderer.h"

namespace plumbline::check {

/// A reference, or its absence.
struct Reference {
  std::string name;
  Renderer* renderer = nullptr;  ///< not owned; null: not built in
};

}  // namespace plumbline::check
