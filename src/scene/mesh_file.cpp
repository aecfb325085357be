#include "scene/mesh_file.h"

#include <algorithm>
#include <cmath>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/Importer.hpp>

#include "scene/mesh_shapes.h"

namespace plumbline {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::string_view what) {
  throw MeshError(fmt::format("{}: {}", file.string(), what));
}

/// Appends one of the file's meshes, placed by `placement`.
void append(Mesh& mesh, const aiMesh& part, const aiMatrix4x4& placement, const std::filesystem::path& file) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const aiMatrix3x3 linear(placement);
  const bool mirrors = linear.Determinant() < 0;
  const aiMatrix3x3 for_normals = aiMatrix3x3(linear).Inverse().Transpose();

  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D p = placement * part.mVertices[i];
    for (const float x : {p.x, p.y, p.z}) {
      if (!(std::abs(x) <= kLargestCoordinate)) {
        fail(file, fmt::format("expected coordinates from {} to {}, found {} in vertex {}", -kLargestCoordinate,
                               kLargestCoordinate, x, first + i));
      }
    }
    mesh.positions.emplace_back(p.x, p.y, p.z);
    const aiVector3D n = part.HasNormals() ? for_normals * part.mNormals[i] : aiVector3D(0);
    mesh.normals.emplace_back(n.x, n.y, n.z);
    const aiColor4D c = part.HasVertexColors(0) ? part.mColors[0][i] : aiColor4D(1);
    mesh.colors.emplace_back(c.r, c.g, c.b, c.a);
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    glm::uvec3 t(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
    for (int k = 0; k < 3; ++k) {
      if (t[k] >= part.mNumVertices) {
        fail(file, fmt::format("expected vertices below {}, found {} in triangle {}", part.mNumVertices, t[k], f));
      }
    }
    if (mirrors) std::swap(t.x, t.y);
    if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t + first);
  }
}

/// Appends what hangs below a node. (aiProcess_PreTransformVertices would leave mirrored parts inside out.)
void append(Mesh& mesh, const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
            const std::filesystem::path& file) {
  const aiMatrix4x4 placement = parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) append(mesh, *scene.mMeshes[node.mMeshes[m]], placement, file);
  for (unsigned c = 0; c < node.mNumChildren; ++c) append(mesh, scene, *node.mChildren[c], placement, file);
}

void repair_normals(Mesh& mesh) {
  std::vector<glm::vec3> spare;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const glm::dvec3 n(mesh.normals[i]);
    const double length = glm::length(n);
    if (std::isfinite(length) && length > 1e-12) {
      mesh.normals[i] = glm::vec3(n / length);
    } else {
      if (spare.empty()) spare = area_weighted_normals(mesh.positions, mesh.triangles);
      mesh.normals[i] = spare[i];
    }
  }
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".obj" && ending != ".3ds") {
    fail(file, fmt::format("expected a mesh file ending in .obj or .3ds, found \"{}\"", ending));
  }
  if (!std::filesystem::is_regular_file(file)) fail(file, "expected a mesh file, found none");

  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(
      file.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_GenSmoothNormals);
  if (scene == nullptr) fail(file, fmt::format("expected a mesh, found: {}", importer.GetErrorString()));

  Mesh mesh;
  append(mesh, *scene, *scene->mRootNode, aiMatrix4x4(), file);
  if (mesh.triangles.empty()) fail(file, "expected triangles, found none");
  const aiMesh* const* parts = scene->mMeshes;
  if (std::none_of(parts, parts + scene->mNumMeshes, [](const aiMesh* part) { return part->HasVertexColors(0); })) {
    mesh.colors.clear();
  }
  repair_normals(mesh);
  return mesh;
}

}  // namespace plumbline
