#include "calibration/camera_entry.hpp"

#include <fmt/format.h>

#include <array>

namespace vantage::reconstruction::detail {
namespace {

using nlohmann::json;
using Pointer = std::optional<std::string>;

constexpr std::array kMatrixKeys = {"camera_matrix",
                                    "cameraMatrix",
                                    "CameraMatrix",
                                    "Camera_Matrix",
                                    "camera_matrix_K",
                                    "intrinsic_matrix",
                                    "K",
                                    "k",
                                    "M",
                                    "mtx"};
constexpr std::array kCoefficientKeys = {"distortion_coefficients",
                                         "distortion_coeffs",
                                         "dist_coeffs",
                                         "dist_coeff",
                                         "distCoeffs",
                                         "DistCoeffs",
                                         "Distortion_Coefficients",
                                         "distortionCoefficients",
                                         "D",
                                         "d",
                                         "dist"};
constexpr std::array kWidthKeys = {"image_width", "imageWidth", "image_Width", "width"};
constexpr std::array kHeightKeys = {"image_height", "imageHeight", "image_Height", "height"};
constexpr std::array kSizeKeys = {"resolution", "image_size", "imageSize", "img_size"};

/// The first of the keys that is there, each with an ending ("1" for M1), as it is or after "_".
template <class Keys>
Pointer first_of(const json& object, const std::string& pointer, const Keys& keys,
                 const std::string& ending = "") {
  for (const char* key : keys) {
    for (const std::string& name : {key + ending, key + ("_" + ending)}) {
      if (object.contains(name)) return child(pointer, name);
    }
  }
  return std::nullopt;
}

Pointer key(const json& object, const std::string& pointer, const char* name) {
  return first_of(object, pointer, std::array{name});
}

CameraEntry camera_at(const json& object, const std::string& pointer, std::string name,
                      const std::string& ending = "") {
  CameraEntry entry{std::move(name)};
  entry.matrix = first_of(object, pointer, kMatrixKeys, ending);
  entry.coefficients = first_of(object, pointer, kCoefficientKeys, ending);
  if (!entry.matrix) entry.four_values = key(object, pointer, "intrinsics");
  entry.model = first_of(object, pointer, std::array{"distortion_model", "distortionModel"});
  entry.camera_model = key(object, pointer, "camera_model");
  entry.fisheye_flag = key(object, pointer, "fisheye_model");
  entry.width = first_of(object, pointer, kWidthKeys);
  entry.height = first_of(object, pointer, kHeightKeys);
  entry.size = first_of(object, pointer, kSizeKeys);
  return entry;
}

bool has_intrinsics(const CameraEntry& entry) {
  return entry.matrix.has_value() || entry.four_values.has_value();
}

}  // namespace

std::vector<CameraEntry> cameras_in(const Document& document) {
  const json& root = document.root;
  std::vector<CameraEntry> cameras;
  if (!root.is_object()) return cameras;
  CameraEntry only = camera_at(root, "", "");
  if (has_intrinsics(only)) return {std::move(only)};
  for (const auto& [name, value] : root.items()) {
    if (!value.is_object()) continue;
    CameraEntry camera = camera_at(value, child("", name), name);
    if (has_intrinsics(camera)) cameras.push_back(std::move(camera));
  }
  if (!cameras.empty()) return cameras;
  for (const char* ending : {"0", "1", "2"}) {
    CameraEntry camera = camera_at(root, "", ending, ending);
    if (camera.matrix) cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace vantage::reconstruction::detail
