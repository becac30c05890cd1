// DAE, FBX, 3DS and 3MF through assimp, whose readers end the process on some damaged files, read
// what path a file names, and unpack without a limit: so they run in a process of their own.
#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/IOSystem.hpp>

#include <Eigen/LU>
#include <assimp/Importer.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/decoder/collada_up.hpp"
#include "mesh/decoder/polygon_soup.hpp"
#include "mesh/mesh_readers.hpp"

namespace vantage::raycore::detail {
namespace {

constexpr std::uint64_t kDecoderMemory = std::uint64_t(768) << 20;

struct PlacedNode {
  const aiNode* node;
  Eigen::Matrix4d T_scene_parent;
};

/// assimp gets the one file that was read, whatever it asks for beside it.
class OnlyFile : public Assimp::IOSystem {
 public:
  OnlyFile(std::string path, std::span<const std::uint8_t> bytes)
      : path_(std::move(path)), bytes_(bytes) {}

  bool Exists(const char* file) const override { return path_ == file; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    return path_ == file ? new Assimp::MemoryIOStream(bytes_.data(), bytes_.size()) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string path_;
  std::span<const std::uint8_t> bytes_;
};

/// assimp guesses a format from the content, too: all readers but the one that is asked for have to
/// be gone.
void keep_only(Assimp::Importer& importer, const std::string& ending) {
  std::vector<Assimp::BaseImporter*> others;
  for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
    std::set<std::string> endings;
    importer.GetImporter(i)->GetExtensionList(endings);
    if (!endings.contains(ending)) others.push_back(importer.GetImporter(i));
  }
  for (Assimp::BaseImporter* reader : others) {
    importer.UnregisterLoader(reader);
    delete reader;
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

void add_part(const aiMesh& part, const Eigen::Matrix4d& T_scene_part, PolygonSoup& soup) {
  const std::size_t first = soup.points.size();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    soup.points.push_back((T_scene_part * Eigen::Vector4d(p.x, p.y, p.z, 1)).head<3>());
  }
  // A mirrored part would be inside out.
  const bool mirrored = T_scene_part.topLeftCorner<3, 3>().determinant() < 0;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices < 3) continue;  // points and lines
    soup.polygons.push_back(face.mNumIndices);
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned index = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
      // Out of range in the part must not become another part's vertex.
      soup.polygons.push_back(index < part.mNumVertices ? std::uint32_t(first + index) : ~0U);
    }
  }
}

/// assimp turns a 3DS, which is z-up, to y-up: back.
Eigen::Matrix4d turn_back(const std::string& ending) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  if (ending == "3ds") turn.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

/// Every mesh of the scene at every node that shows it. A list of what is left to do instead of
/// recursion: the file decides how deep the nodes are.
void add_scene(const aiScene& scene, const Eigen::Matrix4d& T_file_scene, PolygonSoup& soup) {
  std::vector<PlacedNode> left = {{scene.mRootNode, T_file_scene}};
  while (!left.empty()) {
    const auto [node, T_scene_parent] = left.back();
    left.pop_back();
    const Eigen::Matrix4d T_scene_node = T_scene_parent * to_matrix(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] < scene.mNumMeshes) {
        add_part(*scene.mMeshes[node->mMeshes[i]], T_scene_node, soup);
      }
    }
    for (unsigned i = node->mNumChildren; i > 0; --i) {
      left.push_back({node->mChildren[i - 1], T_scene_node});
    }
  }
}

/// The axis that an FBX says is up; assimp leaves the coordinates as they are.
UpAxis fbx_up(const aiScene& scene) {
  std::int32_t axis = 1, sign = 1;
  if (scene.mMetaData != nullptr) {
    scene.mMetaData->Get("UpAxis", axis);
    scene.mMetaData->Get("UpAxisSign", sign);
  }
  if (axis < 0 || axis > 2) return UpAxis::y;
  return UpAxis(axis + (sign < 0 ? 3 : 0));
}

PolygonSoup decode(std::span<const std::uint8_t> bytes, const std::string& ending) {
  const std::string name = "mesh." + ending;
  Assimp::Importer importer;
  keep_only(importer, ending);
  importer.SetIOHandler(new OnlyFile(name, bytes));  // becomes the importer's
  // assimp would turn the scene to y up, and lose what the file says.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool("AI_CONFIG_IMPORT_FBX_IGNORE_UP_DIRECTION", true);  // since assimp 5.4
  const aiScene* scene = importer.ReadFile(name, 0);
  PolygonSoup soup;
  if (scene == nullptr || scene->mRootNode == nullptr) {
    soup.fault = fmt::format("cannot be read as a .{} mesh: {}", ending, importer.GetErrorString());
    return soup;
  }
  if (ending == "dae") soup.up = collada_up(as_text(bytes));
  if (ending == "fbx") soup.up = fbx_up(*scene);
  add_scene(*scene, turn_back(ending), soup);
  return soup;
}

}  // namespace

void read_with_assimp(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                      MeshBuilder& mesh) {
  std::string ending = path.extension().string().substr(1);
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  const unsigned seconds = 2 + 2 * unsigned(bytes.size() >> 20);
  ChildProcess child({seconds, 10 + 4 * seconds, kDecoderMemory}, mesh.file(), [&](int pipe) {
    PolygonSoup soup;
    try {
      soup = decode(bytes, ending);
    } catch (const std::exception& error) {
      soup = {};
      soup.fault = fmt::format("cannot be read as a .{} mesh: {}", ending, error.what());
    }
    send(pipe, soup);
  });
  if (receive(child, mesh)) return;
  const std::string how = child.end();
  throw Error(
      child.out_of_memory() ? ErrorCode::out_of_resources : ErrorCode::bad_input, mesh.file(),
      fmt::format(
          "cannot be read as a .{} mesh: assimp, which ran in a process of its own, {}; the file "
          "is damaged or far too large: export it again, or convert it to .stl, .ply, .obj or .glb",
          ending, how.empty() ? "said nothing" : how));
}

}  // namespace vantage::raycore::detail
