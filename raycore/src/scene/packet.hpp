#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "scene/embree.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::detail {

// Embree's own limit is 1.8e18; below this one nothing overflows on the way to it either.
inline constexpr float kFarthestCoordinate = 1e9f;

/// N points that are all the same, or an array of them, behind one way to load a lane.
struct PointLanes {
  PointsView view;
  std::size_t stride;  ///< 0 or 1

  explicit PointLanes(PointsView points) : view(points), stride(1) {}
  PointLanes(const Eigen::Vector3f& p, std::size_t size)
      : view{&p.x(), &p.y(), &p.z(), size}, stride(0) {}

  Eigen::Vector3f operator[](std::size_t i) const { return view[i * stride]; }
};

/// Whether a point is near enough. Written so that NaN fails, and without branches.
inline bool in_reach(float x, float y, float z) {
  return (std::fabs(x) <= kFarthestCoordinate) & (std::fabs(y) <= kFarthestCoordinate) &
         (std::fabs(z) <= kFarthestCoordinate);
}

/// Whether Embree may see a ray.
inline bool valid_ray(float ox, float oy, float oz, float dx, float dy, float dz) {
  return in_reach(ox, oy, oz) & in_reach(dx, dy, dz) & ((dx != 0) | (dy != 0) | (dz != 0));
}

/// Whether Embree may see the segment between two points.
inline bool valid_segment(float ox, float oy, float oz, float tx, float ty, float tz) {
  return in_reach(ox, oy, oz) & in_reach(tx, ty, tz) & ((tx != ox) | (ty != oy) | (tz != oz));
}

/// Where segments end, in parts of their length: to touch is to be occluded, and the distance that
/// Embree computes is off by up to three of a float's last bits where there is no FMA.
inline constexpr float kSegmentEnd = 1 + 0x1p-21f;

/// Puts a ray into a lane; where Embree may not see it, one that it may see. To leave such a lane
/// out by the packet's mask is not enough: on machines without AVX-512 Embree looks at all of them.
[[gnu::always_inline]] inline void set_ray(RTCRay16& rays, std::size_t lane, bool valid, float ox,
                                           float oy, float oz, float dx, float dy, float dz) {
  rays.org_x[lane] = valid ? ox : 0, rays.org_y[lane] = valid ? oy : 0;
  rays.org_z[lane] = valid ? oz : 0;
  rays.dir_x[lane] = valid ? dx : 1, rays.dir_y[lane] = valid ? dy : 1;
  rays.dir_z[lane] = valid ? dz : 1;
}

/// What all rays of a query share.
struct PacketJob {
  RTCScene scene;
  bool coherent;
  float t_far;
};

/// Sets the fields of a packet that no query changes.
inline void prepare(RTCRay16& rays) {
  for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
    rays.tnear[lane] = 0;
    rays.time[lane] = 0;
    rays.mask[lane] = kAllMasks;
    rays.id[lane] = 0;
    rays.flags[lane] = 0;
  }
}

}  // namespace vantage::detail
