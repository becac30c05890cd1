#include "vantage/reconstruction/object_type.hpp"

#include <fmt/format.h>

namespace vantage {

FeatureKey marker_key(const std::string& dictionary, int id) {
  return {"aruco", fmt::format("{}/{}", marker_family(dictionary), id)};
}

ObjectFeature marker_feature(Marker marker) {
  FeatureKey key = marker_key(marker.dictionary, marker.id);
  return {std::move(key), std::move(marker)};
}

std::vector<Eigen::Vector3d> ObjectFeature::points() const {
  if (const auto* points = std::get_if<FeaturePoints>(&geometry)) return points->points_m;
  if (const auto* marker = std::get_if<Marker>(&geometry)) {
    const auto corners = marker->corners();
    return {corners.begin(), corners.end()};
  }
  return {};
}

std::vector<Marker> ObjectType::markers() const {
  std::vector<Marker> markers;
  for (const ObjectFeature& feature : features) {
    if (const auto* marker = std::get_if<Marker>(&feature.geometry)) markers.push_back(*marker);
  }
  return markers;
}

}  // namespace vantage
