#include "voting/votes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "pose/pose_fit.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr std::size_t kNeighbours = 4;

using Readings = std::vector<const Correspondence*>;

double distance_px(const Correspondence& a, const Correspondence& b) {
  return (a.measurement->points()->pixels.front() - b.measurement->points()->pixels.front()).norm();
}

/// Correspondences that may be of one object with this one, those that are nearest to it in the
/// image.
Readings neighbours(const Correspondence& correspondence, const Readings& all) {
  std::vector<std::pair<double, const Correspondence*>> near;
  for (const Correspondence* other : all) {
    if (go_together(correspondence, *other))
      near.emplace_back(distance_px(correspondence, *other), other);
  }
  const auto count = std::ptrdiff_t(std::min(near.size(), kNeighbours));
  std::partial_sort(
      near.begin(), near.begin() + count, near.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;  // of one array
      });
  Readings nearest;
  for (std::ptrdiff_t i = 0; i < count; ++i) nearest.push_back(near[std::size_t(i)].second);
  return nearest;
}

void add_groups_around(const Correspondence& correspondence, const Readings& all,
                       std::set<CorrespondenceGroup>& groups) {
  const Readings near = neighbours(correspondence, all);
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      if (!go_together(*near[i], *near[j])) continue;
      CorrespondenceGroup group{&correspondence, near[i], near[j]};
      std::sort(group.begin(), group.end());
      groups.insert(group);
    }
  }
}

}  // namespace

std::vector<CorrespondenceGroup> group_points(const CandidateCorrespondences& candidates) {
  std::map<std::pair<std::size_t, std::string>, Readings> single;  // by view and type
  for (const Correspondence& correspondence : candidates.correspondences) {
    if (has_pose(correspondence)) continue;
    single[{correspondence.measurement->id.view, correspondence.type().name}].push_back(
        &correspondence);
  }
  std::vector<CorrespondenceGroup> result;
  for (const auto& [place, correspondences] : single) {
    std::set<CorrespondenceGroup> groups;
    for (const Correspondence* correspondence : correspondences)
      add_groups_around(*correspondence, correspondences, groups);
    result.insert(result.end(), groups.begin(), groups.end());
  }
  return result;
}

namespace {

constexpr double kMinShare = 0.05;

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// What the camera's pose does to a pose that was measured from it.
Matrix6d from_camera(const CameraView& view, const Pose& T_world_object) {
  Matrix6d move = Matrix6d::Identity();
  move.topRightCorner<3, 3>() =
      -cross(T_world_object.translation() - view.T_world_cam->translation());
  return move * view.covariance * move.transpose();
}

/// Poses of correspondences of one view, and how likely each is among them.
struct Guess {
  Pose T_world_object;
  double share = 1;
};

std::vector<Guess> guesses_of(std::span<const Correspondence* const> correspondences,
                              const InlierThresholds& thresholds) {
  const Measurement& first = *correspondences.front()->measurement;
  const Pose& T_world_cam = *first.view->T_world_cam;
  if (const SeenPose* seen = first.pose()) {
    return {
        {T_world_cam * seen->T_cam_feature * correspondences.front()->T_object_feature.inverse()}};
  }
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  double sigma = thresholds.min_sigma_px();
  for (const Correspondence* correspondence : correspondences) {
    const SeenPoints& seen = *correspondence->measurement->points();
    points.insert(points.end(), correspondence->points_m.begin(), correspondence->points_m.end());
    pixels.insert(pixels.end(), seen.pixels.begin(), seen.pixels.end());
    sigma = std::max(sigma, seen.sigma_px);
  }
  const auto found = solve_pnp(first.view->lens, points, pixels);
  std::vector<Guess> guesses;
  double sum = 0;
  for (const PoseGuess& guess : found) {
    const double worse = std::pow(guess.rms_px, 2) - std::pow(found.front().rms_px, 2);
    const double likelihood = std::exp(-0.5 * double(points.size()) * worse / (sigma * sigma));
    guesses.push_back({T_world_cam * guess.T_cam_body, std::max(likelihood, kMinShare)});
    sum += guesses.back().share;
  }
  for (Guess& guess : guesses) guess.share /= sum;
  return guesses;
}

/// Correspondences of one measurement by which it shows different features of one type.
std::size_t features_of_type(std::span<const Correspondence> correspondences,
                             const ObjectType& type) {
  const TypeFeature* last = nullptr;
  std::size_t count = 0;
  for (const Correspondence& correspondence : correspondences) {
    if (&correspondence.type() != &type || correspondence.feature == last)
      continue;  // a symmetry's
    last = correspondence.feature;
    ++count;
  }
  return count;
}

std::vector<Vote> votes_of(std::span<const Correspondence> correspondences,
                           const InlierThresholds& thresholds) {
  std::vector<Vote> votes;
  for (const Correspondence& correspondence : correspondences) {
    if (!has_pose(correspondence)) continue;
    const Correspondence* one[] = {&correspondence};
    const double share = 1.0 / double(features_of_type(correspondences, correspondence.type()));
    for (const Guess& guess : guesses_of(one, thresholds)) {
      votes.push_back(
          vote_for({&correspondence}, guess.T_world_object, share * guess.share, thresholds));
    }
  }
  return votes;
}

/// How many groups each measurement is in for each type, as each has one vote to share.
double share_of(const CorrespondenceGroup& group,
                const std::vector<std::size_t>& groups_of_reading) {
  double share = 0;
  for (const Correspondence* correspondence : group)
    share += 1.0 / double(groups_of_reading[correspondence->number]);
  return share;
}

std::vector<std::vector<Vote>> votes_of_groups(const CandidateCorrespondences& candidates,
                                               const InlierThresholds& thresholds) {
  const std::vector<CorrespondenceGroup> groups = group_points(candidates);
  std::vector<std::size_t> groups_of_reading(candidates.measurements.size(), 0);
  for (const CorrespondenceGroup& group : groups) {
    for (const Correspondence* correspondence : group) ++groups_of_reading[correspondence->number];
  }
  std::vector<std::vector<Vote>> votes(groups.size());
  tbb::parallel_for(std::size_t(0), groups.size(), [&](std::size_t i) {
    const double share = share_of(groups[i], groups_of_reading);
    for (const Guess& guess : guesses_of(groups[i], thresholds)) {
      votes[i].push_back(vote_for({groups[i].begin(), groups[i].end()}, guess.T_world_object,
                                  share * guess.share, thresholds));
    }
  });
  return votes;
}

}  // namespace

CandidateCorrespondences candidate_correspondences(std::span<const Measurement> measurements) {
  CandidateCorrespondences candidates{measurements, {}, {0}};
  for (std::size_t number = 0; number < measurements.size(); ++number) {
    const Measurement& measurement = measurements[number];
    for (const TypeFeature* feature : measurement.features) {
      const ObjectFeature& geometry = feature->type->features[feature->index];
      if (measurement.points()) {
        candidates.correspondences.push_back(
            {&measurement, number, feature, geometry.points(), {}});
      } else if (measurement.pose()) {
        const Pose& frame = *frame_of(geometry);
        candidates.correspondences.push_back({&measurement, number, feature, {}, frame});
        for (const Pose& symmetry : feature->type->symmetries.discrete) {
          candidates.correspondences.push_back(
              {&measurement, number, feature, {}, symmetry * frame});
        }
      }
    }
    candidates.first.push_back(candidates.correspondences.size());
  }
  return candidates;
}

bool has_pose(const Correspondence& correspondence) {
  return correspondence.measurement->pose() || correspondence.points_m.size() >= 3;
}

Vote vote_for(std::vector<const Correspondence*> correspondences, const Pose& T_world_object,
              double weight, const InlierThresholds& thresholds) {
  Matrix6d information = Matrix6d::Zero();
  for (const Correspondence* correspondence : correspondences) {
    information +=
        linear_system_of(*correspondence, T_world_object, thresholds.min_sigma_px()).information;
  }
  const CameraView& view = *correspondences.front()->measurement->view;
  const Matrix6d covariance = covariance_of(information) + from_camera(view, T_world_object);
  return {std::move(correspondences), T_world_object, covariance,
          std::int64_t(std::llround(weight * double(kOneVote)))};
}

std::vector<Vote> cast_votes(const CandidateCorrespondences& candidates,
                             const InlierThresholds& thresholds) {
  std::vector<std::vector<Vote>> parts(candidates.measurements.size());
  tbb::parallel_for(std::size_t(0), parts.size(),
                    [&](std::size_t i) { parts[i] = votes_of(candidates.of(i), thresholds); });
  std::vector<Vote> votes;
  for (auto& part : parts) std::move(part.begin(), part.end(), std::back_inserter(votes));
  for (auto& part : votes_of_groups(candidates, thresholds)) {
    std::move(part.begin(), part.end(), std::back_inserter(votes));
  }
  return votes;
}

}  // namespace vantage::reconstruction::detail
