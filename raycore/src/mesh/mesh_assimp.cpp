#include <assimp/BaseImporter.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <assimp/Importer.hpp>
#include <memory>
#include <utility>

#include "mesh/mesh_readers.hpp"

namespace vantage::raycore::detail {
namespace {

struct PlacedNode {
  const aiNode* node;
  Eigen::Matrix4d T_scene_parent;
};

/// assimp guesses a format from the content, too, and some Debian builds of its readers for these
/// three end the process on damaged files: they have to be gone, not only unasked.
void drop_formats_of_ours(Assimp::Importer& importer) {
  for (const char* ending : {"stl", "ply", "obj"}) {
    while (Assimp::BaseImporter* reader = importer.GetImporter(ending)) {
      importer.UnregisterLoader(reader);
      delete reader;
    }
  }
}

Eigen::Matrix4d to_matrix(const aiMatrix4x4& m) {
  Eigen::Matrix4d result;
  result << m.a1, m.a2, m.a3, m.a4,  //
      m.b1, m.b2, m.b3, m.b4,        //
      m.c1, m.c2, m.c3, m.c4,        //
      m.d1, m.d2, m.d3, m.d4;
  return result;
}

void add_faces(const aiMesh& part, std::size_t first_vertex, bool mirrored, const FilePlace& place,
               MeshCollector& mesh) {
  std::vector<std::int64_t> corners;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices < 3) continue;  // points and lines
    corners.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned index = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
      if (index >= part.mNumVertices) {
        place.fail(
            fmt::format("face {} has a corner at vertex {}; expected an index below {}, the "
                        "number of vertices",
                        i, index, part.mNumVertices));
      }
      corners.push_back(std::int64_t(first_vertex + index));
    }
    mesh.add_polygon(corners, mesh.vertex_count(), place);
  }
}

void add_part(const aiMesh& part, const Eigen::Matrix4d& T_scene_part, const FilePlace& place,
              MeshCollector& mesh) {
  const std::size_t first_vertex = mesh.vertex_count();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    const Eigen::Vector4d p_scene = T_scene_part * Eigen::Vector4d(p.x, p.y, p.z, 1);
    mesh.add_vertex(p_scene.head<3>(), place);
  }
  // A mirrored part would be inside out.
  const bool mirrored = T_scene_part.topLeftCorner<3, 3>().determinant() < 0;
  add_faces(part, first_vertex, mirrored, place, mesh);
}

/// Every mesh of the scene at every node that shows it. A list of what is left to do instead of
/// recursion: the file decides how deep the nodes are.
void add_scene(const aiScene& scene, MeshCollector& mesh) {
  std::vector<PlacedNode> left = {{scene.mRootNode, Eigen::Matrix4d::Identity()}};
  while (!left.empty()) {
    const auto [node, T_scene_parent] = left.back();
    left.pop_back();
    const Eigen::Matrix4d T_scene_node = T_scene_parent * to_matrix(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      const unsigned number = node->mMeshes[i];
      const FilePlace place = {mesh.file(), "mesh", number};
      if (number >= scene.mNumMeshes) {
        place.fail(fmt::format("does not exist; the file has {} meshes", scene.mNumMeshes));
      }
      add_part(*scene.mMeshes[number], T_scene_node, place, mesh);
    }
    for (unsigned i = node->mNumChildren; i > 0; --i) {
      left.push_back({node->mChildren[i - 1], T_scene_node});
    }
  }
}

}  // namespace

void read_with_assimp(const std::filesystem::path& path, MeshCollector& mesh) {
  Assimp::Importer importer;
  drop_formats_of_ours(importer);
  const std::string ending = path.extension().string();
  if (ending.empty() || !importer.IsExtensionSupported(ending)) {
    throw bad_input(mesh.file(), fmt::format("has the ending \"{}\"; expected a mesh: .stl, .ply, "
                                             ".obj, .glb, .gltf, .dae, .fbx, .off or another that "
                                             "assimp reads",
                                             ending));
  }
  const aiScene* scene = nullptr;
  std::string reason;
  try {
    scene = importer.ReadFile(path.string(), 0);
    reason = importer.GetErrorString();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    reason = e.what();
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw bad_input(mesh.file(), fmt::format("cannot be read as a {} mesh: {}", ending, reason));
  }
  add_scene(*scene, mesh);
}

}  // namespace vantage::raycore::detail
