// Export of a scene as plain arrays: all that a renderer in any language needs to draw it, with nothing left to parse
// but one JSON object. src/kit/README.md specifies the folder.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline {

/// Stages 0 to 4 of a scene, for renderers that begin after them.
struct ExportedStages {
  Capture ours;                            ///< plumbline's pipeline: records of matrices to window, in float precision
  std::vector<Matrices<double>> matrices;  ///< per draw, not rounded to float
};
using StagesOf = std::function<ExportedStages(const Scene& scene)>;

/// Writes the scene; for an antialiased scene its passes, each in a folder of its own. `stages_of` is called once per
/// scene or pass. A folder that is empty, or holds an export and nothing else, is replaced atomically. Throws
/// OutputError (base/atomic_path.h), and whatever `stages_of` throws.
void write_export(const Scene& scene, const StagesOf& stages_of, const std::filesystem::path& folder);

/// Checks the folder as write_export() does, without writing. Throws OutputError where write_export() would refuse it.
void require_writable_export(const std::filesystem::path& folder);

}  // namespace plumbline
