#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vantage/raycore/points.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::bench {

/// Rays through a scene: as segments from `origins` to `ends` for occlusion, and as rays in
/// `directions` (= ends - origins) for closest hits. If `one_end` is set, all segments end in
/// `ends[0]`, and if `one_origin` is set, all rays start in `origins[0]`.
struct Workload {
  std::string name;
  const std::vector<TriangleMesh>* scene;
  Points origins, ends, directions;
  bool one_end = false;
  bool one_origin = false;
  bool coherent = false;

  std::size_t size() const { return origins.size(); }
};

/// Five cubes of 5 cm on the floor, as in the first demonstration scene.
const std::vector<TriangleMesh>& five_cubes();

/// One height field of about a million triangles, one metre wide.
const std::vector<TriangleMesh>& million_triangles();

/// From the voxel centres of the volume around the scene to a camera.
Workload voxels_to_camera(std::string name, const std::vector<TriangleMesh>& scene);

/// 8,192 of the rays, sixteen neighbours at a time: their prepared packets stay in the processor's
/// cache, so that bare Embree does not wait for memory.
Workload in_cache(const Workload& work);

/// From a camera through its 640×480 pixels.
Workload pixels(std::string name, const std::vector<TriangleMesh>& scene);

}  // namespace vantage::bench
