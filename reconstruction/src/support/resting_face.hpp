#pragma once

#include <vector>

#include "support/contacts.hpp"

namespace vantage::reconstruction::detail {

/// A distance that is zero if a body lies on another.
struct RestingDistance {
  Eigen::Vector3d point, normal;
  double gap_m = 0;
};

/// How the upper body of a patch lies on the lower one: the distances at up to four places of its
/// lowest face, two for one that is narrow (a cylinder's side), one for a point. Nothing if no face
/// of it lies flat on a horizontal one.
/// @param bodies the patch's.
std::vector<RestingDistance> resting_distances(std::span<const SupportBody> bodies,
                                               const ContactPatch& patch);

}  // namespace vantage::reconstruction::detail
