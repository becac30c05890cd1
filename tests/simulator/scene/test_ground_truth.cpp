#include <doctest/doctest.h>

#include "simulator/scene/ground_truth.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

constexpr Intrinsics kTruthCamera{640, 480, 600, 600, 319.5, 239.5};

SimulatedBody body(const char* name, const Box& box) {
  return {
      name, std::make_shared<const TexturedMesh>(TexturedMesh{TriangleMesh::from_box(box)}), {}};
}

PinholeCamera camera_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  return PinholeCamera(kTruthCamera, Pose::looking_at(eye, target), {0.1, 5});
}

// A plate stands upright in the middle of the work area, so that a camera far off on one side sees
// one half of it only.
const Box kArea({-0.1, -0.1, 0}, {0.1, 0.1, 0.1});
const Box kPlate({-0.005, -0.3, -0.1}, {0.005, 0.3, 0.3});

}  // namespace

TEST_CASE("the truth has the volumes that the bodies and cameras make") {
  const SimulatedScene scene({body("plate", kPlate)});
  const std::vector<PinholeCamera> left{camera_at({-1, 0, 0.05}, {0, 0, 0.05})};
  const GroundTruth truth(scene, left, GridGeometry::covering(kArea, 0.005));
  const StateGrid& grid = truth.grid();
  const double area = 0.2 * 0.2 * 0.1;
  CHECK(grid.volume_m3(VoxelState::occupied) / area == doctest::Approx(0.05));
  CHECK(grid.volume_m3(VoxelState::shadow) / area == doctest::Approx(0.475));
  CHECK(grid.volume_m3(VoxelState::free) / area == doctest::Approx(0.475));

  // From the other side all of it is seen; from the camera's own place nothing new; from above the
  // plate's end about what is not behind it from there.
  CHECK(truth.gain_m3(camera_at({1, 0, 0.05}, {0, 0, 0.05})) ==
        doctest::Approx(grid.volume_m3(VoxelState::shadow)));
  CHECK(truth.gain_m3(left.front()) == 0);
  CHECK(truth.gain_m3(camera_at({1, 0, 0.05}, {2, 0, 0.05})) == 0);  // looks away
}

TEST_CASE("a promise made without knowing a foreign body is not kept by the truth") {
  // The planner knows the plate, but not the box behind it, which fills a part of the shadow.
  const Box foreign({0.02, -0.05, 0}, {0.06, 0.05, 0.1});
  const SimulatedScene scene({body("plate", kPlate), body("foreign", foreign)});
  const std::vector<PinholeCamera> left{camera_at({-1, 0, 0.05}, {0, 0, 0.05})};
  const auto geometry = GridGeometry::covering(kArea, 0.005);
  const GroundTruth truth(scene, left, geometry);

  const auto plate = std::make_shared<const TriangleMesh>(TriangleMesh::from_box(kPlate));
  const WorldModel belief{{{"plate", plate, {}}}, {}, {{"left", left.front(), nullptr}}};
  const auto believed = classify(belief, geometry);
  const PinholeCamera view = camera_at({1, 0, 0.05}, {0, 0, 0.05});
  const double promised = believed->volume_m3(VoxelState::shadow);
  const double kept = truth.seen_m3(*believed, view);
  const double box = 0.04 * 0.1 * 0.1;
  CHECK(kept < promised - box);  // the box itself, and what it hides before the plate
  CHECK(kept > promised - 2.0 * box);
  CHECK(kept == doctest::Approx(truth.gain_m3(view)).epsilon(1e-9));

  // At half the voxel size the truth is the same within a voxel's width.
  const GroundTruth finer(scene, left, GridGeometry::covering(kArea, 0.0025));
  CHECK(finer.gain_m3(view) == doctest::Approx(truth.gain_m3(view)).epsilon(0.03));
}

}  // namespace vantage
