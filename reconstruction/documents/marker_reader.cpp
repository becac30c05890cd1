#include "documents/marker_reader.hpp"

#include "documents/value_readers.hpp"

namespace vantage {
namespace {

/// The middle of a box's face, "+x" to "-z". Markers on the sides stand upright; those on top and
/// underneath have their x axis along the box's: turned around y from one another.
Pose face_pose(const std::string& face, const Eigen::Vector3d& size_m) {
  const int axis = face[1] - 'x';
  const Eigen::Vector3d out = (face[0] == '-' ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis);
  const Eigen::Vector3d up = axis == 2 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d rotation;
  rotation << up.cross(out), up, out;
  return Pose::from_rotation(rotation, 0.5 * size_m.cwiseProduct(out), "face");
}

}  // namespace

void check_marker(const Value& dictionary, const Value& id) {
  const std::string name = dictionary.as<std::string>();
  marker_cells(name, 0, dictionary.place());  // every dictionary has a marker 0
  marker_cells(name, id.as<int>(), id.place());
}

Marker read_marker(const Value& feature, const std::optional<Eigen::Vector3d>& box_size_m) {
  check_marker(feature["dictionary"], feature["value"]);
  Marker marker{marker_dictionary(feature["dictionary"].as<std::string>()),
                feature["value"].as<int>(),
                feature["size_m"].as<double>(),
                {}};
  if (feature.has("pose")) {
    marker.T_object_marker = read_pose(feature["pose"]);
  } else if (box_size_m) {
    marker.T_object_marker = face_pose(feature["face"].as<std::string>(), *box_size_m);
  } else {
    throw feature["face"].error("only a box has faces; give the marker's pose instead");
  }
  return marker;
}

}  // namespace vantage
