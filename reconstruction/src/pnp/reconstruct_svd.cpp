#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hypothesis/collect_measurements.hpp"
#include "pose/kabsch.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage {
namespace reconstruction::detail {
namespace {

/// A measurement's points in space, as its camera alone finds them.
struct Placed {
  const Measurement* measurement = nullptr;
  const TypeFeature* feature = nullptr;
  std::vector<Eigen::Vector3d> p_object, p_world;
};

/// Why the measurement cannot be placed; empty, and `placed` filled in, if it can.
std::string place(const Measurement& measurement, Placed& placed) {
  if (!measurement.points()) return "the SVD method uses points only";
  if (measurement.features.size() > 1) {
    return fmt::format(
        "{} is on {} places of the knowledge base; the SVD method needs features "
        "that are on one",
        name_of(measurement.observation->key), measurement.features.size());
  }
  placed.measurement = &measurement;
  placed.feature = measurement.features.front();
  placed.p_object = placed.feature->type->features[placed.feature->index].points();
  if (placed.p_object.size() < 4) return "one camera needs four points to place them in space";
  const auto guesses =
      solve_pnp(measurement.view->lens, placed.p_object, measurement.points()->pixels);
  if (guesses.empty()) return "no pose of its points explains the pixels: are they collinear?";
  const Pose T_world_body = *measurement.view->T_world_cam * guesses.front().T_cam_body;
  for (const Eigen::Vector3d& point : placed.p_object) {
    placed.p_world.push_back(T_world_body * point);
  }
  return {};
}

double rms_px(const Placed& placed, const Pose& T_world_object) {
  const auto& pixels = placed.measurement->points()->pixels;
  double sum = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Eigen::Vector3d p_cam =
        placed.measurement->T_cam_world * (T_world_object * placed.p_object[i]);
    sum += (placed.measurement->lens->project(p_cam) - pixels[i]).squaredNorm();
  }
  return std::sqrt(sum / double(pixels.size()));
}

void reconstruct_type(const std::vector<Placed>& placed, Reconstruction& result) {
  std::vector<Eigen::Vector3d> from, to;
  for (const Placed& p : placed) {
    from.insert(from.end(), p.p_object.begin(), p.p_object.end());
    to.insert(to.end(), p.p_world.begin(), p.p_world.end());
  }
  const auto pose = kabsch(from, to);
  if (!pose) {
    for (const Placed& p : placed) {
      result.unexplained.push_back({p.measurement->id, "its type's points are collinear"});
    }
    return;
  }
  ReconstructedObject object{placed.front().feature->type, *pose};
  double sum = 0;
  for (const Placed& p : placed) {
    const double rms = rms_px(p, *pose);
    object.support.push_back({p.measurement->id, p.feature->index, rms});
    sum += rms * rms * double(p.p_object.size());
  }
  object.rms_px = std::sqrt(sum / double(from.size()));
  result.objects.push_back(std::move(object));
}

}  // namespace
}  // namespace reconstruction::detail

Reconstruction reconstruct_svd(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                               const ReconstructOptions& options, const StopToken& stop) {
  using namespace reconstruction::detail;
  CollectedMeasurements collected = collect_measurements(views, knowledge, options);
  Reconstruction result{{}, std::move(collected.unexplained), StopReason::none};
  std::map<std::string, std::vector<Placed>> by_type;
  stop.expect(collected.measurements.size());
  for (const Measurement& measurement : collected.measurements) {
    if (result.stopped == StopReason::none) result.stopped = stop.reason();
    Placed placed;
    const std::string reason = result.stopped == StopReason::none ? place(measurement, placed)
                                                                  : "not processed: stopped before";
    stop.advance(1);
    if (reason.empty()) {
      by_type[placed.feature->type->name].push_back(std::move(placed));
    } else {
      result.unexplained.push_back({measurement.id, reason});
    }
  }
  for (const auto& [name, placed] : by_type) reconstruct_type(placed, result);
  sort_result(knowledge, result);
  return result;
}

}  // namespace vantage
