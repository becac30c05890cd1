#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "cli/units.hpp"
#include "evaluate/tracking/tracking_report.hpp"

namespace vantage {
namespace {

constexpr double kMinJitterRatio = 4;

double jitter_ratio(const ComparedJitter& jitter, double Jitter::*part) {
  const double tracked = jitter.tracked.jitter().*part;
  return tracked > 0 ? jitter.single.jitter().*part / tracked : 0;
}

std::string mean_of(const std::vector<int>& numbers) {
  if (numbers.empty()) return "-";
  return fmt::format("{:.2f}",
                     std::accumulate(numbers.begin(), numbers.end(), 0.0) / double(numbers.size()));
}

std::string largest_of(const std::vector<int>& numbers) {
  return numbers.empty() ? "-" : std::to_string(std::ranges::max(numbers));
}

ReportTable identity_table(const TrackingEvaluation& evaluation) {
  ReportTable table{.title = "Objects and their ids",
                    .columns = {{"tracker", "", true},
                                {"HOTA"},
                                {"DetA"},
                                {"AssA"},
                                {"IDF1"},
                                {"MOTA"},
                                {"id switches"},
                                {"between types"},
                                {"phantoms/instant"}}};
  for (const EvaluatedTracking& tracker : evaluation.trackers) {
    const TrackingScores& s = tracker.scores;
    table.rows.push_back(
        {{tracker.name, fmt::format("{:.4f}", s.hota.hota), fmt::format("{:.4f}", s.hota.detection),
          fmt::format("{:.4f}", s.hota.association), fmt::format("{:.4f}", s.identity.f1()),
          fmt::format("{:.4f}", s.clear.accuracy()), std::to_string(s.clear.switches),
          std::to_string(s.clear.type_switches), fmt::format("{:.4f}", s.phantoms_per_instant())}});
  }
  table.note = "snapshots: each reconstructed alone, ids by the nearest of the snapshot before.";
  return table;
}

ReportTable event_table(const TrackingEvaluation& evaluation) {
  ReportTable table{.title = "Events",
                    .columns = {{"tracker", "", true},
                                {"precision"},
                                {"recall"},
                                {"moves found"},
                                {"mean delay"},
                                {"largest"},
                                {"mean lag"},
                                {"largest"},
                                {"unsettled"}}};
  for (const EvaluatedTracking& tracker : evaluation.trackers) {
    const EventScores& e = tracker.scores.events;
    const Lag& lag = tracker.scores.lag;
    table.rows.push_back(
        {{tracker.name, fmt::format("{:.4f}", e.precision()), fmt::format("{:.4f}", e.recall()),
          fmt::format("{} of {}", e.moves_found, e.moves), mean_of(e.delays), largest_of(e.delays),
          mean_of(lag.instants), largest_of(lag.instants), std::to_string(lag.unsettled)}});
  }
  table.note =
      "Delay and lag in instants: from when a camera shows the object where it now stands to the "
      "report, and to a pose within 2 mm and 1 degree.";
  return table;
}

ReportTable pose_table(const TrackingEvaluation& evaluation) {
  ReportTable table{.title = "Poses of standing objects",
                    .columns = {{"tracker", "", true},
                                {"jitter mm"},
                                {"degrees"},
                                {"times smaller, mm"},
                                {"degrees"},
                                {"NEES"},
                                {"95 % interval"},
                                {"within 95 %"}}};
  for (const EvaluatedTracking& tracker : evaluation.trackers) {
    const ComparedJitter& jitter = tracker.scores.jitter;
    const Jitter own = jitter.tracked.jitter();
    const PoseConsistency& c = tracker.scores.consistency;
    table.rows.push_back(
        {{tracker.name, fmt::format("{:.4f}", own.translation_m * kMillimetres),
          fmt::format("{:.4f}", own.rotation_rad * kDegrees),
          fmt::format("{:.2f}", jitter_ratio(jitter, &Jitter::translation_m)),
          fmt::format("{:.2f}", jitter_ratio(jitter, &Jitter::rotation_rad)),
          fmt::format("{:.2f}", c.mean()), fmt::format("{:.2f} to {:.2f}", c.low(), c.high()),
          fmt::format("{:.1f} %", 100 * c.coverage())}});
  }
  table.note =
      "Jitter: standard deviation over time, beside that of the snapshots at the same instants. "
      "NEES: one sample for each time that an object stood somewhere.";
  return table;
}

}  // namespace

std::vector<TrackingGoal> tracking_goals(const TrackingScores& s) {
  const auto at_least = [](const char* name, double value, double goal) {
    return TrackingGoal{fmt::format("{} >= {}", name, goal), fmt::format("{:.4f}", value),
                        value >= goal};
  };
  const double ratio = std::min(jitter_ratio(s.jitter, &Jitter::translation_m),
                                jitter_ratio(s.jitter, &Jitter::rotation_rad));
  const int largest_lag = s.lag.instants.empty() ? 0 : std::ranges::max(s.lag.instants);
  const PoseConsistency& c = s.consistency;
  return {at_least("HOTA", s.hota.hota, 0.95),
          at_least("IDF1", s.identity.f1(), 0.98),
          {"no switch between types", std::to_string(s.clear.type_switches),
           s.clear.type_switches == 0},
          at_least("event precision", s.events.precision(), 0.98),
          at_least("event recall", s.events.recall(), 0.98),
          {fmt::format("every move reported within {} instants", kEventDelay),
           fmt::format("{} of {}", s.events.moves_found, s.events.moves),
           s.events.moves_found == s.events.moves},
          at_least("jitter smaller by a factor", ratio, kMinJitterRatio),
          {fmt::format("settled within {} instants", kEventDelay),
           fmt::format("{} at most, {} not", largest_lag, s.lag.unsettled),
           largest_lag <= kEventDelay && s.lag.unsettled == 0},
          {"NEES in its 95 % interval",
           fmt::format("{:.2f} in {:.2f} to {:.2f}", c.mean(), c.low(), c.high()),
           !c.nees.empty() && c.mean() >= c.low() && c.mean() <= c.high()}};
}

std::vector<ReportTable> tracking_tables(const TrackingEvaluation& evaluation) {
  std::vector<ReportTable> tables{identity_table(evaluation), event_table(evaluation),
                                  pose_table(evaluation)};
  for (std::size_t i = 1; i < evaluation.trackers.size(); ++i) {
    ReportTable goals{.title = "Goals, tracker " + evaluation.trackers[i].name,
                      .columns = {{"goal", "", true}, {"found", "", true}, {"reached", "", true}}};
    for (const TrackingGoal& goal : tracking_goals(evaluation.trackers[i].scores)) {
      goals.rows.push_back({{goal.name, goal.found, goal.reached ? "yes" : "no"}});
    }
    tables.push_back(std::move(goals));
  }
  return tables;
}

}  // namespace vantage
