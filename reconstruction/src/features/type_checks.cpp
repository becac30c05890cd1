#include "features/type_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "vantage/raycore/detail/mesh_measures.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

void check_points(const std::vector<Eigen::Vector3d>& points_m, const std::string& place) {
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (points_m[i].allFinite()) continue;
    const Eigen::Vector3d& p = points_m[i];
    throw bad_input(place, fmt::format("point {} is ({}, {}, {}); expected finite numbers", i,
                                       p.x(), p.y(), p.z()));
  }
}

struct GeometryCheck {
  const std::string& place;

  void operator()(const Marker& marker) const {
    if (std::isfinite(marker.size_m) && marker.size_m > 0) return;
    throw bad_input(place, fmt::format("the marker's size is {} m; expected a finite size above 0",
                                       marker.size_m));
  }
  void operator()(const FeaturePoints& feature) const {
    if (feature.points_m.empty()) throw bad_input(place, "no points; expected one or more");
    check_points(feature.points_m, place);
  }
  void operator()(const FeaturePose&) const {}  // poses are always valid
  void operator()(const FeatureLabel& label) const {
    check_points(label.points_m, place);
    if (std::isfinite(label.radius_m) && label.radius_m >= 0) return;
    throw bad_input(place, fmt::format("the label's radius is {} m; expected a finite radius, 0 or "
                                       "more",
                                       label.radius_m));
  }
};

bool same(const Pose& a, const Pose& b) {
  return a.rotation() == b.rotation() && a.translation() == b.translation();
}
/// Dictionaries of one family have the same markers: the key tells them apart.
bool same(const Marker& a, const Marker& b) {
  return a.size_m == b.size_m && same(a.T_object_marker, b.T_object_marker);
}
bool same(const FeaturePoints& a, const FeaturePoints& b) {
  return a.points_m == b.points_m;
}
bool same(const FeaturePose& a, const FeaturePose& b) {
  return same(a.T_object_feature, b.T_object_feature);
}
bool same(const FeatureLabel& a, const FeatureLabel& b) {
  return a.points_m == b.points_m && a.radius_m == b.radius_m;
}

bool same(const ObjectFeature& a, const ObjectFeature& b) {
  if (a.key != b.key || a.geometry.index() != b.geometry.index()) return false;
  return std::visit(
      [&](const auto& geometry) {
        return same(geometry, std::get<std::decay_t<decltype(geometry)>>(b.geometry));
      },
      a.geometry);
}

std::string feature_place(const ObjectType& type, std::size_t index) {
  return fmt::format("{}.features[{}]", place_of(type), index);
}

/// A marker is printed on a face of the object: it cannot be larger than the object along its
/// edges.
void check_fits(const ObjectType& type, const Marker& marker, const std::string& place) {
  constexpr double kRoom_m = 0.001, kRoom = 1.02;  // a sticker, a rounded mesh
  const Eigen::AlignedBox3d bounds = raycore::detail::bounds_of(*type.mesh);
  if (bounds.isEmpty()) return;
  const Eigen::Vector3d size = bounds.sizes();
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector3d edge = marker.T_object_marker.rotation().col(axis);
    if (marker.size_m <= kRoom * edge.cwiseAbs().dot(size) + kRoom_m) continue;
    throw bad_input(place,
                    fmt::format("the marker {} of {:g} m is larger than the face that carries it: "
                                "the object is {:.4g} x {:.4g} x {:.4g} m; check size_m, and the "
                                "size of the shape",
                                marker.id, marker.size_m, size.x(), size.y(), size.z()));
  }
}

void check_feature(const ObjectType& type, std::size_t index) {
  const ObjectFeature& feature = type.features[index];
  const std::string place = feature_place(type, index);
  if (feature.key.type.empty() || feature.key.value.empty()) {
    throw bad_input(place, fmt::format("its key is \"{}\", \"{}\"; expected a type and a value",
                                       feature.key.type, feature.key.value));
  }
  std::visit(GeometryCheck{place}, feature.geometry);
  if (const auto* marker = std::get_if<Marker>(&feature.geometry)) check_fits(type, *marker, place);
  for (std::size_t other = 0; other < index; ++other) {
    if (!same(type.features[other], feature)) continue;
    throw bad_input(place,
                    fmt::format("{} {} repeats features[{}] in the same place; remove one of them",
                                feature.key.type, feature.key.value, other));
  }
}

void check_line(const ObjectType& type, std::size_t index) {
  const ContinuousSymmetry& line = type.symmetries.continuous[index];
  const std::string place = fmt::format("{}.symmetries.continuous[{}]", place_of(type), index);
  const double length = line.axis.norm();
  if (!(std::abs(length - 1) < 1e-6)) {
    throw bad_input(place, fmt::format("the axis has the length {}; expected 1", length));
  }
  check_points({line.offset_m}, place);
}

}  // namespace

std::string place_of(const ObjectType& type) {
  return type.place.empty() ? type.name : type.place;
}

void check_type(const ObjectType& type) {
  if (type.name.empty()) throw bad_input(place_of(type), "a type without a name; give it one");
  if (type.mesh == nullptr) throw bad_input(place_of(type), "it has no mesh; every type needs one");
  for (std::size_t i = 0; i < type.symmetries.continuous.size(); ++i) check_line(type, i);
  for (std::size_t i = 0; i < type.features.size(); ++i) check_feature(type, i);
}

}  // namespace vantage::reconstruction::detail
