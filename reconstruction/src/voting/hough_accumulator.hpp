#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "voting/covariance_samples.hpp"
#include "voting/votes.hpp"

namespace vantage::reconstruction::detail {

/// Votes that lie together: what they say, and where the middle of it is.
struct Cluster {
  std::vector<const Correspondence*> correspondences;  ///< one for each measurement
  Pose T_world_object;  ///< the mean, weighted by what each vote is sure of
};

/// The table with its votes in it, which can be withdrawn. Not thread-safe.
class HoughAccumulator {
 public:
  HoughAccumulator(std::vector<Vote> votes, std::size_t measurements, const VoteGrid& grid);

  std::size_t size() const { return votes_.size(); }
  const Vote& vote(std::size_t i) const { return votes_[i]; }
  bool open(std::size_t i) const { return open_[i]; }
  const std::vector<std::size_t>& votes_of(std::size_t measurement) const {
    return of_measurement_[measurement];
  }

  /// How many votes there are at and around this one's pose.
  double height(std::size_t i) const;

  void withdraw(std::size_t i);

  /// Votes for the same type that are so near that they may be for the same pose, the nearest of
  /// each measurement; this one's own are in it.
  Cluster cluster_around(std::size_t i) const;

  /// Whether the vote may be for this object; the pose is taken as certain.
  bool may_be(std::size_t i, const ObjectType& type, const Pose& T_world_object) const;

 private:
  void enter(const Vote& vote, std::int64_t sign);
  std::vector<std::pair<double, std::size_t>> near(std::size_t i) const;
  Pose mean(const std::vector<std::size_t>& members, const Pose& around) const;

  std::vector<Vote> votes_;
  VoteGrid grid_;
  VoteTable table_;
  std::vector<bool> open_;
  std::vector<std::vector<std::size_t>> of_measurement_;
  std::map<const ObjectType*, std::vector<std::size_t>> of_type_;  // never walked
  std::map<const ObjectType*, std::uint32_t> rank_;
};

}  // namespace vantage::reconstruction::detail
