#include "metrics/tracking/event_scores.hpp"

#include <algorithm>

#include "metrics/tracking/assignment.hpp"

namespace vantage {
namespace {

bool same_place(const std::optional<Pose>& truth, const std::optional<Pose>& reported,
                const ErrorModel& model) {
  if (!truth) return true;
  return reported && pose_similarity(model, *reported, *truth) > 0;
}

bool is_right(const ReportedEvent& report, const TrueEvent& event,
              std::span<const ErrorModel> models) {
  return report.kind == event.kind && report.type == event.type && report.instant >= event.begin &&
         report.instant <= event.due + kEventDelay &&
         same_place(event.from, report.from, models[event.type]) &&
         same_place(event.to, report.to, models[event.type]);
}

}  // namespace

void EventScores::add(const EventScores& other) {
  events += other.events;
  reports += other.reports;
  found += other.found;
  moves += other.moves;
  moves_found += other.moves_found;
  delays.insert(delays.end(), other.delays.begin(), other.delays.end());
}

EventScores event_scores(std::span<const TrueEvent> events, std::span<const ReportedEvent> reports,
                         std::span<const ErrorModel> models) {
  EventScores scores{.events = events.size(), .reports = reports.size()};
  Eigen::MatrixXd right =
      Eigen::MatrixXd::Zero(Eigen::Index(events.size()), Eigen::Index(reports.size()));
  for (std::size_t e = 0; e < events.size(); ++e) {
    for (std::size_t r = 0; r < reports.size(); ++r) {
      if (is_right(reports[r], events[e], models)) right(Eigen::Index(e), Eigen::Index(r)) = 1;
    }
  }
  const auto matches = best_assignment(right);
  for (std::size_t e = 0; e < events.size(); ++e) {
    const bool is_move = events[e].kind == SceneEventKind::moved;
    scores.moves += is_move;
    if (!matches[e]) continue;
    ++scores.found;
    scores.moves_found += is_move;
    scores.delays.push_back(std::max(0, reports[*matches[e]].instant - events[e].due));
  }
  return scores;
}

}  // namespace vantage
