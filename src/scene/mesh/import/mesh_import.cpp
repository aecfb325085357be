#include "scene/mesh/import/mesh_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>

#include "scene/json/scene_values.h"
#include "scene/mesh/import/mesh_check.h"
#include "scene/mesh/import/refuse.h"
#include "scene/mesh/mesh_shapes.h"
#include "scene/mesh/polygon.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& file) {
  constexpr std::uintmax_t kLargest = 256u << 20;
  if (!fs::is_regular_file(file)) refuse("a mesh file", "none");
  const std::uintmax_t size = fs::file_size(file);
  if (size > kLargest) refuse(fmt::format("a mesh file of at most {} bytes", kLargest), fmt::format("{}", size));
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) refuse("a mesh file", "one that cannot be read");
  return bytes;
}

/// File access for assimp: the mesh file's bytes as they were checked, and regular files that the folders allow. A
/// material file that does not exist reads as an empty one.
class AllowedFiles : public Assimp::DefaultIOSystem {
 public:
  /// Outcome of assimp's requests for files.
  struct Asked {
    std::string refused;     ///< the first file that was not opened, and why
    std::string missing;     ///< the first material file that does not exist
    bool materials = false;  ///< a material file was opened
  };
  AllowedFiles(const AssetFolders& folders, const fs::path& mesh, std::string_view bytes, Asked& asked)
      : folders_(folders), mesh_(mesh), bytes_(bytes), asked_(asked) {}
  /// True: the file is regular. assimp's own test opens the file, and waits for ever on a pipe.
  bool Exists(const char* file) const override {
    std::error_code error;
    return fs::is_regular_file(file, error);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = mode[0] == 'r';
    if (reads && file == mesh_ && folders_.allow(file)) return stream_of(bytes_);
    const bool material = fs::path(file).extension() == ".mtl";
    if (reads && material && lacks(file)) {
      if (asked_.missing.empty()) asked_.missing = file;
      return stream_of("# no material\n");  // assimp would open a file of the mesh's name instead
    }
    std::error_code error;
    const bool there = fs::is_regular_file(file, error);
    if (there && reads && folders_.allow(file)) {
      asked_.materials = asked_.materials || material;
      return DefaultIOSystem::Open(file, mode);
    }
    if (asked_.refused.empty()) {
      asked_.refused = fmt::format("\"{}\", {}", file, there ? "which is elsewhere" : "which is no file");
    }
    return nullptr;
  }

 private:
  static Assimp::IOStream* stream_of(std::string_view bytes) {
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  /// True: a material file is certainly missing: a name with blanks may name several files.
  static bool lacks(const std::string& file) {
    std::error_code error;
    return fs::symlink_status(file, error).type() == fs::file_type::not_found &&
           fs::path(file).filename().string().find(' ') == std::string::npos;
  }

  const AssetFolders& folders_;
  const fs::path& mesh_;
  std::string_view bytes_;
  Asked& asked_;
};

/// Parts of complaints after which assimp guesses nothing about the shape: meshes without nodes, an OBJ without "o",
/// animations, third texture coordinates that are 0.
constexpr std::array<std::string_view, 6> kHarmlessComplaints = {
    "No hierarchy information", "No object detected to attach",         "animation", "roll track",
    "Skipping pivot",           "UVs are declared to be 3D but they're"};

using Names = std::set<std::string, std::less<>>;

/// Records assimp's warnings and errors during its lifetime; after most of them assimp goes on by guessing.
class Complaints {
 public:
  Complaints() {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new Stream(*this), Assimp::Logger::Err | Assimp::Logger::Warn);
  }
  ~Complaints() { Assimp::DefaultLogger::kill(); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;
  const std::string& first() const { return first_; }
  /// Names of materials that the file uses and no material file defines.
  const Names& undefined_materials() const { return undefined_; }

 private:
  struct Stream : Assimp::LogStream {
    explicit Stream(Complaints& to) : complaints(to) {}
    void write(const char* message) override { complaints.add(message); }
    Complaints& complaints;
  };
  void add(std::string_view text) {
    constexpr std::string_view kUndefined = "OBJ: failed to locate material ", kRest = ", creating new material";
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::size_t undefined = line.find(kUndefined), rest = line.rfind(kRest);
    if (undefined != line.npos && rest != line.npos) {
      undefined_.emplace(line.substr(undefined + kUndefined.size(), rest - undefined - kUndefined.size()));
      return;
    }
    const bool harmless = std::any_of(kHarmlessComplaints.begin(), kHarmlessComplaints.end(),
                                      [&](std::string_view part) { return text.find(part) != text.npos; });
    if (!first_.empty() || harmless) return;
    const std::size_t head = line.find(": ");  // of "Warn,  T0: "
    first_ = line.substr(head < 12 ? head + 2 : 0);
  }
  std::string first_;
  Names undefined_;
};

/// Checks a mesh of assimp's before its post-processing, which trusts indices and numbers.
void check_part(const aiMesh& part) {
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices < 3) {
      refuse("faces of three corners or more (lines and points are not drawn)",
             fmt::format("{} in face {}", face.mNumIndices, f));
    }
    constexpr unsigned kMostCorners = 1024;
    if (face.mNumIndices > kMostCorners) {
      refuse(fmt::format("polygons of at most {} corners", kMostCorners),
             fmt::format("{} in face {}", face.mNumIndices, f));
    }
    std::vector<glm::dvec3> corners;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned i = face.mIndices[k];
      if (i >= part.mNumVertices) {
        refuse(fmt::format("vertices below {}", part.mNumVertices), fmt::format("{} in face {}", i, f));
      }
      const aiVector3D& p = part.mVertices[i];
      if (face.mNumIndices > 3) corners.emplace_back(p.x, p.y, p.z);
    }
    if (const std::string fault = polygon_fault(corners); !fault.empty()) {
      refuse("flat polygons that do not cross themselves", fmt::format("in face {} {}", f, fault));
    }
  }
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    for (const float x : {p.x, p.y, p.z}) {
      if (!std::isfinite(x)) refuse("coordinates that are finite", fmt::format("{} in vertex {}", x, i));
    }
    if (part.HasNormals()) {
      const aiVector3D& n = part.mNormals[i];
      if (!std::isnormal(n.SquareLength())) {
        refuse("finite normals that are not zero, for all corners or for none",
               fmt::format("({}, {}, {}) in vertex {}", n.x, n.y, n.z, i));
      }
    }
    if (part.HasTextureCoords(0)) {
      constexpr float kLargest = 16384;
      const aiVector3D& c = part.mTextureCoords[0][i];
      for (const float x : {c.x, c.y}) {
        if (!(std::abs(x) <= kLargest)) {
          refuse(fmt::format("texture coordinates from {} to {}", -kLargest, kLargest),
                 fmt::format("{} in vertex {}", x, i));
        }
      }
    }
    if (part.HasVertexColors(0)) {
      const aiColor4D& c = part.mColors[0][i];
      for (const float x : {c.r, c.g, c.b, c.a}) {
        if (!(x >= 0 && x <= 1)) refuse("colours from 0 to 1", fmt::format("{} in vertex {}", x, i));
      }
    }
  }
}

glm::vec4 read_color(const aiMaterial& from, const char* key, float alpha) {
  aiColor4D c(0);
  if (from.Get(key, 0, 0, c) != aiReturn_SUCCESS) return {0, 0, 0, alpha};
  for (const float x : {c.r, c.g, c.b}) {
    if (!(x >= 0 && x <= 1))
      refuse("colours from 0 to 1", fmt::format("{} in the material {}", x, from.GetName().C_Str()));
  }
  return {c.r, c.g, c.b, alpha};
}

/// The material; nullopt: one that assimp made up, of a file without materials (any PLY file), or `undefined`.
std::optional<Material> read_material(const aiMaterial& from, std::string_view ending, const Names& undefined) {
  const std::string name = from.GetName().C_Str();
  const bool made_up = name == AI_DEFAULT_MATERIAL_NAME || name == "%%%DEFAULT" || undefined.contains(name);
  if (ending == ".ply" || made_up) return std::nullopt;
  float opacity = 1, shininess = 0;
  from.Get(AI_MATKEY_OPACITY, opacity);
  from.Get(AI_MATKEY_SHININESS, shininess);
  if (!(opacity >= 0 && opacity <= 1))
    refuse("an opacity from 0 to 1", fmt::format("{} in the material {}", opacity, name));
  if (!(shininess >= 0)) refuse("a shininess of 0 or more", fmt::format("{} in the material {}", shininess, name));
  Material to;
  to.diffuse = read_color(from, "$clr.diffuse", opacity);
  to.emission = read_color(from, "$clr.emissive", 1);
  if (ending == ".gltf" || ending == ".glb") {
    to.ambient = glm::vec4(glm::vec3(to.diffuse), 1);
    return to;
  }
  to.ambient = read_color(from, "$clr.ambient", 1);
  to.specular = read_color(from, "$clr.specular", 1);
  to.shininess = std::min(shininess, 128.0f);
  return to;
}

/// Collects the meshes of a node tree, transformed, as parts: neighbours of one material in one part.
class Assembly {
 public:
  Assembly(const aiScene& scene, std::string_view ending, const Names& undefined_materials, std::size_t most_triangles)
      : scene_(scene), ending_(ending), undefined_(undefined_materials), most_triangles_(most_triangles) {}

  void add(const aiNode& node, const aiMatrix4x4& parent, int depth = 0) {
    constexpr int kDeepest = 256;
    if (depth > kDeepest) refuse(fmt::format("at most {} levels of nodes", kDeepest), "more");
    const aiMatrix4x4 placement = parent * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) add(*scene_.mMeshes[node.mMeshes[m]], placement);
    for (unsigned c = 0; c < node.mNumChildren; ++c) add(*node.mChildren[c], placement, depth + 1);
  }
  std::vector<MeshPart> take() { return std::move(parts_); }

 private:
  void add(const aiMesh& from, const aiMatrix4x4& placement) {
    triangles_ += from.mNumFaces;
    if (triangles_ > most_triangles_) refuse(fmt::format("at most {} triangles", most_triangles_), "more");
    if (parts_.empty() || material_ != from.mMaterialIndex) {
      parts_.push_back({{}, read_material(*scene_.mMaterials[from.mMaterialIndex], ending_, undefined_), ""});
      material_ = from.mMaterialIndex;
    }
    Mesh& mesh = parts_.back().mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const bool coordinates = from.HasTextureCoords(0) && mesh.texcoords.size() == first;
    if (!coordinates) mesh.texcoords.clear();
    const aiMatrix3x3 linear(placement);
    const bool mirrors = linear.Determinant() < 0;
    const aiMatrix3x3 for_normals = aiMatrix3x3(linear).Inverse().Transpose();
    if (from.HasVertexColors(0)) mesh.colors.resize(first, glm::vec4(1));
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
      const aiVector3D p = placement * from.mVertices[i];
      for (const float x : {p.x, p.y, p.z}) {
        if (!(std::abs(x) <= kLargestCoordinate)) {
          refuse(fmt::format("coordinates from {} to {}", -kLargestCoordinate, kLargestCoordinate),
                 fmt::format("{} in vertex {}", x, first + i));
        }
      }
      mesh.positions.emplace_back(p.x, p.y, p.z);
      const aiVector3D n = from.HasNormals() ? for_normals * from.mNormals[i] : aiVector3D(0);
      mesh.normals.emplace_back(n.x, n.y, n.z);
      if (coordinates) mesh.texcoords.emplace_back(from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y);
      if (from.HasVertexColors(0)) {
        const aiColor4D c = from.mColors[0][i];
        mesh.colors.emplace_back(c.r, c.g, c.b, c.a);
      } else if (!mesh.colors.empty()) {
        mesh.colors.emplace_back(1);
      }
    }
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
      const unsigned* corner = from.mFaces[f].mIndices;
      glm::uvec3 t(corner[0], corner[1], corner[2]);
      if (mirrors) std::swap(t.x, t.y);
      if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t + first);
    }
  }

  const aiScene& scene_;
  std::string_view ending_;
  const Names& undefined_;
  std::size_t most_triangles_, triangles_ = 0;
  unsigned material_ = 0;
  std::vector<MeshPart> parts_;
};

/// Normalises the normals; one without a direction (around triangles without area) is made from the adjacent triangles.
void repair_normals(Mesh& mesh) {
  std::vector<glm::vec3> spare;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const double length = glm::length(glm::dvec3(mesh.normals[i]));
    if (std::isnormal(length)) {
      mesh.normals[i] = glm::vec3(glm::dvec3(mesh.normals[i]) / length);
    } else {
      if (spare.empty()) spare = area_weighted_normals(mesh.positions, mesh.triangles);
      mesh.normals[i] = spare[i];
    }
  }
}

void add_note(std::string& notes, const std::string& note) { notes += (notes.empty() ? "" : "; ") + note; }

/// Requires the first bytes of the format that the ending names: on others assimp tries every format that it knows, and
/// may read for ever.
void check_beginning(std::string_view bytes, std::string_view ending) {
  if (ending == ".glb") check_glb(bytes);
  if (ending == ".3ds" && !bytes.starts_with("MM")) refuse("a 3DS file, beginning with MM", "another beginning");
  if (ending != ".gltf") return;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == bytes.npos || bytes[first] != '{') refuse("a glTF file, beginning with {", "another beginning");
}

}  // namespace

std::vector<MeshPart> import_mesh(const fs::path& file, const AssetFolders& folders, std::size_t most_triangles) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".obj" && ending != ".3ds" && ending != ".ply" && ending != ".gltf" && ending != ".glb") {
    refuse("a mesh file ending in .obj, .3ds, .ply, .gltf or .glb", fmt::format("\"{}\"", ending));
  }
  std::string bytes = read_bytes(file);
  check_beginning(bytes, ending);
  std::string note;
  if (ending == ".obj") note = check_obj(bytes);
  if (ending == ".ply") {
    check_ply(bytes);
    bytes = with_faces_for_strips(bytes);
  }

  AllowedFiles::Asked asked;
  const Complaints complaints;
  const Names& undefined = complaints.undefined_materials();
  Assimp::Importer importer;
  importer.SetIOHandler(new AllowedFiles(folders, file, bytes, asked));
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (!asked.refused.empty())
    refuse("a mesh whose other files are in the scene's folder or an asset folder", asked.refused);
  if (scene == nullptr) refuse("a mesh", importer.GetErrorString());
  if (scene->mRootNode == nullptr) refuse("a mesh", "a scene of nothing");
  if (!complaints.first().empty()) refuse("a mesh that can be read as it is", complaints.first());
  if (!undefined.empty() && asked.materials && asked.missing.empty()) {
    refuse("materials that the material files define", fmt::format("\"{}\"", *undefined.begin()));
  }
  if (!asked.missing.empty()) {
    add_note(note, fmt::format("materials of \"{}\" are left out: there is no such file", asked.missing));
  } else if (!undefined.empty()) {
    add_note(note, fmt::format("the material \"{}\" is left out: no material file is named", *undefined.begin()));
  }
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) check_part(*scene->mMeshes[m]);

  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                       aiProcess_GenSmoothNormals);
  if (scene == nullptr) refuse("a mesh", importer.GetErrorString());
  if (!complaints.first().empty()) refuse("polygons that can be cut into triangles", complaints.first());
  Assembly assembly(*scene, ending, undefined, most_triangles);
  assembly.add(*scene->mRootNode, aiMatrix4x4());
  std::vector<MeshPart> parts = assembly.take();
  std::erase_if(parts, [](const MeshPart& part) { return part.mesh.triangles.empty(); });
  if (parts.empty()) refuse("triangles", "none");
  for (MeshPart& part : parts) repair_normals(part.mesh);
  parts.front().note = std::move(note);
  return parts;
}

}  // namespace plumbline
