#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vantage/raycore/image.hpp"

namespace vantage {

/// sRGB.
struct Ink {
  int red = 0, green = 0, blue = 0;
};

/// A photograph, paled and enlarged, to draw on. Coordinates are the photograph's pixels.
class OverlayCanvas {
 public:
  explicit OverlayCanvas(const ColorImage& photograph);

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Ink& ink,
            double width_px);
  /// `radius_px` and the ring's width are in the picture's pixels, not the photograph's.
  void ring(const Eigen::Vector2d& centre, double radius_px, const Ink& ink, double width_px);
  void cross(const Eigen::Vector2d& centre, double radius_px, const Ink& ink, double width_px);

  /// A name tag above `at` or near it, at a place that no other tag has, with a line to it.
  void tag(const Eigen::Vector2d& at, const std::string& text, const Ink& ink);

  /// The picture with a strip below it for explanations, as many lines as there are.
  ColorImage finished(const std::vector<std::string>& explanations) const;

 private:
  cv::Point fixed_point(const Eigen::Vector2d& p) const;

  double scale_;
  cv::Mat3b picture_;
  std::vector<cv::Rect> tags_;
};

}  // namespace vantage
