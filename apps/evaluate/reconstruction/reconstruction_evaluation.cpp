#include "evaluate/reconstruction/reconstruction_evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "evaluate/reconstruction/evaluation_truth.hpp"
#include "metrics/bop/pose_errors.hpp"
#include "vantage/raycore/error.hpp"
#include "workcell/marker_dictionaries.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMaxRuns = 1'000'000;  // their errors are kept, and written

/// A view that was located, with what it saw of the board, too: a board's marker that is misread
/// may seem to be an object's.
struct UsableView {
  std::size_t image = 0;  ///< index
  CameraView view;
};

std::vector<UsableView> usable_views(const ObservedScene& observed) {
  std::vector<UsableView> usable;
  for (std::size_t i = 0; i < observed.views.size(); ++i) {
    if (!observed.views[i].T_world_cam) continue;
    usable.push_back({i, observed.views[i]});
    auto& all = usable.back().view.observations;
    all.insert(all.end(), observed.board[i].begin(), observed.board[i].end());
  }
  return usable;
}

EvaluatedCamera camera_of(const BopImage& image, const CameraView& view,
                          const CameraLocation& location) {
  EvaluatedCamera camera{image.id, location.reason, view.observations.size()};
  if (view.T_world_cam && image.T_world_cam) {
    camera.translation_error_m = translation_error_m(*view.T_world_cam, *image.T_world_cam);
    camera.rotation_error_rad = rotation_error_rad(*view.T_world_cam, *image.T_world_cam);
  }
  return camera;
}

/// Every key that the marker detector may read.
std::vector<FeatureKey> readable_keys(const Workcell& workcell) {
  std::vector<FeatureKey> keys;
  for (const std::string& dictionary : dictionaries_of(workcell)) {
    const int count = marker_count(dictionary, "dictionary");
    for (int id = 0; id < count; ++id) keys.push_back(marker_key(dictionary, id));
  }
  return keys;
}

std::vector<FeatureKey> board_keys(const Workcell& workcell) {
  std::vector<FeatureKey> keys;
  if (!workcell.board) return keys;
  for (const ObjectFeature& feature : workcell.board->features()) keys.push_back(feature.key);
  return keys;
}

std::vector<EvaluatedMethod> methods_of(const ReconstructionEvaluationOptions& options,
                                        const KnowledgeBase& knowledge) {
  std::vector<EvaluatedMethod> methods;
  for (const ReconstructionMethod method : options.methods) {
    methods.push_back({kReconstructionMethods[std::size_t(method)],
                       [method, &options, &knowledge](std::span<const CameraView> views) {
                         return reconstruct(method, views, knowledge, options.reconstruct);
                       }});
  }
  return methods;
}

std::vector<CameraSubset> subsets_of(const std::vector<CameraView>& views,
                                     const ReconstructionEvaluator& evaluator,
                                     const ReconstructionEvaluationOptions& options) {
  auto subsets =
      camera_subsets(views.size(), options.min_cameras, options.max_cameras.value_or(views.size()));
  if (options.covering) subsets = covering_subsets(views, evaluator.truth(), subsets);
  if (subsets.empty()) {
    throw bad_input("--subsets covering",
                    "no subset of these sizes sees every object that all cameras together see; "
                    "allow more cameras with --sizes, or evaluate all subsets");
  }
  if (subsets.size() * options.trials > kMaxRuns) {
    throw Error(ErrorCode::out_of_resources, "--trials",
                fmt::format("{} trials of {} subsets are more than {} runs; ask for fewer",
                            options.trials, subsets.size(), kMaxRuns));
  }
  return subsets;
}

std::vector<ScoredImage> scored_images(const BopScene& scene,
                                       const std::vector<UsableView>& usable) {
  std::vector<ScoredImage> images;
  for (const UsableView& one : usable) {
    const BopImage& image = scene.images[one.image];
    images.push_back({one.view.lens.intrinsics(), image.T_world_cam.value_or(*one.view.T_world_cam),
                      image.depth});
  }
  return images;
}

void summarise(ReconstructionEvaluation& evaluation) {
  for (std::size_t m = 0; m < evaluation.methods.size(); ++m) {
    std::map<std::size_t, std::vector<const SubsetRun*>> by_size;
    std::vector<const SubsetRun*> all;
    for (const SubsetRun& run : evaluation.runs) {
      by_size[evaluation.subsets[run.subset].size()].push_back(&run);
      all.push_back(&run);
    }
    for (const auto& [size, runs] : by_size) {
      evaluation.methods[m].by_cameras[size] = summary_of(runs, m);
    }
    evaluation.methods[m].all = summary_of(all, m);
  }
}

}  // namespace

ReconstructionEvaluation evaluate_reconstruction(const BopScene& scene, const Workcell& workcell,
                                                 const ReconstructionEvaluationOptions& options,
                                                 const StopToken& stop) {
  options.perturbation.check();
  ReconstructionEvaluation evaluation;
  const ReconstructionEvaluator evaluator(true_objects(workcell, scene, evaluation.files),
                                          options.correct);
  const ObservedScene observed = observe(scene, workcell, options.observe, stop);
  if (stop.stop_requested()) return evaluation;
  evaluation.files.insert(evaluation.files.end(), observed.files.begin(), observed.files.end());
  evaluation.truth = evaluator.truth();
  evaluation.touching_pairs = evaluator.touching().size();
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    evaluation.cameras.push_back(
        camera_of(scene.images[i], observed.views[i], observed.locations[i]));
  }
  check_cameras(scene, observed);

  const std::vector<UsableView> usable = usable_views(observed);
  std::vector<CameraView> views;
  for (const UsableView& one : usable) {
    views.push_back(one.view);
    evaluation.images.push_back(scene.images[one.image].id);
  }
  evaluation.subsets = subsets_of(views, evaluator, options);
  const SubsetPlan plan{evaluation.subsets, options.perturbation, options.trials,
                        readable_keys(workcell), board_keys(workcell)};
  const auto methods = methods_of(options, *workcell.knowledge);
  evaluation.runs = evaluate_subsets(views, evaluator, methods, plan, stop);
  if (stop.stop_requested()) return evaluation;

  const std::vector<ScoredImage> images = scored_images(scene, usable);
  std::vector<CameraView> undisturbed;
  for (const UsableView& one : usable) undisturbed.push_back(observed.views[one.image]);
  for (const EvaluatedMethod& method : methods) {
    const Reconstruction all = method.reconstruct(undisturbed);
    evaluation.methods.push_back({method.name,
                                  {},
                                  {},
                                  all,
                                  estimate_errors(evaluator, all),
                                  bop_scores(evaluator, all, images)});
  }
  summarise(evaluation);
  return evaluation;
}

}  // namespace vantage
