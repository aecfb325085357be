#include "cli/options/renderers.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/did_you_mean.h"
#include "capture/renderers/process_renderer.h"
#include "faults/endings.h"
#include "faults/faults.h"
#include "image_order/image_order.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#ifdef PLUMBLINE_EMBREE
#include "reference/embree/embree.h"
#endif
#if defined(PLUMBLINE_OSMESA) || defined(PLUMBLINE_EGL)
#include "reference/osmesa/osmesa.h"
#endif

namespace plumbline::cli {

namespace {

#ifdef PLUMBLINE_OSMESA
constexpr bool kOsmesa = true;
#else
constexpr bool kOsmesa = false;
#endif
#ifdef PLUMBLINE_EGL
constexpr bool kEgl = true;
#else
constexpr bool kEgl = false;
#endif
#ifdef PLUMBLINE_EMBREE
constexpr bool kEmbree = true;
#else
constexpr bool kEmbree = false;
#endif
// The OpenGL reference of this process.
constexpr const char* kOpenGl = kEgl && !kOsmesa ? "egl" : "osmesa";

// Renderer `name` in a process of its own: plumb capture --with NAME.
class OwnProcess final : public Renderer {
 public:
  OwnProcess(RendererInfo info, const std::vector<std::string>& assets) : info_(std::move(info)) {
    ProcessSpec spec;
    spec.name = info_.name;
    spec.argv = {std::filesystem::read_symlink("/proc/self/exe").string(),
                 "capture",
                 "{scene}",
                 "{output}",
                 "--with",
                 info_.name};
    for (const std::string& folder : assets) spec.argv.insert(spec.argv.end(), {"--assets", folder});
    spec.shown = fmt::format("plumb capture {{scene}} {{output}} --with {}", info_.name);
    spec.timeout = kOwnProcessLimit;
    process_ = make_process_renderer(std::move(spec));
  }
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene& scene, const Request& request) override { return process_->capture(scene, request); }

 private:
  RendererInfo info_;
  std::unique_ptr<Renderer> process_;
};

RendererInfo opengl_info(const std::string& name) {
  RendererInfo info;
  info.name = name;
  info.version = "in a process of its own";
  info.profile = Profile::opengl;
  for (Ability& ability : info.stages) ability.shows = true;
#if defined(PLUMBLINE_OSMESA) || defined(PLUMBLINE_EGL)
  const std::string why = why_unfused(name == "softpipe" ? MesaDriver::softpipe : MesaDriver::llvmpipe);
  if (!why.empty()) info[Stage::window] = {false, false, why};
#endif
  return info;
}

}  // namespace

const std::vector<std::string>& reference_names() {
  static const std::vector<std::string> kNames = {kOpenGl, "embree", "exact"};
  return kNames;
}

std::string_view opengl_reference() { return kOpenGl; }

const std::vector<std::string>& default_references() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names = reference_names();
    if (!kOsmesa && !kEgl) std::erase(names, kOpenGl);
    if (!kEmbree) std::erase(names, "embree");
    return names;
  }();
  return kNames;
}

const std::vector<std::string>& known_reference_names() {
  static const std::vector<std::string> kNames = {"osmesa", "egl", "softpipe", "embree", "exact", "image_order"};
  return kNames;
}

const std::vector<std::string>& renderer_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names = known_reference_names();
    names.insert(names.begin(), {"ours", "definition"});
    return names;
  }();
  return kNames;
}

std::unique_ptr<Renderer> make_renderer(const std::string& name) {
  if (name == "ours") return pipeline::make_pipeline();
  if (name == "definition") return pipeline::make_definition();
  if (name == "exact") return exact::make_exact();
  if (name == "image_order") return image_order::make_image_order();
#ifdef PLUMBLINE_EGL
  if (name == "egl") return make_egl();
#endif
#ifdef PLUMBLINE_OSMESA
  if (name == "osmesa") return make_osmesa();
#endif
#if defined(PLUMBLINE_OSMESA) || defined(PLUMBLINE_EGL)
  if (name == "softpipe") return make_opengl(MesaDriver::softpipe);
#endif
#ifdef PLUMBLINE_EMBREE
  if (name == "embree") return embree::make_embree();
#endif
  const auto& names = renderer_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return nullptr;
  throw std::invalid_argument(fmt::format("no renderer '{}': there are {}", name, fmt::join(names, ", ")));
}

bool in_own_process(const std::string& name) {
  return name == "softpipe" ? kOsmesa || kEgl : name == "egl" && kEgl && kOsmesa;
}

namespace {

std::unique_ptr<Renderer> sound_reference(const std::string& name, const std::vector<std::string>& assets) {
  if (in_own_process(name)) return std::make_unique<OwnProcess>(opengl_info(name), assets);
  return make_renderer(name);
}

}  // namespace

std::unique_ptr<Renderer> make_reference(const std::string& name, const std::vector<std::string>& assets,
                                         const std::string& fault) {
  std::unique_ptr<Renderer> reference = sound_reference(name, assets);
  const auto ending = faults::reference_ending(fault);
  return ending && ending->reference == name ? faults::make_ending(std::move(reference), *ending)
                                             : std::move(reference);
}

std::string faulted_reference(const std::string& fault) {
  const auto ending = faults::reference_ending(fault);
  return ending ? ending->reference : "";
}

std::vector<FaultInfo> fault_infos() {
  std::vector<FaultInfo> out;
  for (const faults::Fault& fault : faults::all()) {
    out.push_back({fault.name, name_of(fault.stage), fault.changes, fault.report});
  }
  return out;
}

namespace {

faults::Fault fault_of(const std::string& name) {
  std::vector<faults::Fault> all = faults::all();
  const auto endings = faults::endings();
  all.insert(all.end(), endings.begin(), endings.end());
  const auto found = std::ranges::find(all, name, &faults::Fault::name);
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const faults::Fault& f : faults::all()) names.push_back(f.name);
  throw std::invalid_argument(
      fmt::format("no fault '{}' to put in{}: plumb list faults shows those that --fault puts in first", name,
                  did_you_mean(name, names)));
}

}  // namespace

std::unique_ptr<Renderer> make_candidate(const std::string& fault, CutAt cut_at) {
  if (fault.empty()) return make_candidate(std::span<const std::string>(), cut_at);
  return make_candidate(std::span(&fault, 1), cut_at);
}

std::unique_ptr<Renderer> make_candidate(std::span<const std::string> faults, CutAt cut_at) {
  if (faults.empty() && cut_at == CutAt::frame_sides) return pipeline::make_pipeline();
  pipeline::Stages stages = pipeline::production_stages();
  if (cut_at == CutAt::guard_band) faults::use_guard_band(stages);
  for (const std::string& name : faults) fault_of(name).apply(stages);
  return pipeline::make_pipeline(stages);
}

}  // namespace plumbline::cli
