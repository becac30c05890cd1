#include "vantage/reconstruction/bop_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "dataset/bop_entry.hpp"
#include "dataset/image_header.hpp"
#include "dataset/json_file.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/detail/limits.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using reconstruction::detail::Entry;
using reconstruction::detail::excerpt;
using reconstruction::detail::ImageSize;

using Entries = std::map<int, Entry>;

constexpr double kNotableSaturation = 0.001;  ///< share of an image's pixels

Entries entries_by_id(const fs::path& file, const json& root) {
  if (!root.is_object() || root.empty()) {
    throw bad_input(file.string(), fmt::format("found {}; expected an object with one entry per "
                                               "image, such as \"0\": {{\"cam_K\": …}}",
                                               excerpt(root)));
  }
  Entries entries;
  for (const auto& [key, value] : root.items()) {
    const int id = reconstruction::detail::id_of(
        key, "image", fmt::format("{}: {}", file.string(), json(key).dump()));
    if (!entries.try_emplace(id, file, key, value).second) {
      throw bad_input(fmt::format("{}: \"{}\"", file.string(), key),
                      fmt::format("image {} is there twice; remove one of them", id));
    }
  }
  return entries;
}

/// Leaves only the images asked for.
void select(Entries& entries, std::span<const int> only_ids, const fs::path& file) {
  if (only_ids.empty()) return;
  for (const int id : only_ids) {
    if (entries.contains(id)) continue;
    throw bad_input(
        file.string(),
        fmt::format("image {} was asked for, but is not here; there are {} images, "
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
  if (k[2] < 0 || k[2] >= size.width || k[5] < 0 || k[5] >= size.height) {
    throw bad_input(where, fmt::format("the principal point ({}, {}) lies outside the image of "
                                       "{} x {} pixels: depth and intrinsics of different size; "
                                       "scale cam_K as the image was scaled",
                                       k[2], k[5], size.width, size.height));
  }
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

/// Loads images one by one and notes the files.
class Loader {
 public:
  Loader(BopScene& scene, const DepthRange& range)
      : scene_(scene), range_(range), has_depth_(fs::is_directory(scene.folder / "depth")) {}

  BopImage load(int id, const Entry& entry) {
    SizeVote vote;
    std::shared_ptr<const DepthImage> depth = load_depth(id, entry, vote);
    const fs::path color = find_color(id, vote);
    add_stated_size(entry, vote);
    if (!vote.size()) {
      throw bad_input(entry.where(), fmt::format("the image's size is not known: there is neither "
                                                 "{0}.png in depth/ nor {0}.png or {0}.jpg in "
                                                 "rgb/, nor are there keys width and height",
                                                 stem(id)));
    }
    const Intrinsics intrinsics = read_intrinsics(entry, *vote.size());
    return {id, entry.where(), intrinsics, range_, read_pose(entry), std::move(depth), color};
  }

 private:
  static std::string stem(int id) { return fmt::format("{:06d}", id); }

  std::shared_ptr<const DepthImage> load_depth(int id, const Entry& entry, SizeVote& vote) {
    if (!has_depth_) return nullptr;
    const fs::path file = scene_.folder / "depth" / (stem(id) + ".png");
    if (!fs::exists(file)) {
      throw bad_input(file.string(), fmt::format("missing: {} needs it, because the scene has a "
                                                 "depth folder; add it or remove the entry",
                                                 entry.where()));
    }
    const double depth_scale_mm = entry.positive("depth_scale");
    const RawDepthImage counts = read_png_counts(file);
    scene_.files.push_back(file);
    vote.add({counts.width, counts.height}, file.string());
    warn_of_saturation(counts, file);
    return std::make_shared<const DepthImage>(
        DepthImage::from_counts(counts, depth_scale_mm, file.string()));
  }

  /// A few such pixels are usual; more of them are a surface that is too near or too bright, or a
  /// program that writes "unknown" so.
  void warn_of_saturation(const RawDepthImage& counts, const fs::path& file) {
    const auto saturated = std::ranges::count(counts.samples, DepthImage::kSaturatedCount);
    const double share = double(saturated) / double(counts.samples.size());
    if (share < kNotableSaturation) return;
    scene_.warnings.push_back(fmt::format(
        "{}: {:.1f} % of the pixels have the value {}, which is taken as \"no reading\": "
        "the volume behind them is neither free nor occupied",
        file.string(), 100 * share, DepthImage::kSaturatedCount));
  }

  fs::path find_color(int id, SizeVote& vote) {
    for (const char* ending : {".png", ".jpg"}) {
      const fs::path file = scene_.folder / "rgb" / (stem(id) + ending);
      if (!fs::exists(file)) continue;
      vote.add(reconstruction::detail::check_color_header(read_file(file), file), file.string());
      scene_.files.push_back(file);
      return file;
    }
    return {};
  }

  BopScene& scene_;
  DepthRange range_;
  bool has_depth_;
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
  const fs::path file = folder / "scene_camera.json";
  if (!fs::exists(file)) {
    throw bad_input(file.string(), "missing; a BOP scene folder has one, e.g. DATASET/test/000001");
  }
  BopScene scene{folder, {}, {file}};
  const json root = reconstruction::detail::parse_json_file(file);
  Entries entries = entries_by_id(file, root);
  select(entries, only_ids, file);

  Loader loader(scene, range);
  for (const auto& [id, entry] : entries) {
    scene.images.push_back(loader.load(id, entry));
    check_pixels(scene);
  }
  return scene;
}

}  // namespace vantage
