#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hypothesis/collect_measurements.hpp"
#include "vantage/raycore/pose.hpp"

// Private: what single observations say about an object's pose, as 6×6 sums that are cheap to add
// up and to ask "what if": hundreds of hypotheses are weighed by them before one is fitted in full.
namespace vantage::reconstruction::detail {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A measurement taken for a certain feature of a certain type. One measurement has several
/// correspondences if its key is on several features, and for a pose one by each symmetry of the
/// type.
struct Correspondence {
  const Measurement* measurement = nullptr;
  std::size_t number = 0;  ///< of the measurement, in its component
  const TypeFeature* feature = nullptr;
  std::vector<Eigen::Vector3d> points_m = {};  ///< of the feature; empty for a pose
  Pose T_object_feature = {};                  ///< of a pose

  const ObjectType& type() const { return *feature->type; }
};

/// Whether both may come of one object: it shows each of its features by a measurement of its own.
inline bool go_together(const Correspondence& a, const Correspondence& b) {
  return a.number != b.number && a.feature != b.feature;
}

/// What a correspondence says at a pose: chi-square and its derivatives by (t, r), see Matrix6d.
struct LinearSystem {
  Matrix6d information = Matrix6d::Zero();  ///< JᵀWJ
  Vector6d gradient = Vector6d::Zero();     ///< JᵀWr
  double chi_square = 0;
  double squared_px = 0;  ///< sum over the points; of a pose 0
  int points = 0;         ///< a pose counts as four, and is worth as much as a marker
  bool in_front = true;   ///< of the camera, every point; otherwise nothing else is of use

  void add(const LinearSystem& other);
  double rms_px() const;
};

inline constexpr std::size_t kAllPoints = std::size_t(-1);

/// @param min_sigma_px is used for corners that claim to be more precise: what a hypothesis may
/// be off by, beside the corners' noise. With it, half of what the camera's own covariance moves
/// the corners by comes in too, so that a bound of six times `min_sigma_px` lets three standard
/// deviations of it pass. 0: the corners' noise alone.
/// @param max_points leaves out the points behind the first ones.
LinearSystem linear_system_of(const Correspondence& correspondence, const Pose& T_world_object,
                              double min_sigma_px, std::size_t max_points = kAllPoints);

/// `pose` moved by (t, r) as Matrix6d has it.
Pose moved(const Pose& pose, const Vector6d& step);

/// The rotation vector of a rotation.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);

/// A pose that explains correspondences best, by damped Gauss–Newton steps.
struct Refined {
  Pose T_world_object;
  LinearSystem sum;                ///< at that pose
  std::vector<LinearSystem> each;  ///< of each correspondence
};

/// Nothing if the start is behind a camera or the correspondences leave the pose open.
std::optional<Refined> refine(std::span<const Correspondence* const> correspondences,
                              const Pose& start, double min_sigma_px);

}  // namespace vantage::reconstruction::detail
