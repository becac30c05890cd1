#pragma once

#include <span>

#include "metrics/tracking/track_frame.hpp"

namespace vantage {

/// From this similarity on an estimate stands for a true object: MSSD below a quarter of the
/// diameter.
inline constexpr double kSameObjectSimilarity = 0.5;

/// Ristani et al., "Performance Measures and a Data Set for Multi-Target, Multi-Camera Tracking",
/// 2016: with the one-to-one assignment of whole tracks that makes most of them true.
struct IdentityScores {
  std::size_t true_positives = 0, truth = 0, estimates = 0;

  /// IDF1; 0 where there is nothing.
  double f1() const {
    return truth + estimates == 0 ? 0 : 2.0 * double(true_positives) / double(truth + estimates);
  }
};
IdentityScores identity_scores(std::span<const ComparedFrame> frames);

/// CLEAR MOT (Bernardin, Stiefelhagen, "Evaluating Multiple Object Tracking Performance", 2008).
struct ClearScores {
  std::size_t truth = 0, misses = 0, false_positives = 0;
  std::size_t switches = 0;  ///< a true object got another id than it had last
  /// An id went, by its place, from an object of one type to one of another.
  std::size_t type_switches = 0;

  /// MOTA: 1 less errors by true objects; 0 without any.
  double accuracy() const {
    if (truth == 0) return 0;
    return 1 - double(misses + false_positives + switches) / double(truth);
  }
};
ClearScores clear_scores(std::span<const ComparedFrame> frames);

}  // namespace vantage
