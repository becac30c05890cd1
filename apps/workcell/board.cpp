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
#include "workcell/object_appearance.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

Marker read_board_marker(const Value& value, const Value& dictionary) {
  check_marker(dictionary, value["id"]);
  const double turn = value.get("turn", 0.0);
  const Value at = value["at_m"];
  return {dictionary.as<std::string>(), value["id"].as<int>(), value["size_m"].as<double>(),
          Pose::from_rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                              {at.number(0), at.number(1), 0}, value.place())};
}

/// No marker may be there twice, nor on an object: a camera would not know which it sees.
class FreeMarkers {
 public:
  explicit FreeMarkers(const KnowledgeBase& knowledge) : knowledge_(knowledge) {}

  void take(const Marker& marker, const Value& value) {
    const FeatureKey key = marker_key(marker.dictionary, marker.id);
    const auto [first, is_new] = places_.try_emplace(key, value.place());
    if (!is_new) fail(marker, first->second, value["id"]);
    const auto& types = knowledge_.with_feature(key);
    if (!types.empty()) fail(marker, "the type " + types.front().type->name, value["id"]);
  }

 private:
  [[noreturn]] static void fail(const Marker& marker, const std::string& owner, const Value& id) {
    throw id.error(
        fmt::format("marker {} of {} is that of {}; each of the board's may be there "
                    "once only",
                    marker.id, marker.dictionary, owner));
  }

  const KnowledgeBase& knowledge_;
  std::map<FeatureKey, std::string> places_;
};

Board read_mapping(const Value& value, const KnowledgeBase& knowledge) {
  Board board{.place = value.place(),
              .size_m = {value["size_m"].number(0), value["size_m"].number(1)}};
  board.thickness_m = value.get("thickness_m", board.thickness_m);
  if (value.has("color")) board.color = read_color(value["color"]);
  FreeMarkers free(knowledge);
  for (const Value& element : value["markers"].elements()) {
    board.markers.push_back(read_board_marker(element, value["dictionary"]));
    free.take(board.markers.back(), element);
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
