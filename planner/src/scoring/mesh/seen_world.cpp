#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"
#include "vantage/volume/advanced/visibility.hpp"

namespace vantage {
namespace {

/// The same object, larger about the middle of its box.
KnownObject enlarged(const KnownObject& object, double factor) {
  if (object.mesh == nullptr) {
    throw bad_input(object.name, "the object has no mesh; expected one, even if it is empty");
  }
  if (object.mesh->empty() || factor == 1) return object;
  const std::vector<Eigen::Vector3f>& vertices = object.mesh->vertices();
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : vertices) box.extend(vertex);
  const Eigen::Vector3d stays = box.center().cast<double>();
  KnownObject result = object;
  result.mesh = std::make_shared<const TriangleMesh>(object.mesh->scaled(factor));
  const Pose shift = Pose::from_rotation(Eigen::Matrix3d::Identity(), (1 - factor) * stays);
  result.T_world_object = object.T_world_object * shift;
  return result;
}

/// Three voxels make the cube's edge: no fewer can be opened with. Work areas may be huge.
double opening_voxel_m(const Box& work_area, const MeshMethod& method) {
  constexpr double kMaxVoxels = 1 << 24;
  return std::max(method.opening_m / 3, std::cbrt(work_area.volume_m3() / kMaxVoxels));
}

void expect_depth(const WorldModel& world) {
  const auto with_depth = [](const DepthCamera& camera) { return camera.depth != nullptr; };
  if (std::any_of(world.cameras.begin(), world.cameras.end(), with_depth)) return;
  throw bad_input("method", fmt::format("\"mesh\" needs depth images, and none of the {} cameras "
                                        "has one; add depth images or choose another method",
                                        world.cameras.size()));
}

}  // namespace

SeenWorld seen_world(const WorldModel& world, const Box& work_area, const StereoNoise& noise,
                     const MeshMethod& method) {
  method.check();
  expect_depth(world);
  SeenWorld seen{work_area, {}, {{}, world.static_structures, {}}};
  for (const KnownObject& object : world.objects) {
    seen.known.objects.push_back(enlarged(object, method.enlarge));
  }
  for (const DepthCamera& camera : world.cameras) {
    if (camera.depth == nullptr) continue;
    const PosedDepth image(camera.camera, camera.depth);
    if (auto lattice = visibility_lattice(image, work_area, noise, method.visibility)) {
      seen.lattices.push_back(std::move(*lattice));
    }
  }
  if (method.opening_m > 0) {
    const auto geometry = GridGeometry::covering(work_area, opening_voxel_m(work_area, method));
    seen.opened = morphological_open(*carve(seen.lattices, geometry, seen.known), 1);
  }
  return seen;
}

}  // namespace vantage
