// glTF 2.0: nodes place meshes, a mesh's primitives name accessors, those name views of buffers.
// Only positions and indices are read. https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/gltf/gltf_accessors.hpp"
#include "mesh/gltf/gltf_file.hpp"
#include "mesh/mesh_readers.hpp"
#include "mesh/text_scanner.hpp"
#include "mesh/triangle_strip.hpp"

namespace vantage::raycore::detail {
namespace {

/// What a file may show again and again, beyond what its own bytes hold.
constexpr std::uint64_t kMaxCopies = 10'000'000;

enum Mode : std::uint64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

/// Extensions that a reader has to know, but that leave positions where they are.
bool leaves_geometry(std::string_view name) {
  constexpr std::array<std::string_view, 6> kHarmless = {
      "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual",
      "KHR_mesh_quantization", "EXT_texture_webp",   "EXT_texture_avif"};
  for (const std::string_view harmless : kHarmless) {
    if (name == harmless) return true;
  }
  return name.starts_with("KHR_materials_");
}

void check_extensions(const GltfValue& root, MeshBuilder& mesh) {
  for (std::size_t i = 0; i < root.element_count("extensionsRequired"); ++i) {
    const GltfValue name = root.element("extensionsRequired", i);
    if (leaves_geometry(name.text())) continue;
    name.fail(
        fmt::format("asks for the extension {}, which is not read; export the mesh without "
                    "compression and extensions, or convert it to PLY",
                    in_quotes(name.text())));
  }
  for (std::size_t i = 0; i < root.element_count("extensionsUsed"); ++i) {
    if (root.element("extensionsUsed", i).text() == "EXT_mesh_gpu_instancing") {
      mesh.add_remark("only the first of its copies by EXT_mesh_gpu_instancing is kept");
    }
  }
}

/// Rounding of the numbers of quarter turns must not move what stands straight.
Eigen::Matrix3d straightened(const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix3d rounded = rotation.array().round().matrix();
  return (rotation - rounded).cwiseAbs().maxCoeff() < 1e-6 ? rounded : rotation;
}

Eigen::Affine3d transform_of(const GltfValue& node) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (node.has("matrix")) {
    const std::vector<double> m = node.numbers("matrix", 16);  // column by column
    result.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
    if (result.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
      node.fail("has a matrix whose last row is not 0, 0, 0, 1; expected no perspective");
    }
    return result;
  }
  if (node.has("translation")) {
    result.translation() = Eigen::Vector3d(node.numbers("translation", 3).data());
  }
  if (node.has("rotation")) {
    const std::vector<double> q = node.numbers("rotation", 4);  // x, y, z, w
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    if (std::abs(rotation.norm() - 1) > 1e-2) {
      node.fail(fmt::format("has a rotation of norm {}; expected a quaternion of norm 1",
                            rotation.norm()));
    }
    result.linear() = straightened(rotation.normalized().toRotationMatrix());
  }
  if (node.has("scale")) {
    result.linear() *= Eigen::Vector3d(node.numbers("scale", 3).data()).asDiagonal();
  }
  return result;
}

class GltfReader {
 public:
  GltfReader(const GltfFile& file, const std::filesystem::path& path, std::uint64_t size,
             MeshBuilder& mesh)
      : root_(file.json, mesh.file() + ": "),
        accessors_(root_, file.binary, path),
        size_(size),
        mesh_(mesh) {}

  void read() {
    check_extensions(root_, mesh_);
    const std::vector<std::uint64_t> first = roots();
    for (auto root = first.rbegin(); root != first.rend(); ++root) {
      left_.push_back({*root, Eigen::Affine3d::Identity()});
    }
    shown_.resize(root_.element_count("nodes"));
    // A list of what is left to do instead of recursion: the file decides how deep the nodes are.
    while (!left_.empty()) {
      const Placed next = left_.back();
      left_.pop_back();
      visit(next);
    }
    if (lines_ > 0) {
      mesh_.add_remark(fmt::format("{} of points and lines {} no surface; left out",
                                   lines_ == 1 ? "1 part" : fmt::format("{} parts", lines_),
                                   lines_ == 1 ? "is" : "are"));
    }
  }

 private:
  struct Placed {
    std::uint64_t node;
    Eigen::Affine3d T_scene_parent;
  };

  /// The nodes of the scene to show; without scenes, those that are no node's child.
  std::vector<std::uint64_t> roots() const {
    std::vector<std::uint64_t> result;
    if (root_.element_count("scenes") > 0) {
      const GltfValue scene = root_.element("scenes", root_.integer("scene", 0));
      for (std::size_t i = 0; i < scene.element_count("nodes"); ++i) {
        result.push_back(scene.element("nodes", i).integer());
      }
      return result;
    }
    std::vector<bool> is_child(root_.element_count("nodes"));
    for (std::size_t n = 0; n < is_child.size(); ++n) {
      const GltfValue node = root_.element("nodes", n);
      for (std::size_t i = 0; i < node.element_count("children"); ++i) {
        const std::uint64_t child = node.element("children", i).integer();
        if (child < is_child.size()) is_child[child] = true;
      }
    }
    for (std::size_t n = 0; n < is_child.size(); ++n) {
      if (!is_child[n]) result.push_back(n);
    }
    return result;
  }

  void visit(const Placed& placed) {
    const GltfValue node = root_.element("nodes", placed.node);
    if (shown_[placed.node]) {
      node.fail("is reached twice; expected nodes that make a tree");
    }
    shown_[placed.node] = true;
    const Eigen::Affine3d T_scene_node = placed.T_scene_parent * transform_of(node);
    if (node.has("mesh")) {
      const GltfValue part = root_.element("meshes", node.integer("mesh"));
      for (std::size_t i = 0; i < part.element_count("primitives"); ++i) {
        add_primitive(part.element("primitives", i), T_scene_node);
      }
    }
    for (std::size_t i = node.element_count("children"); i > 0; --i) {
      left_.push_back({node.element("children", i - 1).integer(), T_scene_node});
    }
  }

  void add_primitive(const GltfValue& primitive, const Eigen::Affine3d& T_scene_part) {
    const std::uint64_t mode = primitive.integer("mode", kTriangles);
    if (mode > kFan) {
      primitive.fail(fmt::format("has the mode {}; expected 0 to 6", mode));
    }
    if (mode < kTriangles) {
      ++lines_;
      return;
    }
    const GltfValue attributes = primitive.member("attributes");
    const std::vector<Eigen::Vector3d> points = accessors_.points(attributes.integer("POSITION"));
    const std::uint64_t first = mesh_.vertex_count();
    check_room(points.size(), primitive);
    for (std::size_t i = 0; i < points.size(); ++i) {
      mesh_.add_vertex(T_scene_part * points[i], {mesh_.file(), "vertex", first + i});
    }
    // A mirrored part would be inside out.
    const bool mirrored = T_scene_part.linear().determinant() < 0;
    if (!primitive.has("indices")) {
      return add_triangles(mode, points.size(), first, mirrored, [](std::size_t i) { return i; });
    }
    const std::vector<std::uint32_t> indices = accessors_.indices(primitive.integer("indices"));
    check_room(indices.size(), primitive);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] < points.size()) continue;
      // 0xFFFF and the like restart a strip in other formats; glTF forbids it.
      primitive.fail(
          fmt::format("has the index {} at place {}; expected less than {}, the number of "
                      "positions",
                      indices[i], i, points.size()));
    }
    add_triangles(mode, indices.size(), first, mirrored,
                  [&](std::size_t i) { return std::size_t(indices[i]); });
  }

  template <class IndexAt>
  void add_triangles(std::uint64_t mode, std::size_t count, std::uint64_t first, bool mirrored,
                     const IndexAt& index_at) {
    const auto vertex = [&](std::size_t i) { return std::int64_t(first + index_at(i)); };
    const auto add = [&](std::array<std::int64_t, 3> corners) {
      if (mirrored) std::swap(corners[1], corners[2]);
      mesh_.add_polygon(corners, mesh_.vertex_count(), {mesh_.file(), "triangle", 0});
    };
    TriangleStrip strip;
    for (std::size_t i = 0; i < count; ++i) {
      if (mode == kTriangles && i % 3 == 2) add({vertex(i - 2), vertex(i - 1), vertex(i)});
      if (mode == kFan && i >= 2) add({vertex(i - 1), vertex(i), vertex(0)});
      if (mode != kStrip) continue;
      if (const auto triangle = strip.next(vertex(i))) add(*triangle);
    }
  }

  /// A small file could show a large mesh any number of times.
  void check_room(std::uint64_t more, const GltfValue& primitive) {
    constexpr std::uint64_t kMinBytes = 6;  // of a point
    elements_ += more;
    const std::uint64_t most = kMaxCopies + (size_ + accessors_.bytes_used()) / kMinBytes;
    if (elements_ <= most) return;
    throw Error(
        ErrorCode::out_of_resources, primitive.place(),
        fmt::format("its nodes show more than {} points, far more than the file holds; export "
                    "a part of it, or fewer copies",
                    most));
  }

  GltfValue root_;
  GltfAccessors accessors_;
  std::uint64_t size_;
  MeshBuilder& mesh_;
  std::vector<Placed> left_;
  std::vector<bool> shown_;
  std::uint64_t lines_ = 0, elements_ = 0;
};

}  // namespace

void read_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
               MeshBuilder& mesh) {
  const GltfFile file = open_gltf(bytes, mesh.file());
  mesh.set_file_up(UpAxis::y);
  GltfReader(file, path, bytes.size(), mesh).read();
}

}  // namespace vantage::raycore::detail
