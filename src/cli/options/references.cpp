#include "cli/options/references.h"

#include <algorithm>

#include "base/temporary_path.h"
#include "check/golden/golden.h"
#include "cli/options/renderers.h"

namespace plumbline::cli {

References make_references(const std::vector<std::string>& names, const std::vector<std::string>& assets) {
  References out;
  for (const std::string& name : names) {
    out.owned.push_back(make_reference(name, assets));
    out.list.push_back({name, out.owned.back().get()});
  }
  return out;
}

References make_references(const std::vector<std::string>& names, const std::vector<std::string>& assets,
                           const Watch& watch, const std::string& fault) {
  References out;
  std::uint32_t number = 0;
  const auto add = [&](const std::string& name, std::vector<check::Reference>& to) {
    Watch own = watch;
    if (in_own_process(name)) own.limit += kOwnProcessLimit;  // the process' own limit ends it first
    const auto make = [&] { return make_reference(name, assets, fault); };
    out.owned.push_back(make_watched(name, make, ++number, own));
    to.push_back({name, out.owned.back().get()});
  };
  for (const std::string& name : names) add(name, out.list);
  for (const std::string& name : default_references()) {
    if (name != opengl_reference() && std::ranges::count(names, name) == 0) add(name, out.arbiters);
  }
  return out;
}

void require_references(const std::vector<std::string>& names) {
  if (std::ranges::any_of(names, in_own_process)) require_temporary_files();
}

std::vector<std::string> without_repeats(const std::vector<std::string>& names) {
  std::vector<std::string> out = known_reference_names();
  std::erase_if(out, [&](const std::string& name) { return std::ranges::count(names, name) == 0; });
  return out;
}

std::vector<std::string> names_of_rows() {
  std::vector<std::string> out = known_reference_names();
  for (const check::Kind own : {check::Kind::golden, check::Kind::picture}) out.emplace_back(name_of(own));
  return out;
}

std::map<std::string, std::string> versions_of(const Renderer& candidate, const References& references) {
  std::map<std::string, std::string> out{{candidate.info().name, candidate.info().version}};
  for (const check::Reference& r : references.list) {
    if (r.renderer != nullptr) out[r.name] = r.renderer->info().version;
  }
  return out;
}

}  // namespace plumbline::cli
