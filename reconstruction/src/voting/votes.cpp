#include "voting/votes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "pose/pose_fit.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage::detail {
namespace {

constexpr std::size_t kNeighbours = 4;

using Readings = std::vector<const Reading*>;

double distance_px(const Reading& a, const Reading& b) {
  return (a.sighting->points()->pixels.front() - b.sighting->points()->pixels.front()).norm();
}

/// Readings that may be of one object with this one, those that are nearest to it in the image.
Readings neighbours(const Reading& reading, const Readings& all) {
  std::vector<std::pair<double, const Reading*>> near;
  for (const Reading* other : all) {
    if (go_together(reading, *other)) near.emplace_back(distance_px(reading, *other), other);
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

void add_groups_around(const Reading& reading, const Readings& all,
                       std::set<ReadingGroup>& groups) {
  const Readings near = neighbours(reading, all);
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      if (!go_together(*near[i], *near[j])) continue;
      ReadingGroup group{&reading, near[i], near[j]};
      std::sort(group.begin(), group.end());
      groups.insert(group);
    }
  }
}

}  // namespace

std::vector<ReadingGroup> group_points(const Ballot& ballot) {
  std::map<std::pair<std::size_t, std::string>, Readings> single;  // by view and type
  for (const Reading& reading : ballot.readings) {
    if (has_pose(reading)) continue;
    single[{reading.sighting->id.view, reading.type().name}].push_back(&reading);
  }
  std::vector<ReadingGroup> result;
  for (const auto& [place, readings] : single) {
    std::set<ReadingGroup> groups;
    for (const Reading* reading : readings) add_groups_around(*reading, readings, groups);
    result.insert(result.end(), groups.begin(), groups.end());
  }
  return result;
}

namespace {

constexpr double kLeastShare = 0.05;

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

/// Poses of readings of one view, and how likely each is among them.
struct Guess {
  Pose T_world_object;
  double share = 1;
};

std::vector<Guess> guesses_of(std::span<const Reading* const> readings, const Bounds& bounds) {
  const Sighting& first = *readings.front()->sighting;
  const Pose& T_world_cam = *first.view->T_world_cam;
  if (const SeenPose* seen = first.pose()) {
    return {{T_world_cam * seen->T_cam_feature * readings.front()->T_object_feature.inverse()}};
  }
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  double sigma = bounds.least_sigma_px();
  for (const Reading* reading : readings) {
    const SeenPoints& seen = *reading->sighting->points();
    points.insert(points.end(), reading->points_m.begin(), reading->points_m.end());
    pixels.insert(pixels.end(), seen.pixels.begin(), seen.pixels.end());
    sigma = std::max(sigma, seen.sigma_px);
  }
  const auto found = guess_poses(first.view->lens, points, pixels);
  std::vector<Guess> guesses;
  double sum = 0;
  for (const PoseGuess& guess : found) {
    const double worse = std::pow(guess.rms_px, 2) - std::pow(found.front().rms_px, 2);
    const double likelihood = std::exp(-0.5 * double(points.size()) * worse / (sigma * sigma));
    guesses.push_back({T_world_cam * guess.T_cam_body, std::max(likelihood, kLeastShare)});
    sum += guesses.back().share;
  }
  for (Guess& guess : guesses) guess.share /= sum;
  return guesses;
}

/// Readings of one sighting by which it shows different features of one type.
std::size_t features_of_type(std::span<const Reading> readings, const ObjectType& type) {
  const TypeFeature* last = nullptr;
  std::size_t count = 0;
  for (const Reading& reading : readings) {
    if (&reading.type() != &type || reading.feature == last) continue;  // a symmetry's
    last = reading.feature;
    ++count;
  }
  return count;
}

std::vector<Vote> votes_of(std::span<const Reading> readings, const Bounds& bounds) {
  std::vector<Vote> votes;
  for (const Reading& reading : readings) {
    if (!has_pose(reading)) continue;
    const Reading* one[] = {&reading};
    const double share = 1.0 / double(features_of_type(readings, reading.type()));
    for (const Guess& guess : guesses_of(one, bounds)) {
      votes.push_back(vote_for({&reading}, guess.T_world_object, share * guess.share, bounds));
    }
  }
  return votes;
}

/// How many groups each sighting is in for each type, as each has one vote to share.
double share_of(const ReadingGroup& group, const std::vector<std::size_t>& groups_of_reading) {
  double share = 0;
  for (const Reading* reading : group) share += 1.0 / double(groups_of_reading[reading->number]);
  return share;
}

std::vector<std::vector<Vote>> votes_of_groups(const Ballot& ballot, const Bounds& bounds) {
  const std::vector<ReadingGroup> groups = group_points(ballot);
  std::vector<std::size_t> groups_of_reading(ballot.sightings.size(), 0);
  for (const ReadingGroup& group : groups) {
    for (const Reading* reading : group) ++groups_of_reading[reading->number];
  }
  std::vector<std::vector<Vote>> votes(groups.size());
  tbb::parallel_for(std::size_t(0), groups.size(), [&](std::size_t i) {
    const double share = share_of(groups[i], groups_of_reading);
    for (const Guess& guess : guesses_of(groups[i], bounds)) {
      votes[i].push_back(vote_for({groups[i].begin(), groups[i].end()}, guess.T_world_object,
                                  share * guess.share, bounds));
    }
  });
  return votes;
}

}  // namespace

Ballot ballot_of(std::span<const Sighting> sightings) {
  Ballot ballot{sightings, {}, {0}};
  for (std::size_t number = 0; number < sightings.size(); ++number) {
    const Sighting& sighting = sightings[number];
    for (const TypeFeature* feature : sighting.features) {
      const ObjectFeature& geometry = feature->type->features[feature->index];
      if (sighting.points()) {
        ballot.readings.push_back({&sighting, number, feature, geometry.points(), {}});
      } else if (sighting.pose()) {
        const Pose& frame = *frame_of(geometry);
        ballot.readings.push_back({&sighting, number, feature, {}, frame});
        for (const Pose& symmetry : feature->type->symmetries.discrete) {
          ballot.readings.push_back({&sighting, number, feature, {}, symmetry * frame});
        }
      }
    }
    ballot.first.push_back(ballot.readings.size());
  }
  return ballot;
}

bool has_pose(const Reading& reading) {
  return reading.sighting->pose() || reading.points_m.size() >= 3;
}

Vote vote_for(std::vector<const Reading*> readings, const Pose& T_world_object, double weight,
              const Bounds& bounds) {
  Matrix6d information = Matrix6d::Zero();
  for (const Reading* reading : readings) {
    information += evidence_of(*reading, T_world_object, bounds.least_sigma_px()).information;
  }
  const CameraView& view = *readings.front()->sighting->view;
  const Matrix6d covariance = covariance_of(information) + from_camera(view, T_world_object);
  return {std::move(readings), T_world_object, covariance,
          std::int64_t(std::llround(weight * double(kOneVote)))};
}

std::vector<Vote> cast_votes(const Ballot& ballot, const Bounds& bounds) {
  std::vector<std::vector<Vote>> parts(ballot.sightings.size());
  tbb::parallel_for(std::size_t(0), parts.size(),
                    [&](std::size_t i) { parts[i] = votes_of(ballot.of(i), bounds); });
  std::vector<Vote> votes;
  for (auto& part : parts) std::move(part.begin(), part.end(), std::back_inserter(votes));
  for (auto& part : votes_of_groups(ballot, bounds)) {
    std::move(part.begin(), part.end(), std::back_inserter(votes));
  }
  return votes;
}

}  // namespace vantage::detail
