#include "evaluate/stability/stability_benchmark.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/reconstruct.hpp"
#include "workcell/sequence/sequence_scene.hpp"

namespace vantage {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kSameObject_m = 0.02;  ///< an estimate that is farther off is of something else

struct StandingObject {
  TypePtr type;
  Pose T_world_object;
};

Vector6d error_of(const Pose& found, const Pose& truth) {
  const Eigen::AngleAxisd turn(truth.rotation() * found.rotation().transpose());
  Vector6d error;
  error << truth.translation() - found.translation(), turn.angle() * turn.axis();
  return error;
}

void add_error(const ReconstructedObject& found, const Pose& truth, RestingErrors::Sums& sums) {
  const Vector6d error = error_of(found.T_world_object, truth);
  sums.translation_m += error.head<3>().norm();
  sums.rotation_rad += error.tail<3>().norm();
  sums.nees += error.dot(found.covariance->ldlt().solve(error));
}

/// For each true object the estimate of it; `kNoEstimate` where there is none.
constexpr std::size_t kNoEstimate = std::size_t(-1);
std::vector<std::size_t> estimates_of(std::span<const StandingObject> truth,
                                      std::span<const ReconstructedObject> found) {
  std::vector<std::size_t> matches(truth.size(), kNoEstimate);
  std::vector<bool> is_taken(found.size(), false);
  for (std::size_t t = 0; t < truth.size(); ++t) {
    double nearest = kSameObject_m;
    for (std::size_t f = 0; f < found.size(); ++f) {
      if (is_taken[f] || found[f].type != truth[t].type || !found[f].covariance) continue;
      const double apart =
          (found[f].T_world_object.translation() - truth[t].T_world_object.translation()).norm();
      if (apart < nearest) nearest = apart, matches[t] = f;
    }
    if (matches[t] != kNoEstimate) is_taken[matches[t]] = true;
  }
  return matches;
}

bool is_blamed(SupportVerdict verdict) {
  return verdict != SupportVerdict::stands && verdict != SupportVerdict::unjudged;
}

/// One scene, and what is said of it.
struct JudgedScene {
  std::vector<StandingObject> truth;
  std::vector<std::size_t> matches;
  std::vector<ObjectSupport> support;
  RestingErrors errors;

  bool is_complete() const { return std::ranges::find(matches, kNoEstimate) == matches.end(); }
  SupportVerdict verdict(std::size_t object) const { return support[matches[object]].verdict; }
};

class StabilityBenchmark {
 public:
  StabilityBenchmark(const Workcell& workcell, const StabilityBenchmarkOptions& options)
      : workcell_(workcell), options_(options), types_(recognisable(workcell)) {
    Workcell empty = workcell;
    empty.random_objects.reset();
    empty.known_objects.clear();
    scene_ = sequence_scene(empty);
    options_.support.floor_z_m = scene_.floor.min().z();
  }

  StackMaker stack_maker() const {
    std::vector<std::shared_ptr<const TriangleMesh>> meshes;
    for (const TypePtr& type : types_) meshes.push_back(type->mesh);
    return StackMaker(meshes);
  }

  StabilityEvaluation judge_stack(const StackMaker& maker, std::size_t index) const {
    constexpr std::array kFaults{StackFault::none, StackFault::removed, StackFault::none,
                                 StackFault::shifted};
    const std::uint64_t seed = sample_hash(options_.seed, 1, index);
    RandomStackOptions stack_options;
    stack_options.floor_z_m = scene_.floor.min().z();
    const Eigen::Vector2d middle = scene_.floor.centre().head<2>();
    const RandomStack stack =
        maker.make(kFaults[index % kFaults.size()], seed, middle, stack_options);
    std::vector<StandingObject> truth;
    for (const StackedBody& body : stack.bodies) {
      truth.push_back({types_[body.mesh], body.T_world_body});
    }
    const JudgedScene scene = judge(std::move(truth), scene_, seed);
    StabilityEvaluation evaluation;
    StackVerdicts& verdicts = evaluation.stacks[std::size_t(stack.fault)];
    if (!scene.is_complete()) {
      verdicts.incomplete = 1;
      return evaluation;
    }
    verdicts.judged = 1;
    verdicts.right = is_right(scene, stack);
    for (std::size_t i = 0; i < scene.truth.size(); ++i) {
      ++verdicts.objects[std::size_t(scene.verdict(i))];
    }
    if (stack.fault == StackFault::none) evaluation.in_stacks = scene.errors;
    return evaluation;
  }

  StabilityEvaluation judge_scene(std::size_t index) const {
    Workcell cell = workcell_;
    if (!cell.random_objects) return {};
    const std::uint64_t seed = sample_hash(options_.seed, 2, index);
    cell.random_objects->seed = seed;
    place_random_objects(cell);
    const SequenceScene scene = sequence_scene(cell);
    std::vector<StandingObject> truth;
    for (const SequenceObject& object : scene.objects) {
      truth.push_back({object.type, object.stays.front().T_world_object});
    }
    StabilityEvaluation evaluation;
    evaluation.in_scenes = judge(std::move(truth), scene, seed).errors;
    return evaluation;
  }

 private:
  static std::vector<TypePtr> recognisable(const Workcell& workcell) {
    std::vector<TypePtr> types =
        workcell.random_objects ? workcell.random_objects->types : workcell.knowledge->types();
    std::erase_if(types, [](const TypePtr& type) { return type->markers().empty(); });
    return types;
  }

  static bool is_right(const JudgedScene& scene, const RandomStack& stack) {
    bool is_found = stack.fault == StackFault::none;
    for (std::size_t i = 0; i < stack.bodies.size(); ++i) {
      if (!is_blamed(scene.verdict(i))) continue;
      if (i < stack.broken_at) return false;
      is_found = true;
    }
    return is_found;
  }

  JudgedScene judge(std::vector<StandingObject> truth, const SequenceScene& scene,
                    std::uint64_t seed) const {
    SequencePlan plan;
    for (const StandingObject& object : truth) {
      plan.objects.push_back({.id = plan.objects.size() + 1,
                              .name = object.type->name + std::to_string(plan.objects.size()),
                              .type = object.type,
                              .stays = {{.T_world_object = object.T_world_object}}});
    }
    const SimulatedInstant seen =
        SequenceSimulator(plan, scene.fixed, scene.cameras, options_.sensor, seed).at(0);
    Reconstruction result = reconstruct_pnp(seen.views, *workcell_.knowledge);
    JudgedScene judged;
    judged.matches = estimates_of(truth, result.objects);
    judged.support =
        judge_support(result.objects, scene.fixed, measured_space(seen.depth), options_.support);
    RestingErrors& errors = judged.errors;
    for (std::size_t t = 0; t < truth.size(); ++t) {
      if (judged.matches[t] == kNoEstimate) continue;
      add_error(result.objects[judged.matches[t]], truth[t].T_world_object, errors.before);
    }
    pull_to_contact(scene.fixed, options_.support, judged.support, result.objects);
    for (std::size_t t = 0; t < truth.size(); ++t) {
      if (judged.matches[t] == kNoEstimate) continue;
      ++errors.objects;
      errors.pulled += judged.support[judged.matches[t]].pulled;
      errors.flagged += is_blamed(judged.support[judged.matches[t]].verdict);
      add_error(result.objects[judged.matches[t]], truth[t].T_world_object, errors.after);
    }
    judged.truth = std::move(truth);
    return judged;
  }

  const Workcell& workcell_;
  StabilityBenchmarkOptions options_;
  std::vector<TypePtr> types_;
  SequenceScene scene_{
      .objects = {}, .floor = workcell_.work_area, .obstacles = {}, .fixed = {}, .cameras = {}};
};

void add(const StackVerdicts& from, StackVerdicts& to) {
  to.judged += from.judged;
  to.right += from.right;
  to.incomplete += from.incomplete;
  for (std::size_t v = 0; v < to.objects.size(); ++v) to.objects[v] += from.objects[v];
}

void add(const RestingErrors::Sums& from, RestingErrors::Sums& to) {
  to.translation_m += from.translation_m;
  to.rotation_rad += from.rotation_rad;
  to.nees += from.nees;
}

}  // namespace

void RestingErrors::add(const RestingErrors& other) {
  objects += other.objects;
  pulled += other.pulled;
  flagged += other.flagged;
  vantage::add(other.before, before);
  vantage::add(other.after, after);
}

StackVerdicts StabilityEvaluation::all_stacks() const {
  StackVerdicts all;
  for (const StackVerdicts& one : stacks) add(one, all);
  return all;
}

StabilityEvaluation evaluate_stability(const Workcell& workcell,
                                       const StabilityBenchmarkOptions& options,
                                       const StopToken& stop) {
  const StabilityBenchmark benchmark(workcell, options);
  const auto stacks = std::size_t(options.stacks);
  const std::size_t count = stacks + std::size_t(options.scenes);
  const std::optional<StackMaker> maker =
      stacks > 0 ? std::optional(benchmark.stack_maker()) : std::nullopt;
  stop.expect(count);
  std::vector<std::optional<StabilityEvaluation>> parts(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    if (stop.stop_requested()) return;
    parts[i] = i < stacks ? benchmark.judge_stack(*maker, i) : benchmark.judge_scene(i - stacks);
    stop.advance(1);
  });
  StabilityEvaluation evaluation;
  for (const std::optional<StabilityEvaluation>& part : parts) {
    if (!part) evaluation.partial = true;
    if (!part) continue;
    for (std::size_t f = 0; f < evaluation.stacks.size(); ++f) {
      add(part->stacks[f], evaluation.stacks[f]);
    }
    evaluation.in_stacks.add(part->in_stacks);
    evaluation.in_scenes.add(part->in_scenes);
  }
  return evaluation;
}

}  // namespace vantage
