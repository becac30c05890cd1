#pragma once

#include "tracking/track_costs.hpp"

namespace vantage::reconstruction::detail {

/// A place where a detection sees an object for the first time, by one of its poses.
/// @param pose that pose as the object's earlier ones are turned, see `like`.
Place place_of(const ObjectType& type, const Detection& detection, std::size_t index,
               const PoseMeasurement& pose, double time_s);

/// Takes in that a detection sees the object there. Where it may have two poses, both take what
/// fits them best, and the likelier one over all snapshots is the place's.
void see_at(Place& place, const ObjectType& type, const Detection& detection, double time_s);

}  // namespace vantage::reconstruction::detail
