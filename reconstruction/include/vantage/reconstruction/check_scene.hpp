#pragma once

#include <span>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage {

/// What is known of the scene beside the objects.
struct SceneKnowledge {
  std::vector<KnownObject> solids = {};  ///< static structures, and the board's plate
  /// For each view, points of the world that it certainly saw: corners of the board's markers by
  /// which it was located. Four for each marker. May be empty.
  std::vector<std::vector<Eigen::Vector3d>> seen_points = {};
  std::vector<DepthCamera> depth = {};  ///< of the same time; of these or other cameras
};

/// Which kinds of evidence count; all by default.
struct EvidenceKinds {
  bool missing_features = true, depth = true, structures = true, other_objects = true;
};

/// Weighs each object by what the cameras saw of one instant, and takes those out that are less
/// likely there than not. Sets their `evidence` and `probability`:
///
/// - features that were seen where the object has them, and features that should have been seen and
///   were not: by rays, and by the detector's recall (`detector_recall`);
/// - depth images: a surface is measured where it has one, or what lies behind it; what stops in
///   front says nothing, unless a feature was seen there;
/// - a structure hides what was seen of it (an object below the table), or is where it would be;
/// - it would hide a marker of the board that a camera saw;
/// - it and another object would hide each other's seen features, or overlap: the evidence decides
///   which of them is there.
///
/// Objects that are taken out stand in `rejected` with the reason; their observations become
/// unexplained. Where the markers of a type seen by several cameras would fit each other in another
/// size, the reason says which. Distances below three standard deviations of a pose contradict
/// nothing.
/// Thread-safe; deterministic.
VANTAGE_API void reject_contradicted(std::span<const CameraView> views,
                                     const SceneKnowledge& knowledge, Reconstruction& result,
                                     const EvidenceKinds& kinds = {});

/// Finds objects that one image sees elsewhere than the others do, by leaving out one image after
/// the other: something moved between two pictures. Sets their `warning`, and widens their
/// covariance by the motion.
VANTAGE_API void warn_of_motion(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                                const ReconstructOptions& options, const StopToken& stop,
                                Reconstruction& result);

}  // namespace vantage
