#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// What a view is worth, in steps of the method's own `ViewScorer::unit()`: an integer, so that
/// sums do not depend on the order in which threads add.
using Score = std::uint64_t;

/// What is known about a view's score.
struct ScoreBound {
  enum class Known : std::uint8_t {
    nothing,  ///< it was stopped before anything was known
    pruned,   ///< not scored: a cheaper method preferred others; `score` is undefined
    at_most,  ///< `score` is a certified upper bound
    exact,
  };
  Known known = Known::nothing;
  Score score = 0;

  bool exact() const noexcept { return known == Known::exact; }
  bool operator==(const ScoreBound&) const = default;
};

/// One of the numbers that a score is made of, for reports: "voxels in view", 312, "".
struct ScoreTerm {
  std::string_view name;
  double value = 0;
  std::string_view unit = {};
};

/// A method of scoring views (thesis 7.1 to 7.4): the larger the score, the better the view.
///
/// Immutable; every method may be called from many threads at once. Work on one call is not split
/// over threads: callers that score many views do that. An exact score does not depend on what else
/// is asked, nor on `needed`; bounds may.
class VANTAGE_API ViewScorer {
 public:
  virtual ~ViewScorer() = default;

  /// The method's name on the command line.
  virtual std::string_view name() const noexcept = 0;

  /// What one step of `Score` is, in `unit_name()`.
  virtual double unit() const noexcept = 0;
  virtual std::string_view unit_name() const noexcept = 0;

  /// A certified upper bound of a view's score, many times cheaper than the score itself.
  virtual Score upper_bound(const PinholeCamera& view) const = 0;

  /// The same, for a view that only matters from a score of `needed` on: if a rougher bound is
  /// below that already, no better one is looked for.
  virtual Score upper_bound_if_needed(const PinholeCamera& view, Score /*needed*/) const {
    return upper_bound(view);
  }

  /// Scores views that all have the same centre, to the bit, and the same intrinsics and range.
  ///
  /// @param needed for each view, the score from which on it matters. A view whose score is certain
  /// to be below that may be left at an upper bound, which then is below it, too.
  /// @param results for each view: exact, or at most something below `needed`; nothing if `stop`
  /// asked to stop before (looked at once in a few thousand rays).
  /// @throws Error bad_input unless all three are of one size.
  virtual void score(std::span<const PinholeCamera> views, std::span<const Score> needed,
                     std::span<ScoreBound> results, const StopToken& stop = {}) const = 0;

  /// What a view's score is made of, the score itself last.
  virtual std::vector<ScoreTerm> terms(const PinholeCamera& view) const = 0;

  /// Whether views with one centre are scored faster together than one after the other, each with
  /// the score of the one before as what it needs.
  virtual bool shares_rays() const noexcept { return false; }

  /// The exact score of one view; nothing known if `stop` asked to stop.
  ScoreBound score(const PinholeCamera& view, const StopToken& stop = {}) const;
};

}  // namespace vantage
