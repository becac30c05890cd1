#include "vantage/reconstruction/calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "calibration/calibration_document.hpp"
#include "calibration/camera_entry.hpp"
#include "calibration/matrix_value.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using reconstruction::detail::CameraEntry;
using reconstruction::detail::matrix_at;
using reconstruction::detail::MatrixValue;

/// What a name means that a calibration has for its lens' model.
enum class ModelName { none, by_count, fisheye, inverse, other };

ModelName model_named(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) {
    return c == '-' || c == ' ' ? '_' : char(std::tolower(c));
  });
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::find(names, name) != names.end();
  };
  if (is_one_of({"none", "pinhole", "no_distortion", "ideal"})) return ModelName::none;
  if (is_one_of({"", "plumb_bob", "radtan", "radial_tangential", "brown_conrady", "brown", "opencv",
                 "rational_polynomial", "rational", "standard"})) {
    return ModelName::by_count;
  }
  if (is_one_of({"equidistant", "equi", "fisheye", "kannala_brandt", "kannala_brandt4", "kb4",
                 "opencv_fisheye"})) {
    return ModelName::fisheye;
  }
  return is_one_of({"inverse_brown_conrady", "modified_brown_conrady"}) ? ModelName::inverse
                                                                        : ModelName::other;
}

Error unknown_model(const std::string& place, const std::string& name) {
  return bad_input(place, fmt::format("found \"{}\"; expected plumb_bob (radtan), "
                                      "rational_polynomial, equidistant (fisheye) or none: other "
                                      "lens models are not supported; undistort the images, or "
                                      "calibrate with one of these",
                                      name));
}

ModelName model_of(const Document& document, const CameraEntry& entry) {
  const auto text_at = [&](const std::string& pointer) {
    const auto& value = document.root.at(nlohmann::json::json_pointer(pointer));
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return std::string();
    throw bad_input(document.place(pointer),
                    fmt::format("found {}; expected the model's name", shown(value)));
  };
  if (entry.camera_model) {
    const std::string name = text_at(*entry.camera_model);
    if (name == "fisheye") return ModelName::fisheye;
    if (name != "pinhole" && name != "perspective" && !name.empty()) {
      throw unknown_model(document.place(*entry.camera_model), name);
    }
  }
  if (entry.fisheye_flag) {
    const auto& flag = document.root.at(nlohmann::json::json_pointer(*entry.fisheye_flag));
    if (flag == 1 || flag == true || flag == "true") return ModelName::fisheye;
    if (flag != 0 && flag != false && flag != "false") {
      throw bad_input(document.place(*entry.fisheye_flag),
                      fmt::format("found {}; expected 0 or 1", shown(flag)));
    }
  }
  if (!entry.model) return ModelName::by_count;
  const std::string name = text_at(*entry.model);
  const ModelName model = model_named(name);
  if (model == ModelName::other) throw unknown_model(document.place(*entry.model), name);
  return model;
}

/// The camera that `name` names, or the only one.
CameraEntry camera_named(const Document& document, const std::string& name) {
  const std::vector<CameraEntry> cameras = reconstruction::detail::cameras_in(document);
  if (cameras.empty()) {
    throw bad_input(document.name + ": camera_matrix",
                    "it is missing; expected 3 × 3 numbers, as OpenCV writes them (also called "
                    "cameraMatrix, K, M1), or Kalibr's intrinsics");
  }
  if (name.empty() && cameras.size() == 1) return cameras.front();
  std::vector<std::string> names;
  for (const CameraEntry& camera : cameras) {
    if (camera.name == name && !name.empty()) return camera;
    names.push_back(camera.name.empty() ? "(the only one, without a name)" : camera.name);
  }
  throw bad_input(document.name,
                  fmt::format("{}; it has {}; name one of them behind the file: {}#{}",
                              name.empty() ? "it has several cameras"
                                           : fmt::format("there is no camera \"{}\" in it", name),
                              fmt::join(names, ", "), document.name, names.front()));
}

int side(const Document& document, const std::optional<std::string>& pointer,
         const nlohmann::json* value, const char* key, int of_images) {
  if (!value) {
    if (of_images > 0) return of_images;
    throw bad_input(
        document.name + ": " + key,
        "it is missing, and there is no image to take it from; add the images' size in pixels");
  }
  const std::string place = document.place(*pointer);
  const double pixels = value->is_number() ? value->get<double>() : -1;
  if (!(pixels >= 0) || pixels > 1e6 || pixels != std::floor(pixels)) {
    throw bad_input(place,
                    fmt::format("found {}; expected a whole number of pixels", shown(*value)));
  }
  if (of_images > 0 && int(pixels) != of_images) {
    throw bad_input(place, fmt::format("it is {}, but the images have {} pixels; expected this "
                                       "camera's calibration at this resolution",
                                       int(pixels), of_images));
  }
  return int(pixels);
}

/// Width and height, from two keys or from one list.
std::pair<int, int> size_of(const Document& document, const CameraEntry& entry, int width,
                            int height) {
  const auto at = [&](const std::optional<std::string>& pointer) {
    return pointer ? &document.root.at(nlohmann::json::json_pointer(*pointer)) : nullptr;
  };
  const nlohmann::json* both = at(entry.size);
  if (both && (entry.width || entry.height)) both = nullptr;
  if (both) {
    if (!both->is_array() || both->size() != 2) {
      throw bad_input(document.place(*entry.size),
                      fmt::format("found {}; expected width and height in pixels", shown(*both)));
    }
    return {side(document, entry.size, &(*both)[0], "image_width", width),
            side(document, entry.size, &(*both)[1], "image_height", height)};
  }
  return {side(document, entry.width, at(entry.width), "image_width", width),
          side(document, entry.height, at(entry.height), "image_height", height)};
}

Intrinsics intrinsics_of(const Document& document, const CameraEntry& entry, int width,
                         int height) {
  const auto [w, h] = size_of(document, entry, width, height);
  Intrinsics k{w, h};
  if (entry.four_values) {
    const MatrixValue values = matrix_at(document, *entry.four_values, "fu, fv, pu, pv");
    if (values.numbers.size() != 4) throw values.error("four numbers: fu, fv, pu, pv");
    k.fx = values.numbers[0], k.fy = values.numbers[1];
    k.cx = values.numbers[2], k.cy = values.numbers[3];
    k.check(values.place);
    return k;
  }
  const MatrixValue matrix = matrix_at(document, *entry.matrix, "3 × 3 numbers");
  const std::vector<double>& m = matrix.numbers;
  if (m.size() != 9 || !(matrix.is_flat || matrix.rows == 3)) throw matrix.error("3 × 3 numbers");
  if (m[1] != 0) {
    throw bad_input(matrix.place, fmt::format("its pixels are skewed by {}; expected 0, as "
                                              "OpenCV's own calibration has it",
                                              m[1]));
  }
  if (m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1) {
    throw bad_input(
        matrix.place,
        fmt::format("it is [{}]; expected [fx, 0, cx, 0, fy, cy, 0, 0, 1]", fmt::join(m, ", ")));
  }
  k.fx = m[0], k.fy = m[4], k.cx = m[2], k.cy = m[5];
  k.check(matrix.place);
  return k;
}

Distortion fisheye_of(const MatrixValue& found) {
  const std::vector<double>& c = found.numbers;
  if (c.size() != 4) throw found.error("the four numbers of a fisheye lens, k1 to k4");
  return Distortion::fisheye(c[0], c[1], c[2], c[3]);
}

/// Which of OpenCV's models it is shows in how many coefficients there are.
Distortion brown_conrady_of(const MatrixValue& found) {
  std::vector<double> c = found.numbers;
  const bool fits =
      c.size() == 4 || c.size() == 5 || c.size() == 8 || c.size() == 12 || c.size() == 14;
  if (!fits || !(found.rows == 1 || found.columns == 1)) {
    throw found.error("a row or a column of 4, 5 or 8 numbers");
  }
  for (std::size_t i = 8; i < c.size(); ++i) {
    if (c[i] == 0) continue;
    throw bad_input(found.place,
                    fmt::format("coefficient {} of {} is {}: the thin-prism and tilted models are "
                                "not supported; calibrate without CALIB_THIN_PRISM_MODEL and "
                                "CALIB_TILTED_MODEL",
                                i + 1, c.size(), c[i]));
  }
  c.resize(8, 0.0);
  return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
}

Distortion distortion_of(const Document& document, const CameraEntry& entry) {
  const ModelName model = model_of(document, entry);
  if (model == ModelName::none) return {};
  if (!entry.coefficients) {
    throw bad_input(document.name + ": distortion_coefficients",
                    "it is missing; expected a row or a column of 4, 5 or 8 numbers");
  }
  const MatrixValue found = matrix_at(document, *entry.coefficients, "the lens' coefficients");
  // ROS leaves them out where images are undistorted.
  if (found.numbers.empty() && entry.model && model != ModelName::fisheye) return {};
  if (model == ModelName::fisheye) return fisheye_of(found);
  if (model == ModelName::inverse) {
    const bool zero = std::ranges::all_of(found.numbers, [](double c) { return c == 0; });
    if (!zero) {
      throw bad_input(document.place(*entry.model),
                      "this RealSense model is not one of OpenCV's; expected plumb_bob, "
                      "rational_polynomial or equidistant: calibrate the camera with OpenCV");
    }
  }
  return brown_conrady_of(found);
}

/// ROS says so where the intrinsics are those of another resolution than the images'.
void check_binning(const Document& document) {
  for (const char* key : {"binning_x", "binning_y"}) {
    const auto found = document.root.find(key);
    if (found == document.root.end() || !found->is_number() || found->get<double>() <= 1) continue;
    throw bad_input(document.place(child("", key)),
                    fmt::format("found {}: the images are smaller than the calibrated ones; "
                                "expected 0 or 1: give a calibration of the images as recorded",
                                shown(*found)));
  }
}

}  // namespace

CalibrationName calibration_name(const fs::path& name) {
  const std::string text = name.string();
  const std::size_t mark = text.rfind('#');
  if (mark == std::string::npos || fs::exists(name)) return {name, {}};
  return {text.substr(0, mark), text.substr(mark + 1)};
}

Lens read_calibration(const fs::path& name, int width, int height) {
  const auto [file, camera] = calibration_name(name);
  const Document document = reconstruction::detail::read_calibration_document(file);
  const CameraEntry entry = camera_named(document, camera);
  check_binning(document);
  const Intrinsics intrinsics = intrinsics_of(document, entry, width, height);
  const Distortion distortion = distortion_of(document, entry);
  return {intrinsics, distortion,
          entry.coefficients ? document.place(*entry.coefficients) : document.name};
}

}  // namespace vantage
