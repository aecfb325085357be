// A scene as plain arrays: what a renderer in any language needs to draw it, with nothing left to parse but one JSON
// object. README.md lists all of it.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline {

/// Stages 0 to 4 of a scene, for renderers that begin after them.
struct ExportedStages {
  Capture ours;                            ///< of our pipeline, floats: records of matrices to window
  std::vector<Matrices<double>> matrices;  ///< not rounded to float
};
using StagesOf = std::function<ExportedStages(const Scene& scene)>;

/// Writes the scene; of an antialiased one its passes, each in a folder of its own. `stages_of` is called for each
/// scene of one sample a pixel. A folder that holds an export and nothing else, or nothing, is replaced, in one moment.
/// Throws OutputError (base/atomic_path.h).
void write_export(const Scene& scene, const StagesOf& stages_of, const std::filesystem::path& folder);

/// What write_export would throw of the folder, before there is anything to write; leaves nothing behind.
void require_writable_export(const std::filesystem::path& folder);

}  // namespace plumbline
