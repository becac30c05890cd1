#include "surface/field_surface.hpp"

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/VolumeToMesh.h>

namespace vantage::volume::detail {
namespace {

namespace tools = openvdb::tools;

/// The voxels near a face.
openvdb::MaskTree band_around(const openvdb::MaskTree& voxels, int depth) {
  openvdb::MaskTree band = voxels, core = voxels;
  tools::dilateActiveValues(band, depth, tools::NN_FACE_EDGE_VERTEX, tools::PRESERVE_TILES);
  tools::erodeActiveValues(core, depth, tools::NN_FACE_EDGE_VERTEX, tools::PRESERVE_TILES);
  band.topologyDifference(core);
  tools::pruneInactive(band);
  band.voxelizeActiveTiles();
  return band;
}

}  // namespace

openvdb::FloatGrid::Ptr field_around(const openvdb::MaskTree& voxels, int band, float half) {
  const auto field = openvdb::FloatGrid::create(std::make_shared<openvdb::FloatTree>(
      band_around(voxels, band), half, half, openvdb::TopologyCopy()));
  for (const MaskBlock& block : mask_blocks(voxels)) {
    if (auto* const leaf = field->tree().probeLeaf(block.origin)) {
      for_each_on(block.words(), [&](int x, int y, int z) {
        leaf->setValueOnly(openvdb::Index(64 * x + 8 * y + z), -half);
      });
    } else {  // in the core, whole
      field->tree().addTile(1, block.origin, -half, false);
    }
  }
  return field;
}

TriangleMesh field_surface(const openvdb::FloatGrid& field, const GridGeometry& geometry,
                           std::string_view where) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  tools::volumeToMesh(field, points, quads, 0.0);
  std::vector<Eigen::Vector3f> vertices;
  vertices.reserve(points.size());
  const Eigen::Vector3d origin = geometry.centre(Eigen::Vector3i::Zero());
  for (const openvdb::Vec3s& p : points) {  // index coordinates, integers at the voxels' centres
    const Eigen::Vector3d offset = geometry.voxel_size_m() * Eigen::Vector3d(p.x(), p.y(), p.z());
    vertices.push_back((origin + offset).cast<float>());
  }
  std::vector<Triangle> triangles;
  triangles.reserve(2 * quads.size());
  for (const openvdb::Vec4I& q : quads) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return {std::move(vertices), std::move(triangles), where};
}

}  // namespace vantage::volume::detail
