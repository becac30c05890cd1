#pragma once

#include <span>
#include <vector>

#include "metrics/tracking/track_frame.hpp"

namespace vantage {

enum class SceneEventKind { moved, appeared, disappeared };

/// What truly happened.
struct TrueEvent {
  SceneEventKind kind = SceneEventKind::moved;
  std::uint64_t object = 0;
  std::size_t type = 0;
  int begin = 0;  ///< the instant from which on it may be reported: it is gone from its place
  int due = 0;    ///< the first instant in which a camera shows the new state
  std::optional<Pose> from = {}, to = {};
};

/// What a tracker said, in the instant in which it said it.
struct ReportedEvent {
  SceneEventKind kind = SceneEventKind::moved;
  std::size_t type = 0;
  int instant = 0;
  std::optional<Pose> from = {}, to = {};
};

/// Within so many instants after `due` a report is in time.
inline constexpr int kEventDelay = 3;

struct EventScores {
  std::size_t events = 0, reports = 0, found = 0;  ///< one to one: a second report is a false one
  std::size_t moves = 0, moves_found = 0;
  std::vector<int> delays = {};  ///< of what was found: instants after `due`, 0 at least

  void add(const EventScores& other);
  double recall() const { return events == 0 ? 1 : double(found) / double(events); }
  double precision() const { return reports == 0 ? 1 : double(found) / double(reports); }
};

/// A report is right if it is of the kind and type of a true event, in time, and has its places
/// where the event has them: MSSD below half the diameter. Identities do not matter here.
EventScores event_scores(std::span<const TrueEvent> events, std::span<const ReportedEvent> reports,
                         std::span<const ErrorModel> models);

}  // namespace vantage
