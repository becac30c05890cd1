#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage::reconstruction::detail {

/// The body of a type, to be looked at from anywhere. Thread-safe.
class TypeBody {
 public:
  explicit TypeBody(const ObjectType& type);

  /// The middle and half the diagonal of its bounding box. Object's frame.
  const Eigen::Vector3d& centre() const { return centre_; }
  double radius_m() const { return radius_m_; }

  /// How far behind `to` (negative: before it), along the line of sight from `from`, the body's
  /// surface is first met. Nothing if the line misses it. Object's frame.
  std::optional<double> depth_behind(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  const ObjectType* type_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double radius_m_ = 0;
  mutable std::once_flag built_;
  mutable std::shared_ptr<const Scene> scene_;  // large meshes take a while: when it is needed
};

}  // namespace vantage::reconstruction::detail
