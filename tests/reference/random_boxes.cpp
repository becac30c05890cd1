#include "reference/random_boxes.hpp"

#include <string>

namespace vantage::test {
namespace {

const Box kWorkArea({-0.12, -0.12, 0}, {0.12, 0.12, 0.2});

TurnedBox random_box(Random& random) {
  TurnedBox box;
  for (int axis = 0; axis < 3; ++axis) box.half[axis] = random.uniform(0.01, 0.045);
  const Pose turned = random.pose(0.09);
  box.T_world_box = Pose::from_translation({0, 0, 0.1}) * turned;
  return box;
}

Intrinsics random_image(Random& random, double min_focal, double max_focal) {
  const int width = 160 + int(random.below(481)), height = 120 + int(random.below(361));
  const double focal = width * random.uniform(min_focal, max_focal);
  return {width,
          height,
          focal,
          focal * random.uniform(0.9, 1.1),
          width * random.uniform(0.4, 0.6),
          height * random.uniform(0.4, 0.6)};
}

PinholeCamera random_camera(Random& random) {
  const Eigen::Vector3d centre(0, 0, 0.1), target = centre + random.in_cube(0.05);
  Eigen::Vector3d direction = random.direction();
  direction.z() = std::abs(direction.z());
  const std::uint32_t kind = random.below(4);
  if (kind == 0) {  // in the midst
    const Eigen::Vector3d eye = centre + random.in_cube(0.09);
    return {random_image(random, 0.4, 0.8), Pose::looking_at(eye, target), {0.01, 0.5}};
  }
  const DepthRange range{0.1, random.uniform(0.5, 1.2)};  // may end within the work area
  const Eigen::Vector3d eye = centre + random.uniform(0.3, 0.7) * direction;
  if (kind == 1) return {random_image(random, 2, 5), Pose::looking_at(eye, target), range};
  return {random_image(random, 0.8, 1.5), Pose::looking_at(eye, target), range};
}

}  // namespace

KnownObject known_box(const std::string& name, const TurnedBox& box) {
  return {name,
          std::make_shared<const TriangleMesh>(TriangleMesh::from_box(Box(-box.half, box.half))),
          box.T_world_box};
}

WorldModel BoxWorld::model() const {
  WorldModel world;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    world.objects.push_back(known_box("box " + std::to_string(i), boxes[i]));
  }
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    world.cameras.push_back({"camera " + std::to_string(i), cameras[i], nullptr});
  }
  return world;
}

BoxWorld random_boxes(std::uint32_t seed, std::optional<double> voxel_size_m) {
  Random random(seed);
  constexpr double kVoxelSizes[] = {0.02, 0.015, 0.01, 0.0075};
  const double size_m = kVoxelSizes[random.below(4)];
  BoxWorld world{{}, {}, GridGeometry::covering(kWorkArea, voxel_size_m.value_or(size_m))};
  const std::uint32_t boxes = 1 + random.below(8), cameras = 1 + random.below(6);
  for (std::uint32_t i = 0; i < boxes; ++i) world.boxes.push_back(random_box(random));
  for (std::uint32_t i = 0; i < cameras; ++i) world.cameras.push_back(random_camera(random));
  return world;
}

BoxWorld random_rods(std::uint32_t seed, double voxel_size_m) {
  Random random(seed);
  BoxWorld world = random_boxes(seed, voxel_size_m);
  world.boxes.clear();
  for (int i = 0; i < 6; ++i) {
    TurnedBox box = random_box(random);
    box.half.x() = random.uniform(0.0005, 0.003);
    if (i < 4) box.half.y() = random.uniform(0.0005, 0.003);
    box.half.z() *= 2;
    world.boxes.push_back(box);
  }
  return world;
}

BoxWorld random_lattice_boxes(std::uint32_t seed, int finer) {
  constexpr double kCoarse = 1.0 / 64;
  const double voxel_m = kCoarse / finer;
  const Eigen::Vector3d low(-8 * kCoarse, -7 * kCoarse, 0),
      high(8 * kCoarse, 7 * kCoarse, 13 * kCoarse);
  Random random(seed);
  BoxWorld world = random_boxes(seed);
  world.geometry = GridGeometry::covering(Box(low, high), voxel_m);
  const auto half_voxels = [&](int from, int to) {
    return 0.5 * voxel_m * (from + int(random.below(std::uint32_t(to - from))));
  };
  for (PinholeCamera& camera : world.cameras) {
    const double x = half_voxels(-60 * finer, 60 * finer), y = half_voxels(-60 * finer, 60 * finer);
    const Eigen::Vector3d eye(x, y, half_voxels(20 * finer, 80 * finer));
    camera = PinholeCamera({640, 480, 200, 200, 319.3, 239.7},
                           Pose::looking_at(eye, {0.003, 0.004, 0.1}), {0.01, 5});
  }
  if (seed % 2 == 0) return world;
  for (TurnedBox& box : world.boxes) {
    Eigen::Vector3d centre;
    for (int axis = 0; axis < 3; ++axis) {
      const int sides = 1 + int(random.below(std::uint32_t(5 * finer)));
      const int corner = -8 * finer + int(random.below(std::uint32_t(16 * finer)));
      box.half[axis] = 0.5 * sides * voxel_m;
      centre[axis] = (corner + 0.5 * sides + (axis == 2 ? 7 * finer : 0)) * voxel_m;
    }
    box.T_world_box = Pose::from_translation(centre);
  }
  return world;
}

}  // namespace vantage::test
