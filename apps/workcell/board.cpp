#include "workcell/board.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <map>

#include "documents/marker_reader.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/value_readers.hpp"
#include "documents/yaml_document.hpp"
#include "simulator/markers/marker_print.hpp"
#include "vantage/raycore/solids.hpp"
#include "workcell/board_pattern.hpp"
#include "workcell/object_appearance.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

Marker read_board_marker(const Value& value, const Value& dictionary) {
  check_marker(dictionary, value["id"]);
  const double turn = value.get("turn", 0.0);
  const Value at = value["at_m"];
  return {marker_dictionary(dictionary.as<std::string>()), value["id"].as<int>(),
          value["size_m"].as<double>(),
          Pose::from_rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                              {at.number(0), at.number(1), 0}, value.place())};
}

/// No marker may be there twice, nor on an object: a camera would not know which it sees.
class FreeMarkers {
 public:
  explicit FreeMarkers(const KnowledgeBase& knowledge) : knowledge_(knowledge) {}

  /// @param value where the marker stands, for messages.
  void take(const Marker& marker, const Value& value) {
    const FeatureKey key = marker_key(marker.dictionary, marker.id);
    const auto [first, is_new] = places_.try_emplace(key, value.place());
    if (!is_new) fail(marker, first->second, value);
    const auto& types = knowledge_.with_feature(key);
    if (!types.empty()) fail(marker, "the type " + types.front().type->name, value);
  }

 private:
  [[noreturn]] static void fail(const Marker& marker, const std::string& owner, const Value& id) {
    throw id.error(
        fmt::format("marker {} of {} is also that of {}; each marker may be on the board only once",
                    marker.id, marker.dictionary, owner));
  }

  const KnowledgeBase& knowledge_;
  std::map<FeatureKey, std::string> places_;
};

/// The one of its three ways to say where its markers are.
std::string layout_of(const Value& value) {
  std::vector<std::string> given;
  for (const char* key : {"markers", "charuco", "grid"}) {
    if (value.has(key)) given.emplace_back(key);
  }
  if (given.size() == 1) return given.front();
  throw value.error(fmt::format("found {} of the keys markers, charuco and grid; expected one",
                                given.empty() ? "none" : std::to_string(given.size())));
}

/// Most often a slip of the decimal point, with which every camera would be somewhere else.
void check_on_plate(const Marker& marker, const Eigen::Vector2d& size_m, const Value& value) {
  const Eigen::Vector2d at = marker.T_object_marker.translation().head<2>();
  if ((at.array().abs() > size_m.array() / 2).any()) {
    throw value["at_m"].error(
        fmt::format("marker {} is at ({}, {}) m, beside the board of {} x {} m around (0, 0)",
                    marker.id, at.x(), at.y(), size_m.x(), size_m.y()));
  }
  if (marker.size_m <= size_m.minCoeff()) return;
  throw value["size_m"].error(
      fmt::format("marker {} is {} m wide, more than the board of {} x {} m", marker.id,
                  marker.size_m, size_m.x(), size_m.y()));
}

void read_listed_markers(const Value& value, Board& board, FreeMarkers& free) {
  for (const char* key : {"size_m", "dictionary"}) {
    if (!value.has(key)) {
      throw value.error(
          fmt::format("the key \"{}\" is missing; a board with markers needs it", key));
    }
  }
  const Eigen::Vector2d size_m(value["size_m"].number(0), value["size_m"].number(1));
  for (const Value& element : value["markers"].elements()) {
    board.markers.push_back(read_board_marker(element, value["dictionary"]));
    check_on_plate(board.markers.back(), size_m, element);
    free.take(board.markers.back(), element["id"]);
  }
}

Board read_mapping(const Value& value, const KnowledgeBase& knowledge) {
  Board board{.place = value.place(), .size_m = Eigen::Vector2d::Zero()};
  board.thickness_m = value.get("thickness_m", board.thickness_m);
  if (value.has("color")) board.color = read_color(value["color"]);
  FreeMarkers free(knowledge);
  const std::string layout = layout_of(value);
  if (layout == "markers") {
    read_listed_markers(value, board, free);
  } else {
    if (value.has("dictionary")) {
      throw value["dictionary"].error(
          fmt::format("this key does not belong here; {} has its own", layout));
    }
    const Value pattern = value[layout.c_str()];
    BoardPattern found = layout == "charuco" ? read_charuco(pattern) : read_grid(pattern);
    board.size_m = found.size_m, board.markers = std::move(found.markers);
    for (const Marker& marker : board.markers) free.take(marker, pattern);
  }
  if (!value.has("size_m")) return board;
  const Eigen::Vector2d size_m(value["size_m"].number(0), value["size_m"].number(1));
  if ((size_m.array() < board.size_m.array() - 1e-9).any()) {
    throw value["size_m"].error(fmt::format("found {} x {} m, less than the {} of {} x {} m on it",
                                            size_m.x(), size_m.y(), layout, board.size_m.x(),
                                            board.size_m.y()));
  }
  board.size_m = size_m;
  return board;
}

/// What describes a board in a file of its own.
nlohmann::json board_schema() {
  return {{"definitions", workcell_schema()["definitions"]}, {"$ref", "#/definitions/board"}};
}

}  // namespace

Board read_board(const Value& value, const KnowledgeBase& knowledge, const fs::path& folder,
                 std::vector<fs::path>& files) {
  if (!value.is_string()) return read_mapping(value, knowledge);
  const Document document = read_yaml(named_file(value, folder, files));
  check_schema(document, board_schema());
  if (document.root.is_string()) throw bad_input(document.place(""), "expected a board's keys");
  return read_mapping(Value(document), knowledge);
}

std::vector<ObjectFeature> Board::features() const {
  std::vector<ObjectFeature> features;
  for (const Marker& marker : markers) features.push_back(marker_feature(marker));
  return features;
}

TexturedMesh board_shape(const Board& board) {
  const Eigen::Vector3d size_m(board.size_m.x(), board.size_m.y(), board.thickness_m);
  const Pose to_top = Pose::from_translation({0, 0, -0.5 * board.thickness_m});
  const TriangleMesh plate = box_solid(size_m).transformed(to_top);
  return with_markers(plate, board.color, board.markers, board.place, texel_for(board.markers));
}

}  // namespace vantage
