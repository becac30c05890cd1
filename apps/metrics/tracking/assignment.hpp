#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace vantage {

/// The one-to-one assignment of rows to columns with the largest sum of gains, by shortest
/// augmenting paths (Jonker, Volgenant, "A shortest augmenting path algorithm for dense and sparse
/// linear assignment problems", 1987).
/// @param gains finite, 0 or more; a pair without gain is never made.
/// @returns for each row its column, if it has one.
std::vector<std::optional<std::size_t>> best_assignment(const Eigen::MatrixXd& gains);

}  // namespace vantage
