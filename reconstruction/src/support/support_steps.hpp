#pragma once

#include <span>
#include <vector>

#include "support/contacts.hpp"

namespace vantage::reconstruction::detail {

/// `judge_support` of the scene's first `count` bodies.
std::vector<ObjectSupport> judge(std::size_t count, const ContactScene& scene,
                                 const SpaceProbe& space, const SupportOptions& options);

/// `pull_to_contact` of the scene's first bodies.
void pull(const ContactScene& scene, const SupportOptions& options,
          std::vector<ObjectSupport>& support, std::span<ReconstructedObject> objects);

}  // namespace vantage::reconstruction::detail
