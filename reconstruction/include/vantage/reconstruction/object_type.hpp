#pragma once

#include <Eigen/Geometry>
#include <compare>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage {

/// Turns around this line leave the object as it is. Object's frame.
struct ContinuousSymmetry {
  Eigen::Vector3d axis;  ///< of length 1
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
};

/// Motions that leave an object as it is, with BOP's meaning (models_info.json).
struct Symmetries {
  std::vector<Pose> discrete;  ///< the identity left out
  std::vector<ContinuousSymmetry> continuous;
  bool none() const { return discrete.empty() && continuous.empty(); }
};

/// What a detector recognises, e.g. {"aruco", "4X4/17"} or {"keypoint", "spout"}. Two features with
/// the same key look the same: which one it is has to follow from where it is.
struct FeatureKey {
  std::string type;   ///< which kind of detector finds it
  std::string value;  ///< which one of its kind
  auto operator<=>(const FeatureKey&) const = default;
};

/// The key of a marker: type "aruco", value "4X4/17" – the family and the id, as 4X4_50's markers
/// are the first of 4X4_250's.
VANTAGE_API FeatureKey marker_key(const std::string& dictionary, int id);

/// Points of the object that a camera sees as pixels, in this order; at least one. Object's frame.
struct FeaturePoints {
  std::vector<Eigen::Vector3d> points_m;
};

/// A frame on the object, of which a detector measures the whole pose.
struct FeaturePose {
  Pose T_object_feature;
};

/// A label that the object carries near some points of it – a colour, a class: a detector says that
/// it sees the label at some point in space. Without points: anywhere on its surface.
struct FeatureLabel {
  std::vector<Eigen::Vector3d> points_m = {};
  double radius_m = 0;  ///< around each point
};

/// Something by which an object is recognised.
struct ObjectFeature {
  FeatureKey key;
  std::variant<Marker, FeaturePoints, FeaturePose, FeatureLabel> geometry;

  /// A marker's four corners, or the points of `FeaturePoints`; empty for the others.
  VANTAGE_API std::vector<Eigen::Vector3d> points() const;
};

/// @returns a feature with the marker's key.
VANTAGE_API ObjectFeature marker_feature(Marker marker);

/// What the knowledge base says of a kind of object. Thesis, section 5.2.
struct ObjectType {
  std::string name;
  std::vector<std::string> is_a = {};             ///< parents; need not be types of their own
  std::shared_ptr<const TriangleMesh> mesh = {};  ///< never null; metres, object's frame
  Eigen::Vector3f color = {0.75f, 0.75f, 0.75f};  ///< sRGB, 0 to 1
  Symmetries symmetries = {};
  std::vector<ObjectFeature> features = {};
  std::optional<int> bop_id = {};  ///< if it comes from a BOP model
  std::string place = {};          ///< in the file, for messages; may be empty

  /// Those of its features that are markers, in their order.
  VANTAGE_API std::vector<Marker> markers() const;
};

}  // namespace vantage
