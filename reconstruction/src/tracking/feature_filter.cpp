#include "tracking/feature_filter.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "hypothesis/generalized_least_squares.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kMinWeight = 0.05;

/// A feature with this weight is as good as one with a larger standard deviation.
Observation with_weight(Observation observation, double weight) {
  const double factor = 1 / std::sqrt(weight);
  if (auto* points = std::get_if<SeenPoints>(&observation.data)) points->sigma_px *= factor;
  if (auto* pose = std::get_if<SeenPose>(&observation.data)) {
    pose->sigma_m *= factor;
    pose->sigma_rad *= factor;
  }
  return observation;
}

}  // namespace

PoseMeasurement FeatureFilter::update(TrackId id, const ReconstructedObject& object,
                                      const Place& place, double time_s,
                                      std::span<const CameraView> views) {
  std::vector<Remembered>& memory = remembered_[id];
  std::erase_if(memory, [&](const Remembered& old) {
    return old.time_s < place.since_s || std::exp((old.time_s - time_s) / decay_s_) < kMinWeight;
  });
  for (const Support& support : object.support) {
    memory.push_back({time_s, support.id.view, support.feature,
                      views[support.id.view].observations[support.id.observation]});
  }
  std::vector<Observation> weighted;
  std::vector<TypeFeature> features;
  std::vector<std::shared_ptr<const WideLens>> lenses(views.size());
  for (const Remembered& old : memory) {
    weighted.push_back(with_weight(old.observation, std::exp((old.time_s - time_s) / decay_s_)));
    features.push_back({object.type, old.feature});
    auto& lens = lenses[old.view];
    if (!lens) lens = std::make_shared<WideLens>(views[old.view].lens);
  }
  std::vector<Measurement> measurements;
  std::vector<Correspondence> correspondences;
  measurements.reserve(memory.size());
  correspondences.reserve(memory.size());
  PoseHypothesis hypothesis{object.T_world_object, {}, {}, {}};
  for (std::size_t i = 0; i < memory.size(); ++i) {
    const CameraView& view = views[memory[i].view];
    const ObjectFeature& feature = object.type->features[memory[i].feature];
    const Pose* frame = frame_of(feature);
    measurements.push_back({{memory[i].view, i},
                            &view,
                            &weighted[i],
                            view.T_world_cam->inverse(),
                            lenses[memory[i].view],
                            {}});
    correspondences.push_back(
        {&measurements.back(), i, &features[i], feature.points(), frame ? *frame : Pose()});
    hypothesis.correspondences.push_back(&correspondences.back());
    hypothesis.each.push_back(linear_system_of(correspondences.back(), object.T_world_object, 0));
    hypothesis.sum.add(hypothesis.each.back());
  }
  const FinalFit fit = generalized_least_squares(std::move(hypothesis));
  return {fit.hypothesis.T_world_object, fit.covariance, Matrix6d::Zero()};
}

}  // namespace vantage::reconstruction::detail
