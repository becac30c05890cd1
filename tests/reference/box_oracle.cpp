#include "reference/box_oracle.hpp"

#include <algorithm>
#include <optional>

#include "reference/moller_trumbore.hpp"
#include "reference/thesis_volume.hpp"

namespace vantage::test {
namespace {

/// `slack` -1 to 1: how much of the margins is taken off the image and the depth range.
bool in_view(const PinholeCamera& camera, const Eigen::Vector3d& point, double slack) {
  const std::optional<ImagePoint> p = camera.project(point);
  if (!p) return false;
  const Intrinsics& k = camera.intrinsics();
  const double pixels = 1e-2 * slack, metres = kCloseCall * slack;
  return p->u >= pixels - 0.5 && p->u < k.width - 0.5 - pixels && p->v >= pixels - 0.5 &&
         p->v < k.height - 0.5 - pixels && p->depth >= camera.range().near_m + metres &&
         p->depth <= camera.range().far_m - metres;
}

}  // namespace

bool TurnedBox::contains(const Eigen::Vector3d& p_world, double slack_m) const {
  const Eigen::Vector3d p_box = T_world_box.inverse() * p_world;
  return (p_box.array().abs() < half.array() + slack_m).all();
}

bool TurnedBox::meets(const Eigen::Vector3d& a_world, const Eigen::Vector3d& b_world,
                      double slack_m) const {
  const Eigen::Vector3d a = T_world_box.inverse() * a_world;
  const Eigen::Vector3d direction = T_world_box.inverse() * b_world - a;
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -half[axis] - slack_m - a[axis], high = half[axis] + slack_m - a[axis];
    if (direction[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / direction[axis], high / direction[axis]));
    leave = std::min(leave, std::max(low / direction[axis], high / direction[axis]));
  }
  return enter <= leave;
}

OracleState BoxOracle::decide(const Eigen::Vector3d& point, double slack) const {
  OracleState result;
  const double slack_m = kCloseCall * slack;
  for (const PinholeCamera& camera : cameras_) {
    if (!in_view(camera, point, slack)) continue;
    result.unseen = false;
    const bool clear = std::none_of(boxes_.begin(), boxes_.end(), [&](const TurnedBox& box) {
      return box.meets(point, camera.centre(), slack_m);
    });
    if (clear) result.state = VoxelState::free;
  }
  for (const TurnedBox& box : boxes_) {
    if (box.contains(point, slack_m)) result.state = VoxelState::occupied;
  }
  return result;
}

OracleState BoxOracle::classify(const Eigen::Vector3d& point) const {
  // Larger boxes only hide and fill more, smaller images only see less: what both extremes agree
  // on holds for everything between them.
  const OracleState least = decide(point, 1), most = decide(point, -1);
  OracleState result = decide(point, 0);
  result.close_call = least.state != most.state || least.unseen != most.unseen;
  return result;
}

std::vector<char> solid_voxels(const std::vector<TurnedBox>& boxes, const GridGeometry& geometry,
                               bool& close_call) {
  std::vector<char> solid;
  for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
    const Eigen::Vector3d centre = geometry.centre(voxel);
    bool inside = false;
    for (const TurnedBox& box : boxes) {
      inside |= box.contains(centre);
      close_call |= box.contains(centre, 1e-6) != box.contains(centre, -1e-6);
    }
    solid.push_back(char(inside));
  });
  return solid;
}

}  // namespace vantage::test
