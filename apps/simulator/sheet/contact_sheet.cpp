#include "simulator/sheet/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "simulator/scene/srgb.hpp"
#include "simulator/sheet/lettering.hpp"
#include "simulator/sheet/sheet_layout.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

const cv::Scalar kPaper(250, 250, 249), kHeadingInk(44, 48, 54), kCaptionInk(112, 117, 124);
const cv::Scalar kLine(222, 223, 225), kPlace(238, 239, 240);

void check(const char* what, int value, int low, int high) {
  if (value >= low && value <= high) return;
  throw bad_input("contact sheet",
                  fmt::format("{} is {}; expected {} to {}", what, value, low, high));
}

void check(std::span<const LabelledPicture> pictures, const ContactSheetOptions& options) {
  check("columns", options.columns, 1, 64);
  check("cell_width", options.cell_width, 40, 4096);
  check("gap", options.gap, 0, 1000);
  check("margin", options.margin, 0, 1000);
  if (pictures.empty()) throw bad_input("contact sheet", "no pictures; expected at least one");
  for (const LabelledPicture& p : pictures) {
    if (p.image.width > 0 && p.image.height > 0) continue;
    throw bad_input("contact sheet", fmt::format("the picture of scene {}, camera {} has no pixels",
                                                 p.scene, p.camera));
  }
}

/// Averaged in linear light, as a lens would do it.
cv::Mat3b thumbnail(const ColorImage& image, cv::Size place) {
  const double scale =
      std::min(double(place.width) / image.width, double(place.height) / image.height);
  const cv::Size size(std::max(1, int(std::lround(scale * image.width))),
                      std::max(1, int(std::lround(scale * image.height))));
  const std::array<float, 256> linear = srgb8_to_linear();
  cv::Mat3f light(image.height, image.width);
  std::transform(image.samples.begin(), image.samples.end(), light.ptr<float>(),
                 [&](std::uint8_t code) { return linear[code]; });
  cv::resize(light, light, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::Mat3b result(size);
  std::transform(light.ptr<float>(), light.ptr<float>() + light.total() * 3,
                 result.ptr<std::uint8_t>(), &linear_to_srgb8);
  return result;
}

/// From cells to pixels.
class Sheet {
 public:
  Sheet(std::span<const LabelledPicture> pictures, const ContactSheetOptions& options)
      : pictures_(pictures),
        options_(options),
        layout_(layout_sheet(pictures, options.columns)),
        place_(options.cell_width, options.cell_width * 3 / 4),
        heading_(std::max(9.0, options.cell_width * 0.058)),
        caption_(std::max(7.0, options.cell_width * 0.040)) {
    const int columns = layout_.columns;
    starts_block_.assign(std::size_t(layout_.rows), false);
    for (const SheetBlock& block : layout_.blocks) starts_block_[std::size_t(block.row)] = true;
    int y = options.margin;
    for (std::size_t row = 0; row < starts_block_.size(); ++row) {
      if (starts_block_[row]) y += (row > 0 ? heading_.capital_px * 5 / 2 : 0) + heading_height();
      top_.push_back(y);
      y += place_.height + caption_height() + options.gap / 2;
    }
    const int width = 2 * options.margin + columns * place_.width + (columns - 1) * options.gap;
    canvas_ = cv::Mat3b(y + options.margin - options.gap / 2, width);
    canvas_.setTo(kPaper);
  }

  ColorImage draw() {
    for (const SheetBlock& block : layout_.blocks) draw(block);
    ColorImage image(canvas_.cols, canvas_.rows);
    std::copy_n(canvas_.ptr<std::uint8_t>(), image.samples.size(), image.samples.begin());
    return image;
  }

 private:
  int heading_height() const { return heading_.capital_px * 5 / 2; }
  int caption_height() const { return caption_.capital_px * 5 / 2; }

  cv::Point cell(int row, int column) const {
    return {options_.margin + column * (place_.width + options_.gap), top_[std::size_t(row)]};
  }

  void draw(const SheetBlock& block) {
    const int width = block.width(options_.columns);
    const int room = width * place_.width + (width - 1) * options_.gap;
    const cv::Point top = cell(block.row, block.column) - cv::Point(0, heading_height());
    heading_.write(canvas_, block.scene, top, room, kHeadingInk);
    const cv::Point line = top + cv::Point(0, heading_.capital_px * 7 / 4);
    cv::line(canvas_, line, line + cv::Point(room - 1, 0), kLine);
    for (std::size_t i = 0; i < block.pictures.size(); ++i) {
      const int row = block.row + int(i) / options_.columns;
      const int column = block.column + int(i) % options_.columns;
      draw(pictures_[block.pictures[i]], cell(row, column));
    }
  }

  void draw(const LabelledPicture& picture, cv::Point at) {
    const cv::Mat3b small = thumbnail(picture.image, place_);
    canvas_(cv::Rect(at, place_)).setTo(kPlace);
    const cv::Point middle((place_.width - small.cols) / 2, (place_.height - small.rows) / 2);
    small.copyTo(canvas_(cv::Rect(at + middle, small.size())));
    caption_.write(canvas_, picture.camera, at + cv::Point(0, place_.height + caption_.capital_px),
                   place_.width, kCaptionInk);
  }

  std::span<const LabelledPicture> pictures_;
  ContactSheetOptions options_;
  SheetLayout layout_;
  cv::Size place_;
  Lettering heading_, caption_;
  std::vector<bool> starts_block_;  ///< whether headings stand above the row
  std::vector<int> top_;            ///< of the thumbnails of each row
  cv::Mat3b canvas_;
};

}  // namespace

ColorImage contact_sheet(std::span<const LabelledPicture> pictures,
                         const ContactSheetOptions& options) {
  check(pictures, options);
  return Sheet(pictures, options).draw();
}

}  // namespace vantage
