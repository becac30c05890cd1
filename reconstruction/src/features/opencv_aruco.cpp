#include "features/opencv_aruco.hpp"

#include <algorithm>
#include <cctype>

namespace vantage::reconstruction::detail {
namespace {

struct Named {
  std::string_view name;
  int type;
};

constexpr Named kDictionaries[] = {
    {"4X4_50", cv::aruco::DICT_4X4_50},
    {"4X4_100", cv::aruco::DICT_4X4_100},
    {"4X4_250", cv::aruco::DICT_4X4_250},
    {"4X4_1000", cv::aruco::DICT_4X4_1000},
    {"5X5_50", cv::aruco::DICT_5X5_50},
    {"5X5_100", cv::aruco::DICT_5X5_100},
    {"5X5_250", cv::aruco::DICT_5X5_250},
    {"5X5_1000", cv::aruco::DICT_5X5_1000},
    {"6X6_50", cv::aruco::DICT_6X6_50},
    {"6X6_100", cv::aruco::DICT_6X6_100},
    {"6X6_250", cv::aruco::DICT_6X6_250},
    {"6X6_1000", cv::aruco::DICT_6X6_1000},
    {"7X7_50", cv::aruco::DICT_7X7_50},
    {"7X7_100", cv::aruco::DICT_7X7_100},
    {"7X7_250", cv::aruco::DICT_7X7_250},
    {"7X7_1000", cv::aruco::DICT_7X7_1000},
    {"ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL},
    {"APRILTAG_16h5", cv::aruco::DICT_APRILTAG_16h5},
    {"APRILTAG_25h9", cv::aruco::DICT_APRILTAG_25h9},
    {"APRILTAG_36h10", cv::aruco::DICT_APRILTAG_36h10},
    {"APRILTAG_36h11", cv::aruco::DICT_APRILTAG_36h11},
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 8)
    {"ARUCO_MIP_36h12", cv::aruco::DICT_ARUCO_MIP_36h12},
#endif
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

}  // namespace

std::vector<std::string> aruco_dictionary_names() {
  std::vector<std::string> names;
  for (const Named& entry : kDictionaries) names.emplace_back(entry.name);
  return names;
}

std::string canonical_dictionary(std::string_view name) {
  std::string wanted = lower_case(name);
  if (wanted.starts_with("dict_")) wanted.erase(0, 5);
  if (wanted.starts_with("tag")) wanted = "apriltag_" + wanted.substr(3);
  for (const Named& entry : kDictionaries) {
    if (lower_case(entry.name) == wanted) return std::string(entry.name);
  }
  return std::string(name);
}

std::optional<cv::aruco::Dictionary> aruco_dictionary(std::string_view name) {
  const std::string wanted = canonical_dictionary(name);
  for (const Named& entry : kDictionaries) {
    if (entry.name == wanted) return predefined_dictionary(entry.type);
  }
  return std::nullopt;
}

}  // namespace vantage::reconstruction::detail
