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

/// OpenCV's names without the prefix `DICT_`.
std::vector<std::string> aruco_dictionary_names();

/// "4X4_50" for "DICT_4X4_50", "APRILTAG_36h11" for "tag36h11", in upper or lower case. Other names
/// are returned unchanged.
std::string canonical_dictionary(std::string_view name);

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

/// What counts as black, and as a quadrangle.
struct OutlineOptions {
  double darker;  ///< codes of grey by which black is darker than its surroundings
  double stray;   ///< how far an outline may stray from a quadrangle, as a part of its length
};

/// OpenCV's own.
inline constexpr OutlineOptions kUsualOutlines = {7, 0.03};
/// With the usual ones white paper in the shade before a bright table is black, too, and markers
/// grow together with it. With these, markers in faint light are missed.
inline constexpr OutlineOptions kStrictOutlines = {15, 0.02};

/// The markers of this dictionary in an 8-bit grey image: ids, and four corners for each, unrefined
/// (a pixel off, or so). Appended to what is there.
inline void detect_in_grey(const cv::Mat& grey, const cv::aruco::Dictionary& dictionary,
                           const OutlineOptions& options, std::vector<int>& ids,
                           std::vector<std::vector<cv::Point2f>>& corners) {
  std::vector<int> found_ids;
  std::vector<std::vector<cv::Point2f>> found_corners;
#if VANTAGE_ARUCO_IN_OBJDETECT
  cv::aruco::DetectorParameters parameters;
  parameters.adaptiveThreshConstant = options.darker;
  parameters.polygonalApproxAccuracyRate = options.stray;
  cv::aruco::ArucoDetector(dictionary, parameters).detectMarkers(grey, found_corners, found_ids);
#else
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->adaptiveThreshConstant = options.darker;
  parameters->polygonalApproxAccuracyRate = options.stray;
  cv::aruco::detectMarkers(grey, cv::makePtr<cv::aruco::Dictionary>(dictionary), found_corners,
                           found_ids, parameters);
#endif
  ids.insert(ids.end(), found_ids.begin(), found_ids.end());
  corners.insert(corners.end(), found_corners.begin(), found_corners.end());
}

}  // namespace vantage::reconstruction::detail
