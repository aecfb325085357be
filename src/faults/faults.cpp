#include "faults/faults.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "faults/lists.h"
#include "faults/notes.h"

namespace plumbline::faults {

namespace {

std::vector<Fault> of_all_stages() {
  std::vector<Fault> out;
  for (const auto list : {of_vertices, of_light, of_light_terms, of_polygons, of_raster, of_scanline, of_textures,
                          of_fog, of_merge, of_corner_values}) {
    out.insert(out.end(), list().begin(), list().end());
  }
  return out;
}

}  // namespace

std::span<const Fault> of_stages() {
  static const std::vector<Fault> kAll = of_all_stages();
  return kAll;
}

std::vector<Fault> all() {
  std::vector<Fault> out(of_stages().begin(), of_stages().end());
  out.insert(out.end(), of_notes().begin(), of_notes().end());
  return out;
}

Fault named(std::string_view name) {
  const std::vector<Fault> faults = all();
  const auto found = std::ranges::find(faults, name, &Fault::name);
  if (found == faults.end()) throw std::out_of_range(std::string(name));
  return *found;
}

}  // namespace plumbline::faults
