#include "vantage/volume/smooth_surface.hpp"

#include "openvdb.hpp"

#include <openvdb/tools/Filter.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>

#include "mask_blocks.hpp"
#include "state_masks.hpp"

namespace vantage {
namespace detail {
namespace {

namespace tools = openvdb::tools;

constexpr int kBand = 4;          // how many voxels deep the Gaussian reaches: four means of 3³
constexpr float kInside = -0.5f;  // the surface is at 0; inside is negative, as in level sets
constexpr float kOutside = 0.5f;
constexpr float kLeastMargin = 0.1f;  // a centre keeps at least this much of its own side

/// The voxels that the Gaussian can change: those near a face.
openvdb::MaskTree band_around(const openvdb::MaskTree& voxels) {
  openvdb::MaskTree band = voxels, core = voxels;
  tools::dilateActiveValues(band, kBand, tools::NN_FACE_EDGE_VERTEX, tools::PRESERVE_TILES);
  tools::erodeActiveValues(core, kBand, tools::NN_FACE_EDGE_VERTEX, tools::PRESERVE_TILES);
  band.topologyDifference(core);
  tools::pruneInactive(band);
  band.voxelizeActiveTiles();
  return band;
}

/// `kInside` in the voxels, `kOutside` elsewhere; active, and in leaves, in the band.
openvdb::FloatGrid::Ptr indicator(const openvdb::MaskTree& voxels) {
  const auto field = openvdb::FloatGrid::create(std::make_shared<openvdb::FloatTree>(
      band_around(voxels), kOutside, kOutside, openvdb::TopologyCopy()));
  for (const MaskBlock& block : mask_blocks(voxels)) {
    if (auto* const leaf = field->tree().probeLeaf(block.origin)) {
      for_each_on(block.words(), [&](int x, int y, int z) {
        leaf->setValueOnly(openvdb::Index(64 * x + 8 * y + z), kInside);
      });
    } else {  // in the core, whole
      field->tree().addTile(1, block.origin, kInside, false);
    }
  }
  return field;
}

/// Brings every voxel of the field back to its own side of the surface.
void keep_sides(const openvdb::MaskTree& voxels, openvdb::FloatTree& field) {
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(field);
  leaves.foreach ([&](openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    const BlockWords inside = BlockReader(voxels).words(leaf.origin());
    for (openvdb::Index n = 0; n < leaf.SIZE; ++n) {
      const bool in = inside[n >> 6] >> (n & 63) & 1;
      const float value = leaf.getValue(n);
      leaf.setValueOnly(n, in ? std::min(value, -kLeastMargin) : std::max(value, kLeastMargin));
    }
  });
}

}  // namespace

TriangleMesh smooth_surface(const openvdb::MaskTree& voxels, const GridGeometry& geometry) {
  const openvdb::FloatGrid::Ptr field = indicator(voxels);
  tools::Filter<openvdb::FloatGrid>(*field).gaussian();
  keep_sides(voxels, field->tree());

  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  tools::volumeToMesh(*field, points, quads, 0.0);
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
  return {std::move(vertices), std::move(triangles), "smooth surface"};
}

}  // namespace detail

TriangleMesh smooth_surface(const StateGrid& grid, VoxelState state) {
  return detail::with_voxels(grid.impl(), state, [&](const openvdb::MaskTree& voxels) {
    return detail::smooth_surface(voxels, grid.geometry());
  });
}

}  // namespace vantage
