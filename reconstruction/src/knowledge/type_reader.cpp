#include "knowledge/type_reader.hpp"

#include <fmt/format.h>

#include <optional>

#include "documents/marker_reader.hpp"
#include "documents/shape_reader.hpp"
#include "documents/value_readers.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

Symmetries read_symmetries(const Value& value) {
  Symmetries symmetries;
  if (value.has("discrete")) {
    for (const Value& turn : value["discrete"].elements()) {
      symmetries.discrete.push_back(
          turn.has("rotation") ? read_pose(turn)
                               : Pose::from_quaternion(read_quaternion(turn),
                                                       Eigen::Vector3d::Zero(), turn.place()));
    }
  }
  if (value.has("continuous")) {
    for (const Value& line : value["continuous"].elements()) {
      const Eigen::Vector3d axis = line["axis"].vector();
      if (axis.norm() < 1e-6) throw line["axis"].error("found no direction; expected an axis");
      ContinuousSymmetry symmetry{axis.normalized()};
      if (line.has("offset_m")) symmetry.offset_m = line["offset_m"].vector();
      symmetries.continuous.push_back(symmetry);
    }
  }
  return symmetries;
}

std::vector<Eigen::Vector3d> read_points(const Value& value) {
  std::vector<Eigen::Vector3d> points;
  for (const Value& point : value.elements()) points.push_back(point.vector());
  return points;
}

/// What is no marker: its keys say which it is.
ObjectFeature read_feature(const Value& value) {
  ObjectFeature feature{{value["type"].as<std::string>(), value["value"].as<std::string>()},
                        FeatureLabel{}};
  if (value.has("points_m")) {
    feature.geometry = FeaturePoints{read_points(value["points_m"])};
  } else if (value.has("pose")) {
    feature.geometry = FeaturePose{read_pose(value["pose"])};
  } else if (value.has("near_m")) {
    feature.geometry = FeatureLabel{read_points(value["near_m"]), value["radius_m"].as<double>()};
  }
  return feature;
}

}  // namespace

ObjectType TypeReader::read(const Value& value, const std::filesystem::path& folder) {
  ObjectType type{.name = value["name"].as<std::string>()};
  type.place = value.place();
  type.is_a = value.get("is_a", type.is_a);
  type.mesh = std::make_shared<const TriangleMesh>(
      value.has("mesh") ? read_mesh_value(value["mesh"], folder, files_)
                        : read_shape(value["shape"], folder, files_));
  if (value.has("color")) type.color = read_color(value["color"]);
  if (value.has("symmetries")) type.symmetries = read_symmetries(value["symmetries"]);
  if (value.has("features")) type.features = read_features(value);
  return type;
}

std::vector<ObjectFeature> TypeReader::read_features(const Value& type) {
  std::optional<Eigen::Vector3d> box_size_m;
  if (type.has("shape") && type["shape"].has("box"))
    box_size_m = type["shape"]["box"]["size_m"].vector();
  std::vector<ObjectFeature> features;
  for (const Value& value : type["features"].elements()) {
    if (value["type"].as<std::string>() != "aruco") {
      features.push_back(read_feature(value));
      continue;
    }
    const Marker marker = read_marker(value, box_size_m);
    take_dictionary(marker, value["dictionary"]);
    features.push_back(marker_feature(marker));
  }
  return features;
}

void TypeReader::take_dictionary(const Marker& marker, const Value& value) {
  const auto [first, is_new] = dictionaries_.try_emplace(
      marker_key(marker.dictionary, marker.id), std::pair{marker.dictionary, value.place()});
  const auto& [name, place] = first->second;
  if (is_new || name == marker.dictionary) return;
  throw value.error(
      fmt::format("marker {0} of {1} is marker {0} of {2}, which {3} names; write "
                  "both with one dictionary name",
                  marker.id, marker.dictionary, name, place));
}

}  // namespace vantage::reconstruction::detail
