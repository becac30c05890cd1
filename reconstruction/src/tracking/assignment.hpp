#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace vantage::reconstruction::detail {

/// The assignment of rows to columns with the smallest sum of costs, each row to one column of its
/// own; by shortest augmenting paths (Jonker, Volgenant 1987; Crouse 2016), O(rows² columns).
/// @param costs rows × columns, rows <= columns; finite or +infinity, which is never assigned.
/// @returns each row's column; nothing if no assignment is finite. Among equal sums the one that
/// the order of rows and columns gives, always the same.
std::optional<std::vector<std::size_t>> cheapest_assignment(const Eigen::MatrixXd& costs);

}  // namespace vantage::reconstruction::detail
