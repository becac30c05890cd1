#include "vantage/reconstruction/bop_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "dataset/bop_entry.hpp"
#include "dataset/bop_sensors.hpp"
#include "dataset/image_header.hpp"
#include "dataset/json_file.hpp"
#include "images/depth_file.hpp"
#include "images/numbered_images.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/detail/limits.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using reconstruction::detail::BopSensor;
using reconstruction::detail::Entry;
using reconstruction::detail::excerpt;
using reconstruction::detail::ImageSize;
using reconstruction::detail::NumberedImages;

/// One image of a sensor.
struct SensorEntry {
  const BopSensor& sensor;
  int number;  ///< of the image, in the names of its files
  Entry entry;
};

using Entries = std::map<int, SensorEntry>;

constexpr double kNotableSaturation = 0.001;  ///< share of an image's pixels

/// Adds the entries of a sensor's file, by the ids of its images among all sensors'.
void add_entries(const BopSensor& sensor, const json& root, Entries& entries) {
  const fs::path& file = sensor.camera_file;
  if (!root.is_object() || root.empty()) {
    throw bad_input(file.string(), fmt::format("found {}; expected an object with one entry per "
                                               "image, such as \"0\": {{\"cam_K\": …}}",
                                               excerpt(root)));
  }
  for (const auto& [key, value] : root.items()) {
    const std::string where = fmt::format("{}: {}", file.string(), json(key).dump());
    const int id = reconstruction::detail::id_of(key, "image", where);
    if (id >= reconstruction::detail::kIdsPerSensor) {
      throw bad_input(where, fmt::format("expected an id of at most {}",
                                         reconstruction::detail::kIdsPerSensor - 1));
    }
    const auto [place, is_new] =
        entries.try_emplace(sensor.first_id + id, SensorEntry{sensor, id, {file, key, value}});
    if (!is_new) {
      throw bad_input(fmt::format("{}: \"{}\"", file.string(), key),
                      fmt::format("image {} is there twice; remove one of them", id));
    }
  }
}

/// Leaves only the images asked for.
void select(Entries& entries, std::span<const int> only_ids, const std::string& where) {
  if (only_ids.empty()) return;
  for (const int id : only_ids) {
    if (entries.contains(id)) continue;
    throw bad_input(
        where, fmt::format("image {} was asked for, but is not here; there are {} images, "
                           "with ids from {} to {}",
                           id, entries.size(), entries.begin()->first, entries.rbegin()->first));
  }
  std::erase_if(entries, [&](const auto& entry) {
    return std::find(only_ids.begin(), only_ids.end(), entry.first) == only_ids.end();
  });
}

std::optional<Pose> read_pose(const Entry& entry) {
  if (!entry.has("cam_R_w2c") && !entry.has("cam_t_w2c")) return std::nullopt;
  const std::array<double, 9> r = entry.numbers<9>("cam_R_w2c");
  const std::array<double, 3> t = entry.numbers<3>("cam_t_w2c");
  Eigen::Matrix3d R_cam_world;
  R_cam_world << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
  const Eigen::Vector3d t_cam_world = 0.001 * Eigen::Vector3d(t[0], t[1], t[2]);
  return Pose::from_rotation(R_cam_world, t_cam_world, entry.where("cam_R_w2c")).inverse();
}

/// The principal point of a cropped image may lie outside of it; but not where the middle of a
/// larger image of the same shape is.
void refuse_other_size(const Intrinsics& k, const std::string& where) {
  constexpr double kAlike = 0.01;
  if (k.cx <= k.width || k.cy <= k.height) return;
  const double across = k.width / (2 * k.cx + 1), down = k.height / (2 * k.cy + 1);
  if (std::abs(across - down) > kAlike * down) return;
  throw bad_input(where, fmt::format("the principal point ({}, {}) lies outside the image of {} x "
                                     "{} pixels, in the middle of a larger one: depth and "
                                     "intrinsics of different size; scale cam_K by {:.4g}",
                                     k.cx, k.cy, k.width, k.height, down));
}

Intrinsics read_intrinsics(const Entry& entry, ImageSize size) {
  const std::array<double, 9> k = entry.numbers<9>("cam_K");
  const std::string where = entry.where("cam_K");
  if (k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1) {
    throw bad_input(where, fmt::format("found {}; expected [fx, 0, cx, 0, fy, cy, 0, 0, 1], "
                                       "row by row and without skew",
                                       excerpt(json(k))));
  }
  const Intrinsics intrinsics{size.width, size.height, k[0], k[4], k[2], k[5]};
  intrinsics.check(where);
  refuse_other_size(intrinsics, where);
  return intrinsics;
}

/// Gathers what one image's files and its entry say about its size: all have to agree.
class SizeVote {
 public:
  void add(ImageSize size, const std::string& source) {
    if (!size_) {
      size_ = size, source_ = source;
    } else if (size != *size_) {
      throw bad_input(source,
                      fmt::format("{} x {} pixels, but {} says {} x {}: they have to be "
                                  "of one size",
                                  size.width, size.height, source_, size_->width, size_->height));
    }
  }
  const std::optional<ImageSize>& size() const { return size_; }

 private:
  std::optional<ImageSize> size_;
  std::string source_;
};

void add_stated_size(const Entry& entry, SizeVote& vote) {
  if (!entry.has("width") && !entry.has("height")) return;
  const auto whole = [&](const char* key) {
    const double found = entry.positive(key);
    if (found > 16384 || found != std::floor(found)) {
      throw bad_input(entry.where(key),
                      fmt::format("found {}; expected a whole number from 1 to 16384", found));
    }
    return int(found);
  };
  const int width = whole("width");
  vote.add({width, whole("height")}, entry.where("width, height"));
}

/// Loads images of one sensor one by one and notes the files.
class Loader {
 public:
  Loader(BopScene& scene, const BopSensor& sensor, const DepthRange& range)
      : scene_(scene),
        range_(range),
        depth_(scene.folder / ("depth" + sensor.suffix), reconstruction::detail::is_depth_image) {
    for (const char* kind : {"rgb", "gray"}) {
      colors_.emplace_back(scene.folder / (kind + sensor.suffix),
                           reconstruction::detail::is_color_image);
    }
  }

  BopImage load(int id, int number, const Entry& entry) {
    SizeVote vote;
    std::shared_ptr<const DepthImage> depth = load_depth(number, entry, vote);
    const fs::path color = find_color(number, vote);
    add_stated_size(entry, vote);
    if (!vote.size()) throw size_unknown(number, entry);
    const Intrinsics intrinsics = read_intrinsics(entry, *vote.size());
    return {id, entry.where(), intrinsics, range_, read_pose(entry), std::move(depth), color};
  }

 private:
  std::shared_ptr<const DepthImage> load_depth(int number, const Entry& entry, SizeVote& vote) {
    if (!depth_.exists()) return nullptr;
    const std::optional<fs::path> file = depth_.find(number);
    if (!file) {
      throw bad_input((depth_.folder() / fmt::format("{:06d}.png", number)).string(),
                      fmt::format("missing: {} needs it, because the scene has a depth folder; {}; "
                                  "expected .png, .tif, .exr or .npy; add it or remove the entry",
                                  entry.where(), depth_.contents()));
    }
    const double depth_scale_mm = entry.positive("depth_scale");
    const auto [depth, saturated_share] = reconstruction::detail::read_depth(*file, depth_scale_mm);
    scene_.files.push_back(*file);
    vote.add({depth->width(), depth->height()}, file->string());
    warn_of_saturation(saturated_share, *file);
    return depth;
  }

  /// A few such pixels are usual; more of them are a surface that is too near or too bright, or a
  /// program that writes "unknown" so.
  void warn_of_saturation(double share, const fs::path& file) {
    if (share < kNotableSaturation) return;
    scene_.warnings.push_back(fmt::format(
        "{}: {:.1f} % of the pixels have the value {}, which is taken as \"no reading\": "
        "the volume behind them is neither free nor occupied",
        file.string(), 100 * share, DepthImage::kSaturatedCount));
  }

  fs::path find_color(int number, SizeVote& vote) {
    for (const NumberedImages& images : colors_) {
      const std::optional<fs::path> file = images.find(number);
      if (!file) continue;
      const auto header = reconstruction::detail::check_color_header(read_file(*file), *file);
      vote.add(header.size, file->string());
      const std::string warning = reconstruction::detail::orientation_warning(header, *file);
      if (!warning.empty()) scene_.warnings.push_back(warning);
      scene_.files.push_back(*file);
      return *file;
    }
    return {};
  }

  /// Says what was found in place of the images.
  Error size_unknown(int number, const Entry& entry) const {
    std::string found;
    for (const NumberedImages& images : colors_) {
      found += fmt::format("; {}: {}", images.folder().filename().string(), images.contents());
    }
    return bad_input(
        entry.where(),
        fmt::format("the image's size is not known: there is neither {0:06d}.png (or .tif, .exr, "
                    ".npy) in {1}/ nor {0:06d}.png (or .jpg, .jpeg, .tif, .bmp, .webp) in {2}/ or "
                    "{3}/, nor are there keys width and height{4}",
                    number, depth_.folder().filename().string(),
                    colors_[0].folder().filename().string(),
                    colors_[1].folder().filename().string(), found));
  }

  BopScene& scene_;
  DepthRange range_;
  NumberedImages depth_;
  std::vector<NumberedImages> colors_;
};

/// @throws Error bad_input where the scene's depth images come to more than a gibibyte.
void check_pixels(const BopScene& scene) {
  std::uint64_t pixels = 0;
  for (const BopImage& image : scene.images) {
    if (image.depth != nullptr) pixels += image.depth->metres().size();
  }
  if (pixels <= limits::kMaxScenePixels) return;
  throw bad_input(scene.folder.string(),
                  fmt::format("its first {} depth images have more than {} pixels together; choose "
                              "some with --images",
                              scene.images.size(), limits::kMaxScenePixels));
}

}  // namespace

PinholeCamera BopImage::camera() const {
  if (T_world_cam) return PinholeCamera(intrinsics, *T_world_cam, range, place);
  throw bad_input(
      place + ": cam_R_w2c",
      "missing, so that nobody knows where the camera is; write its pose into cam_R_w2c "
      "and cam_t_w2c, or give the workcell a board of markers to locate it by");
}

BopScene load_bop_scene(const fs::path& folder, const DepthRange& range,
                        std::span<const int> only_ids) {
  range.check("depth range");
  if (!fs::is_directory(folder)) {
    throw bad_input(folder.string(),
                    "no such folder; expected a BOP scene folder, with "
                    "scene_camera.json, rgb/ and depth/ in it");
  }
  const std::vector<BopSensor> sensors = reconstruction::detail::sensors_of(folder);
  if (sensors.empty()) {
    throw bad_input(
        (folder / "scene_camera.json").string(),
        "missing; a BOP scene folder has one, e.g. DATASET/test/000001, or one for each "
        "sensor, such as scene_camera_cam1.json");
  }
  BopScene scene{folder, {}, {}};
  std::deque<json> roots;  // the entries refer to them
  Entries entries;
  for (const BopSensor& sensor : sensors) {
    scene.files.push_back(sensor.camera_file);
    roots.push_back(reconstruction::detail::parse_json_file(sensor.camera_file));
    add_entries(sensor, roots.back(), entries);
  }
  select(entries, only_ids, (sensors.size() == 1 ? sensors[0].camera_file : folder).string());

  std::map<int, Loader> loaders;  // by the sensor's first id
  for (const auto& [id, entry] : entries) {
    Loader& loader =
        loaders.try_emplace(entry.sensor.first_id, scene, entry.sensor, range).first->second;
    scene.images.push_back(loader.load(id, entry.number, entry.entry));
    check_pixels(scene);
  }
  return scene;
}

bool is_bop_scene(const fs::path& folder) {
  return fs::is_directory(folder) && !reconstruction::detail::sensors_of(folder).empty();
}

}  // namespace vantage
