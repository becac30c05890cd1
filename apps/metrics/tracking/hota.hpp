#pragma once

#include <span>

#include "metrics/tracking/track_frame.hpp"

namespace vantage {

/// Higher order tracking accuracy (Luiten et al., "HOTA: A Higher Order Metric for Evaluating
/// Multi-object Tracking", IJCV 2021): means over the thresholds 0.05, 0.1, …, 0.95 of similarity.
struct HotaScores {
  double hota = 0;
  double detection = 0;    ///< DetA: TP / (TP + FN + FP)
  double association = 0;  ///< AssA: of each TP, how much of its two tracks is common to both
};

/// As the authors' TrackEval matches: by the similarity in the frame times the alignment of the
/// tracks over all frames. 0 where there is nothing to be found.
HotaScores hota(std::span<const ComparedFrame> frames);

}  // namespace vantage
