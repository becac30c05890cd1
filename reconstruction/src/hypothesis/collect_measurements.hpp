#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pose/extrapolated_lens.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

// Private: what the methods of reconstruction have in common before and after the work itself.
namespace vantage::reconstruction::detail {

/// An observation that can be used: sound, from a camera whose pose is known, and with features of
/// the knowledge base that it may be.
struct Measurement {
  ObservationId id = {};
  const CameraView* view = nullptr;
  const Observation* observation = nullptr;
  Pose T_cam_world = {};
  std::shared_ptr<const WideLens> lens = {};  ///< the view's
  /// Features with its key and of its kind: as many points, a frame for a pose (a marker has one
  /// too), labels for a label. In the order of the knowledge base, never empty.
  std::vector<const TypeFeature*> features = {};

  const SeenPoints* points() const { return std::get_if<SeenPoints>(&observation->data); }
  const SeenPose* pose() const { return std::get_if<SeenPose>(&observation->data); }
  const SeenLabel* label() const { return std::get_if<SeenLabel>(&observation->data); }
};

struct CollectedMeasurements {
  std::vector<Measurement> measurements;  ///< ascending by id
  std::vector<Unexplained> unexplained;   ///< the rest, each with its reason; ascending by id
};

/// Sorts out what cannot be used: faults, views without pose, unknown keys, features of another
/// kind, and what repeats an earlier observation of its view (the same key within half a pixel or
/// three standard deviations). The result points into `views` and `knowledge`.
/// @throws Error bad_input, "options" as the place, for bounds that are not positive and finite;
/// "views" for a covariance that is not finite.
CollectedMeasurements collect_measurements(std::span<const CameraView> views,
                                           const KnowledgeBase& knowledge,
                                           const ReconstructOptions& options);

/// The frame of a pose feature or of a marker, T_object_feature; null for the others.
const Pose* frame_of(const ObjectFeature& feature);

/// "marker 4X4/17", "keypoint spout": for reasons.
std::string name_of(const FeatureKey& key);

/// Brings objects, their support and the unexplained into the order that `Reconstruction` has.
void sort_result(const KnowledgeBase& knowledge, Reconstruction& result);

}  // namespace vantage::reconstruction::detail
