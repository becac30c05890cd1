#include <algorithm>
#include <cmath>

#include "pose/pose_fit.hpp"
#include "pose/symmetry.hpp"
#include "voting/greedy_selection.hpp"

namespace vantage::detail {
namespace {

constexpr double kSurfaceM = 0.002;    // what a mesh and a label's place may be off by
constexpr std::size_t kMostWays = 12;  // of one object

/// How far a pose that was fitted to these sums may be off.
double slack_of(const Explanation& explanation, double most) {
  const Matrix6d covariance = covariance_of(explanation.sum.information);
  return std::min(kSurfaceM + std::sqrt(covariance.topLeftCorner<3, 3>().trace()), most);
}

bool same(const Way& a, const Way& b) {
  return a.explanation.type() == b.explanation.type() &&
         equivalent(*a.explanation.type(), a.explanation.T_world_object,
                    b.explanation.T_world_object);
}

/// Fits a pose to a cluster, leaving out, one by one, what does not go with the rest.
std::optional<Explanation> trimmed(std::vector<const Reading*> readings, const Pose& start,
                                   const Bounds& bounds) {
  while (!readings.empty()) {
    const auto refined = refine(readings, start, bounds.least_sigma_px());
    if (!refined) return std::nullopt;
    double worst = 1;
    std::size_t out = readings.size();
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double part = refined->each[i].chi_square / bounds.largest_chi_square(*readings[i]);
      if (part <= worst) continue;
      worst = part;
      out = i;
    }
    if (out == readings.size()) return explain(readings, refined->T_world_object, bounds);
    readings.erase(readings.begin() + std::ptrdiff_t(out));
  }
  return std::nullopt;
}

}  // namespace

/// What the cluster around the vote explains; if that is little, what the vote alone leads to.
std::optional<Way> Election::way_from(std::size_t vote) {
  const Cluster cluster = poll_->cluster_around(vote);
  auto best = grown(trimmed(cluster.readings, cluster.T_world_object, bounds_));
  if (!best || best->readings.size() < kFirm) {
    const Vote& alone = poll_->vote(vote);
    auto other = grown(explain(alone.readings, alone.T_world_object, bounds_));
    if (other && (!best || best->score(bounds_) < other->score(bounds_))) best = std::move(other);
  }
  if (!best || best->sum.points < kFewestPoints) return std::nullopt;
  Verdict verdict = witnesses_->verdict(*best->type(), best->T_world_object,
                                        slack_of(*best, options_.merge_m), free_);
  return Way{std::move(*best), std::move(verdict)};
}

std::optional<Explanation> Election::grown(const std::optional<Explanation>& start) const {
  if (!start) return std::nullopt;
  return grow(start->readings, start->T_world_object, pool(*start->type(), start->T_world_object),
              bounds_);
}

/// Readings that the object may have: those whose first point, or whose frame, is as near to the
/// object's middle as its body reaches.
std::vector<const Reading*> Election::pool(const ObjectType& type,
                                           const Pose& T_world_object) const {
  const TypeBody& body = witnesses_->body(type);
  const Eigen::Vector3d centre = T_world_object * body.centre();
  std::vector<const Reading*> near;
  for (const Reading* reading : readings_of_.at(&type)) {
    if (!free_[reading->number]) continue;
    const Sighting& sighting = *reading->sighting;
    const Eigen::Vector3d p = sighting.T_cam_world * centre;
    const double reach = 1.5 * body.radius_m() + options_.merge_m;
    if (const SeenPoints* seen = sighting.points()) {
      const Intrinsics& k = sighting.view->lens.intrinsics();
      if (p.z() < 2 * reach) {  // so near that pixels say little
        near.push_back(reading);
        continue;
      }
      const double reach_px = std::max(k.fx, k.fy) * reach / (p.z() - reach) + options_.inlier_px;
      const Eigen::Vector2d away = sighting.view->lens.project(p) - seen->pixels.front();
      if (away.norm() <= 1.5 * reach_px) near.push_back(reading);
    } else if ((sighting.pose()->T_cam_feature.translation() - p).norm() <=
               2 * reach + 3 * sighting.pose()->sigma_m +
                   reading->T_object_feature.translation().norm()) {
      near.push_back(reading);
    }
  }
  return near;
}

bool Election::worth_trying(std::size_t vote, const std::vector<std::size_t>& sightings,
                            const std::vector<Way>& ways) const {
  if (!poll_->open(vote)) return false;
  const Explanation& first = ways.front().explanation;
  if (first.readings.size() < kFirm) return true;
  for (const Way& way : ways) {
    const Explanation& known = way.explanation;
    if (poll_->may_be(vote, *known.type(), known.T_world_object)) return false;
  }
  // Others have to be for it, too.
  const Vote& candidate = poll_->vote(vote);
  std::size_t agree = 0;
  for (const std::size_t sighting : sightings) {
    const auto& votes = poll_->votes_of(sighting);
    agree += std::any_of(votes.begin(), votes.end(), [&](std::size_t other) {
      return poll_->may_be(other, *candidate.type(), candidate.T_world_object);
    });
  }
  return 2 * agree >= sightings.size();
}

std::vector<Way> Election::ways(Way first) {
  std::vector<std::size_t> sightings;
  for (const Reading* reading : first.explanation.readings) sightings.push_back(reading->number);
  std::vector<Way> ways;
  ways.push_back(std::move(first));
  for (const std::size_t sighting : sightings) {
    for (const std::size_t vote : poll_->votes_of(sighting)) {
      if (ways.size() >= kMostWays || !worth_trying(vote, sightings, ways)) continue;
      auto way = way_from(vote);
      if (!way) continue;
      const std::size_t shared = common(way->explanation, ways.front().explanation);
      const bool of_the_same = 2 * shared >= way->explanation.readings.size() &&
                               2 * shared >= ways.front().explanation.readings.size();
      const bool known = std::any_of(ways.begin(), ways.end(),
                                     [&](const Way& other) { return same(*way, other); });
      if (of_the_same && !known) ways.push_back(std::move(*way));
    }
  }
  return ways;
}

}  // namespace vantage::detail
