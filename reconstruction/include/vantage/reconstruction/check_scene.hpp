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
};

/// Takes objects out of a reconstruction that the scene contradicts, by the geometry of one
/// instant:
///
/// - a camera could not see the object's features where they would be, as a solid hides them (an
///   object below the table);
/// - the object would hide something that a camera saw: a marker of the board, or of an object that
///   more observations speak for;
/// - it would stand inside another object with more support.
///
/// Their observations become unexplained, with the reason; where the markers of a type seen by
/// several cameras would fit each other in another size, the reason says which. Distances below
/// three standard deviations of a pose contradict nothing.
/// Thread-safe; deterministic.
VANTAGE_API void reject_contradicted(std::span<const CameraView> views,
                                     const SceneKnowledge& knowledge, Reconstruction& result);

/// Finds objects that one image sees elsewhere than the others do, by leaving out one image after
/// the other: something moved between two pictures. Sets their `warning`, and widens their
/// covariance by the motion.
VANTAGE_API void warn_of_motion(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                                const ReconstructOptions& options, const StopToken& stop,
                                Reconstruction& result);

}  // namespace vantage
