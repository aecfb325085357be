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

/// References that a whole judgement asks, in order: osmesa (in a build with EGL and without OSMesa: egl), embree,
/// exact.
const std::vector<std::string>& reference_names();
/// References of reference_names() that this program was built with; asked where none are named.
const std::vector<std::string>& default_references();
/// Name of the OpenGL reference among reference_names().
std::string_view opengl_reference();
/// Names of all references, built in or not, in the order in which they are asked.
const std::vector<std::string>& known_reference_names();
/// Names of all renderers: `ours`, `definition`, and known_reference_names().
const std::vector<std::string>& renderer_names();

/// Makes a renderer in this process, which can hold only one of Mesa's libraries and drivers. Null if the renderer is
/// known but not built in. Throws std::invalid_argument, naming the known ones, if the name is unknown.
std::unique_ptr<Renderer> make_renderer(const std::string& name);

/// Time limit of a renderer in a process of its own.
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
/// Name of the reference that the fault changes (faults/endings.h); empty: the fault changes no reference.
std::string faulted_reference(const std::string& fault);
/// Whether polygons are cut at the frame's sides, or at a guard band eight times as wide and high (faults.h,
/// use_guard_band).
enum class CutAt { frame_sides, guard_band };
/// Our pipeline; with the named fault unless the name is empty. Throws std::invalid_argument if it is unknown.
std::unique_ptr<Renderer> make_candidate(const std::string& fault, CutAt cut_at = CutAt::frame_sides);
/// Our pipeline with all of these faults; where two faults replace one function, the later fault's function stays.
std::unique_ptr<Renderer> make_candidate(std::span<const std::string> faults, CutAt cut_at = CutAt::frame_sides);

}  // namespace plumbline::cli
