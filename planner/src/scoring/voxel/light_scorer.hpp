#pragma once

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::planner::detail {

/// Points spread evenly over surfaces, each for the same area.
struct SurfaceSamples {
  Points points;
  double area_per_point_m2 = 0;
};

/// Samples the surfaces of all known objects and static structures inside a box, a little off the
/// surface on its outer side: a point for every 2 mm², but no more than about 130,000 of them.
SurfaceSamples surface_samples(const WorldModel& world, const Box& inside);

}  // namespace vantage::planner::detail
