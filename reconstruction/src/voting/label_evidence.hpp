#pragma once

#include <map>
#include <memory>
#include <vector>

#include "voting/type_body.hpp"
#include "voting/votes.hpp"

namespace vantage::reconstruction::detail {

/// What is said of an object by those that have no pose to vote for.
struct LabelVotes {
  std::vector<std::pair<std::size_t, std::size_t>> labels;  ///< measurement, feature: votes for it
  std::size_t against = 0;                                  ///< votes against it
};

/// Markers and labels, where they are in space. A type whose surface would be there, or would hide
/// what was seen there, and that does not carry such a feature there, gets a vote against it
/// (thesis, section 6.2: "negative votes on nearby 6DoF"); a type that carries the label there gets
/// one for it. Single points have no place in space, and poses lie inside of bodies: they vote for
/// their types alone.
class LabelEvidence {
 public:
  LabelEvidence(const CandidateCorrespondences& candidates, const std::vector<Vote>& votes);

  /// @param slack_m how far the pose may be off.
  /// @param free measurements that no object has yet: other labels are not counted.
  LabelVotes label_votes(const ObjectType& type, const Pose& T_world_object, double slack_m,
                         const std::vector<bool>& free) const;

  /// Where an object puts its markers is better known than where single cameras see them.
  void place(const std::vector<const Correspondence*>& correspondences, const Pose& T_world_object);

  const TypeBody& body(const ObjectType& type) const { return *bodies_.at(&type); }

 private:
  struct SeenFeature {
    std::size_t number = 0;  // of the measurement
    Eigen::Vector3d p_world;
    double sigma_m = 0;
  };
  const TypeFeature* carried(const SeenFeature& witness, const ObjectType& type,
                             const Pose& T_world_object, double tolerance_m) const;

  void sort();

  const CandidateCorrespondences* candidates_;
  std::vector<SeenFeature> label_evidence_;                        // ascending by x
  std::map<const ObjectType*, std::unique_ptr<TypeBody>> bodies_;  // never walked
};

}  // namespace vantage::reconstruction::detail
