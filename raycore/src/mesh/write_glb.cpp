// glTF 2.0 binary: a header, a chunk of JSON that describes the scene, a chunk with the numbers.
// The numbers of a mesh are its triangles' corners, each with its triangle's normal, which makes
// the shading flat: 3 corners × (3 + 3) floats.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/byte_order.hpp"
#include "geometry/coordinates.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/mesh_io.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kCornerBytes = 24;
constexpr int kFloat = 5126;         // glTF's number for the component type
constexpr int kArrayBuffer = 34962;  // and for the use of a buffer view
constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

void check_look(const ColoredMesh& mesh) {
  const bool color_fits = (mesh.color.array() >= 0).all() && (mesh.color.array() <= 1).all();
  if (color_fits && mesh.opacity >= 0 && mesh.opacity <= 1) return;
  throw bad_input(fmt::format("mesh \"{}\"", mesh.name),
                  fmt::format("has the colour {} and the opacity {}; expected numbers from 0 to 1",
                              raycore::detail::to_text(mesh.color), mesh.opacity));
}

/// IEC 61966-2-1. Six digits are more than enough for a colour.
double linear_from_srgb(double value) {
  const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return std::round(linear * 1e6) / 1e6;
}

Json material(const ColoredMesh& mesh) {
  Json result;
  result["name"] = mesh.name;
  result["pbrMetallicRoughness"]["baseColorFactor"] = {
      linear_from_srgb(mesh.color.x()), linear_from_srgb(mesh.color.y()),
      linear_from_srgb(mesh.color.z()), std::round(mesh.opacity * 1e6) / 1e6};
  result["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  result["pbrMetallicRoughness"]["roughnessFactor"] = 0.9;
  if (mesh.opacity < 1) result["alphaMode"] = "BLEND";
  result["doubleSided"] = true;  // a surface need not be closed
  return result;
}

void append(std::string& bytes, const Eigen::Vector3f& v) {
  for (const float coordinate : v) raycore::detail::append_little_endian(bytes, coordinate);
}

void append_corners(std::string& bytes, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const Eigen::Vector3d a = mesh.corner(i, 0).cast<double>();
    const Eigen::Vector3d ab = mesh.corner(i, 1).cast<double>() - a;
    const Eigen::Vector3d ac = mesh.corner(i, 2).cast<double>() - a;
    const Eigen::Vector3f normal = ab.cross(ac).stableNormalized().cast<float>();
    for (int k = 0; k < 3; ++k) {
      append(bytes, mesh.corner(i, k));
      append(bytes, normal);
    }
  }
}

Json accessor(std::size_t view, std::size_t offset, std::size_t count) {
  return {{"bufferView", view},
          {"byteOffset", offset},
          {"componentType", kFloat},
          {"count", count},
          {"type", "VEC3"}};
}

/// glTF asks for the bounds of the positions; unused vertices are not among them.
void add_bounds(Json& positions, const TriangleMesh& mesh) {
  Eigen::AlignedBox3f bounds;
  for (const Triangle& triangle : mesh.triangles()) {
    for (const std::uint32_t index : triangle) bounds.extend(mesh.vertices()[index]);
  }
  positions["min"] = {bounds.min().x(), bounds.min().y(), bounds.min().z()};
  positions["max"] = {bounds.max().x(), bounds.max().y(), bounds.max().z()};
}

/// The scene as it grows, mesh by mesh.
class Document {
 public:
  Document() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "vantage"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    // The one place where world z up becomes glTF's y up: a quarter turn about x, as x, y, z, w.
    const double half = std::sqrt(0.5);
    json_["nodes"] = Json::array({{{"name", "world"}, {"rotation", {-half, 0.0, 0.0, half}}}});
  }

  void add(const ColoredMesh& mesh) {
    const std::size_t number = json_.contains("meshes") ? json_["meshes"].size() : 0;
    const std::size_t start = bytes_.size();
    append_corners(bytes_, mesh.mesh);
    json_["nodes"][0]["children"].push_back(json_["nodes"].size());
    json_["nodes"].push_back({{"name", mesh.name}, {"mesh", number}});
    const Json attributes = {{"POSITION", 2 * number}, {"NORMAL", 2 * number + 1}};
    json_["meshes"].push_back(
        {{"name", mesh.name},
         {"primitives", Json::array({{{"attributes", attributes}, {"material", number}}})}});
    json_["materials"].push_back(material(mesh));
    const std::size_t count = 3 * mesh.mesh.triangles().size();
    Json positions = accessor(number, 0, count);
    add_bounds(positions, mesh.mesh);
    json_["accessors"].push_back(std::move(positions));
    json_["accessors"].push_back(accessor(number, kCornerBytes / 2, count));
    json_["bufferViews"].push_back({{"buffer", 0},
                                    {"byteOffset", start},
                                    {"byteLength", bytes_.size() - start},
                                    {"byteStride", kCornerBytes},
                                    {"target", kArrayBuffer}});
  }

  std::string finish() && {
    // glTF knows no empty buffer.
    if (!bytes_.empty()) json_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    // A name that is not UTF-8 must not be what fails.
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file;
    const std::size_t binary_chunk = bytes_.empty() ? 0 : 8 + bytes_.size();
    const std::size_t length = 12 + 8 + text.size() + binary_chunk;
    file.reserve(length);
    for (const std::uint32_t word :
         {kMagic, 2U, std::uint32_t(length), std::uint32_t(text.size()), kJsonChunk}) {
      raycore::detail::append_little_endian(file, word);
    }
    file += text;
    if (bytes_.empty()) return file;
    raycore::detail::append_little_endian(file, std::uint32_t(bytes_.size()));
    raycore::detail::append_little_endian(file, kBinaryChunk);
    return file + bytes_;
  }

 private:
  Json json_;
  std::string bytes_;  // 72 for each triangle, so always a multiple of 4
};

/// A glTF binary states its length in 32 bits; the JSON gets a generous 1 MiB of them.
void check_size(const std::filesystem::path& path, const std::vector<ColoredMesh>& meshes) {
  std::uint64_t triangles = 0;
  for (const ColoredMesh& mesh : meshes) triangles += mesh.mesh.triangles().size();
  const std::uint64_t most =
      (std::numeric_limits<std::uint32_t>::max() - (1U << 20)) / (3 * kCornerBytes);
  if (triangles <= most) return;
  throw Error(ErrorCode::out_of_resources, path.string(),
              fmt::format("{} triangles do not fit into a glTF binary, which holds {}; write a PLY "
                          "instead",
                          triangles, most));
}

}  // namespace

void write_glb(const std::filesystem::path& path, const std::vector<ColoredMesh>& meshes) {
  check_size(path, meshes);
  for (const ColoredMesh& mesh : meshes) check_look(mesh);
  Document document;
  for (const ColoredMesh& mesh : meshes) {
    if (!mesh.mesh.empty()) document.add(mesh);
  }
  write_file(path, std::move(document).finish());
}

}  // namespace vantage
