// Private: from measurements to votes over (type, 6DoF).
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "hypothesis/expand_consensus.hpp"
#include "voting/vote_table.hpp"

namespace vantage::reconstruction::detail {

/// What the measurements may be: `correspondences[first[i]]` to `correspondences[first[i + 1]]`,
/// without the last, are those of measurement i, which is their `number`. A label has none.
struct CandidateCorrespondences {
  std::span<const Measurement> measurements;
  std::vector<Correspondence> correspondences;
  std::vector<std::size_t> first;

  std::span<const Correspondence> of(std::size_t measurement) const {
    return {correspondences.data() + first[measurement],
            correspondences.data() + first[measurement + 1]};
  }
};
CandidateCorrespondences candidate_correspondences(std::span<const Measurement> measurements);

/// A pose that a measurement, or a group of single points in one view, implies for a type.
struct Vote {
  std::vector<const Correspondence*> correspondences;  ///< one, or three of different measurements
  Pose T_world_object;
  Matrix6d covariance;  ///< of that pose; with the camera's
  std::int64_t weight = 0;

  const ObjectType* type() const { return &correspondences.front()->type(); }
};

/// Every measurement has one vote for each type that it may be of. Several features of the type
/// with its key and the two flips of a marker share it, the flips by their likelihood (none gets
/// less than a twentieth: corners may be worse than they claim). Poses that a symmetry makes the
/// same have a whole one each. Single points of a view share theirs among groups of three
/// neighbours and among the up to four poses of each; at most six groups for a point, so that their
/// number stays proportional to that of the points. In the order of the measurements, then of the
/// groups; at any number of threads.
std::vector<Vote> cast_votes(const CandidateCorrespondences& candidates,
                             const InlierThresholds& thresholds);

/// The three points at a time of the above: for each group, one of its correspondences per
/// measurement.
using CorrespondenceGroup = std::array<const Correspondence*, 3>;
std::vector<CorrespondenceGroup> group_points(const CandidateCorrespondences& candidates);

/// Whether a measurement that is read so has a pose of its own.
bool has_pose(const Correspondence& correspondence);

/// A vote with its weight, from correspondences of one view and a pose that they imply.
Vote vote_for(std::vector<const Correspondence*> correspondences, const Pose& T_world_object,
              double weight, const InlierThresholds& thresholds);

}  // namespace vantage::reconstruction::detail
