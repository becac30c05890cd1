#include "evaluate/replay/replay_benchmark.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "metrics/reconstruction/frame_pairs.hpp"
#include "vantage/planner/advanced/expected_scorer.hpp"
#include "vantage/planner/advanced/make_view_scorer.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

void check_frames(const std::vector<DepthCamera>& frames) {
  for (const DepthCamera& frame : frames) {
    if (frame.depth != nullptr) continue;
    throw bad_input(
        fmt::format("image {}", frame.name),
        "it has no depth image to measure what it reveals; replay a recording with a depth folder");
  }
  if (frames.size() >= 3) return;
  throw bad_input("dataset", fmt::format("found {} frames whose camera has a pose; expected at "
                                         "least 3: two to plan from and one to choose",
                                         frames.size()));
}

/// One replay: the recording, and how it is looked at.
class Replay {
 public:
  Replay(const PlanInput& input, const ReplayBenchmarkOptions& settings, const StopToken& stop)
      : input_(input),
        frames_(input.world.cameras),
        settings_(settings),
        stop_(stop),
        geometry_(GridGeometry::covering(input.request.work_area, input.request.voxel_size_m)) {}

  ReplayEvaluation run() const {
    ReplayEvaluation evaluation;
    for (const NamedMethod& method : settings_.methods) evaluation.methods.push_back(method.name);
    const std::vector<std::size_t> usable = frames_that_see();
    const auto pairs = frame_pairs(usable.size(), settings_.pairs, settings_.seed);
    stop_.expect(pairs.size() * (frames_.size() - 2));
    for (const FramePair& pair : pairs) {
      if (stop_.stop_requested()) break;
      ReplayPair replayed = run_pair({usable[pair[0]], usable[pair[1]]});
      if (!stop_.stop_requested()) evaluation.pairs.push_back(std::move(replayed));
    }
    return evaluation;
  }

 private:
  WorldModel seen_by(std::initializer_list<std::size_t> frames) const {
    WorldModel world{input_.world.objects, input_.world.static_structures, {}};
    for (const std::size_t frame : frames) world.cameras.push_back(frames_[frame]);
    return world;
  }

  std::shared_ptr<const StateGrid> grid_of(const WorldModel& world) const {
    return classify(world, geometry_, input_.request.volume);
  }

  std::uint64_t shadow_left_by(const WorldModel& world) const {
    return grid_of(world)->count(VoxelState::shadow);
  }

  /// The frames that two cameras may be: those that alone show enough of the work area.
  std::vector<std::size_t> frames_that_see() const {
    const auto all = double(shadow_left_by(seen_by({})));
    std::vector<double> shown(frames_.size());
    tbb::parallel_for(std::size_t(0), frames_.size(), [&](std::size_t i) {
      if (stop_.stop_requested() || all == 0) return;
      shown[i] = 1 - double(shadow_left_by(seen_by({i}))) / all;
    });
    std::vector<std::size_t> usable;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (shown[i] > 0 && shown[i] >= settings_.min_seen) usable.push_back(i);
    }
    if (usable.size() >= 2 || stop_.stop_requested()) return usable;
    throw bad_input("work area",
                    fmt::format("of {} frames, {} show at least {:.3g} % of it (the best one shows "
                                "{:.3g} %); expected 2: check that the box is in the recording's "
                                "world frame and in metres, or lower --least-seen",
                                frames_.size(), usable.size(), 100 * settings_.min_seen,
                                100 * std::ranges::max(shown)));
  }

  ReplayPair run_pair(const FramePair& pair) const {
    const WorldModel two = seen_by({pair[0], pair[1]});
    const auto before = grid_of(two);
    const PlanningScene scene(two, before, input_.request.volume.occluders);
    ReplayPair result{.frames = {std::stoi(two.cameras[0].name), std::stoi(two.cameras[1].name)},
                      .shadow_m3 = before->volume_m3(VoxelState::shadow)};
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (i != pair[0] && i != pair[1]) others.push_back(i);
    }
    result.views.resize(others.size());
    const VoxelScorer voxels(scene);
    const ExpectedScorer expected(scene, two, input_.request.volume, input_.request.gain_options());
    tbb::parallel_for(std::size_t(0), others.size(), [&](std::size_t i) {
      if (stop_.stop_requested()) return;
      const DepthCamera& frame = frames_[others[i]];
      const std::uint64_t gain = before->count(VoxelState::shadow) -
                                 shadow_left_by(seen_by({pair[0], pair[1], others[i]}));
      result.views[i] = {
          .frame = std::stoi(frame.name),
          .predicted_gain_m3 = double(voxels.score(frame.camera).score) * voxels.unit(),
          .real_gain_m3 = double(gain) * geometry_.voxel_volume_m3(),
          .expected_gain_m3 = double(expected.score(frame.camera).score) * expected.unit()};
      stop_.advance(1);
    });
    for (const NamedMethod& method : settings_.methods) choose(method, scene, two, others, result);
    return result;
  }

  std::unique_ptr<const ViewScorer> scorer_of(const NamedMethod& method, const PlanningScene& scene,
                                              const WorldModel& two) const {
    const PlanRequest& request = input_.request;
    if (method.value == ViewValue::expected) {
      return std::make_unique<const ExpectedScorer>(scene, two, request.volume,
                                                    request.gain_options());
    }
    return make_view_scorer(method.method, scene, two, frames_.front().camera.range(),
                            request.volume.noise);
  }

  /// Adds a method's scores and its pick.
  void choose(const NamedMethod& method, const PlanningScene& scene, const WorldModel& two,
              const std::vector<std::size_t>& others, ReplayPair& pair) const {
    const auto scorer = scorer_of(method, scene, two);
    std::vector<Score> scores(others.size());
    tbb::parallel_for(std::size_t(0), others.size(), [&](std::size_t i) {
      if (!stop_.stop_requested()) scores[i] = scorer->score(frames_[others[i]].camera).score;
    });
    for (std::size_t i = 0; i < scores.size(); ++i) {
      pair.views[i].scores.push_back(double(scores[i]) * scorer->unit());
    }
    pair.picks.push_back(std::size_t(std::ranges::max_element(scores) - scores.begin()));
  }

  const PlanInput& input_;
  const std::vector<DepthCamera>& frames_;
  const ReplayBenchmarkOptions& settings_;
  const StopToken& stop_;
  GridGeometry geometry_;
};

}  // namespace

ReplayEvaluation evaluate_replay(const PlanInput& input, const ReplayBenchmarkOptions& settings,
                                 const StopToken& stop) {
  check_frames(input.world.cameras);
  return Replay(input, settings, stop).run();
}

}  // namespace vantage
