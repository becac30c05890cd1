#include "evaluate/planning/planning_benchmark.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/picture_file.hpp"
#include "cli/run_time.hpp"
#include "options/field_json.hpp"
#include "options/volume_fields.hpp"
#include "plan/report/plan_pictures.hpp"
#include "simulator/scene/ground_truth.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/servo_refiner.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/planner/advanced/view_polisher.hpp"
#include "vantage/planner/advanced/view_search.hpp"
#include "vantage/planner/advanced/view_validity_checker.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"

namespace vantage {
namespace {

HalfSpheres set_named(const std::string& name, const Box& work_area,
                      const std::vector<double>& radii_m) {
  const bool full = name == "full";
  HalfSpheres set = full ? full_views() : production_views();
  if (!radii_m.empty()) {
    set.radii_m = full ? radii_m : std::vector{radii_m.front(), radii_m.back()};
  }
  // Written out, so that the report can say what they are.
  if (set.radii_m.empty()) {
    set.radii_m = default_radii_m(work_area, int(std::max<std::size_t>(2, set.counts.size())));
  }
  return set;
}

/// One scene's evaluation: what its methods and sets have in common.
class SceneRun {
 public:
  SceneRun(const PlanningCell& cell, const PlanningBenchmarkOptions& settings,
           const StopToken& stop)
      : cell_(cell), settings_(settings), stop_(stop), request_(cell.request) {
    request_.volume.filter = FalseShadowFilter::off;  // the thesis has none
    request_.servo = settings.servo;
    request_.polish = settings.polish;
    if (settings.given.contains(nlohmann::json::json_pointer("/volume/occluders"))) {
      request_.volume.anti_alias.reset();
    }
    read_given(settings.given,
               {"", "", {voxel_size_field(request_.voxel_size_m)}, {fields_of(request_.volume)}});
  }

  EvaluatedScene run() {
    EvaluatedScene result{{.name = cell_.name,
                           .workcell = cell_.files.front().string(),
                           .depth = cell_.depth,
                           .voxel_size_m = request_.voxel_size_m},
                          {}};
    for (const DepthCamera& camera : cell_.world.cameras)
      result.scene.cameras.push_back(camera.name);
    if (!classify_cell(result.scene)) return result;
    for (const std::string& name : settings_.sets) {
      result.scene.sets.push_back(run_set(name, result));
      if (stop_.stop_requested()) break;
    }
    return result;
  }

 private:
  bool classify_cell(SceneEvaluation& scene) {
    const auto geometry = GridGeometry::covering(request_.work_area, request_.voxel_size_m);
    for (int i = 0; i < settings_.repeat; ++i) {
      const auto start = StopToken::Clock::now();
      grid_ = classify(cell_.world, geometry, request_.volume, stop_);
      if (grid_ != nullptr) {
        grid_ = without_false_shadow(grid_, cell_.world, request_.volume);
      }
      if (grid_ == nullptr) return false;
      scene.classify_s.push_back(seconds_since(start));
    }
    scene.free_voxels = grid_->count(VoxelState::free);
    scene.occupied_voxels = grid_->count(VoxelState::occupied);
    scene.shadow_voxels = grid_->count(VoxelState::shadow);
    truth_.emplace(cell_.scene, cell_.cameras(), geometry);
    scene.truly_hidden_m3 = truth_->grid().volume_m3(VoxelState::shadow);
    believed_.emplace(cell_.world, grid_, request_.volume.occluders);
    return true;
  }

  SetEvaluation run_set(const std::string& name, EvaluatedScene& result) {
    const HalfSpheres views = set_named(name, request_.work_area, settings_.radii_m);
    request_.candidates = views;
    SetEvaluation set{.set = name, .radii_m = views.radii_m};
    find_best_true_gain(set);
    for (const NamedMethod& method : settings_.methods) {
      if (stop_.stop_requested()) return set;
      MethodRun run{.method = method.name, .unit = "", .pick = {}};
      const Plan plan = timed_plan(method, run);
      if (stop_.stop_requested()) return set;
      run.unit = plan.score_unit_name;
      run.pick = pick_of(plan);
      if (run.pick) {
        set.best_true_gain_m3 = std::max(set.best_true_gain_m3, run.pick->worth().true_gain_m3);
      }
      draw(plan, method, run, name, result.pictures);
      set.runs.push_back(run);
    }
    return set;
  }

  Plan timed_plan(const NamedMethod& method, MethodRun& run) {
    request_.method = method.method;
    request_.value = method.value;
    const bool measured = std::holds_alternative<MeshMethod>(method.method);
    const WorldModel& world = measured ? cell_.measured : cell_.world;
    Plan plan = plan_next_view(world, grid_, request_, stop_);
    run.run_times_s.push_back(plan.score_s);
    for (int i = 1; i < settings_.repeat && !stop_.stop_requested(); ++i) {
      run.run_times_s.push_back(plan_next_view(world, grid_, request_, stop_).score_s);
    }
    return plan;
  }

  PinholeCamera camera_at(const Pose& pose) const {
    return PinholeCamera(request_.intrinsics, pose, request_.range, "movable camera");
  }

  std::optional<Pick> pick_of(const Plan& plan) const {
    if (plan.best() == nullptr) return std::nullopt;
    const RankedView& best = *plan.best();
    const bool polished = !best.polish.empty();
    Pick pick{plan.candidates[best.candidate].view.id,
              best.T_world_cam,
              {},
              polished ? plan.trace.size() - 1 : std::size_t(best.servo_iteration)};
    const VoxelScorer voxels(*believed_);
    for (const ScoredStep& step : plan.trace) {
      const PinholeCamera view = camera_at(step.step.T_world_cam);
      pick.steps.push_back(
          {std::string(to_text(step.step.move)),
           {double(step.score.score) * plan.score_unit,
            double(voxels.score(view).score) * voxels.unit(), truth_->gain_m3(view)}});
    }
    return pick;
  }

  /// The best that any method could have picked: of the same views, moved by the same servo,
  /// polished and rejected in the same way, but scored by what they really see.
  void find_best_true_gain(SetEvaluation& set) const {
    const std::vector<ViewCandidate> views =
        view_candidates(request_.candidates, request_.work_area);
    const auto checker = std::make_shared<const ViewValidityChecker>(request_.constraints,
                                                                     *believed_, request_.range);
    const PinholeCamera camera = camera_at(Pose());
    std::shared_ptr<const ServoRefiner> servo;
    if (request_.servo.iterations > 0) {
      servo = std::make_shared<const ServoRefiner>(
          std::make_shared<const ShadowScorer>(*believed_, request_.range, 0), checker, camera,
          believed_->middle_of_shadow(), request_.servo);
    }
    const auto gain = std::make_shared<const VoxelScorer>(
        PlanningScene(truth_->world(), truth_->shared_grid(), OccluderMode::mesh));
    const SearchResult found = ViewSearch(gain, checker, servo, camera, {}).run(views, stop_);
    set.views = views.size();
    set.feasible = std::size_t(
        std::ranges::count(found.candidates, InvalidReason::none, &ScoredCandidate::rejected));
    const ViewPolisher polisher(gain, checker, camera, believed_->middle_of_shadow(),
                                request_.polish);
    const auto consider = [&](const Pose& pose) {
      set.best_true_gain_m3 = std::max(set.best_true_gain_m3, truth_->gain_m3(camera_at(pose)));
    };
    for (std::size_t i = 0; i < found.ranked.size(); ++i) {
      consider(found.ranked[i].T_world_cam);
      if (i >= std::size_t(request_.polish.views)) break;
      const std::vector<PolishStep> steps = polisher.path(found.ranked[i].T_world_cam, stop_);
      if (!steps.empty()) consider(steps.back().T_world_cam);
    }
  }

  /// The first set's picks of the first and of the last method of interest.
  void draw(const Plan& plan, const NamedMethod& method, const MethodRun& run,
            const std::string& set, std::vector<PagePicture>& pictures) const {
    if (settings_.picture_width == 0 || set != settings_.sets.front()) return;
    const bool by_voxels = std::holds_alternative<VoxelMethod>(method.method);
    if (!by_voxels && method.name != other_method()) return;
    const auto image = overview(plan, cell_.world, settings_.picture_width, stop_);
    if (!image) return;
    const std::string caption = run.pick ? fmt::format("{}’s pick from the {} set", run.method, set)
                                         : fmt::format("{} suggests no view", run.method);
    pictures.push_back({0, caption, jpeg_bytes(*image)});
  }

  /// The method whose picks are drawn beside the voxel method's: the thesis' best, or the last one.
  std::string other_method() const {
    const auto d6 = std::ranges::find(settings_.methods, "shadowD6", &NamedMethod::name);
    return d6 != settings_.methods.end() ? d6->name : settings_.methods.back().name;
  }

  const PlanningCell& cell_;
  const PlanningBenchmarkOptions& settings_;
  const StopToken& stop_;
  PlanRequest request_;
  std::shared_ptr<const StateGrid> grid_;
  std::optional<GroundTruth> truth_;
  std::optional<PlanningScene> believed_;
};

}  // namespace

EvaluatedScene evaluate_planning(const PlanningCell& cell, const PlanningBenchmarkOptions& settings,
                                 const StopToken& stop) {
  return SceneRun(cell, settings, stop).run();
}

}  // namespace vantage
