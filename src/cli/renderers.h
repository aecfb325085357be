// The renderers and faults that this program was built with, by name.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "stages/renderer.h"

namespace plumbline::cli {

/// Of the references, in the order in which they are asked.
const std::vector<std::string>& reference_names();
/// All that make_renderer() knows, built in or not.
const std::vector<std::string>& renderer_names();

/// Null if the renderer is known but not built in. Throws std::invalid_argument, naming those there are, if unknown.
std::unique_ptr<Renderer> make_renderer(const std::string& name);

struct FaultInfo {
  std::string_view name, stage, changes;
};
std::vector<FaultInfo> fault_infos();
/// Our pipeline; with the named fault unless the name is empty. Throws std::invalid_argument if it is unknown.
std::unique_ptr<Renderer> make_candidate(const std::string& fault);

}  // namespace plumbline::cli
