#pragma once

#include <span>
#include <vector>

#include "support/contacts.hpp"

namespace vantage::reconstruction::detail {

/// A point at which something unknown may push a body up.
struct HiddenSupport {
  std::size_t body = 0;
  Eigen::Vector3d point;
  double cost = 1;  ///< of a body's whole weight
};

/// How bodies that touch each other are held.
struct Balance {
  std::vector<bool> is_held;         ///< of the bodies asked for, in their order
  std::vector<double> hidden_loads;  ///< of the hidden supports, in weights
};

/// Static equilibrium: forces at the contacts, in friction pyramids, that hold every body against
/// its weight, as a linear programme. Where there are none, as little as can be is held by
/// nothing (bodies that are not held), and before that by hidden supports.
///
/// A contact's force may attack as far beside it as the bodies' poses leave open.
/// @param members bodies that can fall, of known mass. What else they touch stands.
/// @param patches all contacts of the members.
Balance balance_of(std::span<const SupportBody> bodies, std::span<const std::size_t> members,
                   std::span<const ContactPatch* const> patches,
                   std::span<const HiddenSupport> hidden, const SupportOptions& options);

/// Whether bodies are in equilibrium for certain, as each lies on one other alone, or on what
/// stands, and over that horizontal area of contact the common centre of mass of it and all that it
/// carries. False says nothing. Quicker than `balance_of`, and enough for most.
bool stands_as_tree(std::span<const SupportBody> bodies, std::span<const std::size_t> members,
                    std::span<const ContactPatch* const> patches);

}  // namespace vantage::reconstruction::detail
