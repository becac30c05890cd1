#pragma once

#include "hypothesis/hypothesis_verification.hpp"

namespace vantage::reconstruction::detail {

/// The object, canonical as canonical_pose.hpp says, with the ways to explain it as alternatives.
ReconstructedObject object_of(const Candidate& candidate);

}  // namespace vantage::reconstruction::detail
