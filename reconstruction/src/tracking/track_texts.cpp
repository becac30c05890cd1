#include "tracking/track_texts.hpp"

#include <fmt/format.h>

namespace vantage {
namespace reconstruction::detail {
namespace {

std::string at(const Pose& pose) {
  const Eigen::Vector3d& t = pose.translation();
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m", t.x(), t.y(), t.z());
}

}  // namespace

std::string text_of(const TrackEvent& event, const std::string& more) {
  const std::string who = fmt::format("{} #{}", event.type->name, event.id);
  switch (event.kind) {
    case TrackEventKind::appeared:
      return fmt::format("{} appeared at {}", who, at(*event.to));
    case TrackEventKind::discovered:
      return fmt::format("{} came into sight at {}: no camera saw that place before", who,
                         at(*event.to));
    case TrackEventKind::moved:
      return fmt::format("{} moved by {:.3f} m, from {} to {}", who,
                         (event.to->translation() - event.from->translation()).norm(),
                         at(*event.from), at(*event.to));
    case TrackEventKind::disappeared:
      return fmt::format("{} disappeared from {}", who, at(*event.from));
    case TrackEventKind::views_disagree:
      return fmt::format("{}: {}", who, more);
    case TrackEventKind::taken_back:
      break;
  }
  return fmt::format("{} still stands at {}; the one at {} is {}", who, at(*event.to),
                     at(*event.from), more);
}

}  // namespace reconstruction::detail

std::string_view name_of(TrackState state) {
  constexpr std::string_view kNames[] = {"standing", "moving", "hidden", "missing"};
  return kNames[std::size_t(state)];
}

std::string_view name_of(TrackEventKind kind) {
  constexpr std::string_view kNames[] = {"appeared",    "discovered",     "moved",
                                         "disappeared", "views_disagree", "taken_back"};
  return kNames[std::size_t(kind)];
}

}  // namespace vantage
