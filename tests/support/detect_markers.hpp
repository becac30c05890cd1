#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "vantage/reconstruction/detector.hpp"

namespace vantage::test {

struct DetectedMarker {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners;  ///< in OpenCV's order; pixel centres at integers
  double sigma_px = 0;
};

/// What the library's detector finds with one dictionary, by id, which is left of the keys.
inline std::vector<DetectedMarker> detect_markers(const ColorImage& image,
                                                  const std::string& dictionary) {
  std::vector<DetectedMarker> markers;
  for (const Observation& seen : ArucoDetector({{dictionary}, {}}).detect(image)) {
    const SeenPoints& points = std::get<SeenPoints>(seen.data);
    DetectedMarker marker;
    marker.id = std::stoi(seen.key.value.substr(seen.key.value.find('/') + 1));
    for (std::size_t i = 0; i < 4; ++i) marker.corners[i] = points.pixels.at(i);
    marker.sigma_px = points.sigma_px;
    markers.push_back(marker);
  }
  std::stable_sort(markers.begin(), markers.end(),
                   [](const auto& a, const auto& b) { return a.id < b.id; });
  return markers;
}

}  // namespace vantage::test
