#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

// Slow, obvious twins of the table of votes.
namespace vantage::test {

/// Where a vote falls, in cells.
struct PlainPlace {
  int type = 0;
  Eigen::Vector3d position;
  Eigen::Vector4d turn;
};

/// How much of a point is a lattice point's: 1 where they are the same, falling linearly, 0 beyond
/// the simplices that touch it. From the shape of the simplices of the lattice A*, not by looking
/// for the one that the point is in.
double hat3(const Eigen::Vector3d& offset);
double hat4(const Eigen::Vector4d& offset);

/// Every lattice point of a box with its shares, found by trying all of them.
using PlainCells = std::map<std::array<int, 4>, double>;
PlainCells shares_in_space(const Eigen::Vector3d& point);

/// What all votes together give at a place: each weighs as a bell curve of the distance in cells,
/// 1 at none. Turns and their negatives are the same.
double density(const std::vector<PlainPlace>& votes, const PlainPlace& at, double width_cells);

}  // namespace vantage::test
