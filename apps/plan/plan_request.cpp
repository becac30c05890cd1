#include "plan/plan_request.hpp"

namespace vantage {

PlanRequest plan_request(const Workcell& workcell, const Intrinsics& usual) {
  PlanRequest request{.work_area = workcell.work_area,
                      .intrinsics = workcell.movable_intrinsics.value_or(usual),
                      .range = workcell.movable_range};
  request.candidates = workcell.candidates;
  request.constraints = workcell.constraints;
  request.volume = workcell.volume;
  if (workcell.voxel_size_m) request.voxel_size_m = *workcell.voxel_size_m;
  return request;
}

}  // namespace vantage
