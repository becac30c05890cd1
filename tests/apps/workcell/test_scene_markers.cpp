// The shipped scenes' photographs serve for what they are made for: OpenCV finds their markers.
#include <doctest/doctest.h>

#include <map>
#include <string>
#include <vector>

#include "simulator/color/color_sensor.hpp"
#include "support/marker_tally.hpp"
#include "support/scene_count.hpp"
#include "workcell/simulated_cell.hpp"

#include "apps/cell_files.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

struct PlacedMarker {
  Marker marker;
  Pose T_world_object;
};

/// All markers of the cell by their dictionary. Types are there once for each instance.
std::map<std::string, std::vector<PlacedMarker>> markers_of(const Workcell& cell) {
  std::map<std::string, std::vector<PlacedMarker>> markers;
  for (const Marker& marker : cell.board->markers) {
    markers[marker.dictionary].push_back({marker, {}});
  }
  for (const PlacedObject& object : cell.known_objects) {
    for (const Marker& marker : object.type->markers()) {
      markers[marker.dictionary].push_back({marker, object.T_world_object});
    }
  }
  return markers;
}

/// Looks for all markers of a scene in the pictures of its cameras.
void photograph(const std::string& name, MarkerTally& tally) {
  CAPTURE(name);
  Workcell cell = load_workcell(shipped_workcell(name));
  place_random_objects(cell);
  const SimulatedCell simulated = simulated_cell(cell);
  const auto markers = markers_of(cell);
  for (std::size_t i = 0; i < cell.cameras.size(); ++i) {
    CAPTURE(cell.cameras[i].name);
    const PinholeCamera& camera = cell.cameras[i].camera;
    const ColorImage image = *simulate_color(simulated.scene, {}, camera, {}, i);
    for (const auto& [dictionary, placed] : markers) {
      const auto found = detect_markers(image, dictionary);
      for (const PlacedMarker& p : placed) {
        tally.look_for(p.marker, p.T_world_object, simulated.scene.rays(), camera, found);
      }
    }
  }
}

}  // namespace

TEST_CASE("OpenCV finds the markers of the shipped scenes, corners within half a pixel" *
          doctest::test_suite("slow")) {
  MarkerTally tally;
  for (const char* name : {"wall", "corridor", "two_pillars", "foreign_objects", "castle",
                           "clutter", "bin", "duck", "workcell"}) {
    photograph(name, tally);
    if (!kAllScenes) break;
  }
  CHECK(tally.expected > (kAllScenes ? 250 : 10));
  MESSAGE(tally.summary());
}

}  // namespace vantage::test
