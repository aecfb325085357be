// Checks before the work that a run's outputs can be written.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace plumbline::cli {

/// An option that names a file or folder to be written, and its value; empty: not wanted.
struct Output {
  std::string option;
  std::filesystem::path path;
};

/// Refuses files that cannot be written, that are one of `inputs`, or of each other, or lie in `folder`, which will be
/// replaced. Throws std::runtime_error naming option and path. Leaves nothing behind.
void require_outputs(std::span<const Output> files, const Output& folder,
                     std::span<const std::filesystem::path> inputs);

/// Refuses a folder that lies in another, which will be replaced. Throws std::runtime_error as above.
void require_outside(const Output& folder, const Output& replaced);

/// Refuses a folder in which nothing can be made. Throws std::runtime_error as above.
void require_folder(const Output& folder);

}  // namespace plumbline::cli
