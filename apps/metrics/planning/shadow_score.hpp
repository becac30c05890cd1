#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// How much of a grid's shadow is true, and how much of the true shadow it has.
struct ShadowScore {
  double true_m3 = 0;      ///< shadow, and truly hidden
  double false_m3 = 0;     ///< shadow, but truly seen
  double missed_m3 = 0;    ///< truly hidden, but no shadow
  double boundary_m3 = 0;  ///< shadow where the truth's own voxels end: counts for neither

  /// Of the shadow, the part that is true; none without shadow.
  std::optional<double> precision() const;
  /// Of the true shadow, the part that was found; none if nothing is hidden.
  std::optional<double> recall() const;
  /// Their harmonic mean; none where one of them is.
  std::optional<double> f1() const;
};

/// What is truly hidden in a cell, to compare shadow with.
///
/// Three kinds of voxels count for nothing: what is truly solid ("solid or shadow", thesis 7.4.3,
/// tells no difference), what no camera has in view (every method gets that right), and the
/// boundary: voxels that touch, with a corner at least, the other side of the border between the
/// truly seen and the rest, where a voxel's state is a matter of rounding.
class TrueShadow {
 public:
  /// @param truth classified by ideal sensors; `GroundTruth::grid`.
  explicit TrueShadow(const StateGrid& truth);

  /// @param found of the same geometry.
  ShadowScore score(const StateGrid& found) const;

 private:
  enum class Kind : std::uint8_t { nothing, seen, hidden, boundary };

  void mark_boundary(const std::vector<bool>& seen);
  std::size_t index(const Eigen::Vector3i& voxel) const;

  GridGeometry geometry_;
  std::vector<Kind> kinds_;
};

}  // namespace vantage
