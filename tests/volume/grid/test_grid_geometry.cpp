#include <doctest/doctest.h>

#include <limits>

#include "support/expect_error.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage {

TEST_CASE("a grid covers the voxels whose centres are in the work area") {
  const Box area({-0.25, -0.175, 0}, {0.25, 0.175, 0.2});
  const GridGeometry grid = GridGeometry::covering(area, 0.01);
  CHECK(grid.size() == Eigen::Vector3i(50, 35, 20));
  CHECK(grid.voxel_count() == 35000);
  CHECK(grid.volume_m3() == doctest::Approx(0.035));
  CHECK(grid.voxel_volume_m3() == doctest::Approx(1e-6));
  // 0.5 / 0.15 = 3.33: the fourth centre would be at 3.5 voxels, outside.
  CHECK(GridGeometry::covering(area, 0.15).size() == Eigen::Vector3i(3, 2, 1));
  // Larger than the whole area: one voxel still.
  CHECK(GridGeometry::covering(area, 2).size() == Eigen::Vector3i(1, 1, 1));
}

TEST_CASE("index and world are converted to and fro") {
  const GridGeometry grid = GridGeometry::covering(Box({1, 2, 3}, {2, 3, 4}), 0.25);
  CHECK(grid.centre({0, 0, 0}).isApprox(Eigen::Vector3d(1.125, 2.125, 3.125)));
  CHECK(grid.corner({1, 2, 3}).isApprox(Eigen::Vector3d(1.25, 2.5, 3.75)));
  CHECK(grid.voxel_at({1, 2, 3}).value() == Eigen::Vector3i(0, 0, 0));
  CHECK(grid.voxel_at({1.2501, 2.9999, 3.5}).value() == Eigen::Vector3i(1, 3, 2));
  CHECK_FALSE(grid.voxel_at({2.0001, 2.5, 3.5}));
  CHECK_FALSE(grid.voxel_at({0.9999, 2.5, 3.5}));
  CHECK_FALSE(grid.voxel_at({std::numeric_limits<double>::quiet_NaN(), 2.5, 3.5}));
  for (int i = 0; i < 4; ++i) {
    CHECK(grid.voxel_at(grid.centre({i, 3 - i, 1})).value() == Eigen::Vector3i(i, 3 - i, 1));
  }
}

TEST_CASE("a grid refuses sizes that make no sense and tells what would") {
  const Box area({0, 0, 0}, {1, 1, 1});
  test::expect_error(ErrorCode::bad_input, "voxel size", "0 m; expected a number above 0",
                     [&] { GridGeometry::covering(area, 0); });
  test::expect_error(ErrorCode::bad_input, "voxel size", "nan", [&] {
    GridGeometry::covering(area, std::numeric_limits<double>::quiet_NaN());
  });
  test::expect_error(ErrorCode::out_of_resources, "voxel size", "1e-05 m",
                     [&] { GridGeometry::covering(area, 1e-5); });
  CHECK_NOTHROW(GridGeometry::covering(area, 0.001));
}

}  // namespace vantage
