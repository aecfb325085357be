// The renderers and faults that this program was built with, by name.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/renderer.h"

namespace plumbline::cli {

/// The references that a whole judgement asks, in that order: of the OpenGL ones OSMesa, in a build without it EGL;
/// Embree; exact.
const std::vector<std::string>& reference_names();
/// Those of them that this program was built with: asked where none are named.
const std::vector<std::string>& default_references();
/// The OpenGL one of reference_names().
std::string_view opengl_reference();
/// All references that there are, built in or not, in the order in which they are asked.
const std::vector<std::string>& known_reference_names();
/// These, `ours` and `definition`.
const std::vector<std::string>& renderer_names();

/// Makes a renderer in this process, which can hold only one of Mesa's libraries and drivers. Null if the renderer is
/// known but not built in. Throws std::invalid_argument, naming the known ones, if the name is unknown.
std::unique_ptr<Renderer> make_renderer(const std::string& name);

/// How long a renderer in a process of its own may take.
inline constexpr std::chrono::minutes kOwnProcessLimit{10};  // softpipe takes its time
/// Whether the renderer would be a second Mesa in this process.
bool in_own_process(const std::string& name);
/// A reference of a run with several: as make_renderer(), but a second Mesa (in_own_process) is a child process of this
/// program, which is given `assets`. With the named fault, if that is one of this reference (faults/endings.h).
std::unique_ptr<Renderer> make_reference(const std::string& name, const std::vector<std::string>& assets,
                                         const std::string& fault = "");

struct FaultInfo {
  std::string_view name, stage, changes;
  std::string_view report;  ///< who reports such a fault (faults.h), or empty
};
std::vector<FaultInfo> fault_infos();
/// The reference that the fault is of (faults/endings.h); empty: it is none of a reference.
std::string faulted_reference(const std::string& fault);
/// Whether polygons are cut at the frame's sides, or at a guard band eight times as wide and high (faults.h,
/// use_guard_band).
enum class CutAt { frame_sides, guard_band };
/// Our pipeline; with the named fault unless the name is empty. Throws std::invalid_argument if it is unknown.
std::unique_ptr<Renderer> make_candidate(const std::string& fault, CutAt cut_at = CutAt::frame_sides);
/// With all of these faults; of two that replace one function, the later one's stays.
std::unique_ptr<Renderer> make_candidate(std::span<const std::string> faults, CutAt cut_at = CutAt::frame_sides);

}  // namespace plumbline::cli
