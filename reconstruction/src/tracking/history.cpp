#include "tracking/history.hpp"

#include "tracking/track.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kUnlikelyMissed = 0.2;

}  // namespace

void History::add(double time_s, std::span<const CameraView> views,
                  std::span<const DepthCamera> depth, std::shared_ptr<const Scene> scene) {
  auto now = std::make_shared<Past>();
  now->time_s = time_s;
  for (const CameraView& view : views) {
    now->views.push_back({view.name, view.lens, view.T_world_cam, view.covariance, {}});
  }
  now->depth.assign(depth.begin(), depth.end());
  now->scene = std::move(scene);
  now->presence = std::make_unique<Presence>(now->views, now->depth, *now->scene);
  for (std::size_t i = 0; i < past_.size() && count_ % (std::size_t(1) << i) == 0; ++i) {
    past_[i] = now;
  }
  ++count_;
}

bool History::was_seen_empty(const ObjectType& type, const Pose& T_world_object) const {
  std::vector<MissingStreak> streaks;
  std::shared_ptr<const Past> last;
  for (std::size_t i = past_.size(); i-- > 0;) {  // from the oldest to the latest
    if (!past_[i] || past_[i] == last) continue;
    const double step_s = last ? past_[i]->time_s - last->time_s : 0;
    last = past_[i];
    streaks.resize(last->views.size());
    const auto missed = last->presence->missed_probability(type, T_world_object);
    for (std::size_t v = 0; v < streaks.size(); ++v) streaks[v].miss(missed[v], false, step_s);
  }
  return log_of(streaks) < std::log(kUnlikelyMissed);
}

}  // namespace vantage::reconstruction::detail
