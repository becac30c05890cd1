#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "voting/permutohedral_lattice.hpp"

namespace vantage::reconstruction::detail {

/// Votes are counted in integers, so that their order does not matter.
inline constexpr std::int64_t kOneVote = std::int64_t(1) << 20;

/// Where a vote falls: a type, a position, and a rotation as a point of R⁴, in which distances are
/// angles: twice the unit quaternion, of which q and -q are the same, or an axis (x, y, z, 0) of
/// something that looks the same from all around. A sphere in R⁴ has no poles to crowd around.
struct VotePlace {
  std::uint32_t type = 0;
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  bool both_signs = true;  ///< whether -turn is the same as turn
};

/// How fine the table is, and how its lattice lies; where it lies should not matter.
struct VoteGrid {
  double cell_m = 0.02;
  double cell_rad = 0.35;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Eigen::Matrix4d frame = Eigen::Matrix4d::Identity();  ///< a rotation
};

/// The table of votes over (type, 6DoF) of the thesis' section 6.2, with only those cells that
/// somebody voted for. A vote is shared by the 4 x 5 cells around it, as it would be in multilinear
/// interpolation, so that votes on both sides of a border meet.
class VoteTable {
 public:
  static constexpr std::size_t kCellsPerVote = 20;
  /// Votes farther from the origin than this many cells have no cell.
  static constexpr double kFarthestCells = 1e7;

  explicit VoteTable(const VoteGrid& grid);

  bool has_room_for(const VotePlace& place) const;

  /// @param weight in units of 1 / kOneVote; its negative takes the vote back, to the last bit.
  void add(const VotePlace& place, std::int64_t weight);

  /// How many votes there are at and around a place: n where all n are there, and less the farther
  /// they are from it, none at 2.5 cells.
  double height(const VotePlace& place) const;

  std::size_t cell_count() const { return used_; }
  std::size_t bytes() const { return slots_.size() * sizeof(Slot); }

 private:
  using Key = std::array<std::int32_t, 8>;  // type, 3 of the position, 4 of the rotation
  struct Share {
    Key key;
    std::int64_t weight = 0;
  };
  struct Slot {
    Key key;
    std::int64_t votes = 0;
    bool used = false;
  };

  std::array<Share, kCellsPerVote> shares(const VotePlace& place, std::int64_t weight) const;
  std::size_t slot_of(const Key& key) const;
  void expand_consensus();

  VoteGrid grid_;
  std::vector<Slot> slots_;  // open addressing; a power of two
  std::size_t used_ = 0;
};

}  // namespace vantage::reconstruction::detail
