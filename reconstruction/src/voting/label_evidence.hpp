#pragma once

#include <map>
#include <memory>
#include <vector>

#include "voting/type_body.hpp"
#include "voting/votes.hpp"

namespace vantage::detail {

/// What is said of an object by those that have no pose to vote for.
struct Verdict {
  std::vector<std::pair<std::size_t, std::size_t>> labels;  ///< sighting, feature: votes for it
  std::size_t against = 0;                                  ///< votes against it
};

/// Markers and labels, where they are in space. A type whose surface would be there, or would hide
/// what was seen there, and that does not carry such a feature there, gets a vote against it
/// (thesis, section 6.2: "negative votes on nearby 6DoF"); a type that carries the label there gets
/// one for it. Single points have no place in space, and poses lie inside of bodies: they vote for
/// their types alone.
class Witnesses {
 public:
  Witnesses(const Ballot& ballot, const std::vector<Vote>& votes);

  /// @param slack_m how far the pose may be off.
  /// @param free sightings that no object has yet: other labels are not counted.
  Verdict verdict(const ObjectType& type, const Pose& T_world_object, double slack_m,
                  const std::vector<bool>& free) const;

  /// Where an object puts its markers is better known than where single cameras see them.
  void place(const std::vector<const Reading*>& readings, const Pose& T_world_object);

  const TypeBody& body(const ObjectType& type) const { return *bodies_.at(&type); }

 private:
  struct Witness {
    std::size_t number = 0;  // of the sighting
    Eigen::Vector3d p_world;
    double sigma_m = 0;
  };
  const TypeFeature* carried(const Witness& witness, const ObjectType& type,
                             const Pose& T_world_object, double tolerance_m) const;

  void sort();

  const Ballot* ballot_;
  std::vector<Witness> witnesses_;                                 // ascending by x
  std::map<const ObjectType*, std::unique_ptr<TypeBody>> bodies_;  // never walked
};

}  // namespace vantage::detail
