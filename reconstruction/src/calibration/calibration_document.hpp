#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "documents/document.hpp"

namespace vantage::reconstruction::detail {

/// The values of a calibration file: YAML (OpenCV's 1.0 with its tags, too), JSON, or the XML of
/// cv::FileStorage. OpenCV's own reader overflows the stack on deep nesting.
/// @throws Error bad_input as `read_yaml` and `parse_opencv_xml` do.
Document read_calibration_document(const std::filesystem::path& file);

/// The XML of cv::FileStorage: what <opencv_storage> holds. Elements with elements in them are
/// mappings, or lists if these are all called "_"; a text of several words is a list; a word is a
/// number if it is one.
/// @throws Error bad_input for what is no XML or no such storage, nesting deeper than 64, and an
/// element that is there twice.
Document parse_opencv_xml(std::string_view text, const std::string& name);

}  // namespace vantage::reconstruction::detail
