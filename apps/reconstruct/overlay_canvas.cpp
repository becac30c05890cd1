#include "reconstruct/overlay_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vantage {
namespace {

constexpr int kOverlayFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kLetters = 0.5;
constexpr int kShift = 4;  // OpenCV's fixed point: sixteenths of a pixel
constexpr int kLineHeight = 22, kPageMargin = 10, kAbove = 8;
const cv::Scalar kBackground(250, 250, 249), kText(44, 48, 54);

cv::Scalar color(const Ink& ink) {
  return {double(ink.red), double(ink.green), double(ink.blue)};
}

/// Small photographs twice as large: lines of one pixel would hide what they mark.
double scale_for(int width) {
  return width >= 1200 ? 1 : 2;
}

}  // namespace

OverlayCanvas::OverlayCanvas(const ColorImage& photograph) : scale_(scale_for(photograph.width)) {
  const cv::Mat3b rgb(photograph.height, photograph.width,
                      reinterpret_cast<cv::Vec3b*>(
                          const_cast<std::uint8_t*>(photograph.samples.data())));  // only read
  cv::Mat3b large;
  cv::resize(rgb, large, {}, scale_, scale_, cv::INTER_CUBIC);
  picture_ = large * 0.75 + cv::Scalar(60, 60, 60);
}

cv::Point OverlayCanvas::fixed_point(const Eigen::Vector2d& p) const {
  // The centre of the photograph's pixel 0 is at scale/2 - 1/2 in the picture.
  const auto at = [&](double x) {
    const double clamped = std::clamp(scale_ * (x + 0.5) - 0.5, -1e4, 1e5);
    return int(std::lround(clamped * (1 << kShift)));
  };
  return {at(p.x()), at(p.y())};
}

void OverlayCanvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Ink& ink,
                         double width_px) {
  cv::line(picture_, fixed_point(from), fixed_point(to), color(ink), int(std::lround(width_px)),
           cv::LINE_AA, kShift);
}

void OverlayCanvas::ring(const Eigen::Vector2d& centre, double radius_px, const Ink& ink,
                         double width_px) {
  cv::circle(picture_, fixed_point(centre), int(std::lround(radius_px * (1 << kShift))), color(ink),
             int(std::lround(width_px)), cv::LINE_AA, kShift);
}

void OverlayCanvas::cross(const Eigen::Vector2d& centre, double radius_px, const Ink& ink,
                          double width_px) {
  const double r = radius_px / scale_;
  line(centre - Eigen::Vector2d(r, r), centre + Eigen::Vector2d(r, r), ink, width_px);
  line(centre - Eigen::Vector2d(r, -r), centre + Eigen::Vector2d(r, -r), ink, width_px);
}

void OverlayCanvas::tag(const Eigen::Vector2d& at, const std::string& text, const Ink& ink) {
  int below = 0;
  const cv::Size size = cv::getTextSize(text, kOverlayFont, kLetters, 1, &below);
  const cv::Point anchor(int(scale_ * at.x()), int(scale_ * at.y()));
  const int height = size.height + below + 8;
  cv::Rect box(anchor.x - size.width / 2 - 5, anchor.y - height - kAbove, size.width + 10, height);
  const cv::Rect all(0, 0, picture_.cols, picture_.rows);
  const auto fits = [&](const cv::Rect& place) {
    return (place & all) == place &&
           std::none_of(tags_.begin(), tags_.end(),
                        [&](const auto& other) { return (place & other).area() > 0; });
  };
  cv::Rect free = box;
  for (int step = 0; step < 60 && !fits(free); ++step) {  // up, down, farther up …
    const int away = (step / 2 + 1) * 8 * (step % 2 == 0 ? -1 : 1);
    free = box + cv::Point(0, away);
  }
  free &= all;
  if (free.empty()) return;
  tags_.push_back(free);
  const cv::Point middle(free.x + free.width / 2, free.y + free.height / 2);
  cv::line(picture_, anchor, middle, color(ink), 1, cv::LINE_AA);
  cv::rectangle(picture_, free, kBackground, cv::FILLED);
  cv::rectangle(picture_, free, color(ink), 1);
  cv::putText(picture_, text, {free.x + 5, free.y + 5 + size.height}, kOverlayFont, kLetters, kText,
              1, cv::LINE_AA);
}

ColorImage OverlayCanvas::finished(const std::vector<std::string>& explanations) const {
  const int strip = 2 * kPageMargin + kLineHeight * int(explanations.size());
  cv::Mat3b page(picture_.rows + strip, picture_.cols);
  page.setTo(kBackground);
  picture_.copyTo(page.rowRange(0, picture_.rows));
  for (std::size_t i = 0; i < explanations.size(); ++i) {
    const int y = picture_.rows + kPageMargin + kLineHeight * int(i + 1) - 6;
    cv::putText(page, explanations[i], {kPageMargin, y}, kOverlayFont, kLetters, kText, 1,
                cv::LINE_AA);
  }
  ColorImage image(page.cols, page.rows);
  std::copy_n(page.ptr<std::uint8_t>(), image.samples.size(), image.samples.begin());
  return image;
}

}  // namespace vantage
