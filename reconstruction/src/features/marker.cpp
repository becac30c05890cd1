#include "vantage/reconstruction/marker.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

#include "features/opencv_aruco.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

auto known_dictionary(const std::string& name, const std::string& where) {
  const auto found = reconstruction::detail::aruco_dictionary(name);
  if (found) return *found;
  const bool is_newer = name.ends_with("ARUCO_MIP_36h12");
  throw bad_input(where, fmt::format("there is no marker dictionary '{}'{}; expected one of {}",
                                     name, is_newer ? " before OpenCV 4.8" : "",
                                     fmt::join(marker_dictionaries(), ", ")));
}

}  // namespace

std::array<Eigen::Vector3d, 4> Marker::corners() const {
  const double h = size_m / 2;
  return {T_object_marker * Eigen::Vector3d(-h, h, 0), T_object_marker * Eigen::Vector3d(h, h, 0),
          T_object_marker * Eigen::Vector3d(h, -h, 0),
          T_object_marker * Eigen::Vector3d(-h, -h, 0)};
}

std::vector<std::string> marker_dictionaries() {
  return reconstruction::detail::aruco_dictionary_names();
}

std::string marker_dictionary(std::string_view name) {
  return reconstruction::detail::canonical_dictionary(name);
}

std::string marker_family(std::string_view name) {
  const std::string dictionary = marker_dictionary(name);
  const bool sized =
      !dictionary.empty() && std::isdigit(static_cast<unsigned char>(dictionary.front())) != 0;
  return sized ? dictionary.substr(0, dictionary.find('_')) : dictionary;
}

int marker_count(const std::string& dictionary, const std::string& where) {
  return reconstruction::detail::marker_count(known_dictionary(dictionary, where));
}

MarkerCells marker_cells(const std::string& dictionary, int id, const std::string& where) {
  const auto found = known_dictionary(dictionary, where);
  const int count = reconstruction::detail::marker_count(found);
  if (id < 0 || id >= count) {
    throw bad_input(where, fmt::format("marker dictionary {} has no id {}; expected 0 to {}",
                                       dictionary, id, count - 1));
  }
  const cv::Mat drawn = reconstruction::detail::draw_cells(found, id);
  MarkerCells cells{drawn.rows, {}};
  for (int row = 0; row < drawn.rows; ++row) {
    for (int column = 0; column < drawn.cols; ++column) {
      cells.white.push_back(drawn.at<unsigned char>(row, column) > 127);
    }
  }
  return cells;
}

}  // namespace vantage
