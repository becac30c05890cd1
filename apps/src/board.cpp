#include "board.hpp"

#include <fmt/format.h>

#include <cmath>

#include "marker_reader.hpp"
#include "schema_check.hpp"
#include "schemas.hpp"
#include "simulator/solids.hpp"
#include "value_readers.hpp"
#include "yaml_document.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance = 1e-9;  // of lengths that touch in decimal, but not in binary

/// The axes of a marker's edges and their signs, for the test of whether two squares overlap.
Eigen::Matrix2d edges_of(const Marker& marker) {
  return marker.T_object_marker.rotation().topLeftCorner<2, 2>();
}

/// Half of how far the square reaches along a direction.
double reach_along(const Marker& marker, const Eigen::Vector2d& direction) {
  return 0.5 * marker.size_m * (edges_of(marker).transpose() * direction).lpNorm<1>();
}

/// Two squares are apart if they are along one of their edges (separating axes).
bool overlap(const Marker& a, const Marker& b) {
  const Eigen::Vector2d apart =
      (b.T_object_marker.translation() - a.T_object_marker.translation()).head<2>();
  for (const Marker* of : {&a, &b}) {
    for (int edge = 0; edge < 2; ++edge) {
      const Eigen::Vector2d axis = edges_of(*of).col(edge);
      const double reach = reach_along(a, axis) + reach_along(b, axis);
      if (std::abs(apart.dot(axis)) > reach - kTolerance) return false;
    }
  }
  return true;
}

Marker read_board_marker(const Value& value, const Value& dictionary) {
  check_marker(dictionary, value["id"]);
  const double turn = value.get("turn", 0.0);
  const Value at = value["at_m"];
  return {dictionary.as<std::string>(), value["id"].as<int>(), value["size_m"].as<double>(),
          Pose::from_rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                              {at.number(0), at.number(1), 0}, value.place())};
}

/// @throws Error bad_input unless the marker is on the board, and on no other marker.
void check_room(const Board& board, const Marker& marker, const Value& value) {
  for (int axis = 0; axis < 2; ++axis) {
    const double end = std::abs(marker.T_object_marker.translation()[axis]) +
                       reach_along(marker, Eigen::Vector2d::Unit(axis));
    if (end > 0.5 * board.size_m[axis] + kTolerance) {
      throw value["at_m"].error(
          fmt::format("marker {} ends {} m from the middle, but the board {} m", marker.id, end,
                      0.5 * board.size_m[axis]));
    }
  }
  for (const Marker& other : board.markers) {
    if (!overlap(marker, other)) continue;
    throw value["at_m"].error(fmt::format("marker {} lies on marker {}", marker.id, other.id));
  }
}

Board read_mapping(const Value& value, MarkerOwners& owners) {
  Board board{.size_m = {value["size_m"].number(0), value["size_m"].number(1)}};
  board.thickness_m = value.get("thickness_m", board.thickness_m);
  if (value.has("color")) board.color = read_color(value["color"]);
  for (const Value& element : value["markers"].elements()) {
    const Marker marker = read_board_marker(element, value["dictionary"]);
    owners.take(marker, element.place(), element["id"].place());
    check_room(board, marker, element);
    board.markers.push_back(marker);
  }
  return board;
}

/// What describes a board in a file of its own.
nlohmann::json board_schema() {
  return {{"definitions", workcell_schema()["definitions"]}, {"$ref", "#/definitions/board"}};
}

}  // namespace

Board read_board(const Value& value, const KnowledgeBase& knowledge, const fs::path& folder,
                 std::vector<fs::path>& files) {
  MarkerOwners owners;
  for (const auto& type : knowledge.types()) {
    for (const Marker& marker : type->markers) owners.take(marker, "the type " + type->name, "");
  }
  if (!value.is_string()) return read_mapping(value, owners);
  const Document document = read_yaml(named_file(value, folder, files));
  check_schema(document, board_schema());
  if (document.root.is_string()) throw bad_input(document.place(""), "expected a board's keys");
  return read_mapping(Value(document), owners);
}

TexturedMesh board_shape(const Board& board) {
  const Eigen::Vector3d size_m(board.size_m.x(), board.size_m.y(), board.thickness_m);
  const Pose to_top = Pose::from_translation({0, 0, -0.5 * board.thickness_m});
  const TriangleMesh plate = box_solid(size_m).transformed(to_top);
  return with_markers(plate, board.color, board.markers, "board");
}

}  // namespace vantage
