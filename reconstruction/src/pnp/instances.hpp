#pragma once

#include <span>
#include <vector>

#include "hypothesis/expand_consensus.hpp"
#include "pnp/minimal_samples.hpp"

namespace vantage::reconstruction::detail {

/// Types that share features, and all that was seen of them: nothing else bears on them.
struct Component {
  std::vector<const Measurement*>
      measurements;  ///< ascending by id; `Correspondence::number` counts them
  std::vector<Correspondence> correspondences;  ///< ascending by measurement
};

/// In the order of their first measurements.
std::vector<Component> split_into_components(std::span<const Measurement> measurements);

/// An object: every way to explain its measurements, the best first. All explain the same ones.
using Instance = std::vector<PoseHypothesis>;

/// The objects of a component, their number not given (thesis, section 6.3): hypotheses grow from
/// samples, the one that explains most is taken out, and so on with what is left; then objects that
/// can be one are merged, and measurements move to the object that they fit better.
/// What no object explains is in none of them.
std::vector<Instance> find_instances(const Component& component,
                                     const InlierThresholds& thresholds);

/// The last step of `find_instances`, in a file of its own.
void merge_and_reassign(std::vector<PoseHypothesis>& objects, const Component& component,
                        const InlierThresholds& thresholds);

}  // namespace vantage::reconstruction::detail
