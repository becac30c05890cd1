#pragma once

#include <vector>

#include "support/equilibrium.hpp"

namespace vantage::reconstruction::detail {

/// A place under a body where something may hold it that is not known.
struct HiddenPlace {
  HiddenSupport support;
  SpaceState state = SpaceState::unseen;
};

/// Places under a body's lower faces that are not seen to be empty.
/// @param space none: nothing is.
std::vector<HiddenPlace> hidden_places(std::span<const SupportBody> bodies, std::size_t body,
                                       const SpaceProbe& space, const SupportOptions& options);

/// The volume under these places, down to the floor: one of them at least. World frame.
Eigen::AlignedBox3d region_under(std::span<const HiddenPlace> places, const SupportBody& body,
                                 const SupportOptions& options);

}  // namespace vantage::reconstruction::detail
