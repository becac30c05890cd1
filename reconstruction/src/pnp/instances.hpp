#pragma once

#include <span>
#include <vector>

#include "hypothesis/expand_consensus.hpp"
#include "pnp/minimal_samples.hpp"

namespace vantage::detail {

/// Types that share features, and all that was seen of them: nothing else bears on them.
struct Component {
  std::vector<const Sighting*> sightings;  ///< ascending by id; `Reading::number` counts them
  std::vector<Reading> readings;           ///< ascending by sighting
};

/// In the order of their first sightings.
std::vector<Component> split_into_components(std::span<const Sighting> sightings);

/// An object: every way to explain its sightings, the best first. All explain the same ones.
using Instance = std::vector<Explanation>;

/// The objects of a component, their number not given (thesis, section 6.3): hypotheses grow from
/// seeds, the one that explains most is taken out, and so on with what is left; then objects that
/// can be one are merged, and sightings move to the object that they fit better.
/// What no object explains is in none of them.
std::vector<Instance> find_instances(const Component& component, const Bounds& bounds);

/// The last step of `find_instances`, in a file of its own.
void settle(std::vector<Explanation>& objects, const Component& component, const Bounds& bounds);

}  // namespace vantage::detail
