#include "metrics/reconstruction/bop_scores.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "metrics/bop/pose_errors.hpp"

namespace vantage {
namespace {

constexpr double kMinVisible = 0.1;  // BOP's visib_gt_min
constexpr double kDelta = 0.015;     // metres; BOP's for its challenge

/// Recalled targets of one image: over all thresholds, and misalignments.
struct ImageScore {
  std::size_t targets = 0, mssd = 0, mspd = 0, vsd = 0;
};

/// One image, with all that its errors are made of.
class ImageJudge {
 public:
  ImageJudge(const ReconstructionEvaluator& evaluator, const Reconstruction& reconstruction,
             const ScoredImage& image)
      : evaluator_(evaluator), estimates_(reconstruction.objects), image_(image) {
    const Pose T_cam_world = image.T_world_cam.inverse();
    const DepthImage nothing_hides(image.camera.width, image.camera.height);
    for (const TrueObject& object : evaluator.truth()) {
      truth_poses_.push_back(T_cam_world * object.T_world_object);
      truth_views_.push_back(view_of(*object.type->mesh, truth_poses_.back(), image.camera));
      const DepthImage& depth = image.depth ? *image.depth : nothing_hides;
      targets_.push_back(visible_fraction(truth_views_.back(), depth, image.camera, kDelta) >=
                         kMinVisible);
    }
    for (const ReconstructedObject& estimate : estimates_) {
      estimate_poses_.push_back(T_cam_world * estimate.T_world_object);
      scores_.push_back(estimate.probability);
    }
  }

  ImageScore score() const {
    ImageScore score{std::size_t(std::ranges::count(targets_, true))};
    const double pixels = 100.0 * image_.camera.width / 640;  // 0.05 of them are 5 px, for 640
    score.mssd = recalled(errors([&](std::size_t e, std::size_t t) {
      const ErrorModel& model = evaluator_.model_of(t);
      return mssd_m(model, estimate_poses_[e], truth_poses_[t]) / model.diameter_m;
    }));
    score.mspd = recalled(errors([&](std::size_t e, std::size_t t) {
      return mspd_px(evaluator_.model_of(t), estimate_poses_[e], truth_poses_[t], image_.camera) /
             pixels;
    }));
    if (image_.depth) score.vsd = recalled_by_vsd();
    return score;
  }

 private:
  /// estimates × true objects; infinite between types, and for what is no target.
  template <class Error>
  Eigen::MatrixXd errors(Error&& error) const {
    Eigen::MatrixXd matrix(Eigen::Index(estimates_.size()), Eigen::Index(targets_.size()));
    matrix.setConstant(kInfinite);
    for (std::size_t e = 0; e < estimates_.size(); ++e) {
      for (std::size_t t = 0; t < targets_.size(); ++t) {
        if (!targets_[t] || estimates_[e].type->name != evaluator_.truth()[t].type->name) continue;
        matrix(Eigen::Index(e), Eigen::Index(t)) = error(e, t);
      }
    }
    return matrix;
  }

  /// Over BOP's ten thresholds.
  std::size_t recalled(const Eigen::MatrixXd& errors) const {
    std::size_t sum = 0;
    for (const double threshold : bop_thresholds()) {
      sum += found(match_instances(errors, scores_, threshold), targets_);
    }
    return sum;
  }

  std::size_t recalled_by_vsd() const {
    const VsdOptions options;
    std::vector<Eigen::MatrixXd> of_tau(options.taus.size(), errors([](auto, auto) { return 1; }));
    for (std::size_t e = 0; e < estimates_.size(); ++e) {
      const ObjectView view = view_of(*estimates_[e].type->mesh, estimate_poses_[e], image_.camera);
      for (std::size_t t = 0; t < targets_.size(); ++t) {
        const auto at = std::pair(Eigen::Index(e), Eigen::Index(t));
        if (of_tau[0](at.first, at.second) == kInfinite) continue;
        const std::vector<double> of_pair = vsd(view, truth_views_[t], *image_.depth, image_.camera,
                                                evaluator_.model_of(t).diameter_m, options);
        for (std::size_t i = 0; i < of_tau.size(); ++i) of_tau[i](at.first, at.second) = of_pair[i];
      }
    }
    std::size_t sum = 0;
    for (const Eigen::MatrixXd& errors : of_tau) sum += recalled(errors);
    return sum;
  }

  const ReconstructionEvaluator& evaluator_;
  const std::vector<ReconstructedObject>& estimates_;
  const ScoredImage& image_;
  std::vector<Pose> truth_poses_, estimate_poses_;  // T_cam_object
  std::vector<ObjectView> truth_views_;
  std::vector<bool> targets_;
  std::vector<double> scores_;
};

}  // namespace

std::vector<EstimateErrors> estimate_errors(const ReconstructionEvaluator& evaluator,
                                            const Reconstruction& reconstruction) {
  std::vector<EstimateErrors> errors;
  const auto matches = evaluator.matches(reconstruction);
  for (std::size_t e = 0; e < matches.size(); ++e) {
    if (!matches[e]) continue;
    const std::size_t t = matches[e]->truth;
    const ErrorModel& model = evaluator.model_of(t);
    const Pose& estimate = reconstruction.objects[e].T_world_object;
    const Pose& truth = evaluator.truth()[t].T_world_object;
    errors.push_back({e, t, translation_error_m(estimate, truth),
                      rotation_error_rad(estimate, truth), add_m(model, estimate, truth),
                      add_s_m(model, estimate, truth), mssd_m(model, estimate, truth)});
  }
  return errors;
}

std::optional<BopScores> bop_scores(const ReconstructionEvaluator& evaluator,
                                    const Reconstruction& reconstruction,
                                    std::span<const ScoredImage> images) {
  std::vector<ImageScore> of_image(images.size());
  tbb::parallel_for(std::size_t(0), images.size(), [&](std::size_t i) {
    of_image[i] = ImageJudge(evaluator, reconstruction, images[i]).score();
  });
  ImageScore sum;
  std::size_t with_depth = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    sum.targets += of_image[i].targets;
    sum.mssd += of_image[i].mssd;
    sum.mspd += of_image[i].mspd;
    sum.vsd += of_image[i].vsd;
    if (images[i].depth) with_depth += of_image[i].targets;
  }
  if (sum.targets == 0) return {};
  const double thresholds = double(bop_thresholds().size());
  BopScores scores{sum.targets, double(sum.mssd) / (thresholds * double(sum.targets)),
                   double(sum.mspd) / (thresholds * double(sum.targets))};
  if (with_depth > 0) {
    scores.ar_vsd = double(sum.vsd) / (thresholds * thresholds * double(with_depth));
  }
  return scores;
}

}  // namespace vantage
