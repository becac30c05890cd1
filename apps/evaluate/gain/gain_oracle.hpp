#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluate/expected_gain/measured_gain.hpp"
#include "evaluate/gain/judged_plan.hpp"
#include "evaluate/gain/true_gain.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// The views to search for the best one.
class GainCandidates {
 public:
  /// @param shadow as it was planned for.
  GainCandidates(const JudgedPlan& plan, const StateGrid& shadow, GainOracle oracle);

  /// The most that any of them gains now; none without candidates. Views that have too little of
  /// the shadow in their image are not measured.
  std::optional<double> best_m3(MeasuredGain& truth, std::uint64_t seed,
                                const StopToken& stop) const;

 private:
  double voxel_m3_;
  std::vector<PinholeCamera> views_;
};

}  // namespace vantage
