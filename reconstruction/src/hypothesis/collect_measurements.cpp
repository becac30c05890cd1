#include "hypothesis/collect_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kSamePx = 0.5;    // two detectors' corners of one marker are nearer
constexpr double kSameSigmas = 3;  // of poses and labels

void check(const ReconstructOptions& options) {
  const auto positive = [](const char* name, double value) {
    if (value > 0 && std::isfinite(value)) return;
    throw bad_input(fmt::format("options: {}", name),
                    fmt::format("found {}; expected a positive, finite number", value));
  };
  positive("inlier_px", options.inlier_px);
  positive("merge_m", options.merge_m);
  positive("min_evidence", options.min_evidence);
}

void check(const CameraView& view) {
  if (!view.T_world_cam || view.covariance.allFinite()) return;
  throw bad_input("views: " + view.name,
                  "the covariance of its pose is not finite; zero stands for an exact pose");
}

bool of_its_kind(const Observation& observation, const ObjectFeature& feature) {
  if (const auto* seen = std::get_if<SeenPoints>(&observation.data)) {
    const std::size_t count = feature.points().size();
    return count > 0 && count == seen->pixels.size();
  }
  if (std::holds_alternative<SeenPose>(observation.data)) return frame_of(feature) != nullptr;
  return std::holds_alternative<FeatureLabel>(feature.geometry);
}

bool same_place(const SeenPoints& a, const SeenPoints& b) {
  if (a.pixels.size() != b.pixels.size()) return false;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if ((a.pixels[i] - b.pixels[i]).norm() > kSamePx) return false;
  }
  return true;
}

bool same_place(const SeenPose& a, const SeenPose& b) {
  const Pose between = a.T_cam_feature.inverse() * b.T_cam_feature;
  const double turn = Eigen::AngleAxisd(between.rotation()).angle();
  return between.translation().norm() <= kSameSigmas * std::max(a.sigma_m, b.sigma_m) &&
         turn <= kSameSigmas * std::max(a.sigma_rad, b.sigma_rad);
}

bool same_place(const SeenLabel& a, const SeenLabel& b) {
  return (a.p_cam_m - b.p_cam_m).norm() <= kSameSigmas * std::max(a.sigma_m, b.sigma_m);
}

bool repeats(const Observation& later, const Observation& earlier) {
  if (later.data.index() != earlier.data.index()) return false;
  return std::visit(
      [&](const auto& seen) {
        return same_place(seen, std::get<std::decay_t<decltype(seen)>>(earlier.data));
      },
      later.data);
}

/// The observations of one view, one after the other.
class ViewReader {
 public:
  ViewReader(const CameraView& view, const KnowledgeBase& knowledge)
      : view_(view), knowledge_(knowledge) {
    if (!view.T_world_cam) return;
    T_cam_world_ = view.T_world_cam->inverse();
    lens_ = std::make_shared<const WideLens>(view.lens);
  }

  /// Why `measurement` cannot be used; empty, and `measurement` filled in, if it can.
  std::string read(std::size_t index, Measurement& measurement) {
    const Observation& observation = view_.observations[index];
    if (!view_.T_world_cam) return "its camera is not located";
    const std::string fault = fault_of(observation);
    if (!fault.empty()) return fault;
    const auto& features = knowledge_.with_feature(observation.key);
    if (features.empty()) {
      return name_of(observation.key) + " is not on any type of the knowledge base";
    }
    for (const TypeFeature& feature : features) {
      if (of_its_kind(observation, feature.type->features[feature.index])) {
        measurement.features.push_back(&feature);
      }
    }
    if (measurement.features.empty()) {
      return fmt::format("{} is known, but not as a feature of this kind with this many points",
                         name_of(observation.key));
    }
    for (const std::size_t earlier : by_key_[observation.key]) {
      if (repeats(observation, view_.observations[earlier])) {
        return fmt::format("repeats observation {}", earlier);
      }
    }
    by_key_[observation.key].push_back(index);
    measurement.view = &view_;
    measurement.observation = &observation;
    measurement.T_cam_world = T_cam_world_;
    measurement.lens = lens_;
    return {};
  }

 private:
  const CameraView& view_;
  const KnowledgeBase& knowledge_;
  Pose T_cam_world_;
  std::shared_ptr<const WideLens> lens_;
  std::map<FeatureKey, std::vector<std::size_t>> by_key_;
};

}  // namespace

const Pose* frame_of(const ObjectFeature& feature) {
  if (const auto* marker = std::get_if<Marker>(&feature.geometry)) return &marker->T_object_marker;
  if (const auto* pose = std::get_if<FeaturePose>(&feature.geometry)) {
    return &pose->T_object_feature;
  }
  return nullptr;
}

std::string name_of(const FeatureKey& key) {
  return (key.type == "aruco" ? "marker" : key.type) + " " + key.value;
}

CollectedMeasurements collect_measurements(std::span<const CameraView> views,
                                           const KnowledgeBase& knowledge,
                                           const ReconstructOptions& options) {
  check(options);
  for (const CameraView& view : views) check(view);
  CollectedMeasurements collected;
  for (std::size_t v = 0; v < views.size(); ++v) {
    ViewReader reader(views[v], knowledge);
    for (std::size_t o = 0; o < views[v].observations.size(); ++o) {
      Measurement measurement{{v, o}};
      std::string reason = reader.read(o, measurement);
      if (reason.empty()) {
        collected.measurements.push_back(std::move(measurement));
      } else {
        collected.unexplained.push_back({{v, o}, std::move(reason)});
      }
    }
  }
  return collected;
}

void sort_result(const KnowledgeBase& knowledge, Reconstruction& result) {
  std::map<const ObjectType*, std::size_t> rank;
  for (const TypePtr& type : knowledge.types()) rank.emplace(type.get(), rank.size());
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  for (ReconstructedObject& object : result.objects) {
    std::stable_sort(object.support.begin(), object.support.end(), by_id);
  }
  const auto first = [](const ReconstructedObject& object) {
    return object.support.empty() ? ObservationId{} : object.support.front().id;
  };
  std::stable_sort(result.objects.begin(), result.objects.end(), [&](const auto& a, const auto& b) {
    const std::size_t rank_a = rank[a.type.get()], rank_b = rank[b.type.get()];
    return rank_a != rank_b ? rank_a < rank_b : first(a) < first(b);
  });
  std::stable_sort(result.unexplained.begin(), result.unexplained.end(), by_id);
}

}  // namespace vantage::reconstruction::detail
