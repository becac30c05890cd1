#include "workcell/board_pattern.hpp"

#include <fmt/format.h>

#include <string>

namespace vantage {
namespace {

/// Hands out the ids of a dictionary, and markers that lie flat.
class PatternMarkers {
 public:
  explicit PatternMarkers(const Value& value)
      : value_(value),
        dictionary_(marker_dictionary(value["dictionary"].as<std::string>())),
        count_(marker_count(dictionary_, value["dictionary"].place())),
        next_id_(value.get("first_id", 0)) {}

  Marker next(const Eigen::Vector2d& centre_m) {
    if (next_id_ >= count_) {
      throw value_["dictionary"].error(
          fmt::format("{} has {} markers, up to id {}; this board needs more", dictionary_, count_,
                      count_ - 1));
    }
    return {dictionary_, next_id_++, value_["marker_m"].as<double>(),
            Pose::from_translation({centre_m.x(), centre_m.y(), 0})};
  }

 private:
  const Value& value_;
  std::string dictionary_;
  int count_;
  int next_id_;
};

}  // namespace

BoardPattern read_charuco(const Value& value) {
  const int columns = value["columns"].as<int>(), rows = value["rows"].as<int>();
  const double square_m = value["square_m"].as<double>();
  if (!(value["marker_m"].as<double>() < square_m)) {
    throw value["marker_m"].error(fmt::format("found {}; expected less than square_m, {}",
                                              value["marker_m"].as<double>(), square_m));
  }
  const bool starts_white = value.get("legacy", false) && rows % 2 == 0;
  BoardPattern pattern{square_m * Eigen::Vector2d(columns, rows), {}};
  PatternMarkers markers(value);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const bool is_white = (row + column) % 2 == (starts_white ? 0 : 1);
      if (!is_white) continue;
      const Eigen::Vector2d centre((column + 0.5) * square_m - pattern.size_m.x() / 2,
                                   pattern.size_m.y() / 2 - (row + 0.5) * square_m);
      pattern.markers.push_back(markers.next(centre));
    }
  }
  return pattern;
}

BoardPattern read_grid(const Value& value) {
  const int columns = value["columns"].as<int>(), rows = value["rows"].as<int>();
  const double marker_m = value["marker_m"].as<double>(), gap_m = value["gap_m"].as<double>();
  const double step_m = marker_m + gap_m;
  // A gap of white around all of them, too: a marker needs it to be seen.
  BoardPattern pattern{{columns * step_m + gap_m, rows * step_m + gap_m}, {}};
  PatternMarkers markers(value);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d centre(step_m * (column - 0.5 * (columns - 1)),
                                   step_m * (0.5 * (rows - 1) - row));
      pattern.markers.push_back(markers.next(centre));
    }
  }
  return pattern;
}

}  // namespace vantage
