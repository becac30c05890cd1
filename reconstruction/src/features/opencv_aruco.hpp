#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Private: what differs between the OpenCV of Debian 12 (4.6, contrib module `aruco`) and of
// Debian 13 (4.10, `objdetect`). Nothing else asks for OpenCV's version.
#include <opencv2/core/version.hpp>
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
#define VANTAGE_ARUCO_IN_OBJDETECT 1
#include <opencv2/objdetect/aruco_detector.hpp>
#else
#define VANTAGE_ARUCO_IN_OBJDETECT 0
#include <opencv2/aruco.hpp>
#endif

namespace vantage::reconstruction::detail {

/// OpenCV's names without the prefix `DICT_`: those that both versions have.
std::vector<std::string> aruco_dictionary_names();

/// Nothing for another name.
std::optional<cv::aruco::Dictionary> aruco_dictionary(std::string_view name);

inline int marker_count(const cv::aruco::Dictionary& dictionary) {
  return dictionary.bytesList.rows;
}

inline cv::aruco::Dictionary predefined_dictionary(int type) {
#if VANTAGE_ARUCO_IN_OBJDETECT
  return cv::aruco::getPredefinedDictionary(type);
#else
  return *cv::aruco::getPredefinedDictionary(type);
#endif
}

/// A marker with a black border of one cell, one byte for each cell: 0 or 255.
inline cv::Mat draw_cells(const cv::aruco::Dictionary& dictionary, int id) {
  const int side = dictionary.markerSize + 2;
  cv::Mat cells;
#if VANTAGE_ARUCO_IN_OBJDETECT
  dictionary.generateImageMarker(id, side, cells, 1);
#else
  dictionary.drawMarker(id, side, cells, 1);
#endif
  return cells;
}

/// The markers of this dictionary in an 8-bit grey image: ids, and four corners for each, unrefined
/// (a pixel off, or so). Black is what is 15 codes darker than its surroundings: with OpenCV's 7,
/// white paper in the shade before a bright table is black too, and markers grow together with it.
/// Outlines stray from a quadrangle by 2 % of their length at most, not OpenCV's 3 %.
inline void detect_in_grey(const cv::Mat& grey, const cv::aruco::Dictionary& dictionary,
                           std::vector<int>& ids, std::vector<std::vector<cv::Point2f>>& corners) {
  constexpr double kDarker = 15, kStray = 0.02;
#if VANTAGE_ARUCO_IN_OBJDETECT
  cv::aruco::DetectorParameters parameters;
  parameters.adaptiveThreshConstant = kDarker;
  parameters.polygonalApproxAccuracyRate = kStray;
  cv::aruco::ArucoDetector(dictionary, parameters).detectMarkers(grey, corners, ids);
#else
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->adaptiveThreshConstant = kDarker;
  parameters->polygonalApproxAccuracyRate = kStray;
  cv::aruco::detectMarkers(grey, cv::makePtr<cv::aruco::Dictionary>(dictionary), corners, ids,
                           parameters);
#endif
}

}  // namespace vantage::reconstruction::detail
