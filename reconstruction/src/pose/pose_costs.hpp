#pragma once

#include <ceres/cost_function.h>

#include "pose/extrapolated_lens.hpp"
#include "pose/pose_fit.hpp"

namespace vantage::reconstruction::detail {

/// The residuals of all points of a term, divided by sigma: one block, as Ceres' share of the time
/// grows with the number of blocks. Never fails. Refers to the term.
class PointCost final : public ceres::CostFunction {
 public:
  explicit PointCost(const PointTerm& term);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const PointTerm* term_;
  WideLens lens_;
};

/// The difference of a measured frame from where the body has it: 3 for the translation, 3 for the
/// rotation vector, in the reference frame's axes, divided by their sigmas. Refers to the term.
class PoseCost final : public ceres::CostFunction {
 public:
  explicit PoseCost(const PoseTerm& term);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const PoseTerm* term_;
};

}  // namespace vantage::reconstruction::detail
