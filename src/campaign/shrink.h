// Smaller scenes that show the same finding.
#pragma once

#include <functional>
#include <string>

namespace plumbline::campaign {

/// Whether a scene, given as the text of its file, shows the finding.
using Shows = std::function<bool(const std::string& scene)>;

/// The scene with fewer draws, primitives, members and pixels, and rounder numbers, as far as it still shows the finding:
/// at most `trials` scenes are asked about. The same answers give the same scene. `scene` is JSON without comments.
std::string shrink(const std::string& scene, const Shows& shows, int trials);

}  // namespace plumbline::campaign
