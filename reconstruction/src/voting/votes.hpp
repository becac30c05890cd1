// Private: from sightings to votes over (type, 6DoF).
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "hypothesis/expand_consensus.hpp"
#include "voting/vote_table.hpp"

namespace vantage::detail {

/// What the sightings may be: `readings[first[i]]` to `readings[first[i + 1]]`, without the last,
/// are those of sighting i, which is their `number`. A label has none.
struct Ballot {
  std::span<const Sighting> sightings;
  std::vector<Reading> readings;
  std::vector<std::size_t> first;

  std::span<const Reading> of(std::size_t sighting) const {
    return {readings.data() + first[sighting], readings.data() + first[sighting + 1]};
  }
};
Ballot ballot_of(std::span<const Sighting> sightings);

/// A pose that a sighting, or a group of single points in one view, implies for a type.
struct Vote {
  std::vector<const Reading*> readings;  ///< one, or three of different sightings
  Pose T_world_object;
  Matrix6d covariance;  ///< of that pose; with the camera's
  std::int64_t weight = 0;

  const ObjectType* type() const { return &readings.front()->type(); }
};

/// Every sighting has one vote for each type that it may be of. Several features of the type with
/// its key and the two flips of a marker share it, the flips by their likelihood (none gets less
/// than a twentieth: corners may be worse than they claim). Poses that a symmetry makes the same
/// have a whole one each. Single points of a view share theirs among groups of three neighbours and
/// among the up to four poses of each; at most six groups for a point, so that their number stays
/// proportional to that of the points.
/// In the order of the sightings, then of the groups; at any number of threads.
std::vector<Vote> cast_votes(const Ballot& ballot, const Bounds& bounds);

/// The three points at a time of the above: for each group, one of its readings per sighting.
using ReadingGroup = std::array<const Reading*, 3>;
std::vector<ReadingGroup> group_points(const Ballot& ballot);

/// Whether a sighting that is read so has a pose of its own.
bool has_pose(const Reading& reading);

/// A vote with its weight, from readings of one view and a pose that they imply.
Vote vote_for(std::vector<const Reading*> readings, const Pose& T_world_object, double weight,
              const Bounds& bounds);

}  // namespace vantage::detail
