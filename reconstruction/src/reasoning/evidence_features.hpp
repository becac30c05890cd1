#pragma once

#include <span>

#include "reasoning/presence.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

// Private: what the features say of an object that are seen, and those that are not.
namespace vantage::reconstruction::detail {

/// The log-odds of an object by the features that were seen where it has them. A single one may be
/// misread, or stuck to something else; several that fit to each other are not.
double log_odds_of_seen(const ReconstructedObject& object, std::span<const CameraView> views);

/// The features that views should have seen, and did not.
struct MissingFeatures {
  int count = 0;         ///< those that are more likely found than not
  double log_ratio = 0;  ///< of the likelihoods of missing them: object there, or not
};

/// @param views only those by whose pictures features were looked for count: they saw a feature of
/// this kind, or `looked[view]` says so.
MissingFeatures missing_features(const ReconstructedObject& object,
                                 std::span<const CameraView> views, const Presence& presence,
                                 const std::vector<bool>& looked);

}  // namespace vantage::reconstruction::detail
