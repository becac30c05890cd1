#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>
#include <span>
#include <tuple>

#include "features/opencv_aruco.hpp"
#include "markers/refine_corners.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/detector.hpp"

namespace vantage {
namespace {

using reconstruction::detail::kStrictOutlines;
using reconstruction::detail::kUsualOutlines;
using reconstruction::detail::OutlineOptions;

constexpr int kSmallestImage = 16;        ///< pixels; nothing smaller shows a marker
constexpr double kInvertedSupport = 0.8;  ///< white markers on black are rare: look twice

/// One dictionary to look through.
struct Family {
  std::string name;  ///< of the dictionary
  cv::aruco::Dictionary dictionary;
};

/// A marker found in an image, with what decides between two at the same place.
struct Found {
  Observation observation;
  Eigen::Vector2d centre;
  double size_px = 0;
  double support = 0;
};

/// Linear light, 0 to 1, of an image whose codes are sRGB.
cv::Mat1f linear_light(const cv::Mat1b& grey) {
  std::array<float, 256> light;
  for (int code = 0; code < 256; ++code) {
    const double c = code / 255.0;
    light[std::size_t(code)] = float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  cv::Mat1f result(grey.size());
  for (int row = 0; row < grey.rows; ++row) {
    std::transform(grey[row], grey[row] + grey.cols, result[row],
                   [&](unsigned char code) { return light[code]; });
  }
  return result;
}

cv::Mat1b grey_of(const ColorImage& image) {
  // OpenCV takes no pointer to const, and does not write to it.
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<unsigned char*>(image.samples.data()));
  cv::Mat1b grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

std::optional<Found> refined(const cv::Mat1f& light, const Lens* lens, const Family& family, int id,
                             const std::vector<cv::Point2f>& corners) {
  const MarkerCells cells = marker_cells(family.name, id, "dictionaries");
  std::array<Eigen::Vector2d, 4> start;
  for (std::size_t i = 0; i < 4; ++i) start[i] = {double(corners[i].x), double(corners[i].y)};
  const auto fit = reconstruction::detail::refine_corners(
      light, reconstruction::detail::marker_edges(cells), cells.side, start, lens);
  if (!fit) return std::nullopt;
  SeenPoints points{{fit->pixels.begin(), fit->pixels.end()}, fit->sigma_px};
  Found found{{marker_key(family.name, id), std::move(points)}, {0, 0}, 0, fit->support};
  for (const Eigen::Vector2d& pixel : fit->pixels) found.centre += pixel / 4;
  for (const Eigen::Vector2d& pixel : fit->pixels) {
    found.size_px += (pixel - found.centre).norm() / 4;
  }
  return fault_of(found.observation).empty() ? std::optional(std::move(found)) : std::nullopt;
}

/// Whether it is there already: outlines of other options find it again.
bool is_known(std::span<const Found> all, const FeatureKey& key,
              const std::vector<cv::Point2f>& corners) {
  Eigen::Vector2d centre(0, 0);
  for (const cv::Point2f& corner : corners) centre += Eigen::Vector2d(corner.x, corner.y) / 4;
  return std::any_of(all.begin(), all.end(), [&](const Found& found) {
    return found.observation.key == key && (found.centre - centre).norm() < 0.2 * found.size_px;
  });
}

/// Appends the markers of one dictionary that are not there yet and have at least this support.
void find_markers(const cv::Mat1b& grey, const cv::Mat1f& light, const Lens* lens,
                  const Family& family, const OutlineOptions& outlines, double min_support,
                  std::vector<Found>& all) {
  std::vector<int> ids;
  std::vector<std::vector<cv::Point2f>> corners;
  reconstruction::detail::detect_in_grey(grey, family.dictionary, outlines, ids, corners);
  const std::size_t known = all.size();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (is_known(std::span(all).first(known), marker_key(family.name, ids[i]), corners[i]))
      continue;
    auto found = refined(light, lens, family, ids[i], corners[i]);
    if (found && found->support >= min_support) all.push_back(std::move(*found));
  }
}

/// A square of the image is one marker: the one whose pattern is more visible.
void leave_one_of_each(std::vector<Found>& all) {
  std::vector<Found> kept;
  for (Found& found : all) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Found& other) {
      return (other.centre - found.centre).norm() < 0.2 * found.size_px &&
             std::abs(other.size_px - found.size_px) < 0.2 * found.size_px;
    });
    if (same == kept.end()) {
      kept.push_back(std::move(found));
    } else if (found.support > same->support) {
      *same = std::move(found);
    }
  }
  all = std::move(kept);
}

/// Leaves out of `some` what lies on or around one of `others`.
void leave_out_overlaps(const std::vector<Found>& others, std::vector<Found>& some) {
  std::erase_if(some, [&](const Found& found) {
    return std::any_of(others.begin(), others.end(), [&](const Found& other) {
      return (other.centre - found.centre).norm() < std::max(other.size_px, found.size_px);
    });
  });
}

/// The white paper around a black marker is a black frame in the negative, and may be read as
/// another marker; so may, of a white marker, the black around it. Those of the kind that there is
/// less of are taken for that. A single inverted one is not a marker: all markers of a print are
/// inverted, or none.
void add_inverted(std::vector<Found> inverted, std::vector<Found>& all) {
  constexpr std::size_t kFewestInverted = 2;
  if (inverted.size() > all.size()) {
    leave_out_overlaps(inverted, all);
  } else {
    leave_out_overlaps(all, inverted);
  }
  if (inverted.size() < kFewestInverted) return;
  std::move(inverted.begin(), inverted.end(), std::back_inserter(all));
}

std::vector<Family> checked_families(const std::vector<std::string>& names) {
  const char* where = "dictionaries";
  if (names.empty())
    throw bad_input(where, "there is no dictionary; name at least one, e.g. 4X4_50");
  std::vector<Family> families;
  std::set<std::string> seen;
  for (const std::string& name : names) {
    auto dictionary = reconstruction::detail::aruco_dictionary(name);
    if (!dictionary) {
      throw bad_input(where, fmt::format("there is no marker dictionary '{}'; expected one of {}",
                                         name, fmt::join(marker_dictionaries(), ", ")));
    }
    if (!seen.insert(marker_family(name)).second) {
      throw bad_input(where, fmt::format("{} is the second dictionary of the family {}, whose "
                                         "members share their markers; name only the larger one",
                                         name, marker_family(name)));
    }
    families.push_back({name, std::move(*dictionary)});
  }
  return families;
}

void check_size(const ColorImage& image, const Lens& lens) {
  const Intrinsics& k = lens.intrinsics();
  if (image.width == k.width && image.height == k.height) return;
  throw bad_input("image", fmt::format("{} x {} pixels; expected the lens' {} x {}", image.width,
                                       image.height, k.width, k.height));
}

}  // namespace

struct ArucoDetector::Impl {
  std::vector<Family> families;
  std::optional<Lens> lens;
};

ArucoDetector::ArucoDetector(const ArucoOptions& options)
    : impl_(std::make_unique<const Impl>(
          Impl{checked_families(options.dictionaries), options.lens})) {}

ArucoDetector::~ArucoDetector() = default;

std::vector<Observation> ArucoDetector::detect(const ColorImage& image) const {
  const Lens* lens = impl_->lens ? &*impl_->lens : nullptr;
  if (lens) check_size(image, *lens);
  if (image.width < kSmallestImage || image.height < kSmallestImage) return {};
  const cv::Mat1b grey = grey_of(image);
  const cv::Mat1f light = linear_light(grey);
  std::vector<Found> all, inverted;
  for (const Family& family : impl_->families) {
    find_markers(grey, light, lens, family, kStrictOutlines, 0, all);
    find_markers(grey, light, lens, family, kUsualOutlines, 0, all);
  }
  // White markers on black, as some are printed: the same in the negative.
  const cv::Mat1b negative = 255 - grey;
  const cv::Mat1f negative_light = 1 - light;
  for (const Family& family : impl_->families) {
    find_markers(negative, negative_light, lens, family, kUsualOutlines, kInvertedSupport,
                 inverted);
  }
  add_inverted(std::move(inverted), all);
  const auto order = [](const Found& f) {
    return std::make_tuple(std::cref(f.observation.key), f.centre.x(), f.centre.y());
  };
  std::sort(all.begin(), all.end(),
            [&](const Found& a, const Found& b) { return order(a) < order(b); });
  leave_one_of_each(all);
  std::vector<Observation> observations;
  for (Found& found : all) observations.push_back(std::move(found.observation));
  return observations;
}

}  // namespace vantage
