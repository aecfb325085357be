#include "scene/mesh/mesh_bytes.h"

#include <array>
#include <cstring>
#include <span>
#include <type_traits>

namespace plumbline {
namespace {

/// Plain arrays as bytes, and back, in the order in which they are named.
class Bytes {
 public:
  explicit Bytes(std::string bytes = "") : bytes_(std::move(bytes)) {}
  std::string take() { return std::move(bytes_); }

  template <class T>
  void put(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t count = values.size();
    bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  template <class T>
  std::vector<T> get() {
    std::size_t count = 0;
    copy(&count, sizeof count);
    std::vector<T> values(count);
    copy(values.data(), count * sizeof(T));
    return values;
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size == 0) return;
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::string to_bytes(const std::vector<MeshPart>& parts) {
  Bytes bytes;
  bytes.put(std::span<const std::size_t>(std::array{parts.size()}));
  for (const MeshPart& part : parts) {
    bytes.put(std::span<const glm::vec3>(part.mesh.positions));
    bytes.put(std::span<const glm::vec3>(part.mesh.normals));
    bytes.put(std::span<const glm::vec4>(part.mesh.colors));
    bytes.put(std::span<const glm::vec2>(part.mesh.texcoords));
    bytes.put(std::span<const glm::uvec3>(part.mesh.triangles));
    bytes.put(part.material ? std::span<const Material>(&*part.material, 1) : std::span<const Material>());
    bytes.put(std::span<const char>(part.note));
  }
  return bytes.take();
}

std::vector<MeshPart> parts_of(std::string bytes_of_parts) {
  Bytes bytes(std::move(bytes_of_parts));
  std::vector<MeshPart> parts(bytes.get<std::size_t>().front());
  for (MeshPart& part : parts) {
    part.mesh.positions = bytes.get<glm::vec3>();
    part.mesh.normals = bytes.get<glm::vec3>();
    part.mesh.colors = bytes.get<glm::vec4>();
    part.mesh.texcoords = bytes.get<glm::vec2>();
    part.mesh.triangles = bytes.get<glm::uvec3>();
    for (const Material& material : bytes.get<Material>()) part.material = material;
    const std::vector<char> note = bytes.get<char>();
    part.note.assign(note.begin(), note.end());
  }
  return parts;
}

}  // namespace plumbline
