#include "evaluate/reasoning/reasoning_benchmark.hpp"

#include <tbb/parallel_for.h>

#include <array>

#include "metrics/bop/instance_matching.hpp"
#include "workcell/marker_dictionaries.hpp"

namespace vantage {
namespace {

constexpr std::array kMinProbabilities{0.5, 0.7, 0.8, 0.9, 0.95, 0.99};

/// What is looked at of the evidence.
struct EvidenceChoice {
  std::string name;
  bool any = true;  ///< else what the method says stands
  EvidenceKinds kinds = {};
};

const std::vector<EvidenceChoice>& evidence_choices() {
  static const std::vector<EvidenceChoice> choices{
      {"none: the method alone", false},
      {"all"},
      {"all but depth", true, {.depth = false}},
      {"all but missing features", true, {.missing_features = false}},
      {"all but structures and board", true, {.structures = false}},
      {"all but other objects", true, {.other_objects = false}}};
  return choices;
}

/// Every key that a detector may read in place of another one.
std::vector<FeatureKey> readable_keys_of(const Workcell& workcell) {
  std::vector<FeatureKey> keys;
  for (const std::string& dictionary : dictionaries_of(workcell)) {
    const int count = marker_count(dictionary, "dictionary");
    for (int id = 0; id < count; ++id) keys.push_back(marker_key(dictionary, id));
  }
  return keys;
}

/// One minus `pose_similarity`: below 1 if an estimate stands for a true object.
Eigen::MatrixXd errors_of(const Reconstruction& result, std::span<const TruthAt> truth,
                          const TypeModels& types) {
  Eigen::MatrixXd errors = Eigen::MatrixXd::Constant(Eigen::Index(result.objects.size()),
                                                     Eigen::Index(truth.size()), INFINITY);
  for (std::size_t e = 0; e < result.objects.size(); ++e) {
    const std::size_t type = types.index.at(result.objects[e].type.get());
    for (std::size_t t = 0; t < truth.size(); ++t) {
      if (truth[t].type != type) continue;
      errors(Eigen::Index(e), Eigen::Index(t)) =
          1 - pose_similarity(types.models[type], result.objects[e].T_world_object,
                              truth[t].T_world_object);
    }
  }
  return errors;
}

std::vector<ReasoningCounts> counts_of(const Reconstruction& result, std::span<const TruthAt> truth,
                                       const TypeModels& types) {
  std::vector<double> probabilities;
  for (const ReconstructedObject& object : result.objects) {
    probabilities.push_back(object.probability);
  }
  const auto matches = match_instances(errors_of(result, truth, types), probabilities, 1);
  std::vector<ReasoningCounts> all;
  for (const double least : kMinProbabilities) {
    ReasoningCounts counts{.min_probability = least};
    for (std::size_t e = 0; e < probabilities.size(); ++e) {
      if (probabilities[e] < least) continue;
      ++counts.reported;
      counts.phantoms += !matches[e];
      counts.found += matches[e] && truth[matches[e]->truth].judged;
    }
    all.push_back(counts);
  }
  return all;
}

Reconstruction weighed(const ReasoningScene& scene, const EvidenceChoice& choice,
                       Reconstruction result) {
  if (choice.any) reject_contradicted(scene.views, scene.knowledge, result, choice.kinds);
  return result;
}

/// What came of one scene.
struct WeighedScene {
  std::size_t true_objects = 0;
  std::vector<std::vector<ReasoningCounts>> counts;  // of each method with each choice
  bool complete = false;
};

WeighedScene weigh_scene(const ReasoningScene& scene, const Workcell& workcell,
                         const TypeModels& types, std::span<const ReconstructionMethod> methods) {
  WeighedScene result;
  for (const TruthAt& truth : scene.truth) result.true_objects += truth.judged;
  for (const ReconstructionMethod method : methods) {
    const Reconstruction alone = reconstruct(method, scene.views, *workcell.knowledge);
    for (const EvidenceChoice& choice : evidence_choices()) {
      result.counts.push_back(counts_of(weighed(scene, choice, alone), scene.truth, types));
    }
  }
  result.complete = true;
  return result;
}

void add(const WeighedScene& scene, ReasoningEvaluation& evaluation) {
  ++evaluation.scenes;
  evaluation.true_objects += scene.true_objects;
  for (std::size_t r = 0; r < scene.counts.size(); ++r) {
    for (std::size_t i = 0; i < scene.counts[r].size(); ++i) {
      ReasoningCounts& sum = evaluation.results[r].counts[i];
      sum.reported += scene.counts[r][i].reported;
      sum.found += scene.counts[r][i].found;
      sum.phantoms += scene.counts[r][i].phantoms;
    }
  }
}

}  // namespace

ReasoningEvaluation evaluate_reasoning(const Workcell& workcell,
                                       const ReasoningBenchmarkOptions& options,
                                       const StopToken& stop) {
  options.perturbation.check();
  const TypeModels types(*workcell.knowledge);
  const std::vector<FeatureKey> keys = readable_keys_of(workcell);
  const auto count = std::size_t(options.scenes);
  stop.expect(count);
  std::vector<WeighedScene> scenes(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    if (stop.stop_requested()) return;
    const ReasoningScene scene = reasoning_scene(workcell, options.sensor, options.perturbation,
                                                 keys, types, options.seed + i);
    scenes[i] = weigh_scene(scene, workcell, types, options.methods);
    stop.advance(1);
  });
  ReasoningEvaluation evaluation;
  for (const ReconstructionMethod method : options.methods) {
    for (const EvidenceChoice& choice : evidence_choices()) {
      evaluation.results.push_back({kReconstructionMethods[std::size_t(method)], choice.name, {}});
      for (const double least : kMinProbabilities) {
        evaluation.results.back().counts.push_back({.min_probability = least});
      }
    }
  }
  for (const WeighedScene& scene : scenes) {
    if (scene.complete) add(scene, evaluation);
  }
  evaluation.partial = evaluation.scenes < count;
  return evaluation;
}

}  // namespace vantage
