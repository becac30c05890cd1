#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plausibility/checks.hpp"
#include "plausibility/pose_readings.hpp"

namespace vantage::volume::detail {
namespace {

constexpr std::size_t kCommon = 150;   ///< samples that both see, below which nothing is said
constexpr double kContradicted = 0.5;  ///< share of them
constexpr double kNoise = 0.02;        ///< metres, and the same per metre of depth

struct Common {
  std::size_t samples = 0;  ///< readings of one camera, in or close to the work area, that the
                            ///< other one has a reading for
  std::size_t through = 0;  ///< those that the other one sees through

  void add(const Common& more) {
    samples += more.samples;
    through += more.through;
  }
  double share() const { return samples < kCommon ? 0 : double(through) / double(samples); }
};

Common seen_through(const SampledCamera& measuring, const PinholeCamera& from,
                    const SampledCamera& judging, const PinholeCamera& by, const Box& near_area) {
  const DepthRange range = from.range();
  const DepthImage& depth = *judging.camera->depth;
  Common common;
  for (const DepthSample& sample : measuring.depths) {
    if (sample.depth_m < range.near_m || sample.depth_m > range.far_m) continue;
    const Eigen::Vector3d point = from.unproject(sample.u, sample.v, sample.depth_m);
    if (!near_area.contains(point)) continue;
    const auto pixel = by.project(point);
    if (!pixel) continue;
    const double u = std::round(pixel->u), v = std::round(pixel->v);
    if (!(u >= 0 && u < depth.width() && v >= 0 && v < depth.height())) continue;
    const double reading = double(depth.at(int(u), int(v)));
    if (std::isnan(reading) || reading < by.range().near_m) continue;
    ++common.samples;
    common.through += reading > pixel->depth + kNoise * (1 + pixel->depth + sample.depth_m);
  }
  return common;
}

/// A camera against all others: what they see through of what it measures, and the other way round.
/// One that is wrong measures a surface where the others see none, or sees through theirs.
struct Contradiction {
  Common measuring, judging;
  double share() const { return std::max(measuring.share(), judging.share()); }
};

/// Of each camera; the poses are read as `reading` says.
std::vector<Contradiction> contradictions(const std::vector<SampledCamera>& cameras,
                                          const PoseReading* reading, const Box& work_area) {
  const Box near_area = grown(work_area, 0.1);
  std::vector<PinholeCamera> posed;
  for (const SampledCamera& camera : cameras) {
    const PinholeCamera& given = camera.camera->camera;
    posed.push_back(reading ? given.moved_to(reading->of(given.T_world_cam())) : given);
  }
  std::vector<Contradiction> of_camera(cameras.size());
  for (std::size_t a = 0; a < cameras.size(); ++a) {
    for (std::size_t b = 0; b < cameras.size(); ++b) {
      if (a == b || !cameras[a].camera->depth || !cameras[b].camera->depth) continue;
      const Common common = seen_through(cameras[a], posed[a], cameras[b], posed[b], near_area);
      of_camera[a].measuring.add(common);
      of_camera[b].judging.add(common);
    }
  }
  return of_camera;
}

std::string cause_of(const std::vector<SampledCamera>& cameras, const Box& work_area) {
  constexpr double kSolved = 0.1;
  std::vector<const SampledCamera*> all;
  for (const SampledCamera& camera : cameras) all.push_back(&camera);
  const PoseReading* reading = better_reading(all, work_area);
  const auto agrees = [](const Contradiction& camera) { return camera.share() < kSolved; };
  if (reading && std::ranges::all_of(contradictions(cameras, reading, work_area), agrees)) {
    return fmt::format("they agree if {}", reading->cause);
  }
  return "a pose, intrinsics or a depth scale is wrong, or something moved between the images";
}

}  // namespace

void check_agreement(const std::vector<SampledCamera>& cameras, const Box& work_area,
                     Findings& findings) {
  const std::vector<Contradiction> all = contradictions(cameras, nullptr, work_area);
  const auto worst = std::ranges::max_element(all, {}, &Contradiction::share);
  if (worst == all.end() || worst->share() < kContradicted) return;
  const std::string who = cameras.size() == 2
                              ? fmt::format("images {} and {} contradict each other",
                                            cameras[0].camera->name, cameras[1].camera->name)
                              : fmt::format("image {} and the others contradict each other",
                                            cameras[std::size_t(worst - all.begin())].camera->name);
  findings.push_back(fmt::format(
      "{}: {:.0f} % of the surface that one measures in and around the work area is seen through "
      "by another; {}",
      who, 100 * worst->share(), cause_of(cameras, work_area)));
}

}  // namespace vantage::volume::detail
