#include <fmt/format.h>

#include <cmath>

#include "documents/json_document.hpp"
#include "import/imported_dataset.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Values of one frame, and where it has none those of the whole file.
class FrameValues {
 public:
  FrameValues(const Document& document, std::size_t index)
      : document_(document),
        pointer_(child("/frames", index)),
        frame_(document.root.at("frames")[index]) {
    if (!frame_.is_object()) {
      throw bad_input(document.place(pointer_),
                      fmt::format("found {}; expected a frame's keys", shown(frame_)));
    }
  }

  const nlohmann::json* find(const char* key) const {
    if (frame_.contains(key)) return &frame_[key];
    return document_.root.contains(key) ? &document_.root[key] : nullptr;
  }
  std::string place(const char* key) const {
    return document_.place(frame_.contains(key) ? child(pointer_, key) : child("", key));
  }
  std::string frame_place() const { return document_.place(pointer_); }

  std::optional<double> number(const char* key) const {
    const nlohmann::json* found = find(key);
    if (!found) return std::nullopt;
    if (found->is_number() && std::isfinite(found->get<double>())) return found->get<double>();
    throw bad_input(place(key), fmt::format("found {}; expected a finite number", shown(*found)));
  }
  std::optional<std::string> text(const char* key) const {
    const nlohmann::json* found = find(key);
    if (!found || found->is_null()) return std::nullopt;
    if (found->is_string()) return found->get<std::string>();
    throw bad_input(place(key), fmt::format("found {}; expected text", shown(*found)));
  }

 private:
  const Document& document_;
  std::string pointer_;
  const nlohmann::json& frame_;
};

/// The camera looks along -z there, with y up: OpenGL's axes. Ours look along z, with y down.
Pose pose_of(const FrameValues& frame) {
  const nlohmann::json* matrix = frame.find("transform_matrix");
  const auto fail = [&](const std::string& found) {
    return bad_input(frame.place("transform_matrix"),
                     fmt::format("{}; expected 4 rows of 4 numbers, camera to world", found));
  };
  if (!matrix) throw fail("missing");
  if (!matrix->is_array() || matrix->size() < 3) throw fail("found " + shown(*matrix));
  Eigen::Matrix<double, 3, 4> m;
  for (int i = 0; i < 3; ++i) {
    const nlohmann::json& row = (*matrix)[std::size_t(i)];
    if (!row.is_array() || row.size() != 4) throw fail("found " + shown(*matrix));
    for (int j = 0; j < 4; ++j) {
      if (!row[std::size_t(j)].is_number()) throw fail("found " + shown(*matrix));
      m(i, j) = row[std::size_t(j)].get<double>();
    }
  }
  const Eigen::Matrix3d rotation = m.leftCols<3>() * Eigen::Vector3d(1, -1, -1).asDiagonal();
  return Pose::from_rotation(rotation, m.col(3), frame.place("transform_matrix"));
}

Distortion distortion_of(const FrameValues& frame) {
  const auto value = [&](const char* key) { return frame.number(key).value_or(0); };
  const std::string model = frame.text("camera_model").value_or("OPENCV");
  if (model == "OPENCV_FISHEYE") {
    return Distortion::fisheye(value("k1"), value("k2"), value("k3"), value("k4"));
  }
  if (model == "OPENCV" || model == "PINHOLE" || model == "SIMPLE_PINHOLE") {
    return {value("k1"), value("k2"), value("p1"), value("p2"), value("k3")};
  }
  throw bad_input(frame.place("camera_model"),
                  fmt::format("found \"{}\"; expected OPENCV, OPENCV_FISHEYE or PINHOLE", model));
}

Intrinsics intrinsics_of(const FrameValues& frame) {
  const double w = frame.number("w").value_or(0), h = frame.number("h").value_or(0);
  if (!(w >= 0 && w <= 16384 && h >= 0 && h <= 16384)) {
    throw bad_input(
        frame.frame_place(),
        fmt::format("w and h are {} and {}; expected the image's size in pixels", w, h));
  }
  Intrinsics k{int(w), int(h)};
  const auto fl_x = frame.number("fl_x"), angle = frame.number("camera_angle_x");
  if (fl_x) {
    k.fx = *fl_x;
  } else if (angle && w > 0) {
    k.fx = 0.5 * w / std::tan(0.5 * *angle);
  } else {
    throw bad_input(frame.frame_place(),
                    "there is neither fl_x, nor w with camera_angle_x; "
                    "expected the focal length in pixels");
  }
  k.fy = frame.number("fl_y").value_or(k.fx);
  k.cx = frame.number("cx").value_or(w / 2), k.cy = frame.number("cy").value_or(h / 2);
  return from_half_pixels(k);
}

/// NeRF's own data sets leave out the ending.
fs::path picture_of(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  for (const char* ending : {".png", ".jpg", ".jpeg"}) {
    if (!fs::exists(file) && fs::exists(file.string() + ending)) return file.string() + ending;
  }
  return file;
}

}  // namespace

bool detect_nerfstudio(const fs::path& source) {
  return fs::is_regular_file(source / "transforms.json");
}

ImportedDataset read_nerfstudio(const fs::path& source) {
  const fs::path file = source / "transforms.json";
  ImportedDataset dataset{"nerfstudio", 1, {}, {file}};
  const Document document = read_json(file);
  const bool has_frames = document.root.is_object() && document.root.contains("frames") &&
                          document.root["frames"].is_array();
  if (!has_frames) throw bad_input(document.place("/frames"), "missing; expected a list of frames");
  bool any_depth = false;
  for (std::size_t i = 0; i < document.root["frames"].size(); ++i) {
    const FrameValues frame(document, i);
    const auto name = frame.text("file_path");
    if (!name || name->empty()) {
      throw bad_input(frame.frame_place() + ".file_path", "missing; expected a picture");
    }
    ImportedImage image{*name, intrinsics_of(frame), distortion_of(frame), pose_of(frame)};
    image.color = picture_of(source, *name);
    if (const auto depth = frame.text("depth_file_path")) image.depth = source / *depth;
    any_depth |= !image.depth.empty();
    dataset.images.push_back(std::move(image));
  }
  if (any_depth && document.root.contains("depth_unit_scale_factor")) {
    const nlohmann::json& factor = document.root["depth_unit_scale_factor"];
    if (!factor.is_number() || !(factor.get<double>() > 0)) {
      throw bad_input(
          document.place("/depth_unit_scale_factor"),
          fmt::format("found {}; expected metres of one count of the depth images", shown(factor)));
    }
    dataset.depth_scale_mm = 1000 * factor.get<double>();
  }
  return dataset;
}

}  // namespace vantage
