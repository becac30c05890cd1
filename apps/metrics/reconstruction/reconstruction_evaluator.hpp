#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "metrics/bop/instance_matching.hpp"
#include "metrics/bop/true_object.hpp"
#include "metrics/bop/visible_discrepancy.hpp"
#include "metrics/reconstruction/touching_corners.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage {

/// Errors of one object of a reconstruction, against the true one that it was matched to. For an
/// object with symmetries, against that of its equal poses that is nearest in MSSD's sense.
struct ObjectErrors {
  std::size_t estimate = 0, truth = 0;
  double translation_m = 0;
  double rotation_rad = 0;
  double mssd_m = 0;
};

/// A reconstruction compared with the ground truth.
struct ReconstructionScore {
  std::size_t true_objects = 0;  ///< that are to be found
  std::size_t estimates = 0;
  std::size_t found = 0;    ///< of `true_objects`, by an estimate that is correct
  std::size_t correct = 0;  ///< estimates; those of objects that need not be found count, too
  std::vector<std::size_t> found_at = {};  ///< as `found`, at each of BOP's thresholds
  std::vector<ObjectErrors> objects = {};  ///< of everything that was matched, correct or not
  std::optional<double> self_consistency_mm2 =
      {};  ///< if every object that touches another is there
};

/// Knows the true scene, and scores reconstructions of it. Immutable; thread-safe.
///
/// Estimates are matched to true objects of their type by MSSD, in shares of the object's diameter,
/// as `match_instances` does: with a threshold for what counts as correct, and without one for the
/// errors, so that bad poses show in these.
class ReconstructionEvaluator {
 public:
  /// @param correct an estimate is, if its MSSD is below this share of the object's diameter.
  /// @throws Error bad_input unless `correct` is positive.
  explicit ReconstructionEvaluator(std::vector<TrueObject> truth, double correct = 0.1);

  const std::vector<TrueObject>& truth() const noexcept { return truth_; }
  const ErrorModel& model_of(std::size_t truth) const { return *models_[truth]; }
  const std::vector<TouchingCorners>& touching() const noexcept { return touching_; }

  /// @param counts the true objects that are to be found; others do no harm if they are.
  ReconstructionScore evaluator(const Reconstruction& reconstruction,
                                const std::vector<bool>& counts) const;

  /// Without a threshold: for each estimate the true object of its type that it was matched to.
  std::vector<std::optional<Match>> matches(const Reconstruction& reconstruction) const;

 private:
  Eigen::MatrixXd errors_of(const Reconstruction& reconstruction) const;
  std::optional<double> self_consistency_mm2(const Reconstruction& reconstruction,
                                             const std::vector<ObjectErrors>& objects) const;

  std::vector<TrueObject> truth_;
  double correct_;
  std::map<std::string, ErrorModel> by_type_;
  std::vector<const ErrorModel*> models_;  // of the true objects
  std::vector<TouchingCorners> touching_;
};

}  // namespace vantage
