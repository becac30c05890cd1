#include "workcell/marker_dictionaries.hpp"

#include <doctest/doctest.h>

#include "vantage/raycore/solids.hpp"

namespace vantage::test {

TEST_CASE("of each family of markers the largest dictionary is looked for") {
  ObjectType type{"box"};
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.1, 0.1, 0.1}));
  for (const Marker& marker : {Marker{"4X4_50", 1, 0.03, {}}, Marker{"6X6_250", 2, 0.03, {}},
                               Marker{"APRILTAG_36h11", 3, 0.03, {}}}) {
    type.features.push_back(marker_feature(marker));
  }
  Workcell cell{.work_area = Box({0, 0, 0}, {1, 1, 1})};
  CHECK(dictionaries_of(cell).empty());
  cell.knowledge = std::make_shared<const MemoryKnowledgeBase>(std::vector{type});
  CHECK(dictionaries_of(cell) == std::vector<std::string>{"4X4_50", "6X6_250", "APRILTAG_36h11"});
  cell.board = Board{"board", {1, 1}};
  cell.board->markers = {{"4X4_1000", 700, 0.03, {}}, {"6X6_100", 4, 0.03, {}}};
  CHECK(dictionaries_of(cell) == std::vector<std::string>{"4X4_1000", "6X6_250", "APRILTAG_36h11"});
}

}  // namespace vantage::test
