#include "vantage/reconstruction/calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = 1 << 20;  // OpenCV's tools also list all the corners seen

/// A calibration file as OpenCV has read it, and the words for what is wrong with it.
class CalibrationFile {
 public:
  explicit CalibrationFile(const fs::path& path) : path_(path.string()) {
    const std::vector<std::uint8_t> bytes = read_file(path, kMaxBytes);
    const std::string text(bytes.begin(), bytes.end());
    check_kind(text);
    try {
      storage_.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    } catch (const cv::Exception& error) {
      throw unreadable(error.err);
    }
    if (!storage_.isOpened()) throw unreadable("no map at the top");
  }

  Error bad(const std::string& key, const std::string& message) const {
    return bad_input(path_ + ": " + key, message);
  }
  bool has(const std::string& key) const { return !node(key).empty(); }

  /// The elements of a matrix row by row; its size has to be one that `fits`.
  template <class Fits>
  std::vector<double> matrix(const std::string& key, const char* expected, const Fits& fits) const {
    if (!has(key)) throw bad(key, fmt::format("it is missing; expected {}", expected));
    check_claim(key, expected);
    cv::Mat m;
    try {
      node(key) >> m;
    } catch (const cv::Exception& error) {
      throw bad(key, fmt::format("OpenCV reads no matrix: {}; expected {}", error.err, expected));
    }
    if (m.dims != 2 || m.channels() != 1 || !fits(m.rows, m.cols)) {
      throw bad(key, fmt::format("it has {} × {} numbers; expected {}", m.rows,
                                 m.cols * m.channels(), expected));
    }
    cv::Mat1d doubles;
    m.convertTo(doubles, CV_64F);
    const std::vector<double> values(doubles.begin(), doubles.end());
    for (const double value : values) {
      if (!std::isfinite(value)) {
        throw bad(key, fmt::format("a number in it is {}; expected finite ones", value));
      }
    }
    return values;
  }

  /// Of the image, as the file says it; `of_images` where it says nothing.
  int size(const std::string& key, int of_images) const {
    if (!has(key)) {
      if (of_images > 0) return of_images;
      throw bad(key, "it is missing, and no image says it; add the images' size in pixels");
    }
    if (!node(key).isInt()) throw bad(key, "it is no whole number; expected pixels");
    const int value = int(node(key));
    if (of_images > 0 && value != of_images) {
      throw bad(key,
                fmt::format("it is {}, but the images have {} pixels; expected the calibration "
                            "of this camera at this resolution",
                            value, of_images));
    }
    return value;
  }

 private:
  /// OpenCV takes any text for YAML, and asks files that begin with { or < for more than they say.
  void check_kind(const std::string& text) const {
    if (text.starts_with("%YAML") || text.starts_with("<?xml")) return;
    throw bad_input(path_,
                    "it begins with neither '%YAML' nor '<?xml'; expected a calibration as "
                    "OpenCV's cv::FileStorage writes it");
  }
  Error unreadable(const std::string& why) const {
    return bad_input(path_, fmt::format("OpenCV cannot read it: {}; expected a calibration as "
                                        "cv::FileStorage writes it",
                                        why));
  }
  /// OpenCV takes the memory for a matrix before it looks whether its numbers are there.
  void check_claim(const std::string& key, const char* expected) const {
    constexpr int kMax = 100;
    const cv::FileNode claim = node(key);
    const bool is_matrix = claim.isMap() && claim["rows"].isInt() && claim["cols"].isInt();
    if (!is_matrix) throw bad(key, fmt::format("it is no OpenCV matrix; expected {}", expected));
    const int rows = int(claim["rows"]), columns = int(claim["cols"]);
    if (rows < 1 || rows > kMax || columns < 1 || columns > kMax) {
      throw bad(key, fmt::format("it has {} × {} numbers; expected {}", rows, columns, expected));
    }
  }
  cv::FileNode node(const std::string& key) const { return storage_[key]; }

  std::string path_;
  cv::FileStorage storage_;
};

Intrinsics read_intrinsics(const CalibrationFile& file, int width, int height) {
  const std::string key = "camera_matrix";
  const std::vector<double> m = file.matrix(
      key, "3 × 3 numbers", [](int rows, int columns) { return rows == 3 && columns == 3; });
  if (m[1] != 0) {
    throw file.bad(key, fmt::format("its pixels are skewed by {}; expected 0, as OpenCV's own "
                                    "calibration has it",
                                    m[1]));
  }
  if (m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1) {
    throw file.bad(key, fmt::format("it is [{}]; expected [fx, 0, cx, 0, fy, cy, 0, 0, 1]",
                                    fmt::join(m, ", ")));
  }
  const Intrinsics intrinsics{
      file.size("image_width", width), file.size("image_height", height), m[0], m[4], m[2], m[5]};
  intrinsics.check(file.bad(key, "").where());
  return intrinsics;
}

Distortion read_distortion(const CalibrationFile& file) {
  const std::string key = "distortion_coefficients";
  std::vector<double> c =
      file.matrix(key, "a row or a column of 4, 5 or 8 numbers", [](int rows, int columns) {
        const int count = rows * columns;
        return (rows == 1 || columns == 1) &&
               (count == 4 || count == 5 || count == 8 || count == 12 || count == 14);
      });
  for (std::size_t i = 8; i < c.size(); ++i) {
    if (c[i] == 0) continue;
    throw file.bad(key, fmt::format("coefficient {} of {} is {}: the thin-prism and tilted models "
                                    "are not supported; calibrate without CALIB_THIN_PRISM_MODEL "
                                    "and CALIB_TILTED_MODEL",
                                    i + 1, c.size(), c[i]));
  }
  c.resize(8, 0.0);
  return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
}

}  // namespace

Lens read_calibration(const fs::path& file, int width, int height) {
  try {
    const CalibrationFile calibration(file);
    const Intrinsics intrinsics = read_intrinsics(calibration, width, height);
    return {intrinsics, read_distortion(calibration),
            calibration.bad("distortion_coefficients", "").where()};
  } catch (const cv::Exception& error) {
    throw bad_input(file.string(), fmt::format("OpenCV cannot read it: {}", error.err));
  }
}

}  // namespace vantage
