#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "import/imported_dataset.hpp"
#include "import/text_lines.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxApart_s = 0.02;  // the largest difference that TUM's own associate.py matches
constexpr double kTumScale_mm = 0.2;  // 5000 counts are a metre

/// A line of one of the three files, and its time.
struct TumMoment {
  double time_s;
  TextLine line;
};

std::vector<TumMoment> moments(const fs::path& file) {
  std::vector<TumMoment> all;
  for (TextLine& line : read_text_lines(file)) {
    if (line.empty()) continue;
    const double time_s = line.number(0, "a time in seconds");
    if (!std::isfinite(time_s)) throw bad_input(line.place(), "the time is not finite");
    all.push_back({time_s, std::move(line)});
  }
  std::ranges::stable_sort(all, {}, &TumMoment::time_s);
  if (all.empty())
    throw bad_input(file.string(), "is empty; expected lines that begin with a time in seconds");
  return all;
}

/// The line that is nearest in time; null if none is near enough.
const TumMoment* nearest(const std::vector<TumMoment>& all, double time_s) {
  const auto after = std::ranges::lower_bound(all, time_s, {}, &TumMoment::time_s);
  const TumMoment* best = nullptr;
  for (const auto candidate : {after, after == all.begin() ? all.end() : after - 1}) {
    if (candidate == all.end()) continue;
    const double apart_s = std::abs(candidate->time_s - time_s);
    if (apart_s > kMaxApart_s) continue;
    if (!best || apart_s < std::abs(best->time_s - time_s)) best = &*candidate;
  }
  return best;
}

/// "time tx ty tz qx qy qz qw", camera to world.
Pose pose_of(const TextLine& line) {
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = line.number(i + 1, "tx ty tz qx qy qz qw");
  return Pose::from_quaternion({v[6], v[3], v[4], v[5]}, {v[0], v[1], v[2]}, line.place());
}

/// TUM's own cameras, by the folder's name: rgbd_dataset_freiburg1_desk.
std::optional<Intrinsics> published_intrinsics(const fs::path& source) {
  const std::string name = fs::weakly_canonical(source).filename().string();
  if (name.find("freiburg1") != std::string::npos) {
    return Intrinsics{640, 480, 517.3, 516.5, 318.6, 255.3};
  }
  if (name.find("freiburg2") != std::string::npos) {
    return Intrinsics{640, 480, 520.9, 521.0, 325.1, 249.7};
  }
  if (name.find("freiburg3") != std::string::npos) {
    return Intrinsics{640, 480, 535.4, 539.2, 320.1, 247.6};
  }
  return std::nullopt;
}

Lens tum_lens(const fs::path& source, const std::optional<Lens>& lens, ImportedDataset& dataset) {
  if (lens) return *lens;
  const auto published = published_intrinsics(source);
  if (!published) {
    throw bad_input(
        source.string(),
        "a TUM RGB-D folder has no intrinsics, and its name contains none of freiburg1, freiburg2 "
        "and freiburg3, whose intrinsics are known; give them with --calibration FILE");
  }
  dataset.warnings.push_back(
      fmt::format("{}: the intrinsics are those that TUM published for this camera, fx {} fy {} cx "
                  "{} cy {}, without lens distortion; --calibration FILE replaces them",
                  source.string(), published->fx, published->fy, published->cx, published->cy));
  return {*published, {}};
}

}  // namespace

bool detect_tum(const fs::path& source) {
  return fs::is_regular_file(source / "depth.txt") && fs::is_regular_file(source / "rgb.txt");
}

ImportedDataset read_tum(const fs::path& source, const std::optional<Lens>& lens) {
  ImportedDataset dataset{"TUM RGB-D", kTumScale_mm};
  const Lens used = tum_lens(source, lens, dataset);
  const fs::path poses_file = source / "groundtruth.txt";
  dataset.files = {source / "rgb.txt", source / "depth.txt"};
  const auto colors = moments(dataset.files[0]), depths = moments(dataset.files[1]);
  std::vector<TumMoment> poses;
  if (fs::exists(poses_file)) {
    poses = moments(poses_file);
    dataset.files.push_back(poses_file);
  } else {
    dataset.warnings.push_back(fmt::format(
        "{}: missing, so no camera has a pose; give the workcell a board to locate them by",
        poses_file.string()));
  }
  std::size_t without_depth = 0, without_pose = 0;
  for (const TumMoment& color : colors) {
    const TumMoment* depth = nearest(depths, color.time_s);
    const TumMoment* pose = nearest(poses, color.time_s);
    without_depth += depth == nullptr, without_pose += depth && !pose && !poses.empty();
    if (!depth || (!pose && !poses.empty())) continue;
    ImportedImage image{color.line.word(0, "a time"), used.intrinsics(), used.distortion()};
    image.color = source / color.line.rest(1, "a picture's file");
    image.depth = source / depth->line.rest(1, "a depth image's file");
    if (pose) image.T_world_cam = pose_of(pose->line);
    dataset.images.push_back(std::move(image));
  }
  if (without_depth + without_pose > 0) {
    dataset.warnings.push_back(fmt::format(
        "{}: left out {} of {} pictures: {} without depth and {} without a pose within {} s",
        source.string(), without_depth + without_pose, colors.size(), without_depth, without_pose,
        kMaxApart_s));
  }
  return dataset;
}

}  // namespace vantage
