#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "opencv_aruco.hpp"
#include "vantage/raycore/image.hpp"

namespace vantage::test {

struct DetectedMarker {
  int id = 0;
  std::array<cv::Point2f, 4> corners;  ///< in OpenCV's order; pixel centres at integers
};

using MarkerCorners = std::vector<cv::Point2f>;

inline double linear_light(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// Bilinear, and the image's edge goes on forever.
inline double light_at(const cv::Mat1f& light, cv::Point2d p) {
  const double u = std::clamp(p.x, 0.0, light.cols - 1.001);
  const double v = std::clamp(p.y, 0.0, light.rows - 1.001);
  const int column = int(u), row = int(v);
  const double s = u - column, t = v - row;
  return (1 - t) * ((1 - s) * light(row, column) + s * light(row, column + 1)) +
         t * ((1 - s) * light(row + 1, column) + s * light(row + 1, column + 1));
}

/// How far inside of `p` white turns to black: the mean of the fall of light, weighted by itself. A
/// blur does not move it. `fall` is all of the fall.
inline double edge_offset(const cv::Mat1f& light, cv::Point2d p, cv::Point2d inwards, double reach,
                          double& fall) {
  const double step = 0.125;
  double moment = 0;
  fall = 0;
  for (double d = -reach; d < reach; d += step) {
    const double here =
        light_at(light, p + d * inwards) - light_at(light, p + (d + step) * inwards);
    moment += here * (d + step / 2);
    fall += here;
  }
  return moment / fall;
}

/// The line of a marker's side, which lies close to a → b, with the marker at its right hand.
/// As cv::fitLine has it: direction, point.
inline cv::Vec4f side_line(const cv::Mat1f& light, cv::Point2d a, cv::Point2d b, double cell_px) {
  const cv::Point2d along = (b - a) / cv::norm(b - a), inwards(-along.y, along.x);
  std::vector<cv::Point2f> points;
  for (int k = 0; k <= 40; ++k) {
    const cv::Point2d p = a + (0.12 + 0.76 * k / 40) * (b - a);
    double fall = 0;
    // Within the white around the marker, which may be less than a cell and end at something dark.
    const double offset = edge_offset(light, p, inwards, std::clamp(0.4 * cell_px, 1.5, 4.0), fall);
    if (fall > 0.02 && std::abs(offset) < 4) points.emplace_back(p + offset * inwards);
  }
  if (points.size() < 10) return {float(along.x), float(along.y), float(a.x), float(a.y)};
  cv::Vec4f line;
  cv::fitLine(points, line, cv::DIST_HUBER, 0, 0.001, 0.001);
  return line;
}

inline cv::Point2f crossing(const cv::Vec4f& a, const cv::Vec4f& b) {
  const double turn = double(a[0]) * b[1] - double(a[1]) * b[0];
  const double t = ((double(b[2]) - a[2]) * b[1] - (double(b[3]) - a[3]) * b[0]) / turn;
  return {float(a[2] + t * a[0]), float(a[3] + t * a[1])};
}

/// Corners as the crossings of lines through the sides. OpenCV's own refinement, cornerSubPix, is
/// up to 0.4 px off at the corner of a square, even in a perfect image.
inline void refine_corners(const cv::Mat1f& light, int cells, MarkerCorners& corners) {
  for (int round = 0; round < 3; ++round) {
    const double area = std::abs(cv::contourArea(corners));
    std::array<cv::Vec4f, 4> lines;
    for (std::size_t i = 0; i < 4; ++i) {
      const cv::Point2d a = corners[i], b = corners[(i + 1) % 4];
      lines[i] = side_line(light, a, b, area / cv::norm(b - a) / cells);
    }
    for (std::size_t i = 0; i < 4; ++i) corners[i] = crossing(lines[(i + 3) % 4], lines[i]);
  }
}

/// What OpenCV finds in an sRGB image, sorted by id, corners refined to parts of a pixel. The
/// markers need white around them.
/// `dictionary` is a name as in `Marker`.
inline std::vector<DetectedMarker> detect_markers(const ColorImage& image,
                                                  const std::string& dictionary) {
  const auto found = detail::aruco_dictionary(dictionary);
  if (!found) throw std::invalid_argument("no marker dictionary " + dictionary);
  // OpenCV takes no pointer to const, and does not write to it.
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<unsigned char*>(image.samples.data()));
  cv::Mat1b grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  std::vector<int> ids;
  std::vector<MarkerCorners> corners;
  detail::detect_in_grey(grey, *found, ids, corners);

  cv::Mat1f light(grey.size());
  std::transform(grey.begin(), grey.end(), light.begin(),
                 [](unsigned char level) { return float(linear_light(level / 255.0)); });
  std::vector<DetectedMarker> markers(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    refine_corners(light, found->markerSize + 2, corners[i]);
    markers[i].id = ids[i];
    std::copy_n(corners[i].begin(), 4, markers[i].corners.begin());
  }
  std::stable_sort(markers.begin(), markers.end(),
                   [](const auto& a, const auto& b) { return a.id < b.id; });
  return markers;
}

}  // namespace vantage::test
