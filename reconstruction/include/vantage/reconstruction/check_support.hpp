#pragma once

#include <span>
#include <vector>

#include "vantage/reconstruction/support.hpp"

namespace vantage {

/// `judge_support`, `pull_to_contact` and `lower_unsupported`, which share the search for contacts.
VANTAGE_API std::vector<ObjectSupport> check_support(std::span<const KnownObject> structures,
                                                     const SpaceProbe& space,
                                                     const SupportOptions& options,
                                                     std::span<ReconstructedObject> objects);

}  // namespace vantage
