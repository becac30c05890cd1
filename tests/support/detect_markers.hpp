#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/opencv_aruco.hpp"
#include "vantage/raycore/image.hpp"

namespace vantage::test {

struct DetectedMarker {
  int id = 0;
  std::array<cv::Point2f, 4> corners;  ///< in OpenCV's order; pixel centres at integers
};

/// Moves the corners to where the gradients around them say that they are. The window grows with
/// the marker's cells and stays within one, which neither version of OpenCV does by itself.
inline void refine_corners(const cv::Mat& grey, int cells, std::vector<cv::Point2f>& corners) {
  const double cell_px = std::sqrt(std::abs(cv::contourArea(corners))) / cells;
  const int reach = std::clamp(int(std::lround(0.45 * cell_px)), 2, 5);
  cv::cornerSubPix(grey, corners, {reach, reach}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 0.005});
}

/// What OpenCV finds in an image, sorted by id, corners refined to parts of a pixel.
/// `dictionary` is a name as in `Marker`.
inline std::vector<DetectedMarker> detect_markers(const ColorImage& image,
                                                  const std::string& dictionary) {
  const auto found = detail::aruco_dictionary(dictionary);
  if (!found) throw std::invalid_argument("no marker dictionary " + dictionary);
  // OpenCV takes no pointer to const, and does not write to it.
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<unsigned char*>(image.samples.data()));
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  std::vector<int> ids;
  std::vector<std::vector<cv::Point2f>> corners;
  detail::detect_in_grey(grey, *found, ids, corners);

  std::vector<DetectedMarker> markers(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    refine_corners(grey, found->markerSize + 2, corners[i]);
    markers[i].id = ids[i];
    std::copy_n(corners[i].begin(), 4, markers[i].corners.begin());
  }
  std::stable_sort(markers.begin(), markers.end(),
                   [](const auto& a, const auto& b) { return a.id < b.id; });
  return markers;
}

}  // namespace vantage::test
