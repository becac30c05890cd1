#include "tracking/track.hpp"

#include "vantage/raycore/detail/mesh_measures.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kHides_s = 1;  ///< something unknown stays in the way for so long, on average
constexpr double kMissedThere = 0.5;  ///< at least, where something of its shape is measured

}  // namespace

void MissingStreak::miss(double missed, bool something_there, double step_s) {
  const double changes = 1 - std::exp(-step_s / kHides_s);
  const double stays = (1 - changes) * hidden + kViewHidden * changes * clear;
  const double comes = changes * hidden + (1 - kViewHidden * changes) * clear;
  if (something_there) missed = std::max(missed, kMissedThere);
  hidden = stays;
  clear = comes * missed;
}

Matrix6d Place::covariance() const {
  if (!other) return filter.covariance();
  const double share = 1 / (1 + std::exp(-other->log_ratio));
  const Vector6d step = filter.innovation({other->filter.pose()});
  return (1 - share) * filter.covariance() +
         share * (other->filter.covariance() + step * step.transpose());
}

double log_of(const std::vector<MissingStreak>& streaks) {
  double sum = 0;
  for (const MissingStreak& streak : streaks) sum += std::log(streak.probability());
  return sum;
}

double radius_of(const ObjectType& type) {
  return 0.5 * raycore::detail::bounds_of(*type.mesh).diagonal().norm();
}

}  // namespace vantage::reconstruction::detail
