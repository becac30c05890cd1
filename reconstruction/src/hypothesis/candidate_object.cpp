#include "hypothesis/candidate_object.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "hypothesis/canonical_pose.hpp"
#include "pose/rigid_motion.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::reconstruction::detail {
namespace {

/// The covariance of T * S from that of T: S moves the origin.
Matrix6d moved_origin(const Matrix6d& covariance, const Eigen::Vector3d& arm) {
  const Matrix6d by_pose = carried_along(arm);
  return by_pose * covariance * by_pose.transpose();
}

}  // namespace

ReconstructedObject object_of(const Candidate& candidate) {
  const PoseHypothesis& best = candidate.best();
  const CanonicalPose canonical = canonical_pose(best);
  ReconstructedObject object{best.type(), canonical.T_world_object};
  const FinalFit& fit = candidate.voted_hypotheses.front();
  const Eigen::Vector3d arm =
      canonical.T_world_object.translation() - best.T_world_object.translation();
  object.covariance = moved_origin(fit.covariance, arm);
  object.noise_covariance = moved_origin(fit.noise, arm);
  object.probability = candidate.there * candidate.shares.front();
  double squared_px = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < best.correspondences.size(); ++i) {
    const LinearSystem& system = best.each[i];
    object.support.push_back(
        {best.correspondences[i]->measurement->id, canonical.features[i], system.rms_px()});
    squared_px += system.squared_px;
    points += best.correspondences[i]->points_m.size();
  }
  object.rms_px = points > 0 ? std::sqrt(squared_px / double(points)) : 0;
  for (std::size_t w = 1; w < candidate.voted_hypotheses.size(); ++w) {
    const PoseHypothesis& voted = candidate.voted_hypotheses[w].hypothesis;
    object.alternatives.push_back({voted.type(), canonical_pose(voted).T_world_object,
                                   candidate.there * candidate.shares[w]});
  }
  return object;
}

}  // namespace vantage::reconstruction::detail

namespace vantage {

std::vector<KnownObject> known_objects(const Reconstruction& result,
                                       const std::vector<std::string>& taken) {
  std::map<std::string, int> of_type;
  for (const ReconstructedObject& object : result.objects) ++of_type[object.type->name];
  std::set<std::string> names(taken.begin(), taken.end());
  std::vector<KnownObject> objects;
  for (const ReconstructedObject& object : result.objects) {
    const std::string& type = object.type->name;
    std::string name = type;
    for (int i = 1; names.contains(name) || (name == type && of_type[type] > 1); ++i) {
      name = fmt::format("{} {}", type, i);
    }
    names.insert(name);
    KnownObject known{name, object.type->mesh, object.T_world_object,
                      type, object.covariance, object.probability,
                      {}};
    for (const Alternative& other : object.alternatives) {
      known.alternatives.push_back(
          {other.type->name, other.type->mesh, other.T_world_object, other.probability});
    }
    objects.push_back(std::move(known));
  }
  return objects;
}

}  // namespace vantage
