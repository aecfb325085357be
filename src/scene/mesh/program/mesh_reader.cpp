// plumbline_mesh_reader FILE MOST_TRIANGLES FOLDER...: import_mesh() for load_mesh() (mesh_file.h), in its own process:
// assimp crashes or hangs on some bad files.
#include <filesystem>
#include <string>
#include <vector>

#include "base/child_process.h"
#include "scene/mesh/import/mesh_import.h"
#include "scene/mesh/mesh_bytes.h"

int main(int argc, char** argv) {
  using namespace plumbline;
  if (argc < 3) return 2;
  const std::filesystem::path file = argv[1];
  const std::size_t most_triangles = std::stoull(argv[2]);
  const AssetFolders folders(std::vector<std::filesystem::path>(argv + 3, argv + argc));
  answer_parent([&] { return to_bytes(import_mesh(file, folders, most_triangles)); });
}
