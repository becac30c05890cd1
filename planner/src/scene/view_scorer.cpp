#include "vantage/planner/view_scorer.hpp"

namespace vantage {

ScoreBound ViewScorer::score(const PinholeCamera& view, const StopToken& stop) const {
  const Score needed = 0;
  ScoreBound result;
  score({&view, 1}, {&needed, 1}, {&result, 1}, stop);
  return result;
}

}  // namespace vantage
