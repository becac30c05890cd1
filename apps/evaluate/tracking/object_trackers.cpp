#include "evaluate/tracking/tracking_benchmark.hpp"

namespace vantage {
namespace {

std::string filter_name(TemporalFilter filter) {
  switch (filter) {
    case TemporalFilter::none:
      return "none";
    case TemporalFilter::features:
      return "features";
    case TemporalFilter::kalman:
      break;
  }
  return "kalman";
}

}  // namespace

std::vector<EvaluatedTracker> object_trackers(std::span<const TemporalFilter> filters) {
  std::vector<EvaluatedTracker> trackers;
  for (const TemporalFilter filter : filters) {
    trackers.push_back({filter_name(filter),
                        [filter](std::shared_ptr<const KnowledgeBase> knowledge,
                                 const SceneKnowledge& scene) -> SnapshotTracker {
                          const auto tracker = std::make_shared<ObjectTracker>(
                              std::move(knowledge), scene, TrackOptions{.filter = filter});
                          return [tracker](const Snapshot& snapshot, const Reconstruction& alone) {
                            return tracker->update(snapshot, alone);
                          };
                        }});
  }
  return trackers;
}

}  // namespace vantage
