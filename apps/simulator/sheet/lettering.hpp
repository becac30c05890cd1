#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace vantage {

/// Text of a height that is given by that of its capital letters. OpenCV's fonts have ASCII alone,
/// and show "?" for anything else.
struct Lettering {
  int font;
  double scale;
  int thickness, capital_px;

  explicit Lettering(double px, int the_font = cv::FONT_HERSHEY_DUPLEX)
      : font(the_font),
        scale(cv::getFontScaleFromHeight(font, int(std::lround(px)))),
        thickness(std::max(1, int(px / 15))),
        capital_px(int(std::lround(px))) {}

  int width(const std::string& text) const {
    int baseline = 0;
    return cv::getTextSize(text, font, scale, thickness, &baseline).width;
  }

  /// The text, or as much of it as fits, and dots.
  std::string fitted(std::string text, int room) const {
    if (width(text) <= room) return text;
    while (!text.empty() && width(text + "...") > room) text.pop_back();
    return text + "...";
  }

  void write(cv::Mat3b sheet, const std::string& text, cv::Point top_left, int room,
             const cv::Scalar& ink) const {
    cv::putText(sheet, fitted(text, room), top_left + cv::Point(0, capital_px), font, scale, ink,
                thickness, cv::LINE_AA);
  }
};

}  // namespace vantage
