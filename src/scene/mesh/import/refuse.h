// The error of the mesh files' checks.
#pragma once

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace plumbline {

/// Throws std::runtime_error: expected ..., found ....
[[noreturn]] inline void refuse(std::string_view expected, std::string_view found) {
  throw std::runtime_error(fmt::format("expected {}, found {}", expected, found));
}

}  // namespace plumbline
