#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tracking/track.hpp"

namespace vantage::reconstruction::detail {

/// How an object of a snapshot continues a track.
enum class Continuation {
  at_place,   ///< where it stood
  elsewhere,  ///< where it was seen last, since it left its place
  new_place,  ///< at one where it was not seen before
  corrected,  ///< where it stood, but not as it was taken to stand: the same place, another pose
};

/// What it costs to take a detection for a track's object.
struct TrackCost {
  double cost = 0;       ///< negative log-likelihood
  std::size_t pose = 0;  ///< of the detection
  Continuation continuation = Continuation::at_place;
};

/// What is detected nearer to an object than this share of its radius is that object.
inline constexpr double kSamePlace = 0.5;

/// Mahalanobis distances above this, squared, are another place: once in a million by noise.
inline constexpr double kGate = 38.3;

/// The chance of being moved between two snapshots.
struct MotionChances {
  double moves = 0.01;
};

/// Nothing if it cannot be: another type, or, for a track that is not confirmed, elsewhere.
std::optional<TrackCost> cost_of(const Track& track, const Detection& detection,
                                 const MotionChances& chances);

/// Whether a detected pose is where the filter has the object. Turns the pose within its
/// symmetries.
std::optional<NormalLikelihood> fits(const Place& place, const ObjectType& type,
                                     const Detection& detection, std::size_t pose);

/// The detected pose as it continues this place: turned within the type's symmetries.
PoseMeasurement like(const ObjectType& type, const PoseMeasurement& measured, const Pose& target);

/// Which detection continues each track, all at once: the smallest sum of costs, where a track that
/// is not seen costs `unseen[t]` (the negative logarithm of the probability to miss it) and a
/// detection that continues none is a false one or a new object.
std::vector<std::optional<std::size_t>> assign(std::span<const Track> tracks,
                                               std::span<const double> unseen,
                                               std::span<const Detection> detections,
                                               const MotionChances& chances);

}  // namespace vantage::reconstruction::detail
