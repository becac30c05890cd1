#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "documents/document.hpp"

namespace vantage::reconstruction::detail {

/// Where in a calibration file the values of one camera are: JSON pointers, for `Document::place`.
/// Programs call them by different names.
struct CameraEntry {
  std::string name;                        ///< "cam0", "1" of M1 and D1, or "" for the only one
  std::optional<std::string> matrix = {};  ///< 3 × 3
  std::optional<std::string> four_values = {};  ///< Kalibr's fu, fv, pu, pv in place of the matrix
  std::optional<std::string> coefficients = {};
  std::optional<std::string> model = {};         ///< its name
  std::optional<std::string> camera_model = {};  ///< Kalibr's "pinhole" or "omni"
  std::optional<std::string> fisheye_flag = {};  ///< OpenCV's `fisheye_model`
  std::optional<std::string> width = {}, height = {};
  std::optional<std::string> size = {};  ///< both in one list
};

/// All cameras of a file: of Kalibr's camchain, of OpenCV's stereo samples (M1, D1, M2, D2), or
/// one. Empty if the file has none.
std::vector<CameraEntry> cameras_in(const Document& document);

}  // namespace vantage::reconstruction::detail
