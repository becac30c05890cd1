#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pose/pose_manifold.hpp"
#include "vantage/reconstruction/check_scene.hpp"

namespace vantage {
namespace {

constexpr double kNotNoise = 4;       ///< times the noise of the observations
constexpr double kNotable_px = 0.75;  ///< a fit of a blurred or distorted marker is off by less
constexpr double kMostOfIt = 0.35;    ///< of the residual may be left without the odd image

/// The residuals in units of the observations' noise.
double noise_ratio(const ReconstructedObject& object, std::span<const CameraView> views) {
  double squares = 0;
  std::size_t count = 0;
  for (const Support& support : object.support) {
    const auto& seen = views[support.id.view].observations[support.id.observation].data;
    const auto* points = std::get_if<SeenPoints>(&seen);
    if (!points) continue;
    const double ratio = support.residual_px / points->sigma_px;
    squares += ratio * ratio;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(squares / double(count));
}

std::set<std::size_t> views_of(const ReconstructedObject& object) {
  std::set<std::size_t> views;
  for (const Support& support : object.support) views.insert(support.id.view);
  return views;
}

/// The views with nothing but what one object is made of, and that without one image.
std::vector<CameraView> without(std::span<const CameraView> views,
                                const ReconstructedObject& object, std::size_t left_out) {
  std::vector<CameraView> result(views.begin(), views.end());
  for (CameraView& view : result) view.observations.clear();
  for (const Support& support : object.support) {
    if (support.id.view == left_out) continue;
    result[support.id.view].observations.push_back(
        views[support.id.view].observations[support.id.observation]);
  }
  return result;
}

/// The object from all images but one; null if it falls apart or becomes something else.
const ReconstructedObject* same_object(const Reconstruction& without_one,
                                       const ReconstructedObject& object, std::size_t supports) {
  for (const ReconstructedObject& found : without_one.objects) {
    if (found.type == object.type && found.support.size() == supports) return &found;
  }
  return nullptr;
}

struct Motion {
  std::size_t view = 0;
  ReconstructedObject rest;  ///< from the other images
};

void note(const Motion& motion, std::span<const CameraView> views, ReconstructedObject& object) {
  Eigen::Matrix<double, 6, 1> step;
  step.head<3>() = motion.rest.T_world_object.translation() - object.T_world_object.translation();
  step.tail<3>() = reconstruction::detail::log_of(motion.rest.T_world_object.quaternion() *
                                                  object.T_world_object.quaternion().conjugate());
  if (object.covariance) *object.covariance += step * step.transpose();
  object.warning = fmt::format(
      "image {} disagrees with the others: without it the residuals fall from {:.2f} to {:.2f} px; "
      "the object moved between the pictures, or that camera's pose is wrong",
      views[motion.view].name, object.rms_px, motion.rest.rms_px);
}

}  // namespace

void warn_of_motion(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                    const ReconstructOptions& options, const StopToken& stop,
                    Reconstruction& result) {
  for (ReconstructedObject& object : result.objects) {
    const std::set<std::size_t> seeing = views_of(object);
    if (seeing.size() < 2 || object.rms_px < kNotable_px ||
        noise_ratio(object, views) < kNotNoise) {
      continue;
    }
    std::optional<Motion> best;
    for (const std::size_t view : seeing) {
      if (stop.stop_requested()) return;
      const std::vector<CameraView> rest = without(views, object, view);
      std::size_t supports = 0;
      for (const CameraView& other : rest) supports += other.observations.size();
      const Reconstruction found = reconstruct_pnp(rest, knowledge, options, stop);
      const ReconstructedObject* same = same_object(found, object, supports);
      if (same == nullptr || same->rms_px > kMostOfIt * object.rms_px) continue;
      if (!best || same->rms_px < best->rest.rms_px) best = Motion{view, *same};
    }
    if (!best) continue;
    note(*best, views, object);
    if (seeing.size() == 2) {
      object.warning = fmt::format(
          "images {} and {} disagree: each alone has residuals below {:.2f} px, both together "
          "{:.2f} "
          "px; the object moved between the pictures, or a camera's pose is wrong",
          views[*seeing.begin()].name, views[*seeing.rbegin()].name, kMostOfIt * object.rms_px,
          object.rms_px);
    }
  }
}

}  // namespace vantage
