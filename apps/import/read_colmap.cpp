#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "import/imported_dataset.hpp"
#include "import/text_lines.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// The folder with the model's files; empty if there is none.
fs::path model_folder(const fs::path& source) {
  for (const char* inside : {"", "sparse/0", "sparse", "colmap/sparse/0"}) {
    const fs::path folder = source / inside;
    for (const char* ending : {".txt", ".bin"}) {
      if (fs::is_regular_file(folder / (std::string("cameras") + ending)) &&
          fs::is_regular_file(folder / (std::string("images") + ending))) {
        return folder;
      }
    }
  }
  return {};
}

struct ColmapCamera {
  Intrinsics intrinsics;
  Distortion distortion;
};

/// COLMAP, src/colmap/sensor/models.h: the parameters of each model, in this order.
ColmapCamera camera_of(const TextLine& line) {
  const std::string& model = line.word(1, "a camera model");
  const auto p = [&](std::size_t i) { return line.number(4 + i, "the camera's parameters"); };
  Intrinsics k{line.whole(2, "the width"), line.whole(3, "the height")};
  const bool one_focal = model == "SIMPLE_PINHOLE" || model == "SIMPLE_RADIAL" ||
                         model == "RADIAL" || model == "SIMPLE_RADIAL_FISHEYE" ||
                         model == "RADIAL_FISHEYE";
  const std::size_t next = one_focal ? 3 : 4;  // the first parameter behind the pinhole's
  k.fx = p(0), k.fy = p(one_focal ? 0 : 1), k.cx = p(next - 2), k.cy = p(next - 1);
  ColmapCamera camera{from_half_pixels(k), {}};
  Distortion& d = camera.distortion;
  if (model == "SIMPLE_RADIAL") {
    d.k1 = p(3);
  } else if (model == "RADIAL") {
    d.k1 = p(3), d.k2 = p(4);
  } else if (model == "OPENCV") {
    d = {p(4), p(5), p(6), p(7)};
  } else if (model == "FULL_OPENCV") {
    d = {p(4), p(5), p(6), p(7), p(8), p(9), p(10), p(11)};
  } else if (model == "OPENCV_FISHEYE") {
    d = Distortion::fisheye(p(4), p(5), p(6), p(7));
  } else if (model == "SIMPLE_RADIAL_FISHEYE") {
    d = Distortion::fisheye(p(3), 0, 0, 0);
  } else if (model == "RADIAL_FISHEYE") {
    d = Distortion::fisheye(p(3), p(4), 0, 0);
  } else if (model != "PINHOLE" && model != "SIMPLE_PINHOLE") {
    throw bad_input(line.place(),
                    fmt::format("the camera model {} is not supported; undistort the pictures with "
                                "\"colmap image_undistorter\"",
                                model.substr(0, 60)));
  }
  return camera;
}

std::map<int, ColmapCamera> read_cameras(const fs::path& file) {
  std::map<int, ColmapCamera> cameras;
  for (const TextLine& line : read_text_lines(file)) {
    if (line.empty()) continue;
    const int id = line.whole(0, "a camera's id");
    if (!cameras.emplace(id, camera_of(line)).second) {
      throw bad_input(line.place(), fmt::format("camera {} is listed twice; remove one", id));
    }
  }
  return cameras;
}

/// "id qw qx qy qz tx ty tz camera name", world to camera.
Pose pose_of_image(const TextLine& line) {
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = line.number(i + 1, "qw qx qy qz tx ty tz");
  return Pose::from_quaternion({v[0], v[1], v[2], v[3]}, {v[4], v[5], v[6]}, line.place())
      .inverse();
}

fs::path depth_of(const fs::path& source, const std::string& name) {
  for (const char* folder : {"depth", "depths", "depth_maps"}) {
    for (const char* ending : {".png", ".tif", ".tiff", ".exr", ".npy"}) {
      fs::path file = source / folder / name;
      file.replace_extension(ending);
      if (fs::is_regular_file(file)) return file;
    }
  }
  return {};
}

}  // namespace

bool detect_colmap(const fs::path& source) {
  return !model_folder(source).empty();
}

ImportedDataset read_colmap(const fs::path& source) {
  const fs::path folder = model_folder(source);
  if (!fs::exists(folder / "cameras.txt")) {
    throw bad_input(folder.string(),
                    "has a binary model; convert it to text: colmap model_converter --input_path "
                    "FOLDER --output_path FOLDER --output_type TXT");
  }
  ImportedDataset dataset{"COLMAP", 1, {}, {folder / "cameras.txt", folder / "images.txt"}};
  const auto cameras = read_cameras(dataset.files[0]);
  // Two lines for each image; the second one, its points, may be empty.
  const std::vector<TextLine> lines = read_text_lines(dataset.files[1]);
  std::size_t without_picture = 0;
  for (std::size_t i = 0; i < lines.size(); i += 2) {
    const TextLine& line = lines[i];
    if (line.empty()) throw bad_input(line.place(), "empty; expected an image's line");
    const int camera = line.whole(8, "a camera's id");
    const auto found = cameras.find(camera);
    if (found == cameras.end()) {
      throw bad_input(line.place(),
                      fmt::format("camera {} is not in {}", camera, dataset.files[0].string()));
    }
    ImportedImage image{line.rest(9, "a picture's name"), found->second.intrinsics,
                        found->second.distortion, pose_of_image(line)};
    const fs::path picture = source / "images" / image.name;
    if (fs::is_regular_file(picture)) image.color = picture;
    image.depth = depth_of(source, image.name);
    if (image.color.empty() && image.depth.empty()) {
      throw bad_input(picture.string(), fmt::format("missing, and there is no depth image either: "
                                                    "{} names it",
                                                    line.place()));
    }
    without_picture += image.color.empty();
    dataset.images.push_back(std::move(image));
  }
  if (without_picture > 0) {
    dataset.warnings.push_back(
        fmt::format("{}: {} of {} pictures are not there; only their depth "
                    "images are taken",
                    (source / "images").string(), without_picture, dataset.images.size()));
  }
  std::ranges::stable_sort(dataset.images, {}, &ImportedImage::name);
  dataset.warnings.push_back(
      "COLMAP models have no absolute scale: the poses are taken as metres, which is right only "
      "for a model that was scaled (colmap model_aligner); check a length that you know");
  return dataset;
}

}  // namespace vantage
