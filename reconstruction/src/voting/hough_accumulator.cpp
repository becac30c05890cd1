#include "voting/hough_accumulator.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "pose/symmetry.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kNear = 22.5;       // 99.9 % of chi-square with six degrees of freedom
constexpr double kFarthestM = 0.25;  // votes that are vaguer than that find each other otherwise

/// What poses may differ by beside their votes' noise.
Matrix6d floor_of() {
  Matrix6d floor = Matrix6d::Zero();
  floor.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;  // 1 mm, 10 mrad
  return floor;
}

/// Whether a cluster may have the correspondence: one of each measurement, one of each feature in a
/// view.
bool has_room_for(const std::vector<const Correspondence*>& correspondences,
                  const Correspondence& correspondence) {
  return std::none_of(correspondences.begin(), correspondences.end(),
                      [&](const Correspondence* other) {
                        return other->number == correspondence.number ||
                               (other->feature == correspondence.feature &&
                                other->measurement->view == correspondence.measurement->view);
                      });
}

bool has(const std::vector<const Correspondence*>& correspondences,
         const Correspondence* correspondence) {
  return std::find(correspondences.begin(), correspondences.end(), correspondence) !=
         correspondences.end();
}

/// Adds a vote's correspondences, if it contradicts none that is there.
bool take_in(const Vote& vote, std::vector<const Correspondence*>& correspondences) {
  const std::size_t before = correspondences.size();
  for (const Correspondence* correspondence : vote.correspondences) {
    if (has(correspondences, correspondence)) continue;
    if (!has_room_for(correspondences, *correspondence)) {
      correspondences.resize(before);
      return false;
    }
    correspondences.push_back(correspondence);
  }
  return correspondences.size() > before;
}

}  // namespace

HoughAccumulator::HoughAccumulator(std::vector<Vote> votes, std::size_t measurements,
                                   const VoteGrid& grid)
    : votes_(std::move(votes)),
      grid_(grid),
      table_(grid),
      open_(votes_.size(), true),
      of_measurement_(measurements) {
  for (std::size_t i = 0; i < votes_.size(); ++i) {
    const Vote& vote = votes_[i];
    rank_.try_emplace(vote.type(), std::uint32_t(rank_.size()));
    if (!table_.has_room_for(place_of(*vote.type(), 0, vote.T_world_object))) {
      open_[i] = false;
      continue;
    }
    for (const Correspondence* correspondence : vote.correspondences)
      of_measurement_[correspondence->number].push_back(i);
    of_type_[vote.type()].push_back(i);
    enter(vote, 1);
  }
}

void HoughAccumulator::enter(const Vote& vote, std::int64_t sign) {
  const std::vector<Pose> poses = spread(vote.T_world_object, vote.covariance, grid_);
  const std::int64_t weight = vote.weight / std::int64_t(poses.size());
  for (const Pose& pose : poses) {
    const VotePlace place = place_of(*vote.type(), rank_.at(vote.type()), pose);
    if (table_.has_room_for(place)) table_.add(place, sign * weight);
  }
}

double HoughAccumulator::height(std::size_t i) const {
  const Vote& vote = votes_[i];
  return table_.height(place_of(*vote.type(), rank_.at(vote.type()), vote.T_world_object));
}

void HoughAccumulator::withdraw(std::size_t i) {
  if (!open_[i]) return;
  open_[i] = false;
  enter(votes_[i], -1);
}

std::vector<std::pair<double, std::size_t>> HoughAccumulator::near(std::size_t i) const {
  const Vote& vote = votes_[i];
  const Matrix6d covariance = vote.covariance + floor_of();
  std::vector<std::pair<double, std::size_t>> found;
  for (const std::size_t other : of_type_.at(vote.type())) {
    const Vote& candidate = votes_[other];
    const Eigen::Vector3d step =
        candidate.T_world_object.translation() - vote.T_world_object.translation();
    if (!open_[other] || step.norm() > kFarthestM) continue;
    // Along the line between them alone they may already be too far apart.
    const auto both = (covariance + candidate.covariance).topLeftCorner<3, 3>();
    if (std::pow(step.squaredNorm(), 2) > kNear * step.dot(both * step)) continue;
    const Pose turned = turned_towards(*vote.type(), candidate.T_world_object, vote.T_world_object);
    const double squared = other == i ? -1
                                      : squared_distance(vote.T_world_object, covariance, turned,
                                                         candidate.covariance);
    if (squared <= kNear) found.emplace_back(squared, other);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Pose HoughAccumulator::mean(const std::vector<std::size_t>& members, const Pose& around) const {
  Matrix6d information = Matrix6d::Zero();
  Vector6d sum = Vector6d::Zero();
  for (const std::size_t i : members) {
    const Vote& vote = votes_[i];
    const Pose pose = turned_towards(*vote.type(), vote.T_world_object, around);
    Vector6d step;
    step << pose.translation() - around.translation(),
        rotation_vector(pose.rotation() * around.rotation().transpose());
    const Matrix6d weight = Matrix6d(vote.covariance + floor_of()).inverse();
    information += weight;
    sum += weight * step;
  }
  return moved(around, information.ldlt().solve(sum));
}

Cluster HoughAccumulator::cluster_around(std::size_t i) const {
  Cluster cluster;
  std::vector<std::size_t> members;
  for (const auto& [distance, other] : near(i)) {
    if (take_in(votes_[other], cluster.correspondences)) members.push_back(other);
  }
  cluster.T_world_object = mean(members, votes_[i].T_world_object);
  return cluster;
}

bool HoughAccumulator::may_be(std::size_t i, const ObjectType& type,
                              const Pose& T_world_object) const {
  const Vote& vote = votes_[i];
  if (vote.type() != &type) return false;
  const Pose pose = turned_towards(type, T_world_object, vote.T_world_object);
  return squared_distance(vote.T_world_object, vote.covariance, pose, floor_of()) <= kNear;
}

}  // namespace vantage::reconstruction::detail
