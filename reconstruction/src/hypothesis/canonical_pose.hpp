#pragma once

#include "hypothesis/expand_consensus.hpp"

namespace vantage::reconstruction::detail {

/// Of the poses that the type's symmetries make the same, and that the features in use cannot tell
/// apart, the one whose rotation is closest to the identity (the first of equals); the
/// correspondences' features go with it. Features that stand on one side only, as printed markers
/// do, settle which side that is: such a pose stays as it is.
struct CanonicalPose {
  Pose T_world_object;
  std::vector<std::size_t> features;  ///< of the type, one for each correspondence
};
CanonicalPose canonical_pose(const PoseHypothesis& hypothesis);

/// `information` without what it claims to know of turns around the type's axes of symmetry, if the
/// features in use say nothing of them.
Matrix6d without_symmetric_turns(const PoseHypothesis& hypothesis, const Matrix6d& information);

}  // namespace vantage::reconstruction::detail
