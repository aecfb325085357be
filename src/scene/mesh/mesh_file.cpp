#include "scene/mesh/mesh_file.h"

#include <string>

#include <fmt/format.h>

#include "base/child_process.h"
#include "scene/mesh/mesh_bytes.h"

namespace plumbline {

std::vector<MeshPart> load_mesh(const std::filesystem::path& file, const AssetFolders& folders,
                                std::size_t most_triangles) {
  constexpr unsigned kSeconds = 60;
  std::vector<std::string> arguments = {file.string(), std::to_string(most_triangles)};
  for (const std::filesystem::path& folder : folders.all()) arguments.push_back(folder.string());
  try {
    return parts_of(answer_of_child("plumbline_mesh_reader", arguments, kSeconds));
  } catch (const ChildFailed& error) {
    throw MeshError(fmt::format("{}: expected a mesh, found a file whose reader {}", file.string(), error.what()));
  } catch (const std::runtime_error& error) {
    throw MeshError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace plumbline
