#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace vantage {

/// The squared distance of the segments p + s d and q + t e, with s and t in 0 … 1; neither d nor e
/// is zero. Any unit, any frame. Ericson, "Real-Time Collision Detection", 2005, section 5.1.9: the
/// lines' nearest points, then each of them clamped in turn.
inline double squared_segment_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                                       const Eigen::Vector3d& q, const Eigen::Vector3d& e) {
  const Eigen::Vector3d r = p - q;
  const double dd = d.dot(d), ee = e.dot(e), de = d.dot(e), dr = d.dot(r), er = e.dot(r);
  const double parallel = dd * ee - de * de;  // 0 if they are: any s does, then
  double s = parallel > 0 ? std::clamp((de * er - dr * ee) / parallel, 0.0, 1.0) : 0.0;
  double t = (de * s + er) / ee;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((de * t - dr) / dd, 0.0, 1.0);
  }
  return (r + s * d - t * e).squaredNorm();
}

}  // namespace vantage
