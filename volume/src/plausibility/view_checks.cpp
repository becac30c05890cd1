#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plausibility/checks.hpp"
#include "plausibility/pose_readings.hpp"
#include "vantage/volume/plausibility.hpp"

namespace vantage::volume::detail {
namespace {

constexpr double kSeesNothing = 0;
constexpr std::size_t kFewCameras = 8;

/// Poses by which the images show little of the work area and measure next to nothing in it, while
/// by another reading of the same numbers they do.
std::string misread_poses(const std::vector<const SampledCamera*>& cameras, const Box& work_area) {
  constexpr double kLittle = 0.1, kMuch = 0.2, kTimes = 4;
  const AreaFit given = fit_of(cameras, nullptr, work_area);
  const PoseReading* reading = better_reading(cameras, work_area);
  if (reading == nullptr || given.measured > kLittle) return {};
  const AreaFit meant = fit_of(cameras, reading, work_area);
  if (meant.measured < std::max(kMuch, kTimes * given.measured)) return {};
  return fmt::format(
      "little is measured in the work area ({:.2g} % of the readings lie "
      "there): {:.0f} % would if {}",
      100 * given.measured, 100 * meant.measured, reading->cause);
}

std::string cause_of(const std::vector<const SampledCamera*>& cameras, const Box& work_area) {
  const PoseReading* reading = better_reading(cameras, work_area);
  if (reading != nullptr) return fmt::format("it fits if {}", reading->cause);
  return "check the poses (world-to-camera: cam_R_w2c, and cam_t_w2c in millimetres; x right, y "
         "down, z forward) and the work area (metres, in the same world frame)";
}

/// Empty where a part of the work area lies between the near and the far limit.
std::string range_misfit(const PinholeCamera& camera, const Box& work_area) {
  const Pose T_cam_world = camera.T_world_cam().inverse();
  double nearest_m = std::numeric_limits<double>::max(), farthest_m = -nearest_m;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d at = work_area.min();
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0) at[axis] = work_area.max()[axis];
    }
    const double depth_m = (T_cam_world * at).z();
    nearest_m = std::min(nearest_m, depth_m), farthest_m = std::max(farthest_m, depth_m);
  }
  const DepthRange& range = camera.range();
  if (nearest_m <= range.far_m && farthest_m >= range.near_m) return {};
  return fmt::format(
      "the work area lies {:.3g} to {:.3g} m before it, and its depth range is {:g} "
      "to {:g} m: check the pose, and the depth range (--depth-range, sensor: "
      "depth_range_m)",
      nearest_m, farthest_m, range.near_m, range.far_m);
}

}  // namespace

void check_views(const std::vector<SampledCamera>& cameras, const Box& work_area,
                 Findings& findings) {
  std::vector<const SampledCamera*> blind;
  for (const SampledCamera& camera : cameras) {
    if (camera.coverage <= kSeesNothing) blind.push_back(&camera);
  }
  if (!blind.empty() && blind.size() == cameras.size()) {
    findings.push_back(fmt::format("no image sees the work area: {}", cause_of(blind, work_area)));
  } else {
    // A long recording has images that look elsewhere; each of a few cameras should see something.
    if (cameras.size() > kFewCameras) blind.clear();
    for (const SampledCamera* camera : blind) {
      findings.push_back(fmt::format("image {} shows nothing of the work area: {}",
                                     camera->camera->name, cause_of({camera}, work_area)));
    }
    std::vector<const SampledCamera*> all;
    for (const SampledCamera& camera : cameras) all.push_back(&camera);
    std::string misread = misread_poses(all, work_area);
    if (!misread.empty()) findings.push_back(std::move(misread));
  }
  for (const SampledCamera& camera : cameras) {
    const bool said = !findings.empty() || camera.coverage <= kSeesNothing;
    if (said || cameras.size() > kFewCameras) continue;
    const std::string odd = range_misfit(camera.camera->camera, work_area);
    if (!odd.empty()) findings.push_back(fmt::format("image {}: {}", camera.camera->name, odd));
  }
  for (const SampledCamera& camera : cameras) {
    const std::string odd = resolution_misfit(camera.camera->camera.intrinsics());
    if (!odd.empty()) findings.push_back(fmt::format("image {}: {}", camera.camera->name, odd));
  }
}

}  // namespace vantage::volume::detail

namespace vantage {

std::string resolution_misfit(const Intrinsics& k) {
  constexpr double kOff = 0.12, kCentred = 0.06;  // of the image's size
  const auto off = [&](double factor) {
    return std::max(std::abs(factor * k.cx - 0.5 * (k.width - 1)) / k.width,
                    std::abs(factor * k.cy - 0.5 * (k.height - 1)) / k.height);
  };
  if (off(1) < kOff) return {};
  struct Factor {
    double value;
    const char* words;
  };
  constexpr std::array kFactors = {
      Factor{0.5, "twice as large"},           Factor{2, "half as large"},
      Factor{1.0 / 3, "three times as large"}, Factor{3, "a third as large"},
      Factor{0.25, "four times as large"},     Factor{4, "a quarter as large"},
      Factor{2.0 / 3, "1.5 times as large"},   Factor{1.5, "two thirds as large"}};
  for (const Factor& factor : kFactors) {
    if (off(factor.value) > kCentred) continue;
    return fmt::format(
        "the principal point ({:.6g}, {:.6g}) is the middle of an image {} as this one of {} x {} "
        "pixels: the intrinsics are those of another resolution; multiply fx, fy, cx and cy by "
        "{:.4g}",
        k.cx, k.cy, factor.words, k.width, k.height, factor.value);
  }
  const bool turned = std::abs(k.cx - 0.5 * (k.height - 1)) / k.height < kCentred &&
                      std::abs(k.cy - 0.5 * (k.width - 1)) / k.width < kCentred;
  if (!turned) return {};
  return fmt::format(
      "the principal point ({:.6g}, {:.6g}) is the middle of an image of {} x {} pixels, and this "
      "one has {} x {}: was the picture rotated by 90 degrees?",
      k.cx, k.cy, k.height, k.width, k.width, k.height);
}

}  // namespace vantage
