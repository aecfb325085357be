#include "cli/renderers.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipeline/pipeline_renderer.h"
#include "reference/exact/exact.h"
#ifdef PLUMBLINE_EMBREE
#include "reference/embree/embree.h"
#endif
#ifdef PLUMBLINE_OSMESA
#include "reference/osmesa/osmesa.h"
#endif
#ifdef PLUMBLINE_FAULTS
#include "faults/faults.h"
#endif

namespace plumbline::cli {

const std::vector<std::string>& reference_names() {
  static const std::vector<std::string> kNames = {"osmesa", "embree", "exact"};
  return kNames;
}

const std::vector<std::string>& renderer_names() {
  static const std::vector<std::string> kNames = {"ours", "osmesa", "softpipe", "embree", "exact"};
  return kNames;
}

std::unique_ptr<Renderer> make_renderer(const std::string& name) {
  if (name == "ours") return pipeline::make_pipeline();
  if (name == "exact") return exact::make_exact();
#ifdef PLUMBLINE_OSMESA
  if (name == "osmesa") return make_osmesa(OsmesaDriver::llvmpipe);
  if (name == "softpipe") return make_osmesa(OsmesaDriver::softpipe);
#endif
#ifdef PLUMBLINE_EMBREE
  if (name == "embree") return embree::make_embree();
#endif
  const auto& names = renderer_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return nullptr;
  throw std::invalid_argument(fmt::format("no renderer '{}': there are {}", name, fmt::join(names, ", ")));
}

#ifdef PLUMBLINE_FAULTS
std::vector<FaultInfo> fault_infos() {
  std::vector<FaultInfo> out;
  for (const faults::Fault& fault : faults::all()) out.push_back({fault.name, name_of(fault.stage), fault.changes});
  return out;
}

std::unique_ptr<Renderer> make_candidate(const std::string& fault) {
  if (fault.empty()) return pipeline::make_pipeline();
  for (const faults::Fault& f : faults::all()) {
    if (f.name == fault) return pipeline::make_pipeline(f.stages());
  }
  throw std::invalid_argument(fmt::format("no fault '{}': plumb list faults shows all", fault));
}
#else
std::vector<FaultInfo> fault_infos() { return {}; }

std::unique_ptr<Renderer> make_candidate(const std::string& fault) {
  if (fault.empty()) return pipeline::make_pipeline();
  throw std::invalid_argument("--fault: this plumb was built without the library of faults");
}
#endif

}  // namespace plumbline::cli
