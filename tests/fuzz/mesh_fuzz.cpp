// Any bytes as a mesh file of each format (the first byte chooses), read in this process, not in a child.
#include "scene/mesh/import/mesh_import.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  constexpr const char* kNames[] = {"mesh.obj", "mesh.ply", "mesh.gltf", "mesh.glb", "mesh.3ds"};
  if (size == 0) return 0;
  const auto file = fuzz::folder().write(kNames[data[0] % std::size(kNames)], fuzz::text(data + 1, size - 1));
  try {
    import_mesh(file, AssetFolders({fuzz::folder().path()}), 1 << 16);
  } catch (const std::runtime_error&) {
  }
  return 0;
}
