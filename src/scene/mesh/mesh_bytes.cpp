#include "scene/mesh/mesh_bytes.h"

#include "base/byte_archive.h"

namespace plumbline {

template <class Archive>
void visit(Archive& archive, MeshPart& part) {
  archive.block(part.mesh.positions);
  archive.block(part.mesh.normals);
  archive.block(part.mesh.colors);
  archive.block(part.mesh.texcoords);
  archive.block(part.mesh.triangles);
  std::vector<Material> materials;
  if (part.material) materials.push_back(*part.material);
  archive.block(materials);
  for (const Material& material : materials) part.material = material;
  archive(part.note);
}

std::string to_bytes(std::vector<MeshPart> parts) {
  ByteWriter writer;
  visit(writer, parts);
  return writer.done();
}

std::vector<MeshPart> parts_of(std::string_view bytes) {
  ByteReader reader(bytes, nullptr);
  std::vector<MeshPart> parts;
  visit(reader, parts);
  return parts;
}

}  // namespace plumbline
