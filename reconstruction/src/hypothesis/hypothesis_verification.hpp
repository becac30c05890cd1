#pragma once

#include <span>
#include <string>
#include <vector>

#include "hypothesis/generalized_least_squares.hpp"

namespace vantage::reconstruction::detail {

/// The share of measurements whose id is wrong.
inline constexpr double kWrongId = 0.05;

/// An object with all ways to explain its measurements, the most probable first.
struct Candidate {
  std::vector<FinalFit> voted_hypotheses;
  std::vector<double> shares = {};  ///< probabilities of the ways, if the object is there; sum 1
  double there = 1;                 ///< the probability that it is there
  std::string rejected = {};        ///< why it is left out; empty if it is not

  const PoseHypothesis& best() const { return voted_hypotheses.front().hypothesis; }
};

/// Whether a way is listed before another one: the likelier first; ways that only rounding tells
/// apart by the names of their types, so that the order does not depend on it.
/// @param log the way's logarithmic likelihood.
bool goes_before(double log, const PoseHypothesis& voted, double other_log,
                 const PoseHypothesis& other);

/// Leaves out objects whose measurements all lie where an object with more of them (and at least
/// two) shows another of its markers, which that view does not have: their ids were misread.
void reject_misidentified(std::vector<Candidate>& candidates, const InlierThresholds& thresholds);

/// Weighs the ways to explain each object, and whether it is there at all.
///
/// A way's likelihood is exp(-χ²/2), χ² over its ratio to the degrees of freedom where that is
/// above 1. For objects in one view, or with one measurement, what the views do *not* see counts
/// too: a marker that should be seen (turned to the camera, inside the image, large enough, hidden
/// by no reconstructed object) is missed with probability 0.2; with 0.15 something unknown hides
/// the whole object from a view that does not see it. The measurements are wrong ids with 0.05
/// each. Objects that are then more likely not there than there are left out; ways whose likelihood
/// is below the best one's by more than `min_evidence` / 2 in its logarithm are dropped.
void verify_hypotheses(std::vector<Candidate>& candidates, std::span<const CameraView> views,
                       const ReconstructOptions& options);

}  // namespace vantage::reconstruction::detail
