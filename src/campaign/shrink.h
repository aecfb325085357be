// Smaller scenes that show the same finding.
#pragma once

#include <functional>
#include <string>

namespace plumbline::campaign {

/// Test: a scene (the text of its file) shows the finding.
using Shows = std::function<bool(const std::string& scene)>;

/// The scene with fewer draws, primitives, members and pixels, and rounder numbers, that still shows the finding. Makes
/// at most `trials` calls of `shows`. The same answers give the same scene. `scene`: JSON without comments.
std::string shrink(const std::string& scene, const Shows& shows, int trials);

}  // namespace plumbline::campaign
